//! Arrival at plain triangles: opaque, Lambertian on both sides with constant reflectances, and dark.
//!
//! Most hits of most scenes are of this kind. They are told from the others first, so that the loop over them has no other case and
//! writes its columns without growing them.

use std::f32::consts::FRAC_1_PI;

use steradian_kernel::{HitBatch, Work};

use super::columns::{Flights, Vertices};
use super::interaction::place_on_triangle;
use super::tables::{Lanes4, Model, NO_TINT, OPAQUE, Side};
use crate::shape::TriangleRecord;

/// Which primitives are plain, and what the sides of parts reflect.
pub(super) struct PlainTriangles {
    /// By number; the last entry, for everything that is no triangle, is not.
    are_plain: Vec<bool>,
    reflectances: Vec<Lanes4>,
}

impl PlainTriangles {
    pub fn new(triangles: &[TriangleRecord], sides: &[Side]) -> Self {
        let is_plain = |part: u32| {
            let sides = &sides[2 * part as usize..][..2];
            sides.iter().all(is_plain)
        };
        let triangles = triangles.iter().map(|triangle| is_plain(triangle.part));
        Self {
            are_plain: triangles.chain([false]).collect(),
            reflectances: sides.iter().map(|side| side.reflectance.lanes).collect(),
        }
    }

    /// Parts the rows of these primitives into those that met plain triangles and the others.
    pub fn part(&self, primitives: &[u32], plain: &mut Vec<u32>, others: &mut Vec<u32>) {
        plain.resize(primitives.len(), 0);
        others.resize(primitives.len(), 0);
        let last = self.are_plain.len() - 1;
        let mut count = 0;
        for (row, primitive) in primitives.iter().enumerate() {
            // Written to both, kept in one: which one is hard to foresee for a branch.
            plain[count] = row as u32;
            others[row - count] = row as u32;
            count += usize::from(self.are_plain[last.min(*primitive as usize)]);
        }
        plain.truncate(count);
        others.truncate(primitives.len() - count);
    }
}

fn is_plain(side: &Side) -> bool {
    side.model == Model::Lambertian
        && side.opacity == OPAQUE
        && side.reflectance.tint == NO_TINT
        && !side.emits
}

/// Collects the vertices of flights that met plain triangles.
pub(super) struct ArrivePlainly<'a> {
    pub table: &'a PlainTriangles,
    pub triangles: &'a [TriangleRecord],
    pub flights: &'a Flights,
    pub hits: &'a HitBatch,
    /// Their rows.
    pub rows: &'a [u32],
    pub vertices: &'a mut Vertices,
}

impl Work for ArrivePlainly<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let n = self.flights.len();
        let (rays, identity) = (&self.flights.rays, &self.flights.identity);
        let (dx, dy, dz) = (
            &rays.direction_x[..n],
            &rays.direction_y[..n],
            &rays.direction_z[..n],
        );
        let (primitives, u, v) = (
            &self.hits.primitive[..n],
            &self.hits.u[..n],
            &self.hits.v[..n],
        );
        let throughput = self.flights.throughput.each_ref().map(|lane| &lane[..n]);
        let (slots, keys, indices) = (
            &identity.slot[..n],
            &identity.key[..n],
            &identity.index[..n],
        );
        let light = [&self.flights.light_u[..n], &self.flights.light_v[..n]];
        let room = self.vertices.extend(self.rows.len());
        let [x, y, z] = room.point;
        let [normal_x, normal_y, normal_z] = room.normal;
        let [first, second, third, fourth] = room.response;
        let [light_u, light_v] = room.light;
        for (k, &row) in self.rows.iter().enumerate() {
            let i = row as usize;
            let triangle = &self.triangles[primitives[i] as usize];
            let direction = [dx[i], dy[i], dz[i]];
            let (place, front) = place_on_triangle(triangle, [u[i], v[i]], direction);
            let side = (2 * triangle.part + u32::from(!front)) as usize;
            let reflectance = &self.table.reflectances[side];
            let response: Lanes4 =
                std::array::from_fn(|lane| throughput[lane][i] * reflectance[lane] * FRAC_1_PI);
            [x[k], y[k], z[k]] = place.point;
            [normal_x[k], normal_y[k], normal_z[k]] = place.normal;
            [first[k], second[k], third[k], fourth[k]] = response;
            room.clearance[k] = place.clearance;
            (light_u[k], light_v[k]) = (light[0][i], light[1][i]);
            (room.slot[k], room.key[k], room.index[k]) = (slots[i], keys[i], indices[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_parted_in_their_order() {
        let table = PlainTriangles {
            are_plain: vec![true, false, true, false],
            reflectances: vec![],
        };
        let (mut plain, mut others) = (vec![7; 9], vec![]);
        table.part(&[2, 3, u32::MAX, 0, 1, 0], &mut plain, &mut others);
        assert_eq!((plain, others), (vec![0, 3, 5], vec![1, 2, 4]));
    }
}
