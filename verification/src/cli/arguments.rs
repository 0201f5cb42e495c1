//! What can be asked on the command line.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use crate::Tier;

/// Verification and benchmark suite for particle-laden flow. Without a command: run every case at the quick tier and make the site.
#[derive(Debug, Parser)]
#[command(name = "touchstone", version, after_help = MAIN_EXAMPLES)]
pub struct Arguments {
    /// What to do; nothing means the main job.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Where results and pages are kept.
    #[command(flatten)]
    pub places: PlaceOptions,
}

/// Where results and pages are kept.
#[derive(Debug, Clone, Default, Args)]
pub struct PlaceOptions {
    /// Folder of the result rows [default: reports/results of the enclosing checkout]
    #[arg(long, global = true, value_name = "DIR")]
    pub results: Option<PathBuf>,
    /// Folder of the pages [default: reports/site of the enclosing checkout]
    #[arg(long, global = true, value_name = "DIR")]
    pub site: Option<PathBuf>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// List the cases: identifier, question, cost, status.
    #[command(after_help = LIST_EXAMPLES)]
    List {
        /// Print JSON.
        #[arg(long)]
        json: bool,
    },
    /// Run the cases whose identifier is, or matches, a pattern; write their rows and re-render the site.
    #[command(after_help = RUN_EXAMPLES)]
    Run {
        /// Identifier of a case, or a regular expression that is searched for in identifiers.
        #[arg(value_name = "ID|REGEX")]
        pattern: String,
        /// How much may be spent.
        #[arg(long, value_enum, default_value_t = Tier::Quick)]
        tier: Tier,
        /// Only setups in whose label this regular expression is found; rows of others stay as they are.
        #[arg(long, value_name = "REGEX")]
        setup: Option<String>,
        /// Only these values of the knob; rows of others stay as they are.
        #[arg(long, value_name = "VALUE,...", value_delimiter = ',')]
        knob: Vec<f64>,
        /// Cases run side by side; 1 gives the quietest times.
        #[arg(long, default_value = "1", value_name = "N")]
        threads: NonZeroUsize,
        /// Seed of every random choice.
        #[arg(long, default_value_t = DEFAULT_SEED, value_name = "N")]
        seed: u64,
        /// Print the verdicts as JSON.
        #[arg(long)]
        json: bool,
    },
    /// Run a scene file.
    #[command(after_help = SCENE_EXAMPLES)]
    Scene(SceneOptions),
    /// Write a case for other codes: scenes, initial states, parameters in both forms, expected values.
    #[command(after_help = EXPORT_EXAMPLES)]
    Export {
        /// Identifier of the case.
        case: String,
        /// Folder to write; it must not exist or be empty.
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
        /// Tier whose knob values are expected.
        #[arg(long, value_enum, default_value_t = Tier::Quick)]
        tier: Tier,
    },
    /// Hold another code's results against a case's claims and put them on its page.
    #[command(after_help = COMPARE_EXAMPLES)]
    Compare {
        /// Identifier of the case.
        case: String,
        /// Results with the columns of the exported template.csv.
        #[arg(value_name = "FILE.csv")]
        file: PathBuf,
        /// Tier whose claims are checked.
        #[arg(long, value_enum, default_value_t = Tier::Quick)]
        tier: Tier,
        /// Print the rows as JSON.
        #[arg(long)]
        json: bool,
    },
    /// Re-render the site from the rows on disk.
    #[command(after_help = REPORT_EXAMPLES)]
    Report,
}

/// How a scene is run.
#[derive(Debug, Clone, Args)]
pub struct SceneOptions {
    /// The scene.
    #[arg(value_name = "FILE.toml", required_unless_present = "keys")]
    pub file: Option<PathBuf>,
    /// Folder of the outputs: probes.csv, bodies.csv, ledger.json, checkpoint.json, VTK.
    #[arg(long, value_name = "DIR", required_unless_present = "keys")]
    pub out: Option<PathBuf>,
    /// Go on from checkpoint.json in the output folder.
    #[arg(long, conflicts_with = "overwrite")]
    pub resume: bool,
    /// Replace the output folder of a former run.
    #[arg(long)]
    pub overwrite: bool,
    /// Print all keys of scene files instead; with --json their JSON schema.
    #[arg(long, conflicts_with_all = ["file", "out", "resume", "overwrite"])]
    pub keys: bool,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

/// Seed of the main job.
pub const DEFAULT_SEED: u64 = 1;

const MAIN_EXAMPLES: &str = "\
Examples:
  touchstone                       run every case at the quick tier, then open reports/site/index.html
  touchstone list                  what there is
  touchstone run normal_contact    one case

Exit codes: 0 all expectations met, 1 a claim not met, 2 bad input, 3 a guard stopped a scene's run.";

const LIST_EXAMPLES: &str = "\
Examples:
  touchstone list
  touchstone list --json";

const RUN_EXAMPLES: &str = "\
Examples:
  touchstone run normal_contact
  touchstone run 'contact|top' --tier standard
  touchstone run silo_discharge --tier paper --setup 'springs of friction' --knob 1     one point of a long case
  touchstone run . --threads 2     every case, two side by side; results are the same, times are less quiet";

const SCENE_EXAMPLES: &str = "\
Examples:
  touchstone scene verification/scenes/bouncing_ball.toml --out bounce
  touchstone scene verification/scenes/bouncing_ball.toml --out bounce --resume    after raising end_time
  touchstone scene --keys                                                          all keys of scene files
  touchstone scene --keys --json > scene.schema.json                               for editors";

const EXPORT_EXAMPLES: &str = "\
Examples:
  touchstone export normal_contact --out normal_contact_for_others";

const COMPARE_EXAMPLES: &str = "\
Examples:
  touchstone export normal_contact --out exported    fill the value column of exported/template.csv, then
  touchstone compare normal_contact exported/template.csv";

const REPORT_EXAMPLES: &str = "\
Examples:
  touchstone report
  touchstone report --results elsewhere/results --site elsewhere/site";
