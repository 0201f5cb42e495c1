//! Places and turns of the bodies of a bed, as small files that every machine reads alike.

use solver::Simulation;

/// Position in m and quaternion of each body, at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct States(pub Vec<[f64; 7]>);

/// Of positions, in 1/m, and of quaternions.
const DIGITS: [f64; 2] = [1e12, 1e10];

impl States {
    pub(super) fn of(simulation: &Simulation) -> States {
        let bodies = simulation.bodies();
        let state = |index| {
            let (place, turn) = (bodies.position(index), bodies.orientation(index).quaternion().coords);
            [place.x, place.y, place.z, turn.w, turn.x, turn.y, turn.z]
        };
        States((0..bodies.len()).map(state).collect())
    }

    /// As whole picometres, and quaternions times 1e10.
    pub fn text(&self) -> String {
        let mut text = String::from("x_pm,y_pm,z_pm,qw_e10,qx_e10,qy_e10,qz_e10\n");
        for state in &self.0 {
            let numbers =
                state.iter().enumerate().map(|(column, value)| ((value * DIGITS[usize::from(column > 2)]).round() as i64).to_string());
            text += &(numbers.collect::<Vec<_>>().join(",") + "\n");
        }
        text
    }

    /// Reads what [`States::text`] wrote. `None` if a line is not that.
    pub fn parse(text: &str) -> Option<States> {
        let row = |line: &str| {
            let numbers = line.split(',').map(|number| number.parse::<i64>().ok()).collect::<Option<Vec<_>>>()?;
            let numbers = <[i64; 7]>::try_from(numbers).ok()?;
            Some(std::array::from_fn(|column| numbers[column] as f64 / DIGITS[usize::from(column > 2)]))
        };
        text.lines().skip(1).map(row).collect::<Option<Vec<_>>>().map(States)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_read_back_as_they_were_written() {
        let states = States(vec![[1.5e-3, 0.018, 1.25e-5, 0.6, -0.8, 0.0, 1e-3]]);
        assert_eq!(States::parse(&states.text()), Some(states));
        assert_eq!(States::parse("head\n1,2,3\n"), None);
    }
}
