//! `touchstone list`: the cases and how they stand.

use serde_json::{Value, json};

use super::places::Places;
use super::store::{claims_met, read_case};
use super::{CommandError, Finish, print};
use crate::case::Description;
use crate::{CASES, Tier};

/// How a case stands on disk.
enum Status {
    NotRun,
    Ran { claims: usize, met: usize, tiers: String },
}

/// Prints every case: identifier, status, question, budget. Outside a checkout every case counts as not run.
///
/// # Errors
///
/// If results on disk cannot be read.
pub fn list(places: Option<&Places>, json: bool) -> Result<Finish, CommandError> {
    let mut entries = Vec::new();
    for case in CASES {
        let description = case.description();
        let status = places.map_or(Ok(Status::NotRun), |places| status(places, description.id))?;
        entries.push((description, status));
    }
    if json {
        print::json(&entries.iter().map(|(description, status)| entry_as_json(description, status)).collect());
        return Ok(Finish::Met);
    }
    let width = entries.iter().map(|(description, _)| description.id.len()).max().unwrap_or(0);
    for (description, status) in &entries {
        let [quick, standard, paper] = description.budget_cpu_s;
        print::line(&format!("{:width$}  {}", description.id, words(status)));
        print::line(&format!("{:width$}  {}", "", description.question));
        print::line(&format!("{:width$}  at most {quick} s of CPU quick, {standard} s standard, {paper} s paper", ""));
    }
    Ok(Finish::Met)
}

fn status(places: &Places, case: &str) -> Result<Status, CommandError> {
    let Some(results) = read_case(places, case)? else { return Ok(Status::NotRun) };
    let (claims, met) = claims_met(&results);
    let mut tiers: Vec<&str> = results.own_rows().map(|(_, row)| row.tier.as_str()).collect();
    tiers.dedup();
    Ok(Status::Ran { claims, met, tiers: tiers.join(", ") })
}

fn words(status: &Status) -> String {
    match status {
        Status::NotRun => "not run".into(),
        Status::Ran { claims, met, tiers } if met < claims => format!("RED: met {met} of {claims} ({tiers})"),
        Status::Ran { claims, met, tiers } => format!("met {met} of {claims} ({tiers})"),
    }
}

fn entry_as_json(description: &Description, status: &Status) -> Value {
    let budget = |tier: Tier| description.budget(tier);
    let status = match status {
        Status::NotRun => json!({ "state": "not run" }),
        Status::Ran { claims, met, tiers } => {
            json!({ "state": if met < claims { "red" } else { "met" }, "claims": claims, "met": met, "tier": tiers })
        }
    };
    json!({
        "id": description.id,
        "title": description.title,
        "question": description.question,
        "budget_cpu_s": { "quick": budget(Tier::Quick), "standard": budget(Tier::Standard), "paper": budget(Tier::Paper) },
        "status": status,
    })
}
