//! The binary `touchstone`; see [`verification::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    verification::cli::main()
}
