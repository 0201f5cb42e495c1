use super::*;

/// Contacts whose normals are closer than this are one.
const SMOOTH: f64 = 0.2;

/// A square of 2 n triangles a side on a surface of given height, shared vertices or a copy for each triangle as files without topology have them.
fn sheet(count: usize, spacing: f64, height: impl Fn(f64, f64) -> f64, is_welded: bool) -> (Vec<Vector>, Vec<[usize; 3]>) {
    let place = |i: usize, j: usize| Vector::new(i as f64 * spacing, j as f64 * spacing, height(i as f64 * spacing, j as f64 * spacing));
    let vertices: Vec<Vector> = (0..=count).flat_map(|j| (0..=count).map(move |i| (i, j))).map(|(i, j)| place(i, j)).collect();
    let number = |i: usize, j: usize| i + j * (count + 1);
    let halves = |(i, j): (usize, usize)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        // Diagonals in turn, so that vertices have four triangles and eight.
        if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
    };
    let triangles: Vec<[usize; 3]> = (0..count).flat_map(|j| (0..count).map(move |i| (i, j))).flat_map(halves).collect();
    if is_welded {
        return (vertices, triangles);
    }
    let copies = triangles.iter().flatten().map(|corner| vertices[*corner]).collect();
    (copies, (0..triangles.len()).map(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2]).collect())
}

fn mesh(sheet: &(Vec<Vector>, Vec<[usize; 3]>), smooth_below: f64) -> Mesh {
    Mesh::new(&sheet.0, &sheet.1, smooth_below).unwrap()
}

fn touches(mesh: &Mesh, position: Vector, radius: f64) -> Vec<SphereTouch> {
    let mut touches = Vec::new();
    mesh.touch_sphere(&position, radius, &mut touches);
    touches
}

/// Over faces, seams and vertices of a flat mesh a ball has one contact, that of the infinite wall: at any depth, with merging off, far from the
/// origin too. Balls that lie deep touch edges of neighbours at up to 60 degrees: only the rule of minima keeps those away.
#[test]
fn a_ball_that_rolls_over_seams_of_a_plane_feels_the_plane() {
    for is_welded in [true, false] {
        for shift in [0.0, 1e4] {
            let mut flat = sheet(6, 0.5, |_, _| 0.0, is_welded);
            flat.0.iter_mut().for_each(|vertex| *vertex += Vector::repeat(shift));
            let mesh = mesh(&flat, 1e-6);
            let tolerance = 8.0 * f64::EPSILON * shift.max(1.0);
            for depth in [1e-9, 1e-2, 0.5] {
                for step in 0..=400 {
                    let along = 0.25 + f64::from(step) * 0.00625;
                    // Along a row of vertices, along a diagonal, and along no line of the mesh.
                    for (x, y) in [(along, 1.0), (along, along), (1.0, along), (along, 0.37 + 0.61 * along)] {
                        let ball = Vector::new(x, y, 1.0 - depth) + Vector::repeat(shift);
                        let found = touches(&mesh, ball, 1.0);
                        assert_eq!(found.len(), 1, "{x} {y} {depth} {shift}: {found:?}");
                        assert!((found[0].overlap - depth).abs() <= tolerance, "{x} {y}: {found:?}");
                        assert!((found[0].normal + Vector::z()).norm() <= 8.0 * tolerance, "{x} {y}: {found:?}");
                    }
                }
            }
        }
    }
}

/// A groove of two planes at a right angle holds a ball at two faces, a ridge pushes it off at one point, an edge or a face.
#[test]
fn grooves_have_two_contacts_and_ridges_one() {
    let groove = mesh(&sheet(4, 0.5, |x, _| (x - 1.0).abs(), true), SMOOTH);
    let ridge = mesh(&sheet(4, 0.5, |x, _| -(x - 1.0).abs(), true), SMOOTH);
    let root = std::f64::consts::FRAC_1_SQRT_2;
    for y in [0.6, 1.0, 1.3] {
        // The centre stands root 2 times the distance from either plane above the bottom.
        let found = touches(&groove, Vector::new(1.0, y, 0.39 / root), 0.4);
        let mut normals: Vec<f64> = found.iter().map(|touch| touch.normal.x).collect();
        normals.sort_by(f64::total_cmp);
        assert!(found.len() == 2 && found.iter().all(|touch| (touch.overlap - 0.01).abs() < 1e-15), "{y}: {found:?}");
        assert!((normals[0] + root).abs() < 1e-15 && (normals[1] - root).abs() < 1e-15);
        let found = touches(&ridge, Vector::new(1.0, y, 0.39), 0.4);
        assert!(
            found.len() == 1 && (found[0].overlap - 0.01).abs() < 1e-15 && (found[0].normal + Vector::z()).norm() < 1e-15,
            "{y}: {found:?}"
        );
        // Over one slope of the ridge it is the face.
        let found = touches(&ridge, Vector::new(1.4, y, 0.1), 0.4);
        let overlap = 0.4 - (0.4 + 0.1) * root;
        assert!(
            found.len() == 1 && (found[0].overlap - overlap).abs() < 1e-15 && (found[0].normal.x + root).abs() < 1e-15,
            "{y}: {found:?}"
        );
    }
}

/// Three faces of a cube's inner corner are three contacts; the tip of its outer corner is one.
#[test]
fn corners_inside_and_outside() {
    let axes = [Vector::x(), Vector::y(), Vector::z()];
    let corner: Vec<Vector> =
        std::iter::once(Vector::zeros()).chain(axes).chain((0..3).map(|axis| axes[axis] + axes[(axis + 1) % 3])).collect();
    let triangles = [[0, 1, 4], [0, 4, 2], [0, 2, 5], [0, 5, 3], [0, 3, 6], [0, 6, 1]];
    let corner = Mesh::new(&corner, &triangles, SMOOTH).unwrap();
    let inside = touches(&corner, Vector::repeat(0.19), 0.2);
    assert!(inside.len() == 3 && inside.iter().all(|touch| (touch.overlap - 0.01).abs() < 1e-15), "{inside:?}");
    let outside = touches(&corner, Vector::repeat(-0.11), 0.2);
    let distance = 0.11 * 3.0_f64.sqrt();
    assert!(outside.len() == 1 && (outside[0].overlap - (0.2 - distance)).abs() < 1e-15, "{outside:?}");
    assert!((outside[0].normal - Vector::repeat(1.0).normalize()).norm() < 1e-15);
}

/// The inside of a drum of 64 facets: one contact all the way round, within the sag of the facets of that of the cylinder; without merging there are two near seams.
#[test]
fn the_facets_of_a_drum_are_one_contact() {
    let count = 64;
    let place = |index: usize, z: f64| {
        let (sine, cosine) = (std::f64::consts::TAU * index as f64 / count as f64).sin_cos();
        Vector::new(cosine, sine, z)
    };
    let vertices: Vec<Vector> = (0..2 * count).map(|index| place(index / 2, (index % 2) as f64)).collect();
    let panel = |index: usize| {
        let [a, b] = [2 * index, 2 * ((index + 1) % count)];
        [[a, b, a + 1], [b, b + 1, a + 1]]
    };
    let triangles: Vec<[usize; 3]> = (0..count).flat_map(panel).collect();
    let (smooth, sharp) = (Mesh::new(&vertices, &triangles, SMOOTH).unwrap(), Mesh::new(&vertices, &triangles, 1e-6).unwrap());
    let sag = 1.0 - (std::f64::consts::PI / count as f64).cos();
    let mut doubled = 0;
    for step in 0..1000 {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(step) / 1000.0).sin_cos();
        let ball = Vector::new(0.905 * cosine, 0.905 * sine, 0.5);
        let found = touches(&smooth, ball, 0.1);
        assert_eq!(found.len(), 1, "{step}: {found:?}");
        assert!(found[0].overlap > 0.005 - 1e-15 && found[0].overlap < 0.005 + sag, "{step}: {found:?}");
        assert!(found[0].normal.dot(&Vector::new(cosine, sine, 0.0)) > (std::f64::consts::PI / count as f64).cos() - 1e-3);
        doubled += usize::from(touches(&sharp, ball, 0.1).len() > 1);
    }
    assert!(doubled > 100, "{doubled}");
}

/// Against brute force over all triangles.
#[test]
fn distances_and_deepest_contacts_are_those_of_all_triangles() {
    let hills = sheet(12, 0.25, |x, y| 0.4 * (3.0 * x).sin() * (2.0 * y).cos(), false);
    let mesh = mesh(&hills, SMOOTH);
    let plates: Vec<_> = hills.1.iter().map(|corners| super::super::Plate::new(&corners.map(|corner| hills.0[corner])).unwrap()).collect();
    for sample in 0..500 {
        let part = |stride: f64| (f64::from(sample) * stride).fract();
        let point = Vector::new(3.4 * part(0.618_034) - 0.2, 3.4 * part(0.754_878) - 0.2, 2.0 * part(0.569_841) - 1.0);
        let least = plates.iter().map(|plate| plate.distance(&point)).fold(f64::INFINITY, f64::min);
        assert!((mesh.distance(&point) - least).abs() < 1e-15);
        let found = touches(&mesh, point, 0.3);
        let deepest = found.first().map_or(0.0, |touch| touch.overlap);
        assert!((deepest - (0.3 - least).max(0.0)).abs() < 1e-15, "{sample}: {found:?} {least}");
        let within = plates.iter().filter(|plate| plate.distance(&point) <= 0.3).count();
        assert!(found.len() <= within);
    }
}

#[test]
fn what_is_no_surface_is_refused() {
    let corners = [Vector::zeros(), Vector::x(), Vector::y(), Vector::x() * 2.0];
    assert_eq!(Mesh::new(&corners, &[[0; 3]; 0], SMOOTH).unwrap_err(), MeshError::Empty);
    assert_eq!(Mesh::new(&corners, &[[0, 1, 4]], SMOOTH).unwrap_err(), MeshError::NoSuchVertex { face: 0, vertex: 4, count: 4 });
    let flat = MeshError::Degenerate { face: 1, error: PolygonError::NoArea };
    assert_eq!(Mesh::new(&corners, &[[0, 1, 2], [0, 1, 3]], SMOOTH).unwrap_err(), flat);
    assert!(Mesh::new(&[Vector::zeros(), Vector::x(), Vector::y() * f64::NAN], &[[0, 1, 2]], SMOOTH).is_err());
}
