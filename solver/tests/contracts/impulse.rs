//! The law of impulses over a million random collisions: restitution, friction cone, and energy, which no law may create.

use nalgebra::{Matrix3, UnitQuaternion};
use solver::Vector;
use solver::contact::impulse::{CollidingBody, CollisionPoint, FrictionClamp, FrictionImpulse, ImpulseLaw};

/// Numbers in [0, 1) that fill space evenly enough: a counter scrambled by two multiplications and shifts (splitmix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn vector(&mut self, size: f64) -> Vector {
        Vector::new(self.next() - 0.5, self.next() - 0.5, self.next() - 0.5) * size
    }

    /// From one over a hundred to a hundred, evenly in the logarithm.
    fn decades(&mut self) -> f64 {
        10.0_f64.powf(4.0 * self.next() - 2.0)
    }

    fn body(&mut self) -> (CollidingBody, f64, Matrix3<f64>) {
        let mass = self.decades();
        // Moments of three lengths: any real body, from a needle to a plate.
        let squares = Vector::new(self.decades(), self.decades(), self.decades());
        let moments = Vector::new(squares.y + squares.z, squares.z + squares.x, squares.x + squares.y) * mass;
        let turn = UnitQuaternion::from_scaled_axis(self.vector(6.0)).to_rotation_matrix();
        let turned = |moments: Vector| turn.matrix() * Matrix3::from_diagonal(&moments) * turn.matrix().transpose();
        let inverse_inertia = turned(moments.map(|moment| 1.0 / moment));
        let body = CollidingBody { velocity: self.vector(2.0), spin: self.vector(4.0), inverse_mass: 1.0 / mass, inverse_inertia };
        (body, mass, turned(moments))
    }
}

fn energy(body: &CollidingBody, mass: f64, inertia: &Matrix3<f64>) -> f64 {
    0.5 * (mass * body.velocity.norm_squared() + body.spin.dot(&(inertia * body.spin)))
}

#[derive(Default)]
struct Found {
    collisions: u32,
    sticking: u32,
    /// Collisions in which energy rose by more than rounding.
    creating: u32,
    largest_rise: f64,
    largest_restitution_error: f64,
    outside_the_cone: u32,
}

/// A million pairs, one in four of them with a wall.
fn collide_all(clamp: FrictionClamp) -> Found {
    let mut numbers = Numbers(7);
    let mut found = Found::default();
    for index in 0..1_000_000 {
        let (mut first, mass, inertia) = numbers.body();
        let (mut second, its_mass, its_inertia) = numbers.body();
        let with_wall = index % 4 == 0;
        let normal = numbers.vector(1.0).normalize();
        let (arm_of_first, arm_of_second) = (numbers.vector(4.0), numbers.vector(4.0));
        let point = CollisionPoint { normal, arm_of_first, arm_of_second };
        let dynamic_friction = 2.0 * numbers.next() * numbers.next();
        let static_friction = dynamic_friction * (1.0 + numbers.next());
        let restitution = if index % 3 == 0 { 1.0 } else { numbers.next() };
        let law = ImpulseLaw { restitution, friction: Some(FrictionImpulse { dynamic_friction, static_friction, clamp }) };
        let partner = (!with_wall).then_some(second);
        let Some(impulse) = law.impulse_on_first(&first, partner.as_ref(), &point) else { continue };
        let approach = point.relative_velocity(&first, partner.as_ref());
        let total = |first: &CollidingBody, second: &CollidingBody| {
            energy(first, mass, &inertia) + if with_wall { 0.0 } else { energy(second, its_mass, &its_inertia) }
        };
        let before = total(&first, &second);
        first.take(&impulse, &arm_of_first);
        second.take(&-impulse, &arm_of_second);
        let rise = total(&first, &second) / before - 1.0;
        let parting = point.relative_velocity(&first, (!with_wall).then_some(&second));
        let restituted = (parting + approach * restitution).dot(&normal).abs() / approach.norm();
        let push = -impulse.dot(&normal);
        let tangential = (impulse + normal * push).norm();
        found.collisions += 1;
        found.sticking += u32::from((parting - normal * parting.dot(&normal)).norm() < 1e-9 * approach.norm());
        found.creating += u32::from(rise > 1e-12);
        found.largest_rise = found.largest_rise.max(rise);
        found.largest_restitution_error = found.largest_restitution_error.max(restituted);
        found.outside_the_cone += u32::from(push < 0.0 || tangential > static_friction * push * (1.0 + 1e-12));
    }
    found
}

/// The default law: restitution exact, inside the cone, and not one collision of a million creates energy.
#[test]
fn no_collision_creates_energy_and_every_one_keeps_its_restitution() {
    let found = collide_all(FrictionClamp::Stick);
    assert!(found.collisions > 400_000 && found.sticking > 20_000, "{} {}", found.collisions, found.sticking);
    assert!(found.largest_rise < 1e-12, "{:e}, in {} of {}", found.largest_rise, found.creating, found.collisions);
    assert!(found.largest_restitution_error < 1e-11, "{:e}", found.largest_restitution_error);
    assert_eq!(found.outside_the_cone, 0);
}

/// With coefficients up to two, S's dynamic friction creates energy in one collision of seven, with its signs as printed in four of five.
#[test]
fn friction_without_a_limit_creates_energy_often_and_with_the_printed_sign_mostly() {
    let (unlimited, printed) = (collide_all(FrictionClamp::None), collide_all(FrictionClamp::NoneSignAsPrinted));
    let share = |found: &Found| f64::from(found.creating) / f64::from(found.collisions);
    assert!((share(&unlimited) - 0.139).abs() < 0.002, "{}", share(&unlimited));
    assert!((share(&printed) - 0.803).abs() < 0.002, "{}", share(&printed));
    assert!(unlimited.largest_rise > 100.0 && printed.largest_rise > 100.0);
}
