//! Where bodies are stored after they have been sorted, or after some have gone.

/// The new place of each body, by the place it had.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Relocation {
    places: Vec<u32>,
}

/// The place of a body that is no longer there.
const GONE: u32 = u32::MAX;

impl Relocation {
    /// For so many bodies of which the one that was at `order[n]` is at `n` now; those that are not in the order are gone.
    pub fn of_order(order: &[u32], bodies: usize) -> Relocation {
        let mut places = vec![GONE; bodies];
        for (place, old) in order.iter().enumerate() {
            places[*old as usize] = place as u32;
        }
        Relocation { places }
    }

    /// The new place of the body that was at a place; `None` if it is gone.
    #[inline]
    pub fn place(&self, old: usize) -> Option<u32> {
        self.places.get(old).copied().filter(|place| *place != GONE)
    }

    /// How many bodies have a new place.
    pub fn stayed(&self) -> usize {
        self.places.iter().filter(|place| **place != GONE).count()
    }

    /// This one, followed by another.
    pub fn then(self, next: &Relocation) -> Relocation {
        let place = |old: u32| if old == GONE { GONE } else { next.place(old as usize).unwrap_or(GONE) };
        Relocation { places: self.places.into_iter().map(place).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Five bodies, the second goes, one comes behind the others, then all are sorted.
    #[test]
    fn a_body_is_followed_through_going_and_sorting() {
        let gone = Relocation::of_order(&[0, 2, 3, 4], 5);
        let sorted = Relocation::of_order(&[4, 3, 0, 2, 1], 5);
        let both = gone.clone().then(&sorted);
        assert_eq!([&gone, &sorted, &both].map(Relocation::stayed), [4, 5, 4]);
        assert_eq!([0, 1, 2, 3, 4, 5].map(|old| both.place(old)), [Some(2), None, Some(4), Some(3), Some(1), None]);
    }
}
