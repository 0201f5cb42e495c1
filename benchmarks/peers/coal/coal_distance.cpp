// Cost of Coal's distance for the pairs of benchmarks/benches/narrow_phase.rs: cubes and cylinders of size 1, 0 to 5 % of the size apart.
#include <coal/distance.h>
#include <coal/shape/geometric_shapes.h>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

static double thread_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

struct Pair { coal::Transform3s first, second; coal::Vec3s guess; double gap; };

static void measure(const char* name, const coal::ShapeBase& first, const coal::ShapeBase& second) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> even;
  auto vector = [&] { return coal::Vec3s(normal(generator), normal(generator), normal(generator)); };
  auto rotation = [&] {
    Eigen::Quaterniond turn(normal(generator), normal(generator), normal(generator), normal(generator));
    return turn.normalized().toRotationMatrix();
  };
  coal::DistanceRequest request(true);
  request.gjk_tolerance = 1e-6;
  std::vector<Pair> pairs;
  for (int index = 0; index < 2000; ++index) {
    coal::Transform3s own(rotation(), coal::Vec3s(vector())), far(rotation(), coal::Vec3s(own.getTranslation() + vector().normalized() * 5.0));
    coal::DistanceResult result;
    coal::distance(&first, own, &second, far, request, result);
    const double gap = 0.05 * even(generator);
    const coal::Vec3s way = (result.nearest_points[1] - result.nearest_points[0]).normalized();
    far.setTranslation(far.getTranslation() - way * (result.min_distance - gap));
    const coal::Vec3s guess = own.getRotation().transpose() * (-(way + 1e-3 * vector().normalized()));
    pairs.push_back({own, far, guess, gap});
  }
  for (bool is_warm : {false, true}) {
    request.gjk_initial_guess = is_warm ? coal::GJKInitialGuess::CachedGuess : coal::GJKInitialGuess::DefaultGuess;
    std::vector<double> costs;
    double worst = 0.0;
    for (int repeat = 0; repeat < 40; ++repeat) {
      const double start = thread_seconds();
      for (const Pair& pair : pairs) {
        coal::DistanceResult result;
        if (is_warm) request.cached_gjk_guess = pair.guess * std::max(pair.gap, 1e-3);
        coal::distance(&first, pair.first, &second, pair.second, request, result);
        worst = std::max(worst, std::abs(result.min_distance - pair.gap));
      }
      costs.push_back((thread_seconds() - start) / pairs.size() * 1e9);
    }
    std::sort(costs.begin(), costs.end());
    std::printf("%s, %s: median %.0f, least %.0f ns a question, largest error %.1e\n", name, is_warm ? "warm" : "cold", costs[costs.size() / 2], costs[0], worst);
  }
}

int main() {
  coal::Box cube(1.0, 1.0, 1.0);
  coal::Cylinder cylinder(0.5, 1.0);
  measure("cubes", cube, cube);
  measure("cylinders", cylinder, cylinder);
  measure("cube and cylinder", cube, cylinder);
}
