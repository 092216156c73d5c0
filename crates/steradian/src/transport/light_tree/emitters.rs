//! The bounds of each kind of emitter.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use glam::DVec3;

use super::bounds::{Bounds, Cone};
use crate::light::{Beam, FarField, Kind, LuminaireLight, Planes};
use crate::scene::Scene;
use crate::transport::tables::{Emitter, EmitterShape, mean};

/// What a leaf of the tree stands for.
#[derive(Copy, Clone, Debug)]
pub(super) struct Leaf {
    pub emitter: u32,
    /// One of the emitter's triangles, if it is not all of it.
    pub triangle: Option<u32>,
    /// Its part of the emitter's area.
    pub share: f64,
}

/// The leaves of an emitter, with their bounds: its triangles, if they are many and shine alike.
pub(super) fn leaves(
    scene: &Scene,
    (number, emitter): (usize, &Emitter),
    strength: f64,
    beams: &mut Beams,
) -> Vec<(Leaf, Bounds)> {
    let leaf = |triangle, share| Leaf {
        emitter: number as u32,
        triangle,
        share,
    };
    match &emitter.shape {
        EmitterShape::Triangles {
            first,
            cumulative,
            area,
        } if is_split(scene, emitter) => {
            let of_triangle = |k: u32| {
                let bounds = triangle(scene, first + k, emitter.two_sided);
                let share = bounds.intensity / f64::from(*area);
                (leaf(Some(k), share), bounds.times(strength))
            };
            (0..cumulative.len() as u32).map(of_triangle).collect()
        }
        _ => {
            let whole = bounds(scene, emitter, strength, beams);
            whole
                .map(|bounds| (leaf(None, 1.0), bounds))
                .into_iter()
                .collect()
        }
    }
}

/// Whether the triangles of an emitter are leaves of their own: many of the same radiance, which nothing aims at as a whole.
fn is_split(scene: &Scene, emitter: &Emitter) -> bool {
    let kind = &scene.lights()[emitter.light].kind;
    emitter.outline.is_none() && matches!(kind, Kind::Area(area) if area.textures.is_empty())
}

/// Bounds of an emitter whose radiance or intensity is `strength` watts (of a luminaire: per 1 of its table); none of light from infinitely
/// far away.
pub(super) fn bounds(
    scene: &Scene,
    emitter: &Emitter,
    strength: f64,
    beams: &mut Beams,
) -> Option<Bounds> {
    let bounds = evenly(scene, emitter, strength)?;
    let Kind::Luminaire(luminaire) = &scene.lights()[emitter.light].kind else {
        return Some(bounds);
    };
    Some(Bounds {
        cone: beams.cone(luminaire),
        intensity: strength * luminaire.far_field.peak()[2],
        ..bounds
    })
}

/// The same of an emitter whose power is the same in all directions.
fn evenly(scene: &Scene, emitter: &Emitter, strength: f64) -> Option<Bounds> {
    let one_sided = |cone: Cone| match emitter.two_sided {
        true => Cone::EVERYWHERE,
        false => cone,
    };
    match &emitter.shape {
        EmitterShape::Parallelogram {
            origin,
            edges,
            normal,
            area,
        } => {
            let [a, b] = edges.map(double);
            let corners = [DVec3::ZERO, a, b, a + b].map(|corner| double(*origin) + corner);
            let cone = Cone::of_normal(double(*normal));
            Bounds::around(corners, one_sided(cone), strength * f64::from(*area))
        }
        EmitterShape::Triangles {
            first, cumulative, ..
        } => {
            let triangles = (0..cumulative.len() as u32)
                .map(|k| triangle(scene, first + k, emitter.two_sided).times(strength));
            triangles.reduce(Bounds::union)
        }
        EmitterShape::Sphere { center, radius, .. } => {
            let (center, radius) = (double(*center), f64::from(*radius));
            let corners = [center - radius, center + radius];
            Bounds::around(corners, Cone::EVERYWHERE, strength * PI * radius * radius)
        }
        EmitterShape::Disc {
            center,
            normal,
            axes,
            outer,
            area,
            ..
        } => {
            let (center, outer) = (double(*center), f64::from(*outer));
            let [a, b] = axes.map(double);
            // Of a circle the box reaches along each axis as far as the root of the squares of its two diameters.
            let reach = (a * a + b * b).map(f64::sqrt) * outer;
            let cone = Cone::of_normal(double(*normal));
            let corners = [center - reach, center + reach];
            Bounds::around(corners, one_sided(cone), strength * f64::from(*area))
        }
        EmitterShape::Point { position } | EmitterShape::Luminaire { position, .. } => {
            Bounds::around([double(*position)], Cone::EVERYWHERE, strength)
        }
        EmitterShape::Spot {
            position,
            axis,
            beam,
        } => Bounds::around(
            [double(*position)],
            beam_cone(double(*axis), beam),
            strength,
        ),
        EmitterShape::Portal(portal) => {
            let [a, b] = portal.edges.map(|edge| edge.as_dvec3());
            let corners = [DVec3::ZERO, a, b, a + b];
            let corners = corners.map(|corner| portal.origin.as_dvec3() + corner);
            let mean = match &scene.lights()[emitter.light].kind {
                Kind::EnvironmentMap { map, .. } => mean(map),
                _ => 1.0,
            };
            let cone = Cone::of_normal(portal.normal.as_dvec3());
            Bounds::around(corners, cone, strength * mean * f64::from(portal.area))
        }
        EmitterShape::Directional { .. } | EmitterShape::Everywhere(_) => None,
    }
}

/// Of a triangle of the scene, per unit of its radiance.
fn triangle(scene: &Scene, number: u32, two_sided: bool) -> Bounds {
    let record = &scene.surfaces().triangles()[number as usize];
    let (origin, [a, b]) = (double(record.origin), record.edges.map(double));
    let area = 0.5 * a.cross(b).length();
    let corners = [origin + a, origin + b];
    let is_one_sided = area > 0.0 && !two_sided;
    Bounds {
        low: corners.into_iter().fold(origin, DVec3::min),
        high: corners.into_iter().fold(origin, DVec3::max),
        cone: match is_one_sided {
            true => Cone::of_normal(double(record.normal)),
            false => Cone::EVERYWHERE,
        },
        intensity: area,
    }
}

/// cosⁿθ is below cosθ where n ≥ 1; any other beam is as bright as in its middle up to the cutoff.
fn beam_cone(axis: DVec3, beam: &Beam) -> Cone {
    let (spread, reach) = match *beam {
        Beam::CosinePower {
            exponent,
            cos_cutoff,
        } if exponent >= 1.0 => (0.0, libm::acos(cos_cutoff)),
        Beam::CosinePower { cos_cutoff, .. }
        | Beam::Uniform { cos_cutoff }
        | Beam::Smooth { cos_cutoff, .. } => (libm::acos(cos_cutoff.clamp(-1.0, 1.0)), 0.0),
    };
    Cone {
        axis,
        spread,
        reach,
    }
}

/// θ_o and θ_e of tables of intensity about their aim, each found once.
#[derive(Default)]
pub(super) struct Beams(HashMap<*const FarField, [f64; 2]>);

impl Beams {
    fn cone(&mut self, luminaire: &LuminaireLight) -> Cone {
        let table = &luminaire.far_field;
        let entry = self.0.entry(Arc::as_ptr(table));
        let [spread, reach] = *entry.or_insert_with(|| beam_of(table));
        Cone {
            axis: DVec3::from_array(luminaire.aim().to_array()),
            spread,
            reach,
        }
    }
}

/// The narrowest θ_o of a table about its aim.
///
/// Between nodes I is linear in the angle and below the cosine through both, which is concave up to θ_o + π/2; it ends at the node after the
/// last one that shines. Only where planes meet in the aim are the angles of nodes those from the aim.
fn beam_of(table: &FarField) -> [f64; 2] {
    let ([azimuths, polars], peak) = (table.nodes(), table.peak()[2]);
    if table.planes() != Planes::C || peak <= 0.0 {
        return [PI, 0.0];
    }
    let greatest = |polar: f64| {
        let around = azimuths
            .iter()
            .map(|azimuth| table.at_angles(*azimuth, polar));
        around.fold(0.0, f64::max)
    };
    let (mut spread, mut edge) = (0.0_f64, 0.0);
    for (number, polar) in polars.iter().enumerate() {
        let part = greatest(*polar) / peak;
        if part > 0.0 {
            spread = spread.max(polar - libm::acos(part.min(1.0)));
            edge = polars.get(number + 1).copied().unwrap_or(*polar);
        }
    }
    let spread = spread.max(edge - FRAC_PI_2);
    [spread, (edge - spread).max(0.0)]
}

fn double(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Direction;
    use crate::sampling::testing::independent;
    use crate::sampling::warp;

    /// What a table gives in any direction is within its cone: a batwing that ends at 70°, one of light upwards only, a narrow beam.
    #[test]
    fn the_cone_of_a_table_bounds_it() {
        let polars = [0.0, 30.0, 60.0, 65.0, 70.0, 180.0];
        let tables = [
            [
                [3.0, 5.0, 9.0, 2.0, 0.0, 0.0],
                [3.0, 4.0, 7.0, 4.0, 0.0, 0.0],
            ],
            [
                [0.0, 0.0, 0.0, 0.0, 1.0, 4.0],
                [0.0, 0.0, 0.0, 0.0, 2.0, 4.0],
            ],
            [
                [9.0, 1.0, 0.0, 0.0, 0.0, 0.0],
                [9.0, 2.0, 0.0, 0.0, 0.0, 0.0],
            ],
        ];
        for (values, widest) in tables.into_iter().zip([71.0, 181.0, 61.0]) {
            let [a, b] = values;
            let values = [a, b, a].concat();
            let azimuths = [0.0, 180.0, 360.0];
            let table = FarField::new(Planes::C, &azimuths, &polars, &values).unwrap();
            let [spread, reach] = beam_of(&table);
            assert!((spread + reach).to_degrees() < widest);
            for [u, v] in independent(3, 20_000) {
                let [x, y, z] = warp::sphere(u as f32, v as f32).map(f64::from);
                let Ok(direction) = Direction::new(crate::geometry::Vector::new(x, y, z)) else {
                    continue;
                };
                let beyond = libm::acos(-direction.z()) - spread;
                let bound = match beyond > reach {
                    true => 0.0,
                    false => libm::cos(beyond.max(0.0)),
                };
                let intensity = table.intensity(direction) / table.peak()[2];
                assert!(
                    intensity <= bound + 1e-9,
                    "{intensity} {bound} at {direction:?}"
                );
            }
        }
        let turned = FarField::new(Planes::B, &[0.0, 360.0], &[0.0, 180.0], &[1.0; 4]).unwrap();
        assert_eq!(beam_of(&turned), [PI, 0.0]);
    }
}
