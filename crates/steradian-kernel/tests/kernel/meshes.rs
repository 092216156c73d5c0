//! Closed meshes whose neighbours share vertices.

use std::collections::HashMap;
use steradian_kernel::Geometry;

pub fn append(geometry: &mut Geometry, other: &Geometry) {
    let base = geometry.positions.len() as u32;
    geometry.positions.extend(&other.positions);
    geometry.triangles.extend(
        other
            .triangles
            .iter()
            .map(|triangle| triangle.map(|vertex| base + vertex)),
    );
}

/// An axis-parallel box of 12 triangles.
pub fn cuboid(lower: [f32; 3], upper: [f32; 3]) -> Geometry {
    let corner = |c: usize| [0, 1, 2].map(|k| if c >> k & 1 == 1 { upper[k] } else { lower[k] });
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    Geometry {
        positions: (0..8).map(corner).collect(),
        triangles: quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        quadrics: vec![],
    }
}

/// An octahedron, each face divided into four `levels` times, moved to the unit sphere and there to `radius(p)`.
pub fn sphere(levels: usize, radius: impl Fn([f64; 3]) -> f64) -> Geometry {
    let mut points = vec![
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let mut triangles = vec![
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    for _ in 0..levels {
        let mut middles = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let [p, q]: [[f64; 3]; 2] = [points[a as usize], points[b as usize]];
                points.push(unit([0, 1, 2].map(|k| p[k] + q[k])));
                points.len() as u32 - 1
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [d, e, f] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
            })
            .collect();
    }
    let positions = points
        .iter()
        .map(|&p| p.map(|x| (x * radius(p)) as f32))
        .collect();
    Geometry {
        positions,
        triangles,
        quadrics: vec![],
    }
}

/// A sphere with bumps of two sizes; every point of it can be seen from the centre.
pub fn bumpy_sphere(levels: usize) -> Geometry {
    sphere(levels, |[x, y, z]| {
        let coarse = libm::sin(7.0 * x + 1.3) * libm::sin(9.0 * y + 0.7) * libm::sin(8.0 * z + 2.1);
        let fine = libm::sin(31.0 * x) * libm::sin(29.0 * y) * libm::sin(37.0 * z);
        1.0 + 0.08 * coarse + 0.02 * fine
    })
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}
