//! Checks of the keys of hard contacts.

use super::validate::{Check, not_negative, out_of_range};
use super::{HardContact, ImpulseRestitution, NormalLaw, Rotation, Scene, SceneError, SceneErrorKind, TangentialLaw};

/// The laws of one pair whose normal law is an impulse.
pub(super) fn check_laws(key: &str, normal: &ImpulseRestitution, tangential: Option<&TangentialLaw>) -> Check {
    if !(0.0..=1.0).contains(&normal.restitution) {
        return Err(out_of_range(&format!("{key}.normal.impulse.restitution"), normal.restitution, "a number in [0, 1]"));
    }
    let law = match tangential {
        None => return Ok(()),
        Some(TangentialLaw::CoulombImpulse(law)) => law,
        Some(_) => {
            let message = "is a force, and hard contacts know only impulses: use coulomb_impulse, or leave it out";
            return Err(SceneError::new(SceneErrorKind::Combination, format!("{key}.tangential"), message));
        }
    };
    let key = format!("{key}.tangential.coulomb_impulse");
    not_negative(&format!("{key}.dynamic_friction"), law.dynamic_friction)?;
    match law.static_friction {
        None => Ok(()),
        Some(friction) if friction.is_finite() && friction >= law.dynamic_friction => Ok(()),
        Some(friction) => {
            let allowed = format!("a finite number of at least the dynamic friction, {}", law.dynamic_friction);
            Err(out_of_range(&format!("{key}.static_friction"), friction, &allowed))
        }
    }
}

/// What all pairs and the numerics must agree on.
pub(super) fn check_together(scene: &Scene) -> Check {
    let is_hard = |pair: &super::Pair| matches!(pair.normal, NormalLaw::Impulse(_));
    let refuse = |key: String, message: &str| Err(SceneError::new(SceneErrorKind::Combination, key, message));
    let hard = scene.pairs.iter().filter(|pair| is_hard(pair)).count();
    let numerics = &scene.numerics;
    if hard == 0 {
        return match numerics.hard_contact {
            None => Ok(()),
            Some(_) => refuse("numerics.hard_contact".into(), "no [[pair]] has `normal = { impulse = { ... } }`: leave it out"),
        };
    }
    if let Some(soft) = scene.pairs.iter().position(|pair| !is_hard(pair)) {
        let message = "is soft while another pair has impulses: hard and soft contacts do not go together in one scene";
        return refuse(format!("pair[{soft}].normal"), message);
    }
    if numerics.rotation != Rotation::default() {
        let message = "hard bodies turn by the exact free turn of their class between collisions: leave it out";
        return refuse("numerics.rotation".into(), message);
    }
    match &numerics.hard_contact {
        Some(HardContact::EventDriven(mode)) if !(1e-13..=1e-3).contains(&mode.tolerance) => {
            Err(out_of_range("numerics.hard_contact.event_driven.tolerance", mode.tolerance, "a number in [1e-13, 1e-3]"))
        }
        Some(HardContact::TimeDriven(mode)) if !(1..=1_000_000).contains(&mode.sweeps) => {
            Err(out_of_range("numerics.hard_contact.time_driven.sweeps", f64::from(mode.sweeps), "a whole number from 1 to 1000000"))
        }
        Some(HardContact::TimeDriven(mode)) if !(0.0..1.0).contains(&mode.tolerance) => {
            Err(out_of_range("numerics.hard_contact.time_driven.tolerance", mode.tolerance, "a number in [0, 1)"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Body, CoulombImpulse, FrictionClamp, LinearSpringDashpot, Material, Pair, TimeDrivenContact};
    use super::*;
    use crate::scene::{EndOfContact, EventDrivenContact, Geometry, NamedShape, SphereGeometry, Step, ViscousCoulomb};

    fn scene() -> Scene {
        let mut scene = Scene::empty("hard", 1.0);
        scene.materials =
            vec![Material { name: "glass".into(), density: Some(1.0) }, Material { name: "steel".into(), density: Some(1.0) }];
        let pair = |other: &str| Pair {
            materials: ["glass".into(), other.into()],
            normal: NormalLaw::Impulse(ImpulseRestitution { restitution: 0.5 }),
            tangential: Some(coulomb(0.1, Some(0.2))),
            rolling: None,
        };
        scene.pairs = vec![pair("glass"), pair("steel")];
        scene.shapes = vec![NamedShape { name: "ball".into(), geometry: Geometry::Sphere(SphereGeometry { radius: 1.0 }) }];
        scene.bodies = vec![Body::new("ball", "glass")];
        scene.numerics.step = Step::Seconds(0.1);
        scene
    }

    fn coulomb(dynamic_friction: f64, static_friction: Option<f64>) -> TangentialLaw {
        TangentialLaw::CoulombImpulse(CoulombImpulse { dynamic_friction, static_friction, clamp: FrictionClamp::Stick })
    }

    fn key_of_error(change: impl Fn(&mut Scene)) -> String {
        let mut scene = scene();
        change(&mut scene);
        scene.validate().expect_err("this must be refused").key
    }

    #[test]
    fn what_is_wrong_is_named_by_its_key() {
        assert_eq!(scene().validate(), Ok(()));
        let normal = |restitution| NormalLaw::Impulse(ImpulseRestitution { restitution });
        for restitution in [-0.1, 1.1, f64::NAN] {
            assert_eq!(key_of_error(|scene| scene.pairs[1].normal = normal(restitution)), "pair[1].normal.impulse.restitution");
        }
        let friction = |law: TangentialLaw| key_of_error(|scene| scene.pairs[0].tangential = Some(law.clone()));
        assert_eq!(friction(coulomb(-0.1, None)), "pair[0].tangential.coulomb_impulse.dynamic_friction");
        for static_friction in [0.2, f64::NAN, f64::INFINITY] {
            assert_eq!(friction(coulomb(0.3, Some(static_friction))), "pair[0].tangential.coulomb_impulse.static_friction");
        }
        assert_eq!(friction(TangentialLaw::ViscousCoulomb(ViscousCoulomb { friction: 0.1, damping_rate: 1.0 })), "pair[0].tangential");
        let soft = || LinearSpringDashpot { stiffness: 1.0, restitution: 1.0, end_of_contact: EndOfContact::ZeroOverlap };
        let soft_one = |scene: &mut Scene| {
            scene.pairs[1] = Pair { normal: NormalLaw::LinearSpringDashpot(soft()), tangential: None, ..scene.pairs[1].clone() };
        };
        assert_eq!(key_of_error(soft_one), "pair[1].normal");
        let soft_with_impulse = |scene: &mut Scene| scene.pairs[1].normal = NormalLaw::LinearSpringDashpot(soft());
        assert_eq!(key_of_error(soft_with_impulse), "pair[1].tangential.coulomb_impulse");
        assert_eq!(key_of_error(|scene| scene.numerics.rotation = Rotation::ExplicitEuler), "numerics.rotation");
        let mode = |mode: HardContact| key_of_error(|scene| scene.numerics.hard_contact = Some(mode.clone()));
        let time_driven = |sweeps, tolerance| mode(HardContact::TimeDriven(TimeDrivenContact { sweeps, tolerance }));
        assert_eq!(time_driven(0, 0.0), "numerics.hard_contact.time_driven.sweeps");
        assert_eq!(time_driven(1, 1.0), "numerics.hard_contact.time_driven.tolerance");
        let event_driven = HardContact::EventDriven(EventDrivenContact { tolerance: f64::NAN });
        assert_eq!(mode(event_driven), "numerics.hard_contact.event_driven.tolerance");
        let none_hard = |scene: &mut Scene| {
            scene.pairs.clear();
            scene.numerics.hard_contact = Some(HardContact::default());
        };
        assert_eq!(key_of_error(none_hard), "numerics.hard_contact");
    }
}
