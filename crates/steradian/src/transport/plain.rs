//! Arrival at plain triangles: opaque, Lambertian on both sides with constant reflectances, and dark.
//!
//! Most hits of most scenes are of this kind. They are told from the others first, so that the loop over them has no other case and
//! writes its columns without growing them.

use std::f32::consts::FRAC_1_PI;

use steradian_kernel::{HitBatch, Work};

use super::columns::{Flights, Vertices};
use super::interaction::place_on_triangle;
use super::tables::{Model, NO_TINT, OPAQUE, Side, Tables};

/// Whether each part is plain.
pub(super) fn plain_parts(sides: &[Side]) -> Vec<bool> {
    let is_plain = |side: &Side| {
        side.model == Model::Lambertian
            && side.opacity == OPAQUE
            && side.reflectance.tint == NO_TINT
            && !side.emits
    };
    sides
        .chunks(2)
        .map(|sides| sides.iter().all(is_plain))
        .collect()
}

/// Collects the vertices of flights that met plain triangles.
pub(super) struct ArrivePlainly<'a> {
    pub tables: &'a Tables<'a>,
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
        let (tables, flights, hits) = (self.tables, self.flights, self.hits);
        let triangles = tables.scene.surfaces().triangles();
        let (rays, identity) = (&flights.rays, &flights.identity);
        let room = self.vertices.extend(self.rows.len());
        let [x, y, z] = room.point;
        let [normal_x, normal_y, normal_z] = room.normal;
        let [red, green, blue, fourth] = room.response;
        let [light_u, light_v] = room.light;
        for (k, &row) in self.rows.iter().enumerate() {
            let i = row as usize;
            let triangle = &triangles[hits.primitive[i] as usize];
            let direction = [
                rays.direction_x[i],
                rays.direction_y[i],
                rays.direction_z[i],
            ];
            let (place, front) = place_on_triangle(triangle, [hits.u[i], hits.v[i]], direction);
            let side = &tables.sides[(2 * triangle.part + u32::from(!front)) as usize];
            let response: [f32; 4] = std::array::from_fn(|lane| {
                flights.throughput[lane][i] * side.reflectance.lanes[lane] * FRAC_1_PI
            });
            [x[k], y[k], z[k]] = place.point;
            [normal_x[k], normal_y[k], normal_z[k]] = place.normal;
            [red[k], green[k], blue[k], fourth[k]] = response;
            room.clearance[k] = place.clearance;
            (light_u[k], light_v[k]) = (flights.light_u[i], flights.light_v[i]);
            (room.slot[k], room.key[k], room.index[k]) = identity.at(i);
        }
    }
}
