use steradian_kernel::MISS;

use super::*;
use crate::quantity::Length;
use crate::shape::{Parallelogram, TriangleMesh};

/// The middle of a scene far from the origin, exact in f64.
const FAR: Vector = Vector::new(1e4, 1e4, 0.0);

/// A rectangle at z = 1, two triangles at z = 2, a sphere at x = 4, an annulus at x = 8 and the plane z = −1.
fn forms(step: Vector) -> Vec<Placed> {
    let at = |x, y, z| Point::new(x, y, z) + step;
    let edges = [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0)];
    let corners = vec![
        at(2.0, 0.0, 2.0),
        at(3.0, 0.0, 2.0),
        at(3.0, 1.0, 2.0),
        at(2.0, 1.0, 2.0),
    ];
    let mesh = TriangleMesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]);
    let sphere = Sphere {
        center: at(4.5, 0.5, 1.0),
        radius: 0.5,
        inside: true,
        ports: vec![],
    };
    let disc = Disc {
        center: at(8.0, 0.5, 1.0),
        normal: -Direction::Z,
        radius: 1.0,
        inner_radius: 0.25,
    };
    let plane = Form::Plane {
        point: at(0.0, 0.0, -1.0),
        normal: Direction::Z,
    };
    let rectangle = Parallelogram::new(at(0.0, 0.0, 1.0), edges).unwrap();
    let forms = [
        (Form::Sphere(sphere), vec![0]),
        (Form::Parallelogram(rectangle), vec![1]),
        (Form::Disc(disc), vec![2]),
        (Form::Mesh(mesh), vec![3, 4]),
        (plane, vec![5]),
    ];
    let placed = forms.map(|(form, parts)| Placed {
        form,
        parts: parts.into_iter().map(PartId).collect(),
    });
    placed.to_vec()
}

fn surfaces(step: Vector) -> Surfaces {
    Surfaces::new(forms(step), Point::ORIGIN).unwrap()
}

/// Ray parameter and primitive of rays that go down from z = 5.
fn seen_from_above(surfaces: &Surfaces, step: Vector, places: &[[f64; 2]]) -> Vec<(f32, u32)> {
    let mut rays = RayBatch::default();
    for [x, y] in places {
        let origin = surfaces.to_kernel(Point::new(*x, *y, 5.0) + step);
        rays.push(origin, [0.0, 0.0, -1.0], f32::INFINITY);
    }
    let mut hits = HitBatch::default();
    surfaces.closest(&rays, &mut hits, InstructionSet::detect());
    hits.t.into_iter().zip(hits.primitive).collect()
}

const PLACES: [[f64; 2]; 6] = [
    [0.75, 0.25],
    [2.75, 0.25],
    [2.25, 0.75],
    [4.5, 0.5],
    [8.5, 0.5],
    [8.0, 0.5],
];

/// Triangles first, in the order of their shapes; then quadrics in theirs.
#[test]
fn each_primitive_leads_to_its_shape_and_part() {
    let surfaces = surfaces(Vector::ZERO);
    let hits = seen_from_above(&surfaces, Vector::ZERO, &PLACES);
    assert!(hits.iter().all(|(_, primitive)| *primitive != MISS));
    let shapes: Vec<u32> = hits.iter().map(|(_, p)| surfaces.shape_of(*p).0).collect();
    assert_eq!(shapes, [1, 3, 3, 0, 2, 4]);
    let part = |primitive: u32| match surfaces.triangles().get(primitive as usize) {
        Some(triangle) => triangle.part,
        None => surfaces.quadrics()[primitive as usize - surfaces.triangles().len()].part,
    };
    let parts: Vec<u32> = hits.iter().map(|(_, p)| part(*p)).collect();
    assert_eq!(parts, [1, 3, 4, 0, 2, 5]);
    let distances: Vec<f32> = hits.iter().map(|(t, _)| *t).collect();
    assert_eq!(distances, [4.0, 3.0, 3.0, 3.5, 4.0, 6.0]);
    let firsts: Vec<u32> = (0..5)
        .map(|id| surfaces.first_primitive(ShapeId(id)))
        .collect();
    assert_eq!(firsts, [4, 0, 5, 2, 6]);
}

#[test]
fn normals_are_those_of_the_fronts() {
    let surfaces = surfaces(FAR);
    let up = Vector::new(0.0, 0.0, 1.0);
    let hits = seen_from_above(&surfaces, FAR, &PLACES);
    for (([x, y], (t, primitive)), expected) in
        PLACES.iter().zip(hits).zip([up, up, up, -up, -up, up])
    {
        let point = Point::new(*x, *y, 5.0 - f64::from(t)) + FAR;
        assert_eq!(surfaces.normal_at(primitive, point), expected);
    }
}

#[test]
fn a_scene_far_from_the_origin_has_the_same_hits() {
    let (near, far) = (surfaces(Vector::ZERO), surfaces(FAR));
    assert_eq!(far.origin() - near.origin(), FAR);
    let from = |surfaces, step| seen_from_above(surfaces, step, &PLACES);
    assert_eq!(from(&near, Vector::ZERO), from(&far, FAR));
}

#[test]
fn without_finite_shapes_the_anchor_is_the_origin() {
    let anchor = Point::ORIGIN + FAR;
    let empty = Surfaces::new(vec![], anchor).unwrap();
    assert_eq!((empty.origin(), empty.bounds()), (anchor, None));
    let ground = Surfaces::new(forms(Vector::ZERO)[4..].to_vec(), anchor).unwrap();
    assert_eq!(seen_from_above(&ground, FAR, &[[0.1, 0.2]]), [(6.0, 0)]);
}

#[test]
fn nothing_above_the_highest_surface() {
    let mut shapes = forms(Vector::ZERO);
    shapes.truncate(4);
    let surfaces = Surfaces::new(shapes, Point::ORIGIN).unwrap();
    let above =
        |z, normal| surfaces.nothing_above(Point::new(0.5, 0.5, z), normal, 1e-6, &|_| false);
    assert!(above(2.0, Direction::Z) && above(3.0, Direction::Z));
    assert!(!above(1.999, Direction::Z) && !above(0.0, Direction::Z));
    assert!(above(0.5, -Direction::Z) && !above(0.501, -Direction::Z));
    assert!(!above(0.0, Direction::X) && !above(0.0, Direction::Y));
}

#[test]
fn clearance_grows_with_the_distance_from_the_shapes() {
    let surfaces = surfaces(FAR);
    let near = Point::new(1.0, 1.0, 0.0) + FAR;
    assert_eq!(surfaces.clearance_at(near), surfaces.clearance());
    let far = near + Vector::new(1e4, 0.0, 0.0);
    // Single precision resolves 1e4 m to 2⁻¹⁰ m.
    assert!(surfaces.clearance_at(far) > 10.0 * 0.5 * f64::from(f32::EPSILON) * 1e4);
}

/// The shaft between two unit squares, at z = −0.5 under the rectangle and at z = `top`.
#[test]
fn a_shaft_is_clear_up_to_what_it_touches() {
    let surfaces = surfaces(FAR);
    let square = |z: f64| {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y, z) + FAR)
    };
    let is_clear = |top: f64| {
        let shaft = Hull::around(&[square(-0.5), square(top)].concat());
        let margin = Length::from_metres(surfaces.clearance());
        surfaces.is_clear(&shaft.shrunk(margin), &|_| false)
    };
    assert!(is_clear(1.0), "the rectangle lies in the end of the shaft");
    assert!(!is_clear(1.1));
    let shaft = Hull::around(&[square(-0.5), square(1.1)].concat());
    let of_rectangle = |primitive| surfaces.shape_of(primitive) == ShapeId(1);
    assert!(surfaces.is_clear(&shaft, &of_rectangle));
}
