//! Rays and hits as columns: one `Vec` per component, so that loops over rays vectorise.

/// The primitive of a ray that meets nothing.
pub const MISS: u32 = u32::MAX;

/// One ray: the points `origin + t · direction` with `0 < t ≤ t_max`.
///
/// The direction need not be normalised; `t` counts in its length. A ray is *valid* when its numbers are finite (`t_max`
/// may be infinite, not NaN), the origin's coordinates are within ±[`COORDINATE_LIMIT`](crate::COORDINATE_LIMIT) and the
/// direction's largest component is within 2⁻²⁸ … 2²⁸. A ray that is not valid meets nothing.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Ray {
    /// The point at `t = 0`, which itself is not part of the ray.
    pub origin: [f32; 3],
    /// Where the ray goes.
    pub direction: [f32; 3],
    /// The last `t` of the ray.
    pub t_max: f32,
}

/// The closest hit of one ray.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter; infinite for a miss.
    pub t: f32,
    /// Barycentric weight of the triangle's vertex 1; 0 on a quadric and for a miss.
    pub u: f32,
    /// Barycentric weight of the triangle's vertex 2; 0 on a quadric and for a miss.
    pub v: f32,
    /// Triangles count from 0 in input order, quadrics follow; [`MISS`] if there is none.
    pub primitive: u32,
}

impl Hit {
    /// What a ray that meets nothing gets.
    pub const NONE: Self = Self {
        t: f32::INFINITY,
        u: 0.0,
        v: 0.0,
        primitive: MISS,
    };
}

/// Rays in columns; all columns have the same length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RayBatch {
    /// First coordinate of the origins.
    pub origin_x: Vec<f32>,
    /// Second coordinate of the origins.
    pub origin_y: Vec<f32>,
    /// Third coordinate of the origins.
    pub origin_z: Vec<f32>,
    /// First component of the directions.
    pub direction_x: Vec<f32>,
    /// Second component of the directions.
    pub direction_y: Vec<f32>,
    /// Third component of the directions.
    pub direction_z: Vec<f32>,
    /// The last `t` of each ray.
    pub t_max: Vec<f32>,
}

impl RayBatch {
    /// An empty batch with room for `capacity` rays.
    pub fn with_capacity(capacity: usize) -> Self {
        let column = || Vec::with_capacity(capacity);
        Self {
            origin_x: column(),
            origin_y: column(),
            origin_z: column(),
            direction_x: column(),
            direction_y: column(),
            direction_z: column(),
            t_max: column(),
        }
    }

    /// The number of rays: the length of the shortest column.
    pub fn len(&self) -> usize {
        self.columns()
            .iter()
            .map(|column| column.len())
            .min()
            .unwrap_or(0)
    }

    /// Whether there is no ray.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Removes all rays and keeps the memory.
    pub fn clear(&mut self) {
        self.resize(0);
    }

    /// Gives every column `len` entries; new ones are 0, which is an invalid ray.
    pub fn resize(&mut self, len: usize) {
        for column in self.columns_mut() {
            column.resize(len, 0.0);
        }
    }

    /// Appends a ray.
    pub fn push(&mut self, origin: [f32; 3], direction: [f32; 3], t_max: f32) {
        let values = [
            origin[0],
            origin[1],
            origin[2],
            direction[0],
            direction[1],
            direction[2],
            t_max,
        ];
        for (column, value) in self.columns_mut().into_iter().zip(values) {
            column.push(value);
        }
    }

    /// Replaces the ray of row `index`.
    ///
    /// # Panics
    /// If `index` is not below [`len`](Self::len).
    pub fn set(&mut self, index: usize, origin: [f32; 3], direction: [f32; 3], t_max: f32) {
        let values = [
            origin[0],
            origin[1],
            origin[2],
            direction[0],
            direction[1],
            direction[2],
            t_max,
        ];
        for (column, value) in self.columns_mut().into_iter().zip(values) {
            column[index] = value;
        }
    }

    /// The ray of row `index`.
    ///
    /// # Panics
    /// If `index` is not below [`len`](Self::len).
    #[inline(always)]
    pub fn ray(&self, index: usize) -> Ray {
        Ray {
            origin: [
                self.origin_x[index],
                self.origin_y[index],
                self.origin_z[index],
            ],
            direction: [
                self.direction_x[index],
                self.direction_y[index],
                self.direction_z[index],
            ],
            t_max: self.t_max[index],
        }
    }

    /// Origin, direction and `t_max`, in this order.
    pub(crate) fn columns(&self) -> [&Vec<f32>; 7] {
        let Self {
            origin_x,
            origin_y,
            origin_z,
            direction_x,
            direction_y,
            direction_z,
            t_max,
        } = self;
        [
            origin_x,
            origin_y,
            origin_z,
            direction_x,
            direction_y,
            direction_z,
            t_max,
        ]
    }

    fn columns_mut(&mut self) -> [&mut Vec<f32>; 7] {
        let Self {
            origin_x,
            origin_y,
            origin_z,
            direction_x,
            direction_y,
            direction_z,
            t_max,
        } = self;
        [
            origin_x,
            origin_y,
            origin_z,
            direction_x,
            direction_y,
            direction_z,
            t_max,
        ]
    }
}

/// The closest hits of a batch of rays, row by row; [`Hit`] tells what the columns hold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HitBatch {
    /// Ray parameters.
    pub t: Vec<f32>,
    /// Weights of vertex 1.
    pub u: Vec<f32>,
    /// Weights of vertex 2.
    pub v: Vec<f32>,
    /// Primitives, or [`MISS`].
    pub primitive: Vec<u32>,
}

impl HitBatch {
    /// The number of hits: the length of the column of primitives.
    pub fn len(&self) -> usize {
        self.primitive.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.primitive.is_empty()
    }

    /// Gives every column `len` rows; new ones are misses.
    pub fn resize(&mut self, len: usize) {
        self.t.resize(len, Hit::NONE.t);
        self.u.resize(len, Hit::NONE.u);
        self.v.resize(len, Hit::NONE.v);
        self.primitive.resize(len, MISS);
    }

    /// The hit of row `index`.
    ///
    /// # Panics
    /// If `index` is not below [`len`](Self::len).
    pub fn hit(&self, index: usize) -> Hit {
        Hit {
            t: self.t[index],
            u: self.u[index],
            v: self.v[index],
            primitive: self.primitive[index],
        }
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, index: usize, hit: Hit) {
        self.t[index] = hit.t;
        self.u[index] = hit.u;
        self.v[index] = hit.v;
        self.primitive[index] = hit.primitive;
    }
}
