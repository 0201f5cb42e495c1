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

/// Cuts items into one part a thread and calls a function for each part.
#[cfg(feature = "threads")]
pub(crate) fn for_each_part<Item: Send>(items: &mut [Item], function: impl Fn(&mut [Item]) + Sync + Send) {
    use rayon::prelude::*;
    if threads() <= 1 {
        return function(items);
    }
    let length = items.len().div_ceil(threads()).max(1);
    items.par_chunks_mut(length).for_each(function);
}

/// Calls a function for all items as one part.
#[cfg(not(feature = "threads"))]
pub(crate) fn for_each_part<Item: Send>(items: &mut [Item], function: impl Fn(&mut [Item]) + Sync + Send) {
    function(items);
}
