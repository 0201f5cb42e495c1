//! Memory in pages of two megabytes instead of four kilobytes: bodies are read in an order that only nearly follows memory, and the processor knows the
//! places of too few small pages (at 10^5 spheres a step takes a third less time; `cargo bench --bench scaling`).

#[cfg(all(target_os = "linux", target_env = "gnu"))]
use std::{env, os::unix::process::CommandExt, process::Command};

/// What GNU's C library reads when a process starts, and with what it asks the kernel for pages of two megabytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const TUNABLES: (&str, &str) = ("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1");

/// Starts this process again with large pages; does nothing if it has been asked for already, or the C library is another.
///
/// The first thing a program does: nothing may have been allocated that matters, and no thread started. A variable that is already set is left as it is, so
/// `GLIBC_TUNABLES= touchstone ...` keeps small pages. Child processes inherit the variable.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn ask_for() {
    // An analysing tool that has been loaded into this process would not be loaded again.
    if env::var_os(TUNABLES.0).is_some() || env::var_os("LD_PRELOAD").is_some() {
        return;
    }
    let Ok(program) = env::current_exe() else { return };
    let mut arguments = env::args_os();
    let mut again = Command::new(program);
    if let Some(name) = arguments.next() {
        again.arg0(name);
    }
    // Only returns if it fails: then pages stay small.
    let _ = again.args(arguments).env(TUNABLES.0, TUNABLES.1).exec();
}

/// Nothing to ask for.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub fn ask_for() {}
