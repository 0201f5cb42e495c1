//! Hand-made results: one realistic case, one red case, one without rows. Numbers follow simple laws, not a solver.

use std::collections::BTreeMap;

use reports::card::{Equation, Headline, LedgerLine, Mutant, Parameter, Picture, PictureItem, Plot};
use reports::row::{Cost, ErrorKind, Expectation, Knob, Reference, ReferenceKind};
use reports::{Card, CaseResults, DataFile, KeyDoc, KeyTable, Results, Row, SiteMeta};

pub const KNOBS: [f64; 7] = [10.0, 20.0, 40.0, 80.0, 160.0, 320.0, 640.0];
pub const RESTITUTIONS: [f64; 4] = [1.0, 0.9, 0.5, 0.1];
/// Scheme, order of its median error, error at ten steps, cost of a step in seconds.
pub const SCHEMES: [(&str, f64, f64, f64); 3] = [
    ("velocity Verlet, lagged damping", 1.0, 8e-2, 20e-9),
    ("velocity Verlet, centred damping", 2.0, 2e-2, 22e-9),
    ("classical Runge-Kutta", 2.0, 4e-3, 75e-9),
];

pub fn meta() -> SiteMeta {
    SiteMeta { commit: "1a2b3c4d5e6f".into(), date: "2025-05-17".into(), machine: "2 cores, x86-64, Linux".into(), version: "0.1.0".into() }
}

pub fn setup(restitution: f64, scheme: &str) -> String {
    format!("e={restitution}, until zero overlap, {scheme}")
}

/// A row without a claim; tests change what they are about.
pub fn row(case: &str, setup: &str, knob: f64, statistic: &str, error: f64) -> Row {
    Row {
        case: case.into(),
        setup: setup.into(),
        quantity: "restitution".into(),
        knob: Some(Knob { name: "steps_per_contact".into(), value: knob }),
        statistic: format!("{statistic} of 200 phases"),
        n: 200,
        ci95: (statistic == "median").then_some([error * 0.6, error * 1.7]),
        value: Some(0.9 * (1.0 + error)),
        expected: Some(0.9),
        reference: Some(Reference { kind: ReferenceKind::Exact, uncertainty: 1e-15, source: "R eq 3.26".into() }),
        error: Some(error),
        error_kind: ErrorKind::Relative,
        floor: Some(3e-7),
        cost: cost(knob, 22e-9),
        random_seed: 7,
        version: "0.1.0".into(),
        commit: "1a2b3c4d5e6f".into(),
        machine: "2 cores, x86-64, Linux".into(),
        ..Row::default()
    }
}

fn cost(knob: f64, seconds_per_step: f64) -> Cost {
    let steps = (knob * 1.3 * 200.0) as u64;
    let cpu_s = steps as f64 * seconds_per_step;
    Cost {
        work: BTreeMap::from([("steps".into(), steps), ("contacts".into(), 200)]),
        cpu_s: Some(cpu_s),
        cpu_s_range: Some([cpu_s * 0.85, cpu_s * 1.2]),
        rounds: Some(7),
        reference_kernels: Some(cpu_s / 1e-3),
        runs: 200,
        wall_s: Some(cpu_s * 1.1),
        instructions: None,
        peak_bytes: Some(1_200_000),
    }
}

/// The row with a claim of the given kind.
pub fn claim(mut row: Row, bound: f64, expectation: Expectation) -> Row {
    row.bound = Some(bound);
    row.bound_reason = Some("3 × design error at this knob".into());
    row.expectation = expectation;
    row.pass = row.error.map(|error| error <= bound);
    row.expectation_reason = match expectation {
        Expectation::Holds => None,
        Expectation::KnownLimit => Some("a contact that starts between two steps is seen late".into()),
        Expectation::SourceError => Some("the source prints the wrong sign of the damping ratio".into()),
    };
    row
}

/// The row as a run that failed.
pub fn failed(mut row: Row, reason: &str) -> Row {
    row.value = None;
    row.error = None;
    row.ci95 = None;
    row.cost.cpu_s = None;
    row.cost.cpu_s_range = None;
    row.failed = Some(reason.into());
    row
}

fn order_row(restitution: f64, scheme: &str, order: f64) -> Row {
    let mut row = row("normal_contact", &setup(restitution, scheme), 0.0, "median", 0.02);
    row.quantity = "order".into();
    row.knob = None;
    row.value = Some(order + 0.02);
    row.expected = Some(order);
    row.error_kind = ErrorKind::Absolute;
    row.floor = Some(0.05);
    row.ci95 = None;
    row.cost = Cost::default();
    let mut row = claim(row, 0.3, Expectation::Holds);
    row.bound_reason = Some("orders are fitted to seven points".into());
    row
}

/// Errors fall with the order of their scheme until the floor; a fixed wobble keeps them from a perfect line.
fn contact_rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for restitution in RESTITUTIONS {
        for (scheme, order, coarse, step_cost) in SCHEMES {
            for (index, knob) in KNOBS.into_iter().enumerate() {
                let wobble = 1.0 + 0.25 * (index as f64 * 2.3 + restitution * 5.0).sin();
                let median = (coarse * (1.5 - restitution) * (knob / 10.0).powf(-order) * wobble).max(2e-7);
                let worst = 2.0 * coarse * (1.5 - restitution) * (knob / 10.0).powf(-1.0);
                for (statistic, error) in [("median", median), ("worst", worst)] {
                    let mut row = row("normal_contact", &setup(restitution, scheme), knob, statistic, error);
                    row.expected = Some(restitution);
                    row.value = Some(restitution * (1.0 + error));
                    row.cost = cost(knob, step_cost);
                    let claimed = knob == 80.0 && statistic == "median";
                    rows.push(if claimed { claim(row, error * 2.4, Expectation::Holds) } else { row });
                }
            }
            rows.push(order_row(restitution, scheme, order));
        }
    }
    rows
}

fn foreign_rows() -> Vec<Row> {
    KNOBS[1..5]
        .iter()
        .map(|knob| {
            let mut row = row("normal_contact", &setup(0.9, SCHEMES[0].0), *knob, "single run", 0.3 / knob);
            row.statistic = "single run".into();
            row.code = "othercode".into();
            row.version = "2024.1".into();
            claim(row, 1e-2, Expectation::Holds)
        })
        .collect()
}

fn setups() -> Vec<String> {
    SCHEMES.iter().map(|(scheme, ..)| setup(0.9, scheme)).collect()
}

fn picture() -> Picture {
    Picture {
        caption: "A disc of radius R meets a wall with speed v; the spring acts while they overlap.".into(),
        items: vec![
            PictureItem::Wall { from: [-3.0, 0.0], to: [3.0, 0.0], solid_side: [0.0, -1.0] },
            PictureItem::Disc { center: [-1.5, 2.4], radius: 1.0, ghost: true },
            PictureItem::Disc { center: [0.0, 0.9], radius: 1.0, ghost: false },
            PictureItem::Disc { center: [1.5, 2.2], radius: 1.0, ghost: true },
            PictureItem::Arrow { from: [-1.5, 2.4], to: [-0.7, 1.5], label: "v".into() },
            PictureItem::Arrow { from: [1.5, 2.2], to: [2.1, 3.0], label: "e v".into() },
            PictureItem::Dashed { from: [0.0, 0.9], to: [1.0, 0.9] },
            PictureItem::Label { at: [0.45, 1.15], text: "R".into() },
        ],
    }
}

fn plots() -> Vec<Plot> {
    vec![
        Plot::Curves {
            title: "Overlap during the contact".into(),
            file: "normal_contact/overlap.csv".into(),
            x_label: "time, s".into(),
            y_label: "overlap, m".into(),
            columns: vec![["computed".into(), "computed".into()], ["exact".into(), "exact solution".into()]],
            log_x: false,
            log_y: false,
            caption: "Both curves lie on each other; the contact ends when the overlap is zero.".into(),
        },
        Plot::Bars {
            title: "Cost of what is left out".into(),
            file: "normal_contact/left_out.csv".into(),
            x_label: "CPU time with it over without it".into(),
            caption: "Bars begin at one: no cost.".into(),
        },
        Plot::Convergence {
            title: "Error against steps per contact".into(),
            quantity: "restitution".into(),
            setups: setups(),
            statistics: vec!["median".into(), "worst".into()],
            orders: vec![1.0, 2.0],
            knob_is_resolution: true,
            knob_label: "steps per contact".into(),
        },
        Plot::ErrorAgainstCost {
            title: "Error against run time".into(),
            quantity: "restitution".into(),
            setups: setups(),
            statistic: "median".into(),
            targets: vec![0.1, 0.01, 0.001],
        },
    ]
}

fn card(case: &str) -> Card {
    let line = |stage: &str, used, reason: &str, count: u64| LedgerLine {
        stage: stage.into(),
        used,
        reason: reason.into(),
        work: BTreeMap::from([("calls".into(), count)]),
    };
    Card {
        case: case.into(),
        title: "Normal contact of a sphere and a wall".into(),
        question: "Does a sphere leave a wall with exactly the speed its contact law promises?".into(),
        model: vec!["A sphere meets a wall head-on; a linear spring and a viscous damper act while they overlap.".into()],
        equations: vec![Equation {
            latex: r"m\ddot{\delta} + 2 m \gamma_n \dot{\delta} + k_n \delta = 0, \qquad e = \exp\left(-\frac{\gamma_n \pi}{\sqrt{\omega_0^2-\gamma_n^2}}\right)".into(),
            meaning: "Motion during contact and its restitution (R eq 3.26).".into(),
        }],
        parameters: vec![Parameter { name: "stiffness".into(), value: "1e5 N/m".into(), remark: "overlap 0.1 % of R".into() }],
        reference: "The closed form of the model that is coded, so that only the time step is left as an error.".into(),
        picture: picture(),
        plots: plots(),
        headline: Headline {
            setup: setup(0.9, SCHEMES[1].0),
            quantity: "restitution".into(),
            statistic: "median".into(),
            knob: 80.0,
            order_quantity: Some("order".into()),
        },
        ledger: vec![
            line("normal force", true, "linear spring and damper", 52_000),
            line("tangential force", false, "the impact is central and the sphere does not spin", 0),
            line("broad phase", false, "one pair only", 0),
        ],
        mutants: vec![Mutant { name: "damping taken at the old velocity".into(), caught_by: "order of the median".into() }],
        sources: vec!["R section 3.4".into(), "A thread: https://example.org/thread/1.".into()],
        answers: vec!["Requirement 3: error against run time".into()],
        remarks: vec!["The worst phase is a hundred times worse than the median.".into()],
        budget_cpu_s: 5.0,
        command: None,
    }
}

fn overlap_file() -> DataFile {
    let mut content = String::from("time,computed,exact\ns,m,m\n");
    for index in 0..=2000 {
        let time = f64::from(index) * 5e-7;
        let overlap = 1e-5 * (time * std::f64::consts::PI / 1e-3).sin();
        content += &format!("{time:e},{:e},{overlap:e}\n", overlap * (1.0 + 0.02 * (time * 4e4).sin()));
    }
    DataFile { path: "normal_contact/overlap.csv".into(), content }
}

fn bars_file() -> DataFile {
    let content = "what,ratio,low,high,same answer\norientation,1.24,1.2,1.3,yes: to the bit\nwall as plate,0.98,0.9,1.02,yes: to 1e-12\n";
    DataFile { path: "normal_contact/left_out.csv".into(), content: content.into() }
}

/// A case all of whose expectations are met, with one row of each kind.
pub fn good_case() -> CaseResults {
    let mut rows = contact_rows();
    let extra = |quantity: &str, error| {
        let mut row = row("normal_contact", &setup(0.9, SCHEMES[0].0), 20.0, "worst", error);
        row.quantity = quantity.into();
        row
    };
    rows.push(claim(extra("contact time", 4e-2), 1e-2, Expectation::KnownLimit));
    rows.push(claim(extra("restitution as printed", 0.3), 1e-2, Expectation::SourceError));
    rows.push(failed(row("normal_contact", &setup(0.9, SCHEMES[0].0), 5.0, "median", 1.0), "the sphere stuck to the wall"));
    rows[0].data = vec!["normal_contact/overlap.csv".into(), "normal_contact/lost.csv".into()];
    rows.extend(foreign_rows());
    let baseline = contact_rows().into_iter().map(|mut row| {
        row.error = row.error.map(|error| error * 1.3);
        row
    });
    CaseResults { card: card("normal_contact"), baseline: baseline.collect(), rows, data: vec![overlap_file(), bars_file()] }
}

/// A case with a claim that is not met.
pub fn red_case() -> CaseResults {
    let mut card = card("silo_discharge");
    card.title = "Discharge of a flat silo".into();
    card.question = "Does the discharge rate follow the Beverloo law?".into();
    card.plots.retain(|plot| !matches!(plot, Plot::Curves { .. }));
    let mut rows: Vec<Row> = KNOBS.iter().map(|knob| row("silo_discharge", &setups()[1], *knob, "median", 0.8 / knob)).collect();
    rows[0] = claim(rows[0].clone(), 1.0, Expectation::Holds);
    rows[3] = claim(rows[3].clone(), 4e-3, Expectation::Holds);
    rows[4] = claim(rows[4].clone(), 1.0, Expectation::KnownLimit);
    CaseResults { card, rows, baseline: Vec::new(), data: Vec::new() }
}

/// A case that was never run.
pub fn empty_case() -> CaseResults {
    let mut card = card("dam_break");
    card.title = "Dam break of cubes".into();
    card.picture = Picture::default();
    CaseResults { card, rows: Vec::new(), baseline: Vec::new(), data: Vec::new() }
}

pub fn results() -> Results {
    let key = |name: &str, required, default: &str| KeyDoc {
        name: name.into(),
        type_name: "list of 3 numbers".into(),
        required,
        default: default.into(),
        doc: "In metres.".into(),
    };
    let table = |table: &str| KeyTable {
        table: table.into(),
        doc: "The box the world lives in.".into(),
        keys: vec![key("lower", true, ""), key("upper", true, ""), key("periodic", false, "[false, false, false]")],
    };
    Results { cases: vec![good_case(), red_case(), empty_case()], scene_keys: vec![table("domain"), table("numerics")] }
}
