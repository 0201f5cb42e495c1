//! The setups of a case as values of one type: how they are found again from a row's setup, and what is swept of them.

use crate::case::{Failure, Knob, Setup, Tier, setups};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};

/// What one setup of a case is made of.
pub trait Variant: Sized {
    /// All of them, in the order of pages.
    fn all() -> Vec<Self>;

    /// The label of the setup.
    fn label(&self) -> String;

    /// What the knob is.
    fn knob_name(&self) -> &'static str;

    /// Values of the knob at a tier, coarse to fine.
    fn knobs(&self, tier: Tier) -> Vec<f64>;

    /// That of a setup.
    ///
    /// # Errors
    ///
    /// If the setup is of another case.
    fn of(setup: &Setup) -> Result<Self, Failure> {
        Self::all().into_iter().nth(setup.index).ok_or_else(|| Failure::NothingMeasured(setup.label.clone()))
    }

    /// Labels of those that are wanted.
    fn labels(wanted: impl Fn(&Self) -> bool) -> Vec<String> {
        Self::all().iter().filter(|variant| wanted(variant)).map(Self::label).collect()
    }

    /// All as setups.
    fn setups() -> Vec<Setup> {
        setups(Self::labels(|_| true))
    }

    /// The knob of the case.
    fn knob() -> Knob {
        Knob {
            name: |setup| Self::of(setup).map_or("knob", |variant| variant.knob_name()),
            values: |tier, setup| Self::of(setup).map_or_else(|_| Vec::new(), |variant| variant.knobs(tier)),
        }
    }

    /// What holds of each at each value of its knob at a tier.
    fn claims(tier: Tier, claims_at: impl Fn(&Self, f64) -> Vec<Claim>) -> Vec<Claim> {
        Self::all().iter().flat_map(|variant| variant.knobs(tier).into_iter().flat_map(|knob| claims_at(variant, knob))).collect()
    }

    /// A claim about an error at a value of the knob.
    fn claim_at(&self, knob: f64, quantity: &'static str, statistic: Statistic, bound: Bound, expected: Expected) -> Claim {
        Claim { setup: self.label(), quantity, statistic, subject: Subject::ErrorAt(knob), bound, expected }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Size(usize);

    impl Variant for Size {
        fn all() -> Vec<Size> {
            [3, 5, 7].map(Size).into()
        }
        fn label(&self) -> String {
            format!("size {}", self.0)
        }
        fn knob_name(&self) -> &'static str {
            "part"
        }
        fn knobs(&self, _tier: Tier) -> Vec<f64> {
            vec![self.0 as f64; self.0]
        }
    }

    #[test]
    fn a_setup_finds_its_variant_and_one_of_another_case_does_not() {
        let setups = Size::setups();
        assert_eq!(Size::of(&setups[1]).map(|size| size.0).ok(), Some(5));
        assert!(Size::of(&Setup { label: "size 9".into(), index: 3 }).is_err());
        let knob = Size::knob();
        assert_eq!(((knob.name)(&setups[2]), (knob.values)(Tier::Quick, &setups[2]).len()), ("part", 7));
        assert_eq!(Size::labels(|size| size.0 > 3), ["size 5", "size 7"]);
        let claim = |size: &Size, knob| vec![size.claim_at(knob, "error", Statistic::Worst, Bound::new(1.0, 1.0, "one"), Expected::Holds)];
        assert_eq!(Size::claims(Tier::Quick, claim).len(), 15);
    }
}
