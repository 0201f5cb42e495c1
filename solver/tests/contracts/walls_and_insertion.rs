//! Walls and inserted bodies from the text of a scene: what is built, and how what cannot be is refused.

use solver::boundary::{SphereTouch, Wall};
use solver::scene::{Scene, SceneError, SceneErrorKind};
use solver::{Simulation, Vector};

/// A scene with more tables behind it.
fn text(tables: &str) -> String {
    format!(
        r#"
[scene]
name = "fill"
gravity = [0.0, 0.0, -9.81]
end_time = 1e-3
random_seed = 7

[[material]]
name = "glass"
density = 2500.0

[[pair]]
materials = ["glass", "glass"]
normal = {{ linear_spring_dashpot = {{ stiffness = 1e4, restitution = 0.9 }} }}

[[shape]]
name = "ball"
geometry = {{ sphere = {{ radius = 0.005 }} }}

[[shape]]
name = "brick"
geometry = {{ cuboid = {{ lengths = [0.004, 0.006, 0.008] }} }}

{tables}
"#
    )
}

fn build(tables: &str) -> Result<Simulation, SceneError> {
    Scene::from_toml(&text(tables), "fill.toml")?.build()
}

fn refusal(tables: &str) -> (SceneErrorKind, String, String) {
    let error = build(tables).map(|_| ()).expect_err("this scene must be refused");
    (error.kind, error.key.clone(), error.to_string())
}

const LATTICE: &str = r#"
[[insertion]]
name = "rows"
material = "glass"
number = 500
shapes = [{ shape = "ball", scale = [0.5, 1.0] }]
region = { lattice = { lower = [0.0, 0.0, 0.0], upper = [0.1, 0.1, 0.1], spacing = [0.011, 0.011, 0.011], jitter = 0.0004 } }
velocity = [0.0, 0.0, -1.0]
"#;

const WINDOW: &str = r#"
[[insertion]]
name = "window"
material = "glass"
number = 300
shapes = [{ shape = "ball", fraction = 2.0 }, { shape = "brick" }]
region = { box = { lower = [-0.1, -0.1, 0.0], upper = [0.1, 0.1, 0.2] } }
"#;

const VESSEL: &str = r#"
[[body]]
id = 4
shape = "ball"
material = "glass"
position = [0.0, 0.0, 0.1]

[[boundary]]
name = "floor"
material = "glass"
geometry = { plane = { point = [0.0, 0.0, 0.05], normal = [0.0, 0.0, 1.0] } }
"#;

/// Listed and inserted bodies: none overlaps another or the wall (the build would refuse it), ids go on, numbers and masses are those that are wanted.
#[test]
fn inserted_bodies_are_there_before_the_start() {
    let simulation = build(&format!("{VESSEL}{WINDOW}")).unwrap();
    let bodies = simulation.bodies();
    assert_eq!(bodies.len(), 301);
    assert_eq!((bodies.id(0), bodies.id(1), bodies.id(300)), (4, 5, 304));
    let spheres = (0..301).filter(|index| bodies.shape(*index).as_sphere().is_some()).count();
    assert_eq!(spheres, 201);
    assert!((0..301).all(|index| bodies.position(index).z >= 0.05 + bodies.shape(index).bounding_radius()));
    let brick = (0..301).find(|index| bodies.shape(*index).as_sphere().is_none()).unwrap();
    assert!((bodies.mass(brick) / (2500.0 * 0.004 * 0.006 * 0.008) - 1.0).abs() < 1e-14);
    for one in 0..301 {
        for other in 0..one {
            let reach = bodies.shape(one).bounding_radius() + bodies.shape(other).bounding_radius();
            assert!((bodies.position(one) - bodies.position(other)).norm() >= reach, "{one} {other}");
        }
    }
    let again = build(&format!("{VESSEL}{WINDOW}")).unwrap();
    assert_eq!(again.bodies(), bodies);
}

#[test]
fn a_lattice_fills_what_is_left_by_others() {
    let simulation = build(&format!("{LATTICE}{}", WINDOW.replace("number = 300", "number = 20"))).unwrap();
    let bodies = simulation.bodies();
    assert_eq!(bodies.len(), 520);
    let radii: Vec<f64> = (0..500).map(|index| bodies.shape(index).as_sphere().unwrap().radius).collect();
    assert!(radii.iter().all(|radius| (0.0025..=0.005).contains(radius)) && radii.iter().copied().fold(0.0, f64::max) > 0.0049);
    assert!((0..500).all(|index| bodies.half_step_velocity(index) == -Vector::z()));
}

/// A hundred thousand spheres in a box that leaves room for a tenth of its volume more: at random, and in rows.
#[test]
fn a_hundred_thousand_spheres_find_room() {
    let pairless = |tables: &str| {
        let text = text(tables);
        let (before, rest) = text.split_once("[[pair]]").unwrap();
        let rest = rest.split_once("[[shape]]").unwrap().1;
        Scene::from_toml(&format!("{before}[numerics]\nstep = 1e-3\n[[shape]]{rest}"), "many.toml").unwrap().build().unwrap()
    };
    let window = WINDOW.replace("number = 300", "number = 100000").replace(", { shape = \"brick\" }", "");
    // 0.0524 m^3 of balls in 0.216 m^3.
    let random = pairless(&window.replace("[-0.1, -0.1, 0.0], upper = [0.1, 0.1, 0.2]", "[0.0, 0.0, 0.0], upper = [0.6, 0.6, 0.6]"));
    assert_eq!(random.bodies().len(), 100_000);
    let rows = LATTICE.replace("number = 500", "number = 100000").replace("upper = [0.1, 0.1, 0.1]", "upper = [0.52, 0.52, 0.52]");
    assert_eq!(pairless(&rows).bodies().len(), 100_000);
}

#[test]
fn insertions_that_cannot_be_are_refused_by_key() {
    let lattice = |from: &str, to: &str| refusal(&LATTICE.replace(from, to));
    let window = |from: &str, to: &str| refusal(&WINDOW.replace(from, to));
    for ((kind, key, message), wanted_kind, wanted_key, wanted) in [
        (lattice("number = 500", "number = 0"), SceneErrorKind::Value, "insertion[0].number", "from 1 to 10000000"),
        (lattice("number = 500", "number = 730"), SceneErrorKind::Overlap, "insertion[0].number", "room for 729 bodies, 730 are wanted"),
        (
            lattice("jitter = 0.0004", "jitter = 0.0006"),
            SceneErrorKind::Combination,
            "insertion[0].region.lattice.jitter",
            "lets bodies overlap: at most 0.0004",
        ),
        (lattice("jitter = 0.0004", "jitter = nan"), SceneErrorKind::Value, "insertion[0].region.lattice.jitter", "NaN"),
        (
            lattice("[0.011, 0.011, 0.011]", "[0.011, 0.009, 0.011]"),
            SceneErrorKind::Combination,
            "insertion[0].region.lattice.spacing",
            "diameter",
        ),
        (
            lattice("upper = [0.1, 0.1, 0.1]", "upper = [0.1, 0.1, 0.0]"),
            SceneErrorKind::Value,
            "insertion[0].region.lattice.upper",
            "above the lower",
        ),
        (
            lattice("upper = [0.1, 0.1, 0.1]", "upper = [1e9, 1e9, 1e9]"),
            SceneErrorKind::Combination,
            "insertion[0].region.lattice.spacing",
            "sites",
        ),
        (lattice("[0.5, 1.0]", "[1.0, 0.5]"), SceneErrorKind::Value, "insertion[0].shapes[0].scale", "at least the least"),
        (lattice("\"ball\", scale", "\"brick\", scale"), SceneErrorKind::Unsupported, "insertion[0].shapes[0].scale", "only spheres"),
        (lattice("\"ball\"", "\"bell\""), SceneErrorKind::Reference, "insertion[0].shapes[0].shape", "did you mean `ball`"),
        (lattice("\"glass\"", "\"gold\""), SceneErrorKind::Reference, "insertion[0].material", "not defined"),
        (lattice("velocity", "during_run = {}\nvelocity"), SceneErrorKind::Combination, "insertion[0].during_run", "lattice"),
        (window("number = 300", "number = 100000\nattempts = 1000"), SceneErrorKind::Overlap, "insertion[0].number", "1000 attempts"),
        (window("number", "orientation = [0.0, 0.0, 0.0, 0.0]\nnumber"), SceneErrorKind::Value, "insertion[0].orientation", "no direction"),
        (window("number", "orientation = \"upright\"\nnumber"), SceneErrorKind::Format, "insertion[0].orientation", "or \"random\""),
        (window("number", "during_run = { rate = 0.0 }\nnumber"), SceneErrorKind::Value, "insertion[0].during_run.rate", "above 0"),
        (
            window("shapes = [{ shape = \"ball\", fraction = 2.0 }, { shape = \"brick\" }]", "shapes = []"),
            SceneErrorKind::Empty,
            "insertion[0].shapes",
            "at least one",
        ),
        (window("fraction = 2.0", "fraction = -1.0"), SceneErrorKind::Value, "insertion[0].shapes[0].fraction", "above 0"),
    ] {
        assert_eq!((kind, key.as_str()), (wanted_kind, wanted_key), "{message}");
        assert!(message.contains(wanted), "{message}");
    }
}

fn wall(geometry: &str) -> String {
    format!("{LATTICE}\n[[boundary]]\nname = \"wall\"\nmaterial = \"glass\"\ngeometry = {geometry}\n")
}

#[test]
fn walls_that_cannot_be_are_refused_by_key() {
    let plane = "{ plane = { point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] } }";
    let moving = |motion: &str| format!("{}motion = {motion}\n", wall(plane));
    for (tables, kind, key, wanted) in [
        (
            wall("{ box = { lower = [0.0, 0.0, 0.0], upper = [1.0, 0.0, 1.0] } }"),
            SceneErrorKind::Value,
            "geometry.box.upper",
            "above the lower corner",
        ),
        (
            wall("{ cylinder = { centre = [0, 0, 0], axis = [0, 0, 0], radius = 1 } }"),
            SceneErrorKind::Value,
            "geometry.cylinder.axis",
            "no direction",
        ),
        (
            wall("{ cylinder = { centre = [0, 0, 0], axis = [0, 0, 1], radius = 0 } }"),
            SceneErrorKind::Value,
            "geometry.cylinder.radius",
            "above 0",
        ),
        (
            wall("{ cylinder = { centre = [0, 0, 0], axis = [0, 0, 1], radius = 1, length = -1 } }"),
            SceneErrorKind::Value,
            "geometry.cylinder.length",
            "above 0",
        ),
        (wall("{ cylinder = { centre = [0, 0, 0], axis = [0, 0, 1], radius = 1, side = \"in\" } }"), SceneErrorKind::Format, "", "inside"),
        (wall("{ plate = { corners = [[0, 0, 0], [1, 0, 0]] } }"), SceneErrorKind::Value, "geometry.plate.corners", "at least 3"),
        (
            wall("{ plate = { corners = [[0, 0, 0], [1, 0, 0], [0.2, 0.2, 0], [0, 1, 0]] } }"),
            SceneErrorKind::Value,
            "geometry.plate.corners",
            "not convex at corner 2",
        ),
        (
            wall("{ plate = { corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]] } }"),
            SceneErrorKind::Value,
            "geometry.plate.corners",
            "not flat",
        ),
        (wall("{ plate = { corners = [[0, 0, 0], [1, 0, nan], [1, 1, 0]] } }"), SceneErrorKind::Value, "geometry.plate.corners", "NaN"),
        (
            wall("{ hopper = { outlet = [0, 0, 0], upper = [1, 1], lower = [0.1, -0.1], height = 1 } }"),
            SceneErrorKind::Value,
            "geometry.hopper.lower",
            "at least 0",
        ),
        (
            wall("{ hopper = { outlet = [0, 0, 0], upper = [1, 1], lower = [0.1, 0.1], height = 0 } }"),
            SceneErrorKind::Value,
            "geometry.hopper.height",
            "above 0",
        ),
        (wall("{ mesh = { vertices = [], triangles = [] } }"), SceneErrorKind::Value, "geometry.mesh.triangles", "at least one face"),
        (
            wall("{ mesh = { vertices = [[0, 0, 0], [1, 0, 0], [2, 0, 0]], triangles = [[0, 1, 2]] } }"),
            SceneErrorKind::Value,
            "geometry.mesh.triangles",
            "face 0 has no area",
        ),
        (
            wall("{ mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[0, 1, 3]] } }"),
            SceneErrorKind::Value,
            "geometry.mesh.triangles",
            "names vertex 3",
        ),
        (
            wall("{ mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[0, 1, 2]], smooth_below = 4.0 } }"),
            SceneErrorKind::Value,
            "geometry.mesh.smooth_below",
            "below pi",
        ),
        (
            moving("{ translation = { velocity = [0, 0, 1], start = 2, end = 1 } }"),
            SceneErrorKind::Value,
            "motion.translation.end",
            "after the start",
        ),
        (
            moving("{ oscillation = { amplitude = [0, 0, 1], frequency = 0 } }"),
            SceneErrorKind::Value,
            "motion.oscillation.frequency",
            "above 0",
        ),
        (
            moving("{ rotation = { point = [0, 0, 0], axis = [0, 0, 0], angular_velocity = 1 } }"),
            SceneErrorKind::Value,
            "motion.rotation.axis",
            "no direction",
        ),
        (moving("{ removed_at = -1 }"), SceneErrorKind::Value, "motion.removed_at", "at least 0"),
        (moving("{ spin = 1 }"), SceneErrorKind::Format, "motion.spin", "unknown field"),
    ] {
        // Numbers without a point are whole numbers to TOML, and read as what they are.
        let (found, found_key, message) = refusal(&tables);
        assert_eq!(found, kind, "{message}");
        assert!(found_key.starts_with("boundary[0]") && found_key.ends_with(key), "{found_key}: {message}");
        assert!(message.contains(wanted), "{message}");
    }
}

/// Every kind of wall from its table, where the table says: contacts of a ball of 0.1 m at a place.
#[test]
fn tables_become_walls() {
    for (geometry, count, place, overlap) in [
        ("{ plane = { point = [0, 0, 1], normal = [0, 0, 2] } }", 1, [5.0, 5.0, 1.09], 0.01),
        ("{ box = { lower = [-1, -1, -1], upper = [1, 1, 1] } }", 6, [0.0, 0.92, 0.0], 0.02),
        ("{ cylinder = { centre = [0, 0, 0], axis = [0, 0, 5], radius = 1 } }", 1, [0.0, -0.93, 77.0], 0.03),
        ("{ cylinder = { centre = [0, 0, 0], axis = [0, 0, 5], radius = 1, length = 2, side = \"outside\" } }", 1, [0.0, 0.0, 1.06], 0.04),
        ("{ plate = { corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0]] } }", 1, [0.5, -0.05, 0.0], 0.05),
        ("{ hopper = { outlet = [0, 0, 0], upper = [1, 1], lower = [0.5, 1], height = 0.5 } }", 1, [0.0, 0.46, 0.2], 0.06),
        ("{ mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[2, 1, 0]] } }", 1, [0.2, 0.2, 0.03], 0.07),
    ] {
        let tables =
            format!("{}motion = {{ translation = {{ velocity = [1, 2, 3], start = 1, end = 2 }}, removed_at = 9 }}\n", wall(geometry));
        let scene = Scene::from_toml(&text(&tables), "walls.toml").unwrap();
        let walls = scene.moving_walls().unwrap();
        assert_eq!(walls.len(), count);
        for (time, shift) in [(0.0, Vector::zeros()), (3.0, Vector::new(1.0, 2.0, 3.0))] {
            let mut touches: Vec<SphereTouch> = Vec::new();
            let place = Vector::from(place) + shift;
            walls.iter().for_each(|wall| wall.wall.at(time).unwrap().touch_sphere(&place, 0.1, &mut touches));
            assert_eq!(touches.len(), 1, "{geometry}");
            assert!((touches[0].overlap - overlap).abs() < 1e-13, "{geometry}: {touches:?}");
        }
        assert!(walls[0].wall.at(9.0).is_none() && walls.iter().all(|wall| wall.boundary == 0));
        assert!(matches!(walls[0].wall.wall, Wall::Plane(_)) == (geometry.contains("plane") || geometry.contains("box")));
    }
}
