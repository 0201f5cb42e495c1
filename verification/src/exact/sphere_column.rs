//! Spheres on a line between two plates, with linear springs and dashpots: the motion to rounding error, event by event.
//!
//! While the same contacts are closed the equations are linear and smooth. A step that would pass a change ends at it, where an overlap is zero, and the
//! next one begins with the other set of contacts. Each step is an extrapolation of order 20 ([`super::extrapolation`]).

use super::extrapolation::{State, extrapolate, root};

/// Spheres between a lower plate at zero and an upper one.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereColumn {
    /// Radii in m, from below.
    pub radii: Vec<f64>,
    /// Masses in kg.
    pub masses: Vec<f64>,
    /// Height of the upper plate in m.
    pub height: f64,
    /// Stiffness in N/m of every contact.
    pub stiffness: f64,
    /// Damping as a fraction of critical, of every contact with its own reduced mass.
    pub damping_ratio: f64,
    /// Downward acceleration in m/s^2.
    pub gravity: f64,
}

/// One instant of the motion: heights in m, then velocities in m/s.
#[derive(Debug, Clone, PartialEq)]
struct Node<const UNKNOWNS: usize> {
    time: f64,
    state: State<UNKNOWNS>,
    closed: Vec<bool>,
}

/// A motion, known at any time up to its end.
pub struct Motion<'a, const UNKNOWNS: usize> {
    column: &'a SphereColumn,
    nodes: Vec<Node<UNKNOWNS>>,
}

/// Step in radians of the fastest contact: short enough that no contact opens and closes within it.
const STEP_ANGLE: f64 = 0.1;

impl SphereColumn {
    /// Overlap in m of a contact and its rate in m/s: contact 0 is with the lower plate, the last with the upper one.
    fn overlap_and_rate<const UNKNOWNS: usize>(&self, contact: usize, state: &State<UNKNOWNS>) -> (f64, f64) {
        let count = self.radii.len();
        let below = |index: usize| (state[index] + self.radii[index], state[count + index]);
        let (lower, lower_rate) = if contact == 0 { (0.0, 0.0) } else { below(contact - 1) };
        let (upper, upper_rate) = match contact == count {
            true => (self.height, 0.0),
            false => (state[contact] - self.radii[contact], state[count + contact]),
        };
        (lower - upper, lower_rate - upper_rate)
    }

    fn inverse_reduced_mass(&self, contact: usize) -> f64 {
        let inverse = |index: Option<usize>| index.and_then(|index| self.masses.get(index)).map_or(0.0, |mass| 1.0 / mass);
        inverse(contact.checked_sub(1)) + inverse(Some(contact))
    }

    fn derivative<const UNKNOWNS: usize>(&self, closed: &[bool], state: &State<UNKNOWNS>) -> State<UNKNOWNS> {
        let count = self.radii.len();
        let mut derivative = [0.0; UNKNOWNS];
        derivative[..count].copy_from_slice(&state[count..]);
        derivative[count..].fill(-self.gravity);
        for contact in (0..=count).filter(|contact| closed[*contact]) {
            let (overlap, rate) = self.overlap_and_rate(contact, state);
            let dashpot = 2.0 * self.damping_ratio * (self.stiffness / self.inverse_reduced_mass(contact)).sqrt();
            let force = self.stiffness * overlap + dashpot * rate;
            if contact > 0 {
                derivative[count + contact - 1] -= force / self.masses[contact - 1];
            }
            if contact < count {
                derivative[count + contact] += force / self.masses[contact];
            }
        }
        derivative
    }

    fn after<const UNKNOWNS: usize>(&self, node: &Node<UNKNOWNS>, length: f64) -> State<UNKNOWNS> {
        let slope = self.derivative(&node.closed, &node.state);
        let unit = [f64::EPSILON * f64::EPSILON; UNKNOWNS];
        extrapolate(|_, state| self.derivative(&node.closed, state), &node.state, &slope, length, &unit).end
    }

    /// The motion from heights in m and rest until a time in s. `UNKNOWNS` is twice the number of spheres.
    pub fn motion<const UNKNOWNS: usize>(&self, heights: &[f64], end: f64) -> Motion<'_, UNKNOWNS> {
        let mut state = [0.0; UNKNOWNS];
        state[..heights.len()].copy_from_slice(heights);
        let contacts = 0..=self.radii.len();
        let closed = contacts.clone().map(|contact| self.overlap_and_rate(contact, &state).0 > 0.0).collect();
        let fastest = contacts.map(|contact| (self.stiffness * self.inverse_reduced_mass(contact)).sqrt()).fold(0.0, f64::max);
        // Several contacts of a body add up.
        let step = STEP_ANGLE / (2.0 * fastest);
        let mut nodes = vec![Node { time: 0.0, state, closed }];
        while nodes[nodes.len() - 1].time < end {
            nodes.push(self.next(&nodes[nodes.len() - 1], step));
        }
        Motion { column: self, nodes }
    }

    /// The next node: a step on, or at the first change of a contact.
    fn next<const UNKNOWNS: usize>(&self, node: &Node<UNKNOWNS>, step: f64) -> Node<UNKNOWNS> {
        let end = self.after(node, step);
        // What grows through zero when a contact changes.
        let change = |contact: usize, state: &State<UNKNOWNS>| {
            let overlap = self.overlap_and_rate(contact, state).0;
            if node.closed[contact] { -overlap } else { overlap }
        };
        let changing = (0..=self.radii.len()).filter(|contact| change(*contact, &end) > 0.0);
        let first = changing
            .map(|contact| (root(|length| change(contact, &self.after(node, length)), 0.0, step), contact))
            .min_by(|one, other| one.0.total_cmp(&other.0));
        let Some((length, contact)) = first else {
            return Node { time: node.time + step, state: end, closed: node.closed.clone() };
        };
        let mut closed = node.closed.clone();
        closed[contact] = !closed[contact];
        Node { time: node.time + length, state: self.after(node, length), closed }
    }
}

impl<const UNKNOWNS: usize> Motion<'_, UNKNOWNS> {
    /// Heights and velocities at a time in s before the end.
    pub fn at(&self, time: f64) -> State<UNKNOWNS> {
        let last = self.nodes.partition_point(|node| node.time <= time).max(1) - 1;
        let node = &self.nodes[last];
        self.column.after(node, time - node.time)
    }

    /// How often a contact opened or closed.
    pub fn changes(&self) -> usize {
        self.nodes.windows(2).filter(|pair| pair[0].closed != pair[1].closed).count()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn column(masses: &[f64], height: f64, damping_ratio: f64, gravity: f64) -> SphereColumn {
        SphereColumn { radii: vec![0.5; masses.len()], masses: masses.to_vec(), height, stiffness: 100.0, damping_ratio, gravity }
    }

    /// Two equal bodies squeezed evenly swing about the middle of their plates: closed form.
    #[test]
    fn a_squeezed_pair_swings_as_two_springs() {
        let column = column(&[1.0, 1.0], 1.9, 0.0, 0.0);
        let motion = column.motion::<4>(&[0.46, 1.44], 0.1);
        // The upper body is the mirror image of the lower: m y'' = k (0.5 - y) - k (2 y - 0.9), rest at 1.4/3.
        let (rest, frequency) = (1.4 / 3.0, 300.0_f64.sqrt());
        for time in [0.013, 0.07, 0.1] {
            let exact = rest + (0.46 - rest) * (frequency * time).cos();
            let state = motion.at(time);
            assert!((state[0] - exact).abs() < 64.0 * f64::EPSILON, "{} {exact}", state[0]);
            assert!((state[0] + state[1] - 1.9).abs() < 64.0 * f64::EPSILON);
        }
        assert_eq!(motion.changes(), 0);
    }

    /// A ball dropped on the lower plate: free fall, then a contact of known duration and restitution.
    #[test]
    fn a_damped_bounce_has_its_restitution() {
        let restitution: f64 = 0.7;
        let damping_ratio = -restitution.ln() / PI.hypot(restitution.ln());
        let column = column(&[1.0], 4.0, damping_ratio, 1e-9);
        let mut motion = column.motion::<2>(&[0.5 + 1e-3], 1.0);
        // Thrown down instead of dropped: gravity is next to none.
        motion.nodes = vec![Node { time: 0.0, state: [0.51, -2.0], closed: vec![false, false] }];
        while motion.nodes[motion.nodes.len() - 1].time < 0.6 {
            let last = &motion.nodes[motion.nodes.len() - 1];
            motion.nodes.push(column.next(last, 0.005));
        }
        assert_eq!(motion.changes(), 2);
        // Gravity of 1e-9 m/s^2 changes speeds by less than 1e-9 m/s.
        assert!((motion.at(0.5)[1] - 2.0 * restitution).abs() < 2e-9, "{}", motion.at(0.5)[1]);
    }

    /// Without dashpots springs, weight and motion keep their energy through all changes of contacts.
    #[test]
    fn energy_is_kept_through_changes_of_contacts() {
        let column = column(&[1.0, 0.5, 2.0], 3.2, 0.0, 3.0);
        let energy = |state: &State<6>| {
            let motion: f64 = (0..3).map(|index| column.masses[index] * (0.5 * state[3 + index].powi(2) + 3.0 * state[index])).sum();
            let overlap = |contact| column.overlap_and_rate(contact, state).0.max(0.0);
            motion + (0..=3).map(|contact| 50.0 * overlap(contact).powi(2)).sum::<f64>()
        };
        let motion = column.motion::<6>(&[0.3, 1.5, 2.9], 5.0);
        assert!(motion.changes() > 20, "{}", motion.changes());
        let start = energy(&motion.nodes[0].state);
        // Each of a thousand steps rounds energies of this size a few times.
        assert!((energy(&motion.at(5.0)) / start - 1.0).abs() < 1e3 * f64::EPSILON, "{:e}", energy(&motion.at(5.0)) / start - 1.0);
    }
}
