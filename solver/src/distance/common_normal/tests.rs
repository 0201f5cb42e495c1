use std::sync::Arc;

use nalgebra::Matrix4;

use super::super::{Pose, Query, separation};
use super::*;
use crate::Orientation;

fn core(semi_axes: [f64; 3], exponents: [f64; 2]) -> Core {
    Core::Superellipsoid(Arc::new(Superellipsoid::new(semi_axes.into(), exponents).unwrap()))
}

fn pose(index: u32, distance: f64) -> Pose {
    let part = |stride: f64| (f64::from(index) * stride).fract() - 0.5;
    let direction = Vector::new(part(0.618_034), part(0.754_878), part(0.569_841)).normalize();
    let turn = Orientation::from_euler_angles(7.0 * part(0.324_718), 7.0 * part(0.220_744), 7.0 * part(0.856_675));
    Pose { position: direction * distance, rotation: *turn.to_rotation_matrix().matrix() }
}

/// Without the shortcut for ellipsoids, from a direction that is a little off.
fn common_normal(one: &Core, first: &Pose, other: &Core, second: &Pose, normal: Vector) -> Separation {
    let relative = Relative::new(first, second);
    let start = Start::Guess(first.rotation.tr_mul(&(normal + Vector::new(0.02, -0.03, 0.01))).into());
    super::separation(one, other, &relative, &start, 1e-12).unwrap().turned(&first.rotation)
}

/// Independent: nalgebra's triangular factors, for matrices of every order of rows.
#[test]
fn four_equations_are_solved_and_their_determinant_is_that_of_triangular_factors() {
    let mut part = 0.3_f64;
    let mut next = || {
        part = (part * 997.0 + 0.618_034).fract();
        part - 0.5
    };
    for index in 0..100 {
        let mut rows: Rows = std::array::from_fn(|_| std::array::from_fn(|_| next()));
        rows[index % 4][index / 4 % 4] = 0.0;
        let (matrix, right) = (Matrix4::from_fn(|row, column| rows[row][column]), Vector4::from_fn(|_, _| next()));
        assert!((determinant(&rows) - matrix.determinant()).abs() < 64.0 * f64::EPSILON);
        let left = matrix * Vector4::from(solved(&rows, &right)) - right;
        let condition = matrix.try_inverse().expect("random matrices are regular").norm();
        assert!(left.norm() < 64.0 * f64::EPSILON * (1.0 + condition), "{rows:?}");
    }
}

/// Exact: two balls of different radii, at any gap and any shallow overlap.
#[test]
fn balls_are_as_far_as_their_centres_less_their_radii() {
    let (one, other) = (core([1.0; 3], [1.0, 1.0]), core([0.4; 3], [1.0, 1.0]));
    for index in 1..200 {
        for gap in [1.0, 1e-3, 1e-9, -1e-9, -1e-3, -0.1] {
            let (first, second) = (Pose { position: Vector::zeros(), ..pose(index, 1.0) }, pose(2 * index, 1.4 + gap));
            let found = separation((&one, &first), (&other, &second), &Query::cold());
            assert!((found.distance - gap).abs() < 1e-13 && found.outcome == Outcome::Polished, "{index} {gap}: {found:?}");
            assert!((found.normal - second.position.normalize()).norm() < 1e-12);
            let twin = common_normal(&one, &first, &other, &second, found.normal);
            assert!((twin.distance - found.distance).abs() < 1e-13 && (twin.normal - found.normal).norm() < 1e-12);
            let balls = separation((&one, &first), (&Core::Point, &second), &Query::cold());
            assert!((balls.distance - gap - 0.4).abs() < 1e-13 && balls.outcome == Outcome::Polished, "{balls:?}");
        }
    }
}

/// Exact: two equal ellipsoids that are turned alike become balls when all lengths along each axis are scaled, which keeps touching.
#[test]
fn ellipsoids_turned_alike_touch_as_balls_do() {
    let axes = Vector::new(1.0, 0.3, 2.0);
    let body = core(axes.into(), [1.0, 1.0]);
    let origin = Pose { position: Vector::zeros(), rotation: Matrix3::identity() };
    for index in 1..200 {
        let way = pose(index, 2.0).position;
        let second = Pose { position: way.component_mul(&axes), ..origin };
        let found = separation((&body, &origin), (&body, &second), &Query::cold());
        let normal = way.component_div(&axes).normalize();
        let twin = common_normal(&body, &origin, &body, &second, normal);
        assert!(twin.distance.abs() < 1e-13 && (twin.normal - normal).norm() < 1e-11, "{index}: {twin:?} {normal}");
        assert!(found.distance.abs() < 1e-13 && (found.normal - normal).norm() < 1e-11, "{index}: {found:?} {normal}");
    }
}

/// Slow twin: another look from where the last step has led.
#[test]
fn a_last_step_without_a_look_is_as_good_as_with_one() {
    let (mut without, mut total) = (0, 0);
    for index in 1..1000_u32 {
        let part = |place: u32| f64::from(index / 10_u32.pow(place) % 10) / 10.0;
        let general = [[0.2 + 1.6 * part(0), 0.2 + 1.6 * part(1)], [0.2 + 1.6 * part(2), 1.1]];
        let axes = ([1.0, 0.3 + 0.01 * f64::from(index % 70), 0.2], [0.5, 0.5, 0.1 + 0.02 * f64::from(index % 60)]);
        for (exponents, gap) in [(general, -0.002), ([[1.0; 2]; 2], -0.002), ([[1.0; 2]; 2], 0.002)] {
            let (one, other) = (core(axes.0, exponents[0]), core(axes.1, exponents[1]));
            let floor = ROUNDED * (one.reach() + other.reach());
            let (first, far) = (Pose { position: Vector::zeros(), ..pose(3 * index, 1.0) }, pose(index, 4.0));
            let cold = separation((&one, &first), (&other, &far), &Query::cold());
            let second = Pose { position: far.position - cold.normal * (cold.distance - gap), ..far };
            let before = Pose { position: second.position + pose(7 * index, 4e-5).position, ..second };
            let ask = |second: &Pose, guess| separation((&one, &first), (&other, second), &Query { guess, cutoff: f64::INFINITY });
            let warm = ask(&second, Some(ask(&before, None).guess()));
            if warm.outcome != Outcome::Polished {
                continue;
            }
            let twin = ask(&second, Some(warm.guess()));
            if exponents == general {
                // A second look from where a first has ended changes no bit.
                (without, total) = (without + u32::from(warm.distance != twin.distance), total + 1);
            }
            let who = format!("{index} {exponents:?} {gap}: {warm:?} {twin:?}");
            assert!((warm.distance - twin.distance).abs() < 0.1 * floor, "{who}");
            // Normals and points differ by the error of a step times how much a surface may turn or move in it.
            assert!((warm.normal - twin.normal).norm() < 100.0 * ROUNDED, "{who}");
            assert!((warm.on_first - twin.on_first).norm() < 100.0 * floor, "{who}");
            assert!((warm.on_second - twin.on_second).norm() < 100.0 * floor, "{who}");
        }
    }
    assert!(total > 950 && 2 * without > total, "{without} of {total}");
}

#[test]
fn general_shapes_are_certified_cold_and_warm_apart_and_overlapping() {
    let exponents = [0.1, 0.5, 1.0, 1.5, 1.9];
    let (mut others, mut total) = (Vec::new(), 0);
    for index in 1..2000_u32 {
        let pick = |place: u32| exponents[(index / 5_u32.pow(place) % 5) as usize];
        let one = core([1.0, 0.3 + 0.01 * f64::from(index % 70), 0.2], [pick(0), pick(1)]);
        let other = core([0.5, 0.5, 0.1 + 0.02 * f64::from(index % 60)], [pick(2), pick(3)]);
        let first = Pose { position: Vector::zeros(), ..pose(3 * index, 1.0) };
        let far = pose(index, 4.0);
        let cold = separation((&one, &first), (&other, &far), &Query::cold());
        for gap in [0.02, -0.002] {
            let near = Pose { position: far.position - cold.normal * (cold.distance - gap), ..far };
            let found = separation((&one, &first), (&other, &near), &Query::cold());
            total += 1;
            if found.outcome != Outcome::Polished {
                others.push((index, gap, found.outcome, found.distance, found.gap));
                continue;
            }
            let guess = Some((found.normal + Vector::new(4e-4, -6e-4, 7e-4)).into());
            let warm = separation((&one, &first), (&other, &near), &Query { guess, cutoff: f64::INFINITY });
            assert!(gap < 0.0 || (found.distance - gap).abs() < 1e-9, "{index} {gap}: {found:?}");
            assert!((warm.distance - found.distance).abs() < 1e-9, "{index} {gap}: {found:?} {warm:?}");
        }
    }
    // Sharp corners that overlap by more than they are round have their least depth beside their common normal.
    assert!(others.len() * 100 <= total && others.iter().all(|other| other.1 < 0.0), "{} of {total}: {others:?}", others.len());
}
