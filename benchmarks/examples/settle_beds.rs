//! Makes the settled states of `cargo bench --bench beds` anew: `cargo run --release -p benchmarks --example settle_beds`, or with words that are parts of the
//! names of beds for those alone.
//!
//! It takes some minutes. Another version of the solver settles otherwise in the last digits, and so in the end everywhere.

use std::path::Path;

use benchmarks::beds::kinds::Kind;
use benchmarks::beds::settle::settled;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("beds");
    let words: Vec<String> = std::env::args().skip(1).collect();
    let is_asked_for = |kind: &Kind| words.is_empty() || words.iter().any(|word| kind.name().contains(word));
    for kind in Kind::ALL.into_iter().filter(is_asked_for) {
        let path = folder.join(kind.file());
        std::fs::write(&path, settled(kind)?.text())?;
        println!("{}", path.display());
    }
    Ok(())
}
