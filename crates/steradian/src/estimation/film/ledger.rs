//! What one pass of an image hands out to the threads, and how it adds up what comes back.

use super::exposure::PassImage;
use super::session::Effort;
use super::splat::{BUNDLE, Bundle, Splatter};
use super::tile::{BUFFER_SIDE, Job, RIM, SLICE, Task, Tile};
use super::{CHANNELS, Film, Splat};
use crate::estimation::EstimationError;
use crate::estimation::crew::{Ledger, Standing};
use crate::sampling::hash::combine;

/// Hands out the tiles of one pass in slices and adds up what they bring.
pub(super) struct PassLedger<'a> {
    film: &'a Film,
    tiles: &'a [Tile],
    lengths: &'a [u64],
    key: u64,
    standing: &'a mut Standing,
    sums: Vec<[f64; CHANNELS]>,
    number: usize,
    done: u64,
    merged: usize,
    spare: Vec<Vec<[f32; CHANNELS]>>,
    spare_splats: Vec<Vec<Splat>>,
    splatter: Splatter,
    /// How many samples choose their own places, are issued, and are merged.
    splats: [u32; 3],
}

impl<'a> PassLedger<'a> {
    pub(super) fn new(
        film: &'a Film,
        tiles: &'a [Tile],
        effort: &'a Effort,
        key: u64,
        standing: &'a mut Standing,
    ) -> Self {
        let sums = vec![[0.0; CHANNELS]; film.width as usize * film.height as usize];
        Self {
            film,
            tiles,
            lengths: &effort.lengths,
            key,
            standing,
            sums,
            number: 0,
            done: 0,
            merged: 0,
            spare: Vec::new(),
            spare_splats: Vec::new(),
            splatter: Splatter::new(film),
            splats: [effort.splats, 0, 0],
        }
    }

    pub(super) fn into_image(self) -> PassImage {
        self.sums
            .into_iter()
            .map(|pixel| pixel.map(|value| value as f32))
            .collect()
    }

    /// Adds the part of a tile's buffer that lies on the image.
    fn add(&mut self, job: &Job) {
        let scale = 1.0 / self.lengths[job.number] as f64;
        let side = BUFFER_SIDE as i32;
        let (left, top) = (job.tile.left - RIM as i32, job.tile.top - RIM as i32);
        let (width, height) = (self.film.width as i32, self.film.height as i32);
        let columns = left.max(0)..(left + side).min(width);
        for row in top.max(0)..(top + side).min(height) {
            let from = ((row - top) * side + columns.start - left) as usize;
            let to = (row * width + columns.start) as usize;
            for (pixel, sum) in self.sums[to..][..columns.len()]
                .iter_mut()
                .zip(&job.sums[from..])
            {
                *pixel =
                    std::array::from_fn(|channel| pixel[channel] + scale * f64::from(sum[channel]));
            }
        }
    }
}

impl PassLedger<'_> {
    fn issue_tile(&mut self) -> Option<Job> {
        let tile = *self.tiles.get(self.number)?;
        let count = (self.lengths[self.number] - self.done).min(u64::from(SLICE)) as u32;
        let sums = self.spare.pop().unwrap_or_default();
        let job = Job {
            number: self.number,
            tile,
            first: self.done as u32,
            count,
            key: self.key,
            sums,
            fault: None,
        };
        self.done += u64::from(count);
        if self.done == self.lengths[self.number] {
            (self.number, self.done) = (self.number + 1, 0);
        }
        Some(job)
    }

    fn issue_splats(&mut self) -> Option<Bundle> {
        let [count, issued, _] = &mut self.splats;
        let indices = *issued..issued.saturating_add(BUNDLE).min(*count);
        *issued = indices.end;
        (!indices.is_empty()).then(|| Bundle {
            indices,
            key: combine(self.film.key, self.key),
            splats: self.spare_splats.pop().unwrap_or_default(),
        })
    }

    fn merge_tile(&mut self, job: Job) -> Result<(), EstimationError> {
        if let Some(([x, y], count)) = job.fault {
            return Err(EstimationError::NonFinitePixel { x, y, count });
        }
        self.add(&job);
        self.standing.samples += job.samples();
        self.merged += usize::from(u64::from(job.first + job.count) == self.lengths[job.number]);
        self.spare.push(job.sums);
        Ok(())
    }

    fn merge_splats(&mut self, mut bundle: Bundle) -> Result<(), EstimationError> {
        bundle.check()?;
        let scale = 1.0 / f64::from(self.splats[0]);
        for splat in bundle.splats.drain(..) {
            self.splatter.add(&splat, scale, &mut self.sums);
        }
        self.standing.samples += bundle.indices.len() as u64;
        self.splats[2] = bundle.indices.end;
        self.spare_splats.push(bundle.splats);
        Ok(())
    }
}

impl Ledger for &mut PassLedger<'_> {
    type Job = Task;

    fn issue(&mut self) -> Option<Task> {
        let tile = self.issue_tile().map(Task::Tile);
        tile.or_else(|| self.issue_splats().map(Task::Splats))
    }

    fn merge(&mut self, task: Task) -> Result<(), EstimationError> {
        match task {
            Task::Tile(job) => self.merge_tile(job),
            Task::Splats(bundle) => self.merge_splats(bundle),
        }
    }

    fn is_complete(&self) -> bool {
        self.merged == self.tiles.len() && self.splats[2] == self.splats[0]
    }

    fn standing(&self) -> Standing {
        Standing { ..*self.standing }
    }
}
