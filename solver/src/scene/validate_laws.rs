//! Checks of the contact laws of a pair: numbers in their ranges, laws that go together.

use super::hard_checks;
use super::validate::{Check, not_negative, out_of_range, positive};
use super::{Elasticity, EndOfContact, Hertz, LinearSpringDashpot, NormalLaw, Pair, RollingLaw, SceneError, SceneErrorKind, TangentialLaw};
use crate::contact::law::linear_spring_dashpot::damping_ratio;

/// Checks the laws of a pair.
pub(super) fn check_laws(key: &str, pair: &Pair) -> Check {
    match &pair.normal {
        NormalLaw::LinearSpringDashpot(law) => check_linear(&format!("{key}.normal.linear_spring_dashpot"), law)?,
        NormalLaw::Hertz(law) => check_hertz(&format!("{key}.normal.hertz"), law)?,
        NormalLaw::Impulse(_) if pair.rolling.is_some() => {
            let message = "an impulse has no duration in which anything rolls: leave `rolling` out";
            return Err(SceneError::new(SceneErrorKind::Combination, format!("{key}.rolling"), message));
        }
        NormalLaw::Impulse(law) => return hard_checks::check_laws(key, law, pair.tangential.as_ref()),
    }
    if let Some(law) = &pair.tangential {
        check_tangential(&format!("{key}.tangential"), law)?;
        check_together(key, &pair.normal, law)?;
    }
    match &pair.rolling {
        None => Ok(()),
        Some(_) if pair.tangential.is_none() => {
            let message = "without a tangential law nothing rolls: give the pair one, or leave `rolling` out";
            Err(SceneError::new(SceneErrorKind::Combination, format!("{key}.rolling"), message))
        }
        Some(RollingLaw::ConstantTorque(law)) => not_negative(&format!("{key}.rolling.constant_torque.friction"), law.friction),
        Some(RollingLaw::SpringTorque(law)) => {
            let key = format!("{key}.rolling.spring_torque");
            not_negative(&format!("{key}.friction"), law.friction)?;
            positive(&format!("{key}.stiffness"), law.stiffness, "N m")?;
            not_negative(&format!("{key}.damping_ratio"), law.damping_ratio)
        }
    }
}

fn check_linear(key: &str, law: &LinearSpringDashpot) -> Check {
    positive(&format!("{key}.stiffness"), law.stiffness, "N/m")?;
    let key_of_restitution = format!("{key}.restitution");
    match law.end_of_contact {
        EndOfContact::ZeroOverlap => from_zero_to_one(&key_of_restitution, law.restitution),
        EndOfContact::NoAttraction if !(law.restitution > 0.0 && law.restitution <= 1.0) => {
            let allowed = "a number in (0, 1]: without attraction no dashpot, however strong, stops the rebound altogether";
            Err(out_of_range(&key_of_restitution, law.restitution, allowed))
        }
        EndOfContact::NoAttraction => Ok(()),
    }
}

fn check_hertz(key: &str, law: &Hertz) -> Check {
    check_elasticity(&format!("{key}.first"), &law.first)?;
    law.second.as_ref().map_or(Ok(()), |second| check_elasticity(&format!("{key}.second"), second))?;
    from_zero_to_one(&format!("{key}.restitution"), law.restitution)?;
    law.reference_speed.map_or(Ok(()), |speed| positive(&format!("{key}.reference_speed"), speed, "m/s"))
}

fn check_elasticity(key: &str, side: &Elasticity) -> Check {
    positive(&format!("{key}.young_modulus"), side.young_modulus, "Pa")?;
    if side.poisson_ratio > -1.0 && side.poisson_ratio <= 0.5 {
        return Ok(());
    }
    Err(out_of_range(&format!("{key}.poisson_ratio"), side.poisson_ratio, "a number above -1 and at most 0.5"))
}

fn check_tangential(key: &str, law: &TangentialLaw) -> Check {
    match law {
        TangentialLaw::ViscousCoulomb(law) => {
            not_negative(&format!("{key}.viscous_coulomb.friction"), law.friction)?;
            not_negative(&format!("{key}.viscous_coulomb.damping_rate"), law.damping_rate)
        }
        TangentialLaw::LinearHistory(law) => {
            not_negative(&format!("{key}.linear_history.friction"), law.friction)?;
            positive(&format!("{key}.linear_history.stiffness"), law.stiffness, "N/m")?;
            not_negative(&format!("{key}.linear_history.damping_ratio"), law.damping_ratio)
        }
        TangentialLaw::ViscousSpring(law) => {
            not_negative(&format!("{key}.viscous_spring.friction"), law.friction)?;
            positive(&format!("{key}.viscous_spring.stiffness"), law.stiffness, "N/m")
        }
        TangentialLaw::Mindlin(law) => {
            not_negative(&format!("{key}.mindlin.friction"), law.friction)?;
            not_negative(&format!("{key}.mindlin.damping_ratio"), law.damping_ratio)
        }
        TangentialLaw::CoulombImpulse(_) => Err(SceneError::new(
            SceneErrorKind::Combination,
            format!("{key}.coulomb_impulse"),
            "goes with `normal = { impulse = { ... } }` only: a soft contact needs a force, such as viscous_coulomb or linear_history",
        )),
    }
}

/// Tangential laws that take their numbers from the normal law need the right one.
fn check_together(key: &str, normal: &NormalLaw, tangential: &TangentialLaw) -> Check {
    let refuse = |message: &str| Err(SceneError::new(SceneErrorKind::Combination, format!("{key}.tangential"), message));
    match (normal, tangential) {
        (NormalLaw::Hertz(_), TangentialLaw::Mindlin(_)) => Ok(()),
        (NormalLaw::Hertz(_), _) => refuse("with `normal = { hertz = ... }` the tangential law is `mindlin` or absent"),
        (_, TangentialLaw::Mindlin(_)) => {
            refuse("`mindlin` takes its elastic constants from `normal = { hertz = ... }`, which this pair has not")
        }
        (NormalLaw::LinearSpringDashpot(law), TangentialLaw::ViscousSpring(_)) => {
            if damping_ratio(law.restitution, law.end_of_contact) < 1.0 {
                return Ok(());
            }
            let key = format!("{key}.normal.linear_spring_dashpot.restitution");
            Err(out_of_range(
                &key,
                law.restitution,
                "enough for `viscous_spring`: a critically damped contact has no duration to guess with",
            ))
        }
        _ => Ok(()),
    }
}

fn from_zero_to_one(key: &str, value: f64) -> Check {
    if (0.0..=1.0).contains(&value) { Ok(()) } else { Err(out_of_range(key, value, "a number in [0, 1]")) }
}
