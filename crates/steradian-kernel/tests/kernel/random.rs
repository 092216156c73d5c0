//! A counter-based generator (Steele, Lea & Flood 2014, SplitMix64) and what the tests draw from it.

use steradian_kernel::{Geometry, RayBatch};

/// Numbers by seed and counter.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ z >> 31
    }

    /// Uniform in 0 .. 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in `-size .. size`, each coordinate.
    pub fn point(&mut self, size: f64) -> [f32; 3] {
        std::array::from_fn(|_| ((2.0 * self.unit() - 1.0) * size) as f32)
    }

    pub fn index(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }
}

/// Triangles of this size at random places in the cube −1 .. 1.
pub fn soup(count: usize, size: f64, seed: u64) -> Geometry {
    let mut random = Random::new(seed);
    let mut geometry = Geometry::default();
    for triangle in 0..count as u32 {
        let center = random.point(1.0);
        for _ in 0..3 {
            let offset = random.point(size);
            geometry
                .positions
                .push([0, 1, 2].map(|k| center[k] + offset[k]));
        }
        geometry
            .triangles
            .push([3 * triangle, 3 * triangle + 1, 3 * triangle + 2]);
    }
    geometry
}

/// Rays from the cube −`size` .. `size` in all directions, half of them of limited length.
pub fn rays(count: usize, size: f64, seed: u64) -> RayBatch {
    let mut random = Random::new(seed);
    let mut batch = RayBatch::with_capacity(count);
    for row in 0..count {
        let t_max = if row % 2 == 0 {
            f32::INFINITY
        } else {
            2.0 * random.unit() as f32
        };
        let (origin, direction) = (random.point(size), random.point(1.0));
        batch.push(origin, direction, t_max);
    }
    batch
}
