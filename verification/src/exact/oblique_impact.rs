//! The oblique impact of a sphere on a wall or on another sphere, with friction: the ordinary differential equation of the coded contact laws solved
//! to about 1e-12 by extrapolation, with steps that end at every stick, slip and turn.
//!
//! Plane motion in polar form. With $n$ from the first to the second, $e = k \times n$, the tangential velocity $U$ of the first less the second centre, the spins
//! and the arms $a_i = r_i - \delta/2$ (the contact point lies in the middle of the overlap): slip $s = U + a_1 \omega_1 + a_2 \omega_2$,
//! $\ddot\delta = -F_n/m - U^2/d$, $\dot U = F_t/m + \dot\delta U/d$, $\dot\omega_i = a_i F_t / I_i$, and the normal turns by $-U/d$; a flat wall has $1/d = 0$.
//!
//! Contacts begin and end where their laws are singular ($\delta^{1/4}$). There the fourth root of the overlap stands for time: every law is smooth in it, and
//! the end of the contact is simply its zero.

mod motion;

use motion::Motion;

/// Normal law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normal {
    /// $k \delta + c \dot\delta$: stiffness in N/m and dashpot in N s/m.
    Linear(f64, f64),
    /// $K \delta^{3/2} + C \delta^{1/4} \dot\delta$: in N/m^(3/2) and N s/m^(5/4).
    Hertz(f64, f64),
}

impl Normal {
    /// The linear law with a restitution in (0, 1], for an effective mass in kg.
    pub fn linear(stiffness: f64, restitution: f64, mass: f64) -> Normal {
        Normal::Linear(stiffness, 2.0 * ratio(restitution) * (stiffness * mass).sqrt())
    }

    /// Hertz's law with Tsuji's dashpot.
    pub fn hertz(stiffness: f64, restitution: f64, mass: f64) -> Normal {
        Normal::Hertz(stiffness, 5.0_f64.sqrt() * ratio(restitution) * (stiffness * mass).sqrt())
    }
}

/// Damping ratio of a linear contact that ends at zero overlap.
fn ratio(restitution: f64) -> f64 {
    -restitution.ln() / std::f64::consts::PI.hypot(restitution.ln())
}

/// Tangential law, below the cap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tangential {
    /// A spring with memory in N/m.
    Spring(f64),
    /// A spring whose stiffness is this, in N/m^(3/2), times the root of the overlap; it loses stretch as in Thornton, Cummins and Cleary (2013).
    Mindlin(f64),
    /// A dashpot in N s/m.
    Dashpot(f64),
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Radius in m.
    pub radius: f64,
    /// Mass in kg.
    pub mass: f64,
    /// Moment of inertia in kg m^2.
    pub inertia: f64,
}

impl Sphere {
    /// A solid sphere of given radius in m and density in kg/m^3.
    pub fn solid(radius: f64, density: f64) -> Sphere {
        let mass = density * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
        Sphere { radius, mass, inertia: 0.4 * mass * radius * radius }
    }
}

/// The setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObliqueImpact {
    /// The first body.
    pub first: Sphere,
    /// The second; a wall if there is none.
    pub second: Option<Sphere>,
    /// Normal law.
    pub normal: Normal,
    /// Tangential law.
    pub tangential: Tangential,
    /// Coulomb coefficient.
    pub friction: f64,
    /// Whether the lever arms shrink by half the overlap and the normal turns, as in the solver; otherwise they stay as they were.
    pub moves: bool,
}

/// Velocities of the first relative to the second and both spins: before in the direction of the contact at first touch, and after in the same.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Velocities {
    /// Approach in m/s: along the normal at first touch.
    pub approach: f64,
    /// Of the centres across it, in m/s.
    pub tangential: f64,
    /// Spin of the first in rad/s; it adds to the slip.
    pub spin_of_first: f64,
    /// Spin of the second in rad/s.
    pub spin_of_second: f64,
}

/// The end of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// Velocities after.
    pub after: Velocities,
    /// Duration in s.
    pub duration: f64,
    /// Largest overlap in m.
    pub largest_overlap: f64,
    /// Turn of the normal in rad.
    pub turn: f64,
    /// Events on the way: stick, slip and release.
    pub events: usize,
}

impl ObliqueImpact {
    /// Effective mass along the normal in kg.
    pub fn normal_mass(&self) -> f64 {
        1.0 / (1.0 / self.first.mass + self.second.map_or(0.0, |second| 1.0 / second.mass))
    }

    /// Effective mass of the contact point along the plane at first touch, in kg.
    pub fn tangential_mass(&self) -> f64 {
        let turning = |sphere: Sphere| sphere.radius * sphere.radius / sphere.inertia;
        1.0 / (1.0 / self.normal_mass() + turning(self.first) + self.second.map_or(0.0, turning))
    }

    /// Slip velocity of the contact point in m/s, with the arms at first touch.
    pub fn slip(&self, velocities: &Velocities) -> f64 {
        let of_second = self.second.map_or(0.0, |second| second.radius * velocities.spin_of_second);
        velocities.tangential + self.first.radius * velocities.spin_of_first + of_second
    }

    /// The end of an impact that begins with given velocities, the approach above zero.
    pub fn after(&self, before: &Velocities) -> Outcome {
        Motion::new(self, before).run()
    }
}

#[cfg(test)]
mod tests {
    use super::super::hertz_contact::HertzContact;
    use super::super::linear_oblique_impact::LinearObliqueImpact;
    use super::super::rigid_oblique_impact::RigidObliqueImpact;
    use super::*;

    fn wall(normal: Normal, tangential: Tangential) -> ObliqueImpact {
        ObliqueImpact { first: Sphere::solid(0.005, 2500.0), second: None, normal, tangential, friction: 0.3, moves: false }
    }

    fn at(approach: f64, tangential: f64, spin: f64) -> Velocities {
        Velocities { approach, tangential, spin_of_first: spin, spin_of_second: 0.0 }
    }

    /// Independent: the pieces of closed form of the linear law, through stick, slip and spin.
    #[test]
    fn linear_impacts_are_those_of_the_closed_forms() {
        let mass = Sphere::solid(0.005, 2500.0).mass;
        for restitution in [1.0_f64, 0.9, 0.5] {
            let setting = wall(Normal::linear(1e5, restitution, mass), Tangential::Spring(4e4));
            let closed = LinearObliqueImpact {
                normal_mass: mass,
                tangential_mass: setting.tangential_mass(),
                stiffness: 1e5,
                damping_ratio: ratio(restitution),
                tangential_stiffness: 4e4,
                friction: 0.3,
            };
            for (tangential, spin) in [(0.1, 0.0), (0.5, 0.0), (1.0, 0.0), (3.0, 0.0), (0.0, 300.0), (1.0, -600.0), (0.0, 0.0)] {
                let before = at(1.0, tangential, spin);
                let (found, exact) = (setting.after(&before), closed.after(1.0, setting.slip(&before)));
                assert!((found.after.approach + exact.rebound).abs() < 1e-12, "{restitution} {tangential} {spin}: {found:?} {exact:?}");
                let slip = setting.slip(&found.after);
                assert!((slip - exact.slip).abs() < 1e-11, "{restitution} {tangential} {spin}: {slip} {exact:?}");
            }
        }
    }

    /// Closed forms: largest overlap and duration of Hertz's law, and the restitution of Tsuji's dashpot.
    #[test]
    fn head_on_impacts_on_hertz_springs_are_those_of_the_closed_forms() {
        let mass = Sphere::solid(0.005, 2500.0).mass;
        let stiffness = 1e9;
        let elastic = HertzContact::new(mass, stiffness, 2.0);
        for restitution in [1.0, 0.9, 0.3] {
            let found = wall(Normal::hertz(stiffness, restitution, mass), Tangential::Mindlin(1e9)).after(&at(2.0, 0.0, 0.0));
            assert!((found.after.approach + 2.0 * restitution).abs() < 1e-12, "{restitution}: {found:?}");
            if restitution == 1.0 {
                assert!((found.largest_overlap / elastic.largest_overlap - 1.0).abs() < 1e-13, "{found:?} {elastic:?}");
                assert!((found.duration / elastic.duration - 1.0).abs() < 1e-12, "{found:?} {elastic:?}");
            }
        }
    }

    /// Closed form: an impact that slides all along is that of rigid spheres, on every law.
    #[test]
    fn sliding_impacts_are_those_of_rigid_spheres() {
        let mass = Sphere::solid(0.005, 2500.0).mass;
        let rigid = RigidObliqueImpact { restitution: 1.0, friction: 0.3, tangential_restitution: 0.0 };
        for (normal, tangential) in [
            (Normal::linear(1e5, 1.0, mass), Tangential::Spring(4e4)),
            (Normal::hertz(1e9, 1.0, mass), Tangential::Mindlin(1e9)),
            (Normal::hertz(1e9, 1.0, mass), Tangential::Dashpot(1e6)),
        ] {
            let setting = wall(normal, tangential);
            let found = setting.after(&at(1.0, 8.0, 0.0)).after;
            assert!((setting.slip(&found) - rigid.slip_after(8.0)).abs() < 1e-12, "{found:?}");
        }
    }

    /// Independent: Hertz's and Mindlin's laws stepped two million times by an explicit scheme of first order.
    #[test]
    fn elastic_impacts_match_a_brute_force_integration() {
        let mass = Sphere::solid(0.005, 2500.0).mass;
        let (stiffness, tangential) = (1e9, 1.1e9);
        for (restitution, slip) in [(1.0_f64, 0.2), (1.0, 0.8), (0.8, -1.4), (0.8, 0.1)] {
            let setting = wall(Normal::hertz(stiffness, restitution, mass), Tangential::Mindlin(tangential));
            let found = setting.after(&at(1.0, slip, 0.0));
            let Normal::Hertz(_, damping) = setting.normal else { panic!("the law is Hertz's") };
            let step = found.duration / 2e6;
            let (mut overlap, mut rate, mut slip, mut spring) = (0.0_f64, 1.0_f64, slip, 0.0_f64);
            while overlap >= 0.0 {
                let last = overlap;
                overlap += rate * step;
                if overlap < 0.0 {
                    break;
                }
                let force = stiffness * overlap.powf(1.5) + damping * overlap.powf(0.25) * rate;
                let cap = (0.3 * force).max(0.0);
                let shrink = if overlap < last { (overlap / last).sqrt() } else { 1.0 };
                spring = (spring * shrink + tangential * overlap.sqrt() * slip * step).clamp(-cap, cap);
                rate -= force / mass * step;
                slip -= spring / setting.tangential_mass() * step;
            }
            let exact = setting.slip(&found.after);
            assert!((slip - exact).abs() < 1e-5 && (rate - found.after.approach).abs() < 1e-5, "{found:?}: {exact} {slip}, {rate}");
        }
    }

    /// Conservation: two unequal spheres keep their angular momentum about their common centre of mass while normal and arms move.
    #[test]
    fn two_spheres_keep_their_angular_momentum() {
        let (first, second) = (Sphere::solid(0.005, 2500.0), Sphere::solid(0.003, 2500.0));
        let shell = ObliqueImpact { second: Some(second), ..wall(Normal::Linear(1e5, 0.0), Tangential::Spring(4e4)) };
        let mass = shell.normal_mass();
        for (normal, tangential) in
            [(Normal::linear(1e5, 0.8, mass), Tangential::Spring(4e4)), (Normal::hertz(1e9, 0.8, mass), Tangential::Mindlin(1e9))]
        {
            let setting = ObliqueImpact { normal, tangential, moves: true, ..shell };
            let before = Velocities { approach: 1.0, tangential: 0.8, spin_of_first: 50.0, spin_of_second: -20.0 };
            let found = setting.after(&before);
            let spins = |now: &Velocities| first.inertia * now.spin_of_first + second.inertia * now.spin_of_second;
            // Along the path of the relative motion: lever arm after from the turn and the distance at the end, which is the sum of the radii.
            let distance = first.radius + second.radius;
            let tangential_after = found.after.tangential * found.turn.cos() - found.after.approach * found.turn.sin();
            let change = mass * distance * (tangential_after - before.tangential) - (spins(&found.after) - spins(&before));
            assert!(change.abs() < 1e-12 * mass * distance, "{change} {found:?}");
        }
    }
}
