//! The soft impact of a rigid body on a plane wall without friction or gravity, in the plane: the ordinary differential equation of the
//! contact law solved to about 1e-13, by extrapolation, with steps that end at every touch and release.
//!
//! The axis of the body points along $(\sin\theta, \cos\theta)$ in $(x, z)$, its radius along $(\cos\theta, -\sin\theta)$. A contact point
//! with body coordinates $(u, w)$ and a radius $r$ of its own has the height $h = z + u \cos\theta - w \sin\theta - r$ above the wall $z =
//! 0$, the horizontal arm $x = u \sin\theta + w \cos\theta$, and $\partial h/\partial\theta = -x$. With overlaps $d_j = -h_j$, $F_j = q_j
//! (k d_j + c \dot d_j)$ and $c = 2 \zeta \sqrt{k m_d}$ divided according to [`Sharing`], $M \ddot z = \sum F_j$ and $I \ddot\theta = -\sum
//! F_j x_j$. A contact lasts until its overlap is zero: its force may pull just before. In between, bodies fly freely, which has a closed
//! form.

use super::extrapolation::{COLUMNS, State, Step, extrapolate, root};
use super::rigid_cylinder_impact::FlyingPoint;
use std::array::from_fn;
use std::f64::consts::PI;

/// A point at which the body may touch the wall: sharp, or the centre of a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Coordinate along the axis in m.
    pub axial: f64,
    /// Coordinate along the radius in the plane of the motion, in m.
    pub radial: f64,
    /// Radius of the sphere about the point in m; zero for a sharp point.
    pub radius: f64,
}

/// A rigid body that moves in a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarBody {
    /// Mass in kg.
    pub mass: f64,
    /// Moment of inertia about the axis across the plane, in kg m^2.
    pub inertia: f64,
    /// Contact points, from the centre of mass; points that coincide count each.
    pub points: Vec<Point>,
}

/// How several contacts share one law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Weights $d_j / \sum d$. Such springs have no potential: impacts without damping gain or lose energy.
    ByOverlap,
    /// Weights $1/N$: R's model B. The weights jump when a contact begins or ends, and with them the energy: a cylinder that comes down
    /// almost flat without damping may leave with twice its energy.
    ByCount,
    /// Weights of one, $N$ contacts as stiff as $N$ springs, each dashpot divided by $\sqrt N$: R's model A with eq. 3.35 corrected.
    Sum,
    /// As `Sum` with R's printed 3.35, which at a wall doubles the dashpot: a target of 0.85 gives 0.7216. R 3.31-3.36 mix the pair of
    /// equal spheres with the wall; at $N = 1$ they must reduce to 3.22 and 3.27.
    SumAsPrinted,
}

/// The mass $m_d$ that the dashpot is set by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DampingMass {
    /// The body's mass, the reduced mass of body and wall. Beside the centre of mass the body is lighter than that: the dashpot is too
    /// strong and stiff contacts do not tend to the rigid impact of their restitution.
    Reduced,
    /// $1/m_d = 1/M + X^2/I$ with the mean arm $X = \sum q_j x_j / \sum q_j$. Stiff contacts of one point tend to the rigid impact, as
    /// $k^{-1/2}$.
    Effective,
}

/// A linear spring and dashpot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// Of the spring in N/m.
    pub stiffness: f64,
    /// That the dashpot is set for, in (0, 1].
    pub restitution: f64,
    /// Among several contacts.
    pub sharing: Sharing,
    /// Of the dashpot.
    pub damping_mass: DampingMass,
}

/// The end of a motion, and what happened on the way. Not a number where a law or a body makes no sense.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Height of the centre of mass at the end, in m.
    pub height: f64,
    /// Its velocity in m/s, positive away from the wall.
    pub velocity: f64,
    /// Tilt at the end in rad.
    pub tilt: f64,
    /// Rate of the tilt in rad/s.
    pub tilt_rate: f64,
    /// From the first touch until no point touches, in s; none if that is not reached.
    pub contact_duration: Option<f64>,
    /// Times that the body came down on the wall.
    pub touches: usize,
    /// Largest overlap of any point in m.
    pub largest_overlap: f64,
    /// Largest force of all points together in N.
    pub largest_force: f64,
}

/// Motion of a body that comes down without spin, from the instant at which its lowest point is at the wall, for a duration in s.
pub fn impact(body: &PlanarBody, law: &Law, tilt: f64, approach: f64, duration: f64) -> Motion {
    Setting { body, law, approach, tolerance: TOLERANCE }.motion(tilt, duration)
}

/// Time and total force from the first touch until no point touches, or for a duration if that is shorter, at the middles of so many equal
/// parts: both ends are jumps.
pub fn force_history(body: &PlanarBody, law: &Law, tilt: f64, approach: f64, duration: f64, samples: usize) -> Vec<[f64; 2]> {
    let setting = Setting { body, law, approach, tolerance: TOLERANCE };
    let mut whole = Episode::new(setting, tilt, [-approach, 0.0]);
    whole.advance(duration);
    let mut episode = Episode::new(setting, tilt, [-approach, 0.0]);
    let mut sample = |index: usize| {
        let time = whole.time * (index as f64 + 0.5) / samples as f64;
        episode.advance(time);
        [time, episode.loads(&episode.state)[0]]
    };
    (0..samples).map(&mut sample).collect()
}

/// Four points of each rim of a cylinder: two in the plane of the motion, two beside it that lie on the axis when seen across the plane.
pub fn cylinder_points(radius: f64, length: f64) -> Vec<Point> {
    sliced_cylinder_points(radius, length, 1)
}

/// The rim points of a number of thinner cylinders glued in a row; those of faces that are glued together count twice.
pub fn sliced_cylinder_points(radius: f64, length: f64, slices: usize) -> Vec<Point> {
    let face = |index: usize| 0.5 * length * (2.0 * index as f64 - slices as f64) / slices as f64;
    let rim = move |axial: f64| [radius, -radius, 0.0, 0.0].map(|radial| Point { axial, radial, radius: 0.0 });
    (0..slices).flat_map(|slice| [face(slice), face(slice + 1)]).flat_map(rim).collect()
}

/// Error allowed to the longest steps, relative to the scales of the impact, and in proportion to shorter ones: there are many where
/// weights by overlap change fast, because points touch or leave almost together.
const TOLERANCE: f64 = 1e-14;

/// Heights that differ by less, relative to the size of the body, are equal.
const ROUNDING: f64 = 1e-15;

/// Steps shorter than this part of a period are not tried: the law makes no sense.
const SHORTEST_STEP: f64 = 1e-18;

/// What stays the same throughout a motion.
#[derive(Debug, Clone, Copy)]
struct Setting<'a> {
    body: &'a PlanarBody,
    law: &'a Law,
    approach: f64,
    tolerance: f64,
}

impl Setting<'_> {
    fn motion(self, tilt: f64, duration: f64) -> Motion {
        let mut episode = Episode::new(self, tilt, [-self.approach, 0.0]);
        let (mut time, mut contact_duration) = (0.0, None);
        let (mut touches, mut largest_overlap, mut largest_force) = (0, 0.0_f64, 0.0_f64);
        loop {
            episode.advance(duration - time);
            time += episode.time;
            touches += 1;
            largest_overlap = largest_overlap.max(episode.largest_overlap);
            largest_force = largest_force.max(episode.largest_force);
            let ended = !episode.touches();
            if touches == 1 && ended {
                contact_duration = Some(episode.time);
            }
            let [height, velocity, tilt, tilt_rate] = episode.now();
            let rest = duration - time;
            let fall = |point: &Point| {
                FlyingPoint::new(point.axial, point.radial, [height - point.radius, velocity], [tilt, tilt_rate]).first_touch(rest)
            };
            let next = self.body.points.iter().filter_map(fall).min_by(f64::total_cmp);
            match next {
                Some(flight) if ended => {
                    time += flight;
                    episode = Episode::new(self, tilt + tilt_rate * flight, [velocity, tilt_rate]);
                }
                _ => {
                    let (height, tilt) = (height + velocity * rest, tilt + tilt_rate * rest);
                    return Motion { height, velocity, tilt, tilt_rate, contact_duration, touches, largest_overlap, largest_force };
                }
            }
        }
    }

    /// Scales of the impact in the order of the state.
    fn scales(&self) -> State {
        let period = (self.body.mass / self.law.stiffness).sqrt();
        let turn = self.approach * (self.body.mass / self.body.inertia).sqrt();
        [self.approach * period, self.approach, turn * period, turn]
    }
}

/// A point of the body during an episode.
#[derive(Debug, Clone, Copy)]
struct Spot {
    point: Point,
    /// Above the wall at the start of the episode; exactly zero where it differs from that by rounding.
    height: f64,
    touches: bool,
}

/// What all points need of a state: chord and middle of the turn give differences of sines and cosines without cancellation.
#[derive(Debug, Clone, Copy)]
struct Pose {
    sine: f64,
    cosine: f64,
    middle_sine: f64,
    middle_cosine: f64,
    chord: f64,
}

/// A point on the wall.
#[derive(Debug, Clone, Copy)]
struct Contact {
    overlap: f64,
    /// Rate of the overlap.
    rate: f64,
    arm: f64,
}

/// From the touch of one point until no point touches. Everything is measured from the start, so that overlaps are not differences of large
/// numbers.
struct Episode<'a> {
    setting: Setting<'a>,
    spots: Vec<Spot>,
    /// Height of the centre of mass and tilt at the start.
    start: [f64; 2],
    state: State,
    time: f64,
    /// Length of the next step to try, and the longest allowed: a small part of the fastest period, so that nothing happens twice in a
    /// step.
    trial: f64,
    longest: f64,
    /// Difference of heights that is rounding.
    rounding: f64,
    largest_overlap: f64,
    largest_force: f64,
}

impl<'a> Episode<'a> {
    /// The lowest point is at the wall.
    fn new(setting: Setting<'a>, tilt: f64, [velocity, tilt_rate]: [f64; 2]) -> Episode<'a> {
        let Setting { body, law, .. } = setting;
        let (sine, cosine) = tilt.sin_cos();
        let above_centre = |point: &Point| point.axial * cosine - point.radial * sine - point.radius;
        let lowest = body.points.iter().map(above_centre).fold(f64::INFINITY, f64::min);
        let reach = body.points.iter().map(|point| point.axial.hypot(point.radial) + point.radius).fold(0.0, f64::max);
        let rounding = ROUNDING * reach;
        let spot = |point: &Point| {
            let height = above_centre(point) - lowest;
            let touches = height <= rounding;
            Spot { point: *point, height: if touches { 0.0 } else { height }, touches }
        };
        let springs = if matches!(law.sharing, Sharing::Sum | Sharing::SumAsPrinted) { body.points.len() as f64 } else { 1.0 };
        let longest = 0.5 / (springs * law.stiffness * (1.0 / body.mass + reach * reach / body.inertia)).sqrt();
        Episode {
            setting,
            spots: body.points.iter().map(spot).collect(),
            start: [-lowest, tilt],
            state: [0.0, velocity, 0.0, tilt_rate],
            time: 0.0,
            trial: longest,
            longest,
            rounding,
            largest_overlap: 0.0,
            largest_force: 0.0,
        }
    }

    fn touches(&self) -> bool {
        self.spots.iter().any(|spot| spot.touches)
    }

    /// Height, velocity, tilt and its rate.
    fn now(&self) -> State {
        let [displacement, velocity, turn, rate] = self.state;
        [self.start[0] + displacement, velocity, self.start[1] + turn, rate]
    }

    /// Overlap, its rate and arm of a point, negative above the wall.
    fn contact(&self, spot: &Spot, state: &State, pose: &Pose) -> Contact {
        let Point { axial, radial, .. } = spot.point;
        let [displacement, velocity, _, tilt_rate] = *state;
        let rise = displacement - pose.chord * (axial * pose.middle_sine + radial * pose.middle_cosine);
        let arm = axial * pose.sine + radial * pose.cosine;
        Contact { overlap: -(spot.height + rise), rate: tilt_rate * arm - velocity, arm }
    }

    fn pose(&self, state: &State) -> Pose {
        let turn = state[2];
        let (sine, cosine) = (self.start[1] + turn).sin_cos();
        let (middle_sine, middle_cosine) = (self.start[1] + 0.5 * turn).sin_cos();
        Pose { sine, cosine, middle_sine, middle_cosine, chord: 2.0 * (0.5 * turn).sin() }
    }

    fn contacts(&self, state: &State) -> Vec<Contact> {
        let pose = self.pose(state);
        self.spots.iter().filter(|spot| spot.touches).map(|spot| self.contact(spot, state, &pose)).collect()
    }

    /// Total force and torque that raises the tilt.
    fn loads(&self, state: &State) -> [f64; 2] {
        let Setting { body, law, .. } = self.setting;
        let contacts = self.contacts(state);
        let count = contacts.len() as f64;
        let overlaps: f64 = contacts.iter().map(|contact| contact.overlap).sum();
        let rates: f64 = contacts.iter().map(|contact| contact.rate).sum();
        let weight = |contact: &Contact| match law.sharing {
            // The limit at a touch of several points at once.
            Sharing::ByOverlap if overlaps == 0.0 => contact.rate / rates,
            Sharing::ByOverlap => contact.overlap / overlaps,
            Sharing::ByCount => 1.0 / count,
            Sharing::Sum | Sharing::SumAsPrinted => 1.0,
        };
        let weights: f64 = contacts.iter().map(weight).sum();
        let arm = contacts.iter().map(|contact| weight(contact) * contact.arm).sum::<f64>() / weights;
        let damping_mass = match law.damping_mass {
            DampingMass::Reduced => body.mass,
            DampingMass::Effective => 1.0 / (1.0 / body.mass + arm * arm / body.inertia),
        };
        let damping_ratio = -law.restitution.ln() / PI.hypot(law.restitution.ln());
        let of_one = 2.0 * damping_ratio * (law.stiffness * damping_mass).sqrt();
        let dashpot = match law.sharing {
            Sharing::ByOverlap | Sharing::ByCount => of_one,
            Sharing::Sum => of_one / count.sqrt(),
            Sharing::SumAsPrinted => 2.0 * of_one / count.sqrt(),
        };
        contacts.iter().fold([0.0; 2], |[force, torque], contact| {
            let own = weight(contact) * (law.stiffness * contact.overlap + dashpot * contact.rate);
            [force + own, torque - own * contact.arm]
        })
    }

    fn derivative(&self, state: &State) -> State {
        let [force, torque] = self.loads(state);
        [state[1], force / self.setting.body.mass, state[3], torque / self.setting.body.inertia]
    }

    /// Steps until a time, or until no point touches.
    fn advance(&mut self, until: f64) {
        while self.touches() && self.time < until {
            let rest = until - self.time;
            let slope = self.derivative(&self.state);
            let length = self.trial.min(rest);
            let step = self.step(&slope, length);
            if !step.converged && length > SHORTEST_STEP * self.longest {
                self.trial = 0.5 * length;
                continue;
            }
            if !step.converged {
                self.state = [f64::NAN; 4];
                return;
            }
            if step.columns + 2 < COLUMNS {
                self.trial = self.longest.min(1.5 * self.trial);
            }
            let event = self.first_event(&slope, length, step.end);
            let (taken, end) = event.map_or((length, step.end), |(_, time)| (time, self.step(&slope, time).end));
            self.largest_overlap = self.largest_overlap.max(self.peak(&slope, taken, &end, Episode::deepest));
            self.largest_force = self.largest_force.max(self.peak(&slope, taken, &end, Episode::force_and_rate));
            self.time = if taken == rest { until } else { self.time + taken };
            self.state = end;
            if let Some((spot, _)) = event {
                self.change_contacts(spot);
            }
        }
    }

    fn step(&self, slope: &State, length: f64) -> Step {
        let allowed = self.setting.tolerance * length / self.longest;
        let unit = self.setting.scales().map(|scale| scale * allowed);
        extrapolate(|state| self.derivative(state), &self.state, slope, length, &unit)
    }

    /// How far a point is beyond its next event, and the rate of that: a touch if it is above the wall, a release if it touches.
    fn excess(&self, spot: &Spot, state: &State, pose: &Pose) -> [f64; 2] {
        let contact = self.contact(spot, state, pose);
        let sign = if spot.touches { -1.0 } else { 1.0 };
        [sign * contact.overlap, sign * contact.rate]
    }

    /// The first event of a step: its point and time.
    fn first_event(&self, slope: &State, length: f64, mut end: State) -> Option<(usize, f64)> {
        let pose = self.pose(&self.state);
        let mut end_pose = self.pose(&end);
        let mut first: Option<(usize, f64)> = None;
        for (index, spot) in self.spots.iter().enumerate() {
            let both_ends = [self.excess(spot, &self.state, &pose), self.excess(spot, &end, &end_pose)];
            let (until, beyond) = first.map_or((length, 0.0), |(_, time)| (time, self.rounding));
            if let Some(time) = self.event_of(spot, slope, until, both_ends, beyond) {
                first = Some((index, time));
                end = self.step(slope, time).end;
                end_pose = self.pose(&end);
            }
        }
        first
    }

    /// When a point has its event in a part of a step, given its excess and rate at both ends, if that takes it beyond so much.
    fn event_of(&self, spot: &Spot, slope: &State, length: f64, both_ends: [[f64; 2]; 2], beyond: f64) -> Option<f64> {
        let [[_, rate], [end_excess, end_rate]] = both_ends;
        let at = |time: f64| {
            let state = self.step(slope, time).end;
            self.excess(spot, &state, &self.pose(&state))
        };
        if end_excess > beyond {
            // A point that has just had an event first goes away from it.
            let low = if rate < 0.0 { root(|time| at(time)[1], 0.0, length) } else { 0.0 };
            return Some(root(|time| at(time)[0], low, length));
        }
        let there_and_back = rate > 0.0 && end_rate < 0.0;
        let furthest = there_and_back.then(|| root(|time| -at(time)[1], 0.0, length))?;
        (at(furthest)[0] > beyond).then(|| root(|time| at(time)[0], 0.0, furthest))
    }

    /// Begins or ends the contact of a point, and with it all that do the same in this instant.
    fn change_contacts(&mut self, index: usize) {
        let pose = self.pose(&self.state);
        let happens = |spot: &Spot| {
            let [excess, rate] = self.excess(spot, &self.state, &pose);
            excess >= -self.rounding && rate > 0.0
        };
        let changes: Vec<bool> = self.spots.iter().map(happens).collect();
        for (other, (spot, changes)) in self.spots.iter_mut().zip(changes).enumerate() {
            spot.touches ^= changes || other == index;
        }
    }

    /// Largest value in a step of a measure, given with its rate.
    fn peak(&self, slope: &State, length: f64, end: &State, measure: fn(&Episode<'a>, &State) -> [f64; 2]) -> f64 {
        let ([value, rate], [end_value, end_rate]) = (measure(self, &self.state), measure(self, end));
        let at = |time: f64| measure(self, &self.step(slope, time).end);
        let turns = rate > 0.0 && end_rate < 0.0;
        let inside = if turns { at(root(|time| -at(time)[1], 0.0, length))[0] } else { value };
        value.max(end_value).max(inside)
    }

    /// The largest overlap and its rate.
    fn deepest(&self, state: &State) -> [f64; 2] {
        let deeper = |[overlap, rate]: [f64; 2], contact: Contact| {
            if contact.overlap > overlap { [contact.overlap, contact.rate] } else { [overlap, rate] }
        };
        self.contacts(state).into_iter().fold([f64::NEG_INFINITY, 0.0], deeper)
    }

    /// The total force and its rate, by a central difference along the motion: good enough to find where it turns.
    fn force_and_rate(&self, state: &State) -> [f64; 2] {
        let slope = self.derivative(state);
        let apart = 1e-5 * self.longest;
        let force = |time: f64| self.loads(&from_fn(|part| state[part] + time * slope[part]))[0];
        [force(0.0), (force(apart) - force(-apart)) / (2.0 * apart)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::linear_contact::LinearContact;
    use crate::exact::rigid_cylinder_impact::CylinderImpact;

    const RESTITUTION: f64 = 0.85;
    const LAW: Law = Law { stiffness: 1e6, restitution: RESTITUTION, sharing: Sharing::ByOverlap, damping_mass: DampingMass::Effective };
    const RIGID: CylinderImpact =
        CylinderImpact { radius: 4e-3, length: 5.3e-3, mass: 3.1e-4, inertia: 1.966e-9, approach: 1.0, restitution: RESTITUTION };
    const MASSES: [DampingMass; 2] = [DampingMass::Reduced, DampingMass::Effective];

    fn body(points: Vec<Point>) -> PlanarBody {
        PlanarBody { mass: RIGID.mass, inertia: RIGID.inertia, points }
    }

    fn cylinder() -> PlanarBody {
        body(cylinder_points(RIGID.radius, RIGID.length))
    }

    /// Largest of the differences of velocity and spin, the latter as a velocity at the radius of gyration; the approach has 1 m/s.
    fn difference(one: &Motion, velocity: f64, tilt_rate: f64) -> f64 {
        (one.velocity - velocity).abs().max((one.tilt_rate - tilt_rate).abs() * (RIGID.inertia / RIGID.mass).sqrt())
    }

    fn is(value: f64, expected: f64) -> bool {
        (value / expected - 1.0).abs() < 1e-12
    }

    /// Exact: one contact below the centre of mass.
    #[test]
    fn one_point_is_the_closed_form() {
        let body = body(vec![Point { axial: -0.5 * RIGID.length, radial: 0.0, radius: 0.0 }]);
        let (closed, period) = (LinearContact::until_zero_overlap(RESTITUTION), (body.mass / LAW.stiffness).sqrt());
        for damping_mass in MASSES {
            let motion = impact(&body, &Law { damping_mass, ..LAW }, 0.0, 1.0, 1e-3);
            assert!(is(motion.velocity, RESTITUTION) && motion.tilt_rate == 0.0, "{motion:?}");
            assert!(motion.contact_duration.is_some_and(|duration| is(duration, closed.duration * period)), "{motion:?}");
            assert!(is(motion.largest_overlap, closed.largest_overlap * period), "{motion:?}");
        }
    }

    /// Exact: the face has four contacts and the side line two, which touch and leave together.
    #[test]
    fn flat_contacts_rebound_without_spin() {
        let damping_ratio = 2.0 * LinearContact::until_zero_overlap(RESTITUTION).damping_ratio;
        let as_printed = (-PI * damping_ratio / (1.0 - damping_ratio * damping_ratio).sqrt()).exp();
        assert!((as_printed - 0.7216).abs() < 5e-5);
        let whole = LinearContact::until_zero_overlap(RESTITUTION).duration * (RIGID.mass / LAW.stiffness).sqrt();
        for (tilt, count) in [(0.0, 4.0_f64), (0.5 * PI, 2.0)] {
            for (sharing, velocity, duration) in [
                (Sharing::ByOverlap, RESTITUTION, Some(whole)),
                (Sharing::ByCount, RESTITUTION, Some(whole)),
                (Sharing::Sum, RESTITUTION, Some(whole / count.sqrt())),
                (Sharing::SumAsPrinted, as_printed, None),
            ] {
                for damping_mass in MASSES {
                    let motion = impact(&cylinder(), &Law { sharing, damping_mass, ..LAW }, tilt, 1.0, 1e-3);
                    assert!(is(motion.velocity, velocity) && motion.touches == 1, "{motion:?}");
                    assert!(difference(&motion, motion.velocity, 0.0) < 1e-14, "{motion:?}");
                    assert!(duration.zip(motion.contact_duration).is_none_or(|(expected, found)| is(found, expected)), "{motion:?}");
                }
            }
        }
    }

    /// Exact: without damping energy is kept, and spin and momentum are exchanged at an arm that the contact had.
    #[test]
    fn an_elastic_oblique_impact_keeps_energy() {
        let tilt = 0.25 * PI;
        let motion = impact(&cylinder(), &Law { restitution: 1.0, ..LAW }, tilt, 1.0, 6e-5);
        let energy = motion.velocity.powi(2) + RIGID.inertia / RIGID.mass * motion.tilt_rate.powi(2);
        assert!(is(energy, 1.0), "{energy}");
        let mean_arm = -RIGID.inertia * motion.tilt_rate / (RIGID.mass * (motion.velocity + 1.0));
        assert!(mean_arm > RIGID.arm(tilt) && mean_arm < RIGID.arm(motion.tilt), "{mean_arm}");
    }

    /// Independent: the closed form of the rigid impact, approached as one over the root of the stiffness. Seen: orders within 2e-4 of a
    /// half.
    #[test]
    fn stiff_contacts_approach_the_rigid_impact() {
        for (restitution, degrees) in [(1.0, 45.0_f64), (RESTITUTION, 45.0), (RESTITUTION, 35.0), (RESTITUTION, 70.0)] {
            let tilt = degrees.to_radians();
            let rigid = CylinderImpact { restitution, ..RIGID }.after_impact(tilt);
            let error = |stiffness: f64| {
                let motion = impact(&cylinder(), &Law { stiffness, restitution, ..LAW }, tilt, 1.0, 1e-3);
                difference(&motion, rigid.velocity, -rigid.angular_velocity)
            };
            let order = (error(1e8) / error(1e10)).log10() / 2.0;
            println!("e = {restitution}, {degrees} degrees: order {order} in the stiffness");
            assert!((order - 0.5).abs() < 1e-3, "{order}");
        }
    }

    /// Independent: another program for the same equations in arithmetic of 32 digits, with coordinates from the wall.
    #[test]
    fn motions_match_another_program() {
        let [overlap, count, sum] = [Sharing::ByOverlap, Sharing::ByCount, Sharing::Sum];
        let [reduced, effective] = MASSES;
        for (sharing, damping_mass, degrees, velocity, tilt_rate, duration) in [
            (overlap, effective, 0.2_f64, 0.631_965_211_828_597_6, 223.488_229_202_379_5, 6.033_922_537_128_933e-5),
            (overlap, reduced, 89.9, 0.777_266_128_036_247_3, -112.278_663_138_879_08, 5.847_775_907_698_189e-5),
            (count, effective, 0.2, 0.732_847_510_418_421_7, 181.693_867_641_395_66, 6.889_980_765_638_479e-5),
            (sum, reduced, 89.9, 0.823_193_652_637_398_7, -17.111_763_248_500_73, 4.811_256_107_504_179e-5),
        ] {
            let motion = impact(&cylinder(), &Law { sharing, damping_mass, ..LAW }, degrees.to_radians(), 1.0, 1.001 * duration);
            assert!(difference(&motion, velocity, tilt_rate) < 1e-12, "{motion:?}");
            assert!(motion.contact_duration.is_some_and(|found| is(found, duration)), "{motion:?}");
        }
        let spheres = [(-1.5e-3, 0.0, 1e-3), (1.4e-3, 5e-4, 1.1e-3)].map(|(axial, radial, radius)| Point { axial, radial, radius });
        let soft = Law { stiffness: 1e4, restitution: 0.6, ..LAW };
        let motion = impact(&body(spheres.to_vec()), &soft, 80_f64.to_radians(), 1.0, 2e-3);
        assert!(difference(&motion, 0.603_778_363_428_811_2, -74.493_320_816_861) < 1e-12, "{motion:?}");
        assert!(is(motion.height, 2.161_082_181_734_166e-3) && is(motion.tilt, 1.234_253_705_765_368_2), "{motion:?}");
    }

    /// Consistency: what the tolerance leaves open.
    #[test]
    fn a_third_of_the_tolerance_changes_nothing() {
        for sharing in [Sharing::ByOverlap, Sharing::ByCount, Sharing::Sum] {
            for tilt in [1e-6, 0.01, 0.2, 5.0, 45.0, 80.0, 89.9, 89.9999].map(f64::to_radians) {
                let (law, body) = (Law { sharing, ..LAW }, cylinder());
                let coarse = impact(&body, &law, tilt, 1.0, 0.01);
                let fine = Setting { body: &body, law: &law, approach: 1.0, tolerance: TOLERANCE / 3.0 }.motion(tilt, 0.01);
                assert!(difference(&coarse, fine.velocity, fine.tilt_rate) < 1e-12, "{coarse:?} {fine:?}");
                assert!(is(coarse.largest_force, fine.largest_force) && is(coarse.largest_overlap, fine.largest_overlap));
            }
        }
    }

    /// Exact: springs that simply add up store energy, also while both ends touch, and over several touches.
    #[test]
    fn added_springs_keep_energy() {
        let law = Law { stiffness: 1e3, restitution: 1.0, sharing: Sharing::Sum, ..LAW };
        let body = cylinder();
        let mut episode =
            Episode::new(Setting { body: &body, law: &law, approach: 1.0, tolerance: TOLERANCE }, 80_f64.to_radians(), [-1.0, 0.0]);
        let mut most = 0;
        while episode.touches() {
            episode.advance(episode.time + 5e-5);
            let contacts = episode.contacts(&episode.state);
            let stored: f64 = contacts.iter().map(|contact| law.stiffness * contact.overlap.powi(2)).sum();
            let moving = body.mass * episode.state[1].powi(2) + body.inertia * episode.state[3].powi(2);
            assert!(is((stored + moving) / body.mass, 1.0), "{} at {}", (stored + moving) / body.mass, episode.time);
            most = most.max(contacts.len());
        }
        assert_eq!(most, 2);
        let again = impact(&body, &Law { stiffness: 1e6, ..law }, 5_f64.to_radians(), 1.0, 0.01);
        assert!(is(again.velocity.powi(2) + body.inertia / body.mass * again.tilt_rate.powi(2), 1.0) && again.touches > 1, "{again:?}");
    }

    /// Seen, no theory: between one contact and four, weights that share one spring change the energy of an impact without damping.
    #[test]
    fn shared_springs_do_not_keep_energy() {
        for (sharing, degrees, kept) in
            [(Sharing::ByOverlap, 0.1_f64, 0.919), (Sharing::ByOverlap, 0.28, 1.296), (Sharing::ByCount, 0.32, 2.128)]
        {
            let motion = impact(&cylinder(), &Law { sharing, restitution: 1.0, ..LAW }, degrees.to_radians(), 1.0, 0.05);
            let energy = motion.velocity.powi(2) + RIGID.inertia / RIGID.mass * motion.tilt_rate.powi(2);
            assert!((energy - kept).abs() < 1e-3, "{energy}");
        }
    }

    /// Exact: the force adds up to the change of momentum, to the error of the midpoint rule with its kinks.
    #[test]
    fn the_history_adds_up_to_the_momentum() {
        let law = Law { sharing: Sharing::Sum, ..LAW };
        let (tilt, samples) = (89.9_f64.to_radians(), 2000);
        let motion = impact(&cylinder(), &law, tilt, 1.0, 1e-4);
        let history = force_history(&cylinder(), &law, tilt, 1.0, 1e-4, samples);
        let part = motion.contact_duration.expect("an end") / samples as f64;
        let impulse: f64 = history.iter().map(|[_, force]| force * part).sum();
        assert!((impulse / RIGID.mass - (1.0 + motion.velocity)).abs() < 1e-5, "{impulse}");
        assert!(history.iter().all(|[_, force]| *force <= motion.largest_force));
    }

    #[test]
    fn slices_have_glued_faces_twice() {
        let points = sliced_cylinder_points(1.0, 3.0, 3);
        let count = |axial: f64| points.iter().filter(|point| point.axial == axial).count();
        assert_eq!([-1.5, -0.5, 0.5, 1.5].map(count), [4, 8, 8, 4]);
        assert_eq!(points.iter().filter(|point| point.radial == 0.0).count(), 12);
    }
}
