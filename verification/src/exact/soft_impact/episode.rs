//! The motion between two instants at which the set of contacts changes.

use std::array::from_fn;
use std::f64::consts::PI;

use super::{DampingMass, Law, Motion, PlanarBody, Point, Sharing};
use crate::exact::extrapolation::{COLUMNS, State, Step, extrapolate, root};
use crate::exact::rigid_cylinder_impact::FlyingPoint;

/// Error allowed to the longest steps, relative to the scales of the impact, and in proportion to shorter ones: there are many where
/// weights by overlap change fast, because points touch or leave almost together.
pub(super) const TOLERANCE: f64 = 1e-14;

/// Heights that differ by less, relative to the size of the body, are equal.
const ROUNDING: f64 = 1e-15;

/// Steps shorter than this part of a period are not tried: the law makes no sense.
const SHORTEST_STEP: f64 = 1e-18;

/// What stays the same throughout a motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Setting<'a> {
    pub(super) body: &'a PlanarBody,
    pub(super) law: &'a Law,
    pub(super) approach: f64,
    pub(super) tolerance: f64,
}

impl Setting<'_> {
    pub(super) fn motion(self, tilt: f64, duration: f64) -> Motion {
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
pub(super) struct Contact {
    pub(super) overlap: f64,
    /// Rate of the overlap.
    rate: f64,
    arm: f64,
}

/// From the touch of one point until no point touches. Everything is measured from the start, so that overlaps are not differences of large
/// numbers.
pub(super) struct Episode<'a> {
    setting: Setting<'a>,
    spots: Vec<Spot>,
    /// Height of the centre of mass and tilt at the start.
    start: [f64; 2],
    pub(super) state: State,
    pub(super) time: f64,
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
    pub(super) fn new(setting: Setting<'a>, tilt: f64, [velocity, tilt_rate]: [f64; 2]) -> Episode<'a> {
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

    pub(super) fn touches(&self) -> bool {
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

    pub(super) fn contacts(&self, state: &State) -> Vec<Contact> {
        let pose = self.pose(state);
        self.spots.iter().filter(|spot| spot.touches).map(|spot| self.contact(spot, state, &pose)).collect()
    }

    /// Total force and torque that raises the tilt.
    pub(super) fn loads(&self, state: &State) -> [f64; 2] {
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
    pub(super) fn advance(&mut self, until: f64) {
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
        extrapolate(|_, state| self.derivative(state), &self.state, slope, length, &unit)
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
