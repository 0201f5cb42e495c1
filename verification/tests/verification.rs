//! Integration tests of the library and of the binary `touchstone`: one test binary, one module per topic.

mod verification {
    mod cases;
    mod command_line;
    mod mutants;
    mod snapshots;
}
