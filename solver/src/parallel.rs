//! Threads, or one after the other without the feature `threads`: the same results either way, because work is cut where order does not matter.

/// Calls a function for every item with its index and collects what it returns, in order.
#[cfg(feature = "threads")]
pub(crate) fn map<Item: Send, Out: Send>(items: &mut [Item], function: impl Fn(usize, &mut Item) -> Out + Sync + Send) -> Vec<Out> {
    use rayon::prelude::*;
    items.par_iter_mut().enumerate().map(|(index, item)| function(index, item)).collect()
}

/// Calls a function for every item with its index and collects what it returns, in order.
#[cfg(not(feature = "threads"))]
pub(crate) fn map<Item: Send, Out: Send>(items: &mut [Item], function: impl Fn(usize, &mut Item) -> Out + Sync + Send) -> Vec<Out> {
    items.iter_mut().enumerate().map(|(index, item)| function(index, item)).collect()
}

/// Threads that work is cut for.
pub(crate) fn threads() -> usize {
    #[cfg(feature = "threads")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "threads"))]
    1
}
