//! Chapter 2 of S: shapes, turns, detection.

use std::sync::Arc;

use nalgebra::{Matrix3, Quaternion};
use solver::contact::detect::{OneSided, PlacedSurface, VertexSurface, vertex_pair};
use solver::distance::Pose;
use solver::shape::Superellipsoid;
use solver::shape::superellipsoid::vertices::Spacing;
use solver::{Orientation, Scene, Vector};

use super::{Erratum, ROUNDING};
use crate::case::Failure;

pub fn errata() -> Vec<Erratum> {
    let ball_of_density = 0.4 * DENSITY * 4.0 / 3.0 * std::f64::consts::PI;
    vec![
        Erratum::new(
            2.1,
            "no modulus",
            ["octants in which the surface function is a number", "1"],
            [8.0, 0.05],
            octants_printed,
            octants_coded,
        ),
        Erratum::new(
            2.4,
            "one over the density",
            ["moment of inertia of a ball", "kg m^2"],
            [ball_of_density, ROUNDING * ball_of_density],
            inertia_printed,
            inertia_coded,
        ),
        Erratum::new(
            2.14,
            "an entry with the wrong sign",
            ["largest entry of R R^T - 1", "1"],
            [0.0, ROUNDING],
            rotation_printed,
            rotation_coded,
        ),
        Erratum::new(
            2.17,
            "bodies are moved into the wall",
            ["height of the lowest point after relocation", "m"],
            [0.0, ROUNDING],
            || Ok(-0.1 - 0.1),
            relocation_coded,
        ),
        Erratum::new(
            2.24,
            "sum of two means",
            ["contact point of two balls", "m"],
            [5.95, 6.0 * ROUNDING],
            || contact_point().map(|place| 2.0 * place),
            contact_point,
        ),
        Erratum::new(
            2.25,
            "gradient taken in the other body's frame",
            ["angle of the normal", "rad"],
            [0.0, 1e-7],
            normal_printed,
            normal_coded,
        ),
        Erratum::new(
            2.28,
            "exponents of the gradient",
            ["slope of the surface function of a unit ball", "1/m"],
            [1.2, ROUNDING],
            slope_printed,
            slope_coded,
        ),
    ]
}

fn superellipsoid(semi_axes: [f64; 3], exponents: [f64; 2]) -> Result<Arc<Superellipsoid>, Failure> {
    let shape = Superellipsoid::new(semi_axes.into(), exponents);
    shape.map(Arc::new).map_err(|error| Failure::NothingMeasured(error.to_string()))
}

fn octants(function: impl Fn(Vector) -> f64) -> f64 {
    let sign = |octant: u32, axis: u32| if octant >> axis & 1 == 1 { -0.3 } else { 0.3 };
    (0..8).filter(|octant| !function(Vector::new(sign(*octant, 0), sign(*octant, 1), sign(*octant, 2))).is_nan()).count() as f64
}

fn octants_printed() -> Result<f64, Failure> {
    let [outer, inner] = [0.7, 1.3_f64];
    Ok(octants(|place| (place.x.powf(2.0 / inner) + place.y.powf(2.0 / inner)).powf(inner / outer) + place.z.powf(2.0 / outer)))
}

fn octants_coded() -> Result<f64, Failure> {
    let shape = superellipsoid([1.0; 3], [0.7, 1.3])?;
    Ok(octants(|place| shape.inside_outside(&place)))
}

const DENSITY: f64 = 2500.0;

/// For unit density.
fn inertia_of_ball() -> Result<f64, Failure> {
    let ball = superellipsoid([1.0; 3], [1.0; 2])?;
    let squares = ball.mean_squares() * ball.volume();
    Ok(squares.x + squares.y)
}

fn inertia_printed() -> Result<f64, Failure> {
    Ok(inertia_of_ball()? / DENSITY)
}

fn inertia_coded() -> Result<f64, Failure> {
    Ok(inertia_of_ball()? * DENSITY)
}

/// A turn by 34 degrees about an axis of no special direction.
fn quaternion() -> Quaternion<f64> {
    let (sine, cosine) = 17.0_f64.to_radians().sin_cos();
    let axis = Vector::new(0.3, -0.4, 0.87).normalize() * sine;
    Quaternion::new(cosine, axis.x, axis.y, axis.z)
}

fn beside_orthogonal(matrix: &Matrix3<f64>) -> f64 {
    (matrix * matrix.transpose() - Matrix3::identity()).abs().max()
}

fn rotation_printed() -> Result<f64, Failure> {
    let (q1, q2, q3, q4) = (quaternion().w, quaternion().i, quaternion().j, quaternion().k);
    let upper_middle = 2.0 * (q2 * q3 - q1 * q4);
    let printed = Matrix3::new(
        q1 * q1 + q2 * q2 - q3 * q3 - q4 * q4,
        upper_middle,
        2.0 * (q2 * q4 - q1 * q3),
        upper_middle,
        q1 * q1 - q2 * q2 + q3 * q3 - q4 * q4,
        2.0 * (q3 * q4 + q1 * q2),
        2.0 * (q2 * q4 + q1 * q3),
        2.0 * (q3 * q4 - q1 * q2),
        q1 * q1 - q2 * q2 - q3 * q3 + q4 * q4,
    );
    Ok(beside_orthogonal(&printed))
}

fn rotation_coded() -> Result<f64, Failure> {
    Ok(beside_orthogonal(Orientation::new_normalize(quaternion()).to_rotation_matrix().matrix()))
}

/// A ball at rest whose lowest point lies 0.1 m below a wall, after one step of time-driven hard bodies.
fn relocation_coded() -> Result<f64, Failure> {
    let text = r#"
        scene = { name = "relocation", end_time = 1e-3 }
        material = [{ name = "any", density = 1000.0 }]
        pair = [{ materials = ["any", "any"], normal = { impulse = { restitution = 1.0 } } }]
        shape = [{ name = "ball", geometry = { sphere = { radius = 1.0 } } }]
        body = [{ shape = "ball", material = "any", position = [0.0, 0.0, 0.9] }]
        boundary = [{ name = "floor", material = "any", geometry = { plane = { point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] } } }]
        numerics = { step = 1e-3, initial_overlap = "allow", hard_contact = { time_driven = {} } }
    "#;
    let mut simulation = Scene::from_toml(text, "relocation")?.build()?;
    simulation.step();
    Ok(simulation.now().position(0).z - 1.0)
}

fn in_place(surface: &VertexSurface, position: Vector, rotation: Matrix3<f64>) -> PlacedSurface<'_> {
    PlacedSurface { surface, pose: Pose { position, rotation }, centre_of_body: position }
}

/// Along the line of centres, from the origin, of two unit balls at 5 and 6.9 m.
fn contact_point() -> Result<f64, Failure> {
    let shape = superellipsoid([1.0; 3], [1.0; 2])?;
    let ball = VertexSurface { vertices: shape.vertices(40, Spacing::Linear), shape };
    let first = in_place(&ball, Vector::x() * 5.0, Matrix3::identity());
    let mut touches = Vec::new();
    vertex_pair(&first, &in_place(&ball, Vector::x() * 6.9, Matrix3::identity()), None, OneSided::Ignored, &mut touches);
    touches.first().map(|touch| 5.0 + touch.arm_of_first.x).ok_or_else(|| Failure::NothingMeasured("no contact".into()))
}

/// Two turns of no special direction.
fn turns() -> [Matrix3<f64>; 2] {
    [Orientation::from_euler_angles(0.4, -1.1, 2.0), Orientation::from_euler_angles(-1.3, 0.8, -0.5)]
        .map(|turn| *turn.to_rotation_matrix().matrix())
}

/// A vertex of an ellipsoid in its own frame.
const VERTEX: [f64; 2] = [0.7, 0.3];

fn angle_to_normal(normal: impl Fn(&Superellipsoid, Vector, &[Matrix3<f64>; 2]) -> Vector) -> Result<f64, Failure> {
    let (ellipsoid, turns) = (superellipsoid([1.0, 0.5, 0.25], [1.0; 2])?, turns());
    let vertex = ellipsoid.surface_point(VERTEX[0], VERTEX[1]);
    // By hand: of an ellipsoid the normal is the point over the squares of the semi-axes.
    let exact = turns[0] * vertex.component_div(&Vector::new(1.0, 0.25, 0.0625));
    Ok(normal(&ellipsoid, vertex, &turns).angle(&exact))
}

/// S eq. 2.25 leaves the vertex in the second frame, turned; eq. 2.30 turns the gradient from the first.
fn normal_printed() -> Result<f64, Failure> {
    angle_to_normal(|ellipsoid, vertex, turns| turns[0] * ellipsoid.gradient(&turns[1].tr_mul(&(turns[0] * vertex))))
}

fn normal_coded() -> Result<f64, Failure> {
    angle_to_normal(|ellipsoid, vertex, turns| turns[0] * ellipsoid.gradient(&vertex))
}

const PLACE: Vector = Vector::new(0.6, 0.6, 0.529_150_262_212_918);

/// With both exponents and all semi-axes one: $2 x\, y^{-2}$.
fn slope_printed() -> Result<f64, Failure> {
    Ok(2.0 * PLACE.x * PLACE.y.powi(-2))
}

fn slope_coded() -> Result<f64, Failure> {
    Ok(superellipsoid([1.0; 3], [1.0; 2])?.gradient(&PLACE).x)
}
