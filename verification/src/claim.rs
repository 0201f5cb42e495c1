//! Claims: what must hold, with a bound that is a computed floor times a written factor.

use reports::row::Expectation;

/// What must hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Setup it speaks of, by label.
    pub setup: String,
    /// Quantity it speaks of.
    pub quantity: &'static str,
    /// Which statistic of the samples.
    pub statistic: Statistic,
    /// What about it.
    pub subject: Subject,
    /// The largest error allowed.
    pub bound: Bound,
    /// Whether it is expected to hold.
    pub expected: Expected,
}

/// How samples become one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Statistic {
    /// Median error.
    Median,
    /// Largest error.
    Worst,
    /// The only sample.
    Single,
}

impl Statistic {
    /// The word that begins the statistic in rows.
    pub fn name(self) -> &'static str {
        match self {
            Statistic::Median => "median",
            Statistic::Worst => "worst",
            Statistic::Single => "single run",
        }
    }
}

/// What a claim is about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Subject {
    /// The error at one knob value.
    ErrorAt(f64),
    /// The observed order of the error over a range of knob values is at least this; more is better.
    OrderAtLeast {
        /// The design order.
        order: f64,
        /// Coarsest and finest knob value of the fit.
        range: [f64; 2],
    },
    /// The observed order of the error over a range of knob values is about this, neither less nor more.
    OrderAbout {
        /// The design order.
        order: f64,
        /// Coarsest and finest knob value of the fit.
        range: [f64; 2],
    },
}

/// A bound: floor times factor.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// Computed floor, or computed design error, in the unit of the error.
    pub floor: f64,
    /// What the floor is.
    pub floor_is: String,
    /// Written factor.
    pub factor: f64,
}

impl Bound {
    /// A bound of a factor times a floor.
    pub fn new(factor: f64, floor: f64, floor_is: impl Into<String>) -> Bound {
        Bound { floor, floor_is: floor_is.into(), factor }
    }

    /// The largest error allowed.
    pub fn value(&self) -> f64 {
        self.factor * self.floor
    }

    /// In words.
    pub fn reason(&self) -> String {
        format!("{} x {:.1e}, {}", self.factor, self.floor, self.floor_is)
    }
}

/// Whether a claim is expected to hold.
#[derive(Debug, Clone, PartialEq)]
pub enum Expected {
    /// It holds.
    Holds,
    /// It does not, for a known reason.
    KnownLimit(String),
    /// It is what a source prints, and must fail.
    SourceError(String),
}

impl Expected {
    /// The word in rows.
    pub fn expectation(&self) -> Expectation {
        match self {
            Expected::Holds => Expectation::Holds,
            Expected::KnownLimit(_) => Expectation::KnownLimit,
            Expected::SourceError(_) => Expectation::SourceError,
        }
    }

    /// Why it does not hold, if it is not expected to.
    pub fn reason(&self) -> Option<String> {
        match self {
            Expected::Holds => None,
            Expected::KnownLimit(reason) | Expected::SourceError(reason) => Some(reason.clone()),
        }
    }
}

/// What checking a claim found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checked {
    /// Distance from what is claimed; never negative.
    pub error: f64,
    /// Whether the claim itself holds.
    pub pass: bool,
}

impl Claim {
    /// Holds an error, or an observed order, against the claim. The one place where an absolute value is taken and a bound compared.
    pub fn check(&self, observed: f64) -> Checked {
        let error = match self.subject {
            Subject::ErrorAt(_) => observed.abs(),
            // Not `max`, which would turn a missing order into a perfect one.
            Subject::OrderAtLeast { order, .. } if observed >= order => 0.0,
            Subject::OrderAtLeast { order, .. } => order - observed,
            Subject::OrderAbout { order, .. } => (order - observed).abs(),
        };
        Checked { error, pass: error <= self.bound.value() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(subject: Subject) -> Claim {
        Claim {
            setup: "any".into(),
            quantity: "restitution",
            statistic: Statistic::Median,
            subject,
            bound: Bound::new(2.0, 0.05, "one over the coarsest knob value of the fit"),
            expected: Expected::Holds,
        }
    }

    #[test]
    fn errors_below_and_above_count_alike() {
        let claim = claim(Subject::ErrorAt(50.0));
        assert!(claim.check(-0.09).pass && claim.check(0.09).pass);
        assert!(!claim.check(-0.11).pass && !claim.check(0.11).pass && !claim.check(f64::NAN).pass);
    }

    #[test]
    fn an_order_may_be_better_but_not_worse_than_at_least() {
        let at_least = claim(Subject::OrderAtLeast { order: 2.0, range: [20.0, 400.0] });
        assert!(at_least.check(1.91).pass && at_least.check(4.0).pass && !at_least.check(1.89).pass);
        assert!(!at_least.check(f64::NAN).pass);
        let about = claim(Subject::OrderAbout { order: 1.0, range: [20.0, 400.0] });
        assert!(about.check(1.05).pass && !about.check(1.2).pass && !about.check(0.8).pass);
        assert_eq!(about.bound.reason(), "2 x 5.0e-2, one over the coarsest knob value of the fit");
    }
}
