//! `touchstone scene --keys`: the reference of scene files.

use solver::scene::keys::{Key, schema, tables};

use crate::cli::print;

/// Prints every table and key, or their JSON schema.
pub fn print(json: bool) {
    if json {
        print::json(&schema());
        return;
    }
    print::line("Scene files are TOML: SI units, angles in radians. An absent table is absent physics; unknown keys are refused.");
    for table in tables() {
        print::line(&format!("\n{}\n    {}", table.table, table.doc));
        for key in &table.keys {
            print::line(&format!("  {} ({})\n      {}", key.name, what_it_takes(key), key.doc));
        }
    }
}

fn what_it_takes(key: &Key) -> String {
    let default = if key.default.is_empty() { "optional".to_string() } else { format!("default {}", key.default) };
    format!("{}; {}", key.type_name, if key.required { "required" } else { &default })
}
