//! The list of deliberate bugs stays honest.

use std::collections::BTreeSet;
use std::path::Path;

use verification::mutants::all;

#[test]
fn every_bug_can_still_be_planted_and_was_caught() {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    // In a copy of the workspace one bug stands planted; that one is known by its text.
    for mutant in all() {
        let path = workspace.join(mutant.file);
        let source = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", mutant.file));
        let planted_here = std::env::var("PLANTED_BUG").is_ok_and(|name| name == mutant.name);
        let places = source.matches(mutant.original).count();
        assert!(places == 1 || planted_here, "{}: its text stands {places} times in {}", mutant.name, mutant.file);
        assert!(!mutant.caught_by.is_empty(), "{}: nothing catches it", mutant.name);
    }
    let names: BTreeSet<&str> = all().map(|mutant| mutant.name).collect();
    assert_eq!(names.len(), all().count(), "names are unique");
}
