//! Bad input: refused with exit code 2 and a message that names file, line, key and what is allowed; nothing is left behind.

use std::fs;

use super::{SCENE, contents, folder, names, touchstone, write};

/// A scene that must be refused: what is replaced in the good scene, and what the message must contain.
struct BadScene {
    fault: &'static str,
    replace: (&'static str, &'static str),
    wanted: &'static [&'static str],
}

const fn bad(fault: &'static str, replace: (&'static str, &'static str), wanted: &'static [&'static str]) -> BadScene {
    BadScene { fault, replace, wanted }
}

const TWICE_ZERO: &str =
    "id = 0\nposition = [0.0, 0.0, 0.5]\n\n[[body]]\nshape = \"ball\"\nmaterial = \"rubber\"\nid = 0\nposition = [0.0, 0.0, 1.5]";
const BALL: &str = "{ sphere = { radius = 0.02 } }";
const STEP_TOO_LARGE: (&str, &str) = ("[output]", "[numerics]\nstep = 0.01\n\n[output]");

/// One line per way to get a scene wrong.
const BAD_SCENES: &[BadScene] = &[
    bad("unknown key", ("density", "densty"), &["bad.toml:8", "`material[0].densty`", "did you mean `density`"]),
    bad("unknown table", ("[output]", "[outputs]"), &["bad.toml:", "`outputs`", "did you mean `output`"]),
    bad("missing key", ("end_time = 0.35\n", ""), &["bad.toml:1", "`scene`", "missing field `end_time`"]),
    bad("missing mass", ("density = 1100.0\n", ""), &["bad.toml:", "`body[0].mass`", "has no density"]),
    bad("wrong type", ("end_time = 0.35", "end_time = \"soon\""), &["bad.toml:4", "`scene.end_time`", "expected f64"]),
    bad("too few components", ("[0.0, 0.0, 0.5]", "[0.0, 0.5]"), &["bad.toml:25", "`body[0].position", "expected an array of length 3"]),
    bad("not a number", ("radius = 0.02", "radius = nan"), &["bad.toml:20", "`shape[0].geometry.sphere.radius`", "NaN is not"]),
    bad("infinity", ("velocity = [0.3", "velocity = [inf"), &["bad.toml:26", "`body[0].velocity`", "inf is not a finite number"]),
    bad("endless run", ("end_time = 0.35", "end_time = inf"), &["bad.toml:4", "`scene.end_time`", "above 0"]),
    bad("run without end", ("end_time = 0.35", "end_time = 1e300"), &["bad.toml:4", "`scene.end_time`", "steps"]),
    bad("run backwards", ("end_time = 0.35", "end_time = -1.0"), &["bad.toml:4", "`scene.end_time`", "above 0"]),
    bad(
        "negative mass",
        ("velocity =", "mass = -1.0\nvelocity ="),
        &["bad.toml:26", "`body[0].mass`", "-1 is not a finite number above 0"],
    ),
    bad("negative density", ("1100.0", "-1100.0"), &["bad.toml:8", "`material[0].density`", "above 0"]),
    bad("negative stiffness", ("stiffness = 1e4", "stiffness = -1e4"), &["bad.toml:15", "linear_spring_dashpot.stiffness`", "above 0"]),
    bad("negative friction", ("friction = 0.3", "friction = -0.3"), &["bad.toml:16", "linear_history.friction`", "at least 0"]),
    bad("zero radius", ("radius = 0.02", "radius = 0.0"), &["bad.toml:20", "sphere.radius`", "0 is not a finite number above 0"]),
    bad(
        "restitution below 0",
        ("restitution = 0.8", "restitution = -0.1"),
        &["bad.toml:15", "restitution`", "-0.1 is not a number in [0, 1]"],
    ),
    bad(
        "restitution above 1",
        ("restitution = 0.8", "restitution = 1.1"),
        &["bad.toml:15", "restitution`", "1.1 is not a number in [0, 1]"],
    ),
    bad(
        "no rebound without attraction",
        ("restitution = 0.8", "restitution = 0.0, end_of_contact = \"no_attraction\""),
        &["bad.toml:15", "restitution`", "(0, 1]"],
    ),
    bad(
        "unknown choice",
        ("restitution = 0.8", "restitution = 0.8, end_of_contact = \"zero_overlp\""),
        &["bad.toml:15", "did you mean `zero_overlap`"],
    ),
    bad("zero step", ("[output]", "[numerics]\nstep = 0.0\n\n[output]"), &["bad.toml:40", "`numerics.step`", "above 0"]),
    bad("negative step", ("[output]", "[numerics]\nstep = -1e-5\n\n[output]"), &["bad.toml:40", "`numerics.step`", "above 0"]),
    bad("step too large", STEP_TOO_LARGE, &["bad.toml:40", "`numerics.step`", "limit of stability", "body 0 and boundary `ground`"]),
    bad("half a step in a contact", ("[output]", "[numerics]\nsteps_per_contact = 0.5\n\n[output]"), &["bad.toml:40", "at least 1"]),
    bad("zero interval", ("0.0037", "0.0"), &["bad.toml:40", "`output.probe_interval`", "above 0"]),
    bad(
        "overlap at the start",
        ("[0.0, 0.0, 0.5]", "[0.0, 0.0, 0.01]"),
        &["bad.toml:25", "`body[0].position`", "boundary `ground` overlap by"],
    ),
    bad("centre behind the wall", ("[0.0, 0.0, 0.5]", "[0.0, 0.0, -5.0]"), &["bad.toml:25", "`body[0].position`", "overlap"]),
    bad("id twice", ("position = [0.0, 0.0, 0.5]", TWICE_ZERO), &["bad.toml:31", "`body[1].id`", "id 0 is used twice"]),
    bad("name twice", ("name = \"floor\"", "name = \"rubber\""), &["bad.toml:11", "`material[1].name`", "used twice"]),
    bad(
        "unknown material",
        ("material = \"rubber\"", "material = \"ruber\""),
        &["bad.toml:24", "`body[0].material`", "did you mean `rubber`"],
    ),
    bad("unknown shape", ("shape = \"ball\"", "shape = \"bal\""), &["bad.toml:23", "`body[0].shape`", "did you mean `ball`"]),
    bad("unknown material in a pair", ("\"floor\"]", "\"flor\"]"), &["bad.toml:14", "`pair[0].materials`", "did you mean `floor`"]),
    bad(
        "probe of nothing",
        ("measure = \"position\"", "measure = \"position\"\nbody = 4"),
        &["bad.toml:35", "`probe[0].body`", "no body with id 4"],
    ),
    bad("no direction", ("normal = [0.0, 0.0, 1.0]", "normal = [0.0, 0.0, 0.0]"), &["bad.toml:31", "plane.normal`", "no direction"]),
    bad("no rotation", ("velocity =", "orientation = [0.0, 0.0, 0.0, 0.0]\nvelocity ="), &["bad.toml:26", "`body[0].orientation`"]),
    bad(
        "a cylinder without length",
        (BALL, "{ cylinder = { radius = 0.02, length = 0.0 } }"),
        &["bad.toml:20", "`shape[0].geometry.cylinder.length`", "above 0"],
    ),
    bad("unknown kind of shape", (BALL, "{ cylindre = { radius = 0.02 } }"), &["bad.toml:20", "cylindre", "did you mean `cylinder`"]),
    bad(
        "flat polyhedron",
        (BALL, "{ hull = { points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]] } }"),
        &["bad.toml:20", "`shape[0].geometry.hull`", "volume"],
    ),
    bad(
        "faces that look inwards",
        (
            BALL,
            "{ polyhedron = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]] } }",
        ),
        &["bad.toml:20", "`shape[0].geometry.polyhedron`", "inward"],
    ),
    bad(
        "a polyhedron that is not convex",
        (
            BALL,
            "{ polyhedron = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0.3, 0.3, 0.3]], faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 4], [2, 3, 4], [3, 1, 4]] } }",
        ),
        &["bad.toml:20", "`shape[0].geometry.polyhedron`", "convex"],
    ),
    bad(
        "a part that does not exist",
        (BALL, "{ composite = { parts = [{ shape = \"bell\" }] } }"),
        &["bad.toml:20", "parts[0].shape`", "`bell` is not defined", "did you mean `ball`"],
    ),
    bad(
        "a composite of composites",
        (BALL, "{ composite = { parts = [{ shape = \"ball\" }] } }"),
        &["bad.toml:20", "parts[0].shape`", "not convex"],
    ),
    bad("no part", (BALL, "{ composite = { parts = [] } }"), &["bad.toml:20", "composite.parts`", "at least one part"]),
    bad(
        "a cross of stubs",
        (BALL, "{ cross_in_space = { radius = 0.02, length = 0.03 } }"),
        &["bad.toml:20", "cross_in_space.length`", "at least the diameter"],
    ),
    bad(
        "a crust as thick as the shape",
        ("[output]", "[numerics.shaped_contact]\ncrust = 1.0\n\n[output]"),
        &["bad.toml:", "`numerics.shaped_contact.crust`", "below 1"],
    ),
    bad("nothing to advise a step from", ("[[pair]]\n", "[[nothing]]\n"), &["bad.toml:13", "`nothing`", "unknown field"]),
    bad("a table cut off", ("[output]", "[output"), &["bad.toml:39"]),
    bad("a key twice", ("end_time = 0.35", "end_time = 0.35\nend_time = 0.4"), &["bad.toml:5", "duplicate key"]),
];

const BALLS_IN_OIL: &str = include_str!("../../../scenes/balls_in_oil.toml");
const OIL: &str = "[fluid]\ndensity = 960.0";
const BOX: &str = "[domain]\nlower = [0.0, 0.0, 0.0]\nupper = [0.012, 0.012, 0.024]\nperiodic = [true, true, false]\n";
const FREE: &str = "bodies = \"free\"";
const GIVEN: &str = "bodies = \"given\"";

/// One line per way to get a scene with a fluid wrong.
const BAD_FLUIDS: &[BadScene] = &[
    bad("unknown key", ("viscosity", "viscocity"), &["`fluid.viscocity`", "did you mean `viscosity`"]),
    bad("no viscosity", ("viscosity = 0.05", "viscosity = 0.0"), &["`fluid.viscosity`", "0 is not a finite number above 0"]),
    bad("nothing as density", ("density = 960.0", "density = nan"), &["`fluid.density`", "NaN is not"]),
    bad("no slip at all", ("slip = 1e-5", "slip = 0.0"), &["`fluid.slip`", "above 0"]),
    bad("a step backwards", ("step = 1e-3", "step = -1e-3"), &["`fluid.step`", "above 0"]),
    bad("half a cell", ("0.012, 0.024]", "0.0123, 0.024]"), &["`fluid.spacing`", "whole cells", "direction 1"]),
    bad("one cell", ("spacing = 0.00075", "spacing = 0.012"), &["`fluid.spacing`", "1 cells in direction 0", "4 to 4096"]),
    bad("more cells than memory", ("spacing = 0.00075", "spacing = 0.00001"), &["`fluid.spacing`", "at most 50000000"]),
    bad("cells wider than a ball", ("spacing = 0.00075", "spacing = 0.003"), &["`fluid.spacing`", "spacings deep", "at least 1"]),
    bad("no box", (BOX, ""), &["`fluid`", "needs a [domain]"]),
    bad("endless iterations", (OIL, "[fluid]\nmost_flows = 4000000000\ndensity = 960.0"), &["`fluid.most_flows`", "from 1 to 10000"]),
    bad(
        "a push through the floor",
        (OIL, "[fluid]\ndriving_force = [0.0, 0.0, 1.0]\ndensity = 960.0"),
        &["`fluid.driving_force`", "walls stand there"],
    ),
    bad(
        "a floor in the fluid",
        ("point = [0.0, 0.0, 0.0]", "point = [0.0, 0.0, 0.001]"),
        &["`boundary[0].geometry`", "would pass through it"],
    ),
    bad(
        "a floor that moves",
        ("[[boundary]]", "[[boundary]]\nmotion = { removed_at = 0.1 }"),
        &["`boundary[0].geometry`", "planes at rest"],
    ),
    bad(
        "first order in turning",
        ("[output]", "[numerics]\nrotation = \"explicit_euler\"\n[output]"),
        &["`numerics.rotation`", "angular momentum"],
    ),
    bad("no coupling", ("[coupling.resolved]\nbodies = \"free\"", ""), &["`coupling`", "say how bodies meet the [fluid]"]),
    bad("two couplings", (FREE, "bodies = \"held\""), &["`coupling.resolved.bodies`", "unknown variant `held`"]),
    bad("contacts of given motion", (FREE, GIVEN), &["`coupling.resolved.bodies`", "feel no contact"]),
    bad("a ball outside", ("0.0195]", "0.0301]"), &["`body[1].position`", "outside the [domain]"]),
    bad("a ball in the ceiling", ("0.0195]", "0.0225]"), &["`body[1].position`", "body 1 reaches through the wall across direction 2"]),
    bad("balls wider than the world", ("radius = 0.003", "radius = 3000.0"), &["`body[0].shape`", "edges of the box"]),
    bad("balls in each other", ("0.0195]", "0.0160]"), &["`body[1].position`", "bodies 0 and 1 overlap"]),
    bad(
        "wind through the floor",
        (OIL, "[fluid]\nvelocity = [0.0, 0.0, 0.1]\ndensity = 960.0"),
        &["`fluid.velocity`", "walls stand there"],
    ),
    bad(
        "a mean flow through the floor",
        (OIL, "[fluid]\nmean_velocity = [0.0, 0.0, 0.1]\ndensity = 960.0"),
        &["`fluid.mean_velocity`", "walls stand there"],
    ),
    bad(
        "driven twice",
        (OIL, "[fluid]\nmean_velocity = [0.1, 0.0, 0.0]\ndriving_force = [1.0, 0.0, 0.0]\ndensity = 960.0"),
        &["`fluid.driving_force`", "leave one of them out"],
    ),
    bad(
        "sides of a box without sides",
        (OIL, "[fluid]\nmoving_sides = [{ across = \"x\", upper = [0.0, 1.0, 0.0] }]\ndensity = 960.0"),
        &["`fluid.moving_sides[0].across`", "no sides there"],
    ),
    bad(
        "a floor that rises",
        (OIL, "[fluid]\nmoving_sides = [{ across = \"z\", lower = [0.0, 0.0, 1.0] }]\ndensity = 960.0"),
        &["`fluid.moving_sides[0]`", "along themselves"],
    ),
    bad(
        "hard balls",
        ("{ linear_spring_dashpot = { stiffness = 2000.0, restitution = 0.9 } }", "{ impulse = { restitution = 0.9 } }"),
        &["`pair[0].normal`", "use a soft law"],
    ),
    bad(
        "a shape no flow knows",
        ("{ sphere = { radius = 0.003 } }", "{ spherocylinder = { radius = 0.003, length = 0.001 } }"),
        &["`shape[0].geometry`", "trilobe"],
    ),
    bad("contacts without end", ("stiffness = 2000.0", "stiffness = 2e18"), &["`fluid.step`", "shorter step or softer contacts"]),
];

#[test]
fn bad_scenes_are_refused_with_file_line_and_key_and_leave_nothing() {
    refuses_all(SCENE, BAD_SCENES);
}

#[test]
fn bad_fluids_are_refused_with_file_line_and_key_and_leave_nothing() {
    refuses_all(BALLS_IN_OIL, BAD_FLUIDS);
    let no_fluid = SCENE.replace("measure = \"position\"", "measure = \"mean_flow\"") + "\n[coupling.resolved]\n";
    for (text, wanted) in [(&no_fluid, "no [fluid] to couple bodies to"), (&no_fluid.replace("[coupling.resolved]", ""), "has no [fluid]")]
    {
        let folder = folder();
        write(folder.path(), "bad.toml", text);
        let done = touchstone(folder.path(), &["scene", "bad.toml", "--out", "out"]);
        assert!(done.code == 2 && done.stderr.contains(wanted), "{}", done.stderr);
    }
}

fn refuses_all(good_scene: &str, bad_scenes: &[BadScene]) {
    let folder = folder();
    for BadScene { fault, replace: (good, wrong), wanted } in bad_scenes {
        assert!(good_scene.contains(good), "{fault}: the good scene has no `{good}`");
        write(folder.path(), "bad.toml", &good_scene.replacen(good, wrong, 1));
        let done = touchstone(folder.path(), &["scene", "bad.toml", "--out", "out"]);
        assert_eq!(done.code, 2, "{fault}: {}{}", done.stdout, done.stderr);
        assert!(done.stderr.starts_with("error: bad.toml:"), "{fault}: {}", done.stderr);
        for part in *wanted {
            assert!(done.stderr.contains(part), "{fault}: `{part}` is not in: {}", done.stderr);
        }
        assert_eq!(names(folder.path()), ["bad.toml"], "{fault} left something behind");
    }
}

#[test]
fn texts_that_are_no_scenes_are_refused() {
    let folder = folder();
    let no_pairs = SCENE.split("[[pair]]").next().unwrap_or_default().to_string()
        + "[[shape]]\nname = \"ball\"\ngeometry = { sphere = { radius = 0.02 } }\n[[body]]\nshape = \"ball\"\nmaterial = \"rubber\"\nposition = [0, 0, 0]\n";
    let texts: [(&str, &[u8], &[&str]); 6] = [
        ("empty file", b"", &["`scene`", "missing field"]),
        ("empty scene", b"[scene]\nname = \"nothing\"\nend_time = 1.0\n", &["the scene is empty", "[[body]]"]),
        ("binary garbage", &[0x7f, 0x45, 0x4c, 0x46, 0xff, 0xfe, 0x00, 0x80], &["not text", "byte 4"]),
        ("text garbage", b"\x00\x01\x02{{{{", &["text.toml:1"]),
        ("no contacts, no step", no_pairs.as_bytes(), &["`numerics.step`", "nothing in the scene can touch"]),
        ("deep nesting", &[b'['; 100_000], &["text.toml"]),
    ];
    for (fault, text, wanted) in texts {
        fs::write(folder.path().join("text.toml"), text).expect("a file is written");
        let done = touchstone(folder.path(), &["scene", "text.toml", "--out", "out"]);
        assert_eq!(done.code, 2, "{fault}: {}", done.stderr);
        for part in wanted.iter().chain(&["error: ", "text.toml"]) {
            assert!(done.stderr.contains(part), "{fault}: `{part}` is not in: {}", done.stderr);
        }
        assert_eq!(names(folder.path()), ["text.toml"], "{fault} left something behind");
    }
}

#[test]
fn bad_places_are_refused_and_left_as_they_are() {
    let folder = folder();
    let (path, good) = (folder.path(), SCENE);
    write(path, "good.toml", good);
    write(path, "file", "a file");
    fs::create_dir_all(path.join("strange/vtk")).expect("a folder");
    write(path, "strange/diary.txt", "not the output of a run");
    let run = |name: &str, end: &str| {
        write(path, "run.toml", &good.replace("0.35", end));
        assert_eq!(touchstone(path, &["scene", "run.toml", "--out", name]).code, 0);
    };
    run("former", "0.01");
    run("corrupt", "0.01");
    write(path, "corrupt/checkpoint.json", "{\"format\":1,");
    run("later", "0.02");
    run("other", "0.01");
    let checkpoint = fs::read_to_string(path.join("other/checkpoint.json")).expect("a checkpoint");
    write(path, "other/checkpoint.json", &checkpoint.replace("\"restitution\":0.8", "\"restitution\":0.7"));
    run("foreign_rows", "0.01");
    write(path, "foreign_rows/probes.csv", "time,nothing\ns,1\n");
    write(path, "short.toml", &good.replace("0.35", "0.01"));
    let before = contents(path);
    let rows: &[(&[&str], &[&str])] = &[
        (&["scene", "good.toml", "--out", "file"], &["`file` is a file"]),
        (&["scene", "good.toml", "--out", "file/out"], &["`file/out`", "Not a directory"]),
        (&["scene", "absent.toml", "--out", "out"], &["cannot read `absent.toml`"]),
        (&["scene", "strange", "--out", "out"], &["cannot read `strange`", "it is a folder"]),
        (&["scene", "/dev/zero", "--out", "out"], &["cannot read `/dev/zero`", "not a regular file"]),
        (&["scene", "good.toml", "--out", "strange"], &["`strange` is not empty", "choose another folder"]),
        (&["scene", "good.toml", "--out", "strange", "--overwrite"], &["`strange` is not empty", "choose another folder"]),
        (&["scene", "good.toml", "--out", "former"], &["former run", "`--resume`", "`--overwrite`"]),
        (&["scene", "good.toml", "--out", "out", "--resume"], &["nothing to resume", "checkpoint.json"]),
        (&["scene", "good.toml", "--out", "corrupt", "--resume"], &["corrupt/checkpoint.json", "not a checkpoint"]),
        (&["scene", "good.toml", "--out", "other", "--resume"], &["other/checkpoint.json", "another scene"]),
        (&["scene", "good.toml", "--out", "foreign_rows", "--resume"], &["foreign_rows/probes.csv", "line 1"]),
        (&["scene", "short.toml", "--out", "later", "--resume"], &["`scene.end_time`", "beyond"]),
        (&["scene", "good.toml"], &["--out"]),
        (&["export", "normal_contact", "--out", "strange"], &["`strange` is taken"]),
        (&["export", "normal_contact", "--out", "file/out"], &["cannot create the folder `file`"]),
        (&["run", "normal_contact"], &["not inside a checkout", "--results DIR --site DIR"]),
        (&["report", "--results", "absent", "--site", "site"], &["no results in `absent`"]),
        (&["run", "normal_contact", "--results", "file/results", "--site", "site"], &["cannot create the folder"]),
    ];
    for (arguments, wanted) in rows {
        let done = touchstone(path, arguments);
        assert_eq!(done.code, 2, "{arguments:?}: {}{}", done.stdout, done.stderr);
        for part in *wanted {
            assert!(done.stderr.contains(part), "{arguments:?}: `{part}` is not in: {}", done.stderr);
        }
        assert!(contents(path) == before, "{arguments:?} changed something");
    }
}

#[test]
fn unknown_cases_and_bad_patterns_are_refused() {
    let folder = folder();
    let places = ["--results", "results", "--site", "site"];
    let rows: &[(&[&str], &[&str])] = &[
        (&["run", "normal_contct"], &["no case `normal_contct`", "did you mean `normal_contact`"]),
        (&["run", "nor[mal"], &["`nor[mal` is neither a case nor a regular expression"]),
        (&["run", "normal_contact", "--threads", "0"], &["--threads"]),
        (&["run", "normal_contact", "--tier", "huge"], &["--tier", "quick"]),
        (&["export", "normal", "--out", "out"], &["no case `normal`", "did you mean `normal_contact`"]),
        (&["compare", "nothing_like_it", "file.csv"], &["no case `nothing_like_it`"]),
        (&["runn"], &["runn"]),
    ];
    for (arguments, wanted) in rows {
        let done = touchstone(folder.path(), &[*arguments, &places].concat());
        assert_eq!(done.code, 2, "{arguments:?}: {}{}", done.stdout, done.stderr);
        for part in *wanted {
            assert!(done.stderr.contains(part), "{arguments:?}: `{part}` is not in: {}", done.stderr);
        }
        assert!(names(folder.path()).is_empty(), "{arguments:?} left something behind");
    }
}
