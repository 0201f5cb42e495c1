//! The oblique impact of rigid spheres with three constants: normal restitution, friction, and the tangential restitution of a contact that sticks
//! (Walton 1993; Foerster, Louge, Chang and Allia 1994).
//!
//! With the slip velocity $s$ and the tangential effective mass $m_t$ of the contact point (2/7 of the normal one for solid spheres) the tangential
//! impulse is $\min(m_t (1 + \beta_0) |s|,\ \mu (1 + e) m_n v_n)$ against the slip.

/// The three constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidObliqueImpact {
    /// Rebound over approach velocity.
    pub restitution: f64,
    /// Coulomb coefficient.
    pub friction: f64,
    /// Slip after over slip before of a contact that sticks, reversed.
    pub tangential_restitution: f64,
}

impl RigidObliqueImpact {
    /// Tangential impulse in N s against the slip in m/s of an impact at an approach velocity in m/s, for effective masses in kg.
    pub fn impulse(&self, normal_mass: f64, tangential_mass: f64, approach: f64, slip: f64) -> f64 {
        let sticking = tangential_mass * (1.0 + self.tangential_restitution) * slip.abs();
        let sliding = self.friction * (1.0 + self.restitution) * normal_mass * approach;
        sticking.min(sliding).copysign(slip)
    }

    /// Slip after, as a part of the approach velocity, for a slip before as a part of it: solid spheres, or one at a wall.
    pub fn slip_after(&self, slip: f64) -> f64 {
        slip - self.impulse(1.0, 2.0 / 7.0, 1.0, slip) * 3.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published: test 4 of Chung and Ooi (2011), sliding rebound off a wall at e = 0.98, friction 0.092, radius 2.5 mm, speed 3.9 m/s:
    /// tangential restitution, spin and angle of the centre.
    #[test]
    fn sliding_rebounds_are_as_published() {
        let law = RigidObliqueImpact { restitution: 0.98, friction: 0.092, tangential_restitution: 0.44 };
        let table = [
            [35.0, 0.739_848_559, 581.945_272],
            [40.0, 0.782_910_166, 544.216_357],
            [50.0, 0.847_149_611, 456.651_745],
            [60.0, 0.894_829_875, 355.212],
            [70.0, 0.933_699_182, 242.979_318],
            [80.0, 0.967_880_277, 123.363_833],
            [85.0, 0.984_063_065, 61.917_531_4],
        ];
        let radius = 0.0025;
        for [angle, restitution, spin] in table {
            let (along, into) = (3.9 * f64::to_radians(angle).sin(), 3.9 * f64::to_radians(angle).cos());
            let impulse = law.impulse(1.0, 2.0 / 7.0, into, along);
            assert!(((along - impulse) / along - restitution).abs() < 1e-9, "{angle}");
            // Spin of a solid sphere of unit mass.
            assert!((2.5 * impulse / radius / spin - 1.0).abs() < 1e-8, "{angle}: {}", 2.5 * impulse / radius);
        }
    }

    /// Closed form: sticking and sliding meet at (7/2) mu (1 + e) / (1 + beta0).
    #[test]
    fn the_two_regimes_meet() {
        let law = RigidObliqueImpact { restitution: 0.87, friction: 0.25, tangential_restitution: 0.43 };
        let critical = 3.5 * 0.25 * 1.87 / 1.43;
        assert!((law.slip_after(critical * (1.0 - 1e-12)) + 0.43 * critical).abs() < 1e-11);
        assert!((law.slip_after(critical * (1.0 + 1e-12)) + 0.43 * critical).abs() < 1e-11);
    }
}
