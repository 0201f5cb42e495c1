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

/// Runs something on one of the threads that share the work: from there it costs little to wake the others.
#[cfg(feature = "threads")]
pub(crate) fn inside<Out: Send>(work: impl FnOnce() -> Out + Send) -> Out {
    rayon::scope(|_| work())
}

/// Runs something.
#[cfg(not(feature = "threads"))]
pub(crate) fn inside<Out: Send>(work: impl FnOnce() -> Out + Send) -> Out {
    work()
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

/// Length of parts that items are cut into: one part a thread, as far as each has so many items.
pub(crate) fn length_of_part(items: usize, least: usize) -> usize {
    items.div_ceil(threads()).max(least)
}

/// Work in values below which a second thread costs more than it brings.
const WORTH_A_THREAD: usize = 20_000;

/// Like [`for_each_part`], but on one thread if all items together have fewer values than a second one is worth.
pub(crate) fn for_each_part_of<Item: Send>(values: usize, items: &mut [Item], function: impl Fn(&mut [Item]) + Sync + Send) {
    if values < WORTH_A_THREAD { function(items) } else { for_each_part(items, function) }
}
