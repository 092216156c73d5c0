//! Tables for the tests that every model passes.

use std::f64::consts::{FRAC_1_PI, PI};
use std::sync::Arc;

use super::{
    AngleBasis, Block, Measured, Merl, PatchMatrix, Rank, Reading, Side, TreeBuilder, TwoSided,
};

/// A table, how well its albedo is known, and what its weights stay below.
pub(crate) fn subjects() -> Vec<(Measured, f64, f64)> {
    let patches = two_sided([0.04, 0.08].map(|value| Block::Matrix(matrix(value))));
    let trees = two_sided([Rank::Three, Rank::Four].map(|rank| Block::Tree(tree(rank))));
    let colours = Measured::Merl(Arc::new(merl()), Reading::Rgb);
    vec![
        (patches, 1e-6, 1.0),
        (trees, 1e-6, 0.8),
        (colours, 4e-3, 4.0),
    ]
}

/// Reflection on the first block's side, and transmission both ways by the second.
fn two_sided([reflection, transmission]: [Block; 2]) -> Measured {
    let mut table = TwoSided::default();
    table.set_reflection(Side::Above, reflection.clone());
    table.set_reflection(Side::Below, reflection);
    table.set_transmission(Side::Below, transmission.reversed());
    table.set_transmission(Side::Above, transmission);
    Measured::TwoSided(Arc::new(table))
}

/// Brighter towards the horizon, ring by ring, and symmetrical.
fn matrix(value: f32) -> PatchMatrix {
    let basis = AngleBasis::named("LBNL/Klems Half").remove(0);
    let ring_of = |patch: usize| basis.rings().position(|ring| ring.contains(&patch));
    let rings: Vec<_> = (0..basis.patches())
        .map(|patch| ring_of(patch).unwrap_or(0) as f32)
        .collect();
    let row = |a: &f32| {
        rings
            .iter()
            .map(move |b| value + 0.002 * (a + b))
            .collect::<Vec<_>>()
    };
    let values = rings.iter().flat_map(row).collect();
    PatchMatrix::new(basis.clone(), basis.clone(), values).unwrap()
}

/// Lambertian, on leaves of two sizes.
fn tree(rank: Rank) -> super::TensorTree {
    let children = 1 << rank.axes();
    let mut builder = TreeBuilder::new(rank);
    builder.branch().unwrap();
    for child in 0..children {
        let count = if child % 2 == 0 { 1 } else { children };
        builder.grid(&vec![0.3 * FRAC_1_PI as f32; count]).unwrap();
    }
    builder.build().unwrap()
}

/// A smooth lobe about the half vector, of three colours.
fn merl() -> Merl {
    let [halves, differences, azimuths] = Merl::CELLS;
    let value = |k: usize| {
        let cell = [
            k / azimuths / differences,
            k / azimuths % differences,
            k % azimuths,
        ];
        let [theta_h, _, phi_d] = Merl::middle(cell);
        let lobe = libm::exp(-8.0 * theta_h * theta_h) / PI;
        let grain = 0.02 * libm::cos(2.0 * phi_d);
        [0.1 + lobe, 0.1 + grain, 0.05 + 0.3 * lobe].map(|x| x as f32)
    };
    Merl::new((0..halves * differences * azimuths).map(value).collect()).unwrap()
}
