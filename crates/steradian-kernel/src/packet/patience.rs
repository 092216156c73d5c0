//! How alike shadow rays must be to be tried as a packet.
//!
//! Whether a packet of rays that are not much alike gets through in few steps is told by its neighbours: after one that was given up
//! the next ones are left alone, twice as many each time.

/// The most by which slopes in a packet of shadow rays differ.
const WIDEST: f32 = 1.0;

/// The same after packets that were given up.
const NARROW: f32 = 1.0 / 16.0;

/// The most packets left alone.
const LONGEST_PAUSE: usize = 31;

/// What the packets so far have shown.
#[derive(Default)]
pub(crate) struct Patience {
    pause: usize,
    left: usize,
}

impl Patience {
    /// The most by which slopes in the next packet may differ.
    #[inline(always)]
    pub(crate) fn widest(&mut self) -> f32 {
        if self.left == 0 {
            return WIDEST;
        }
        self.left -= 1;
        NARROW
    }

    /// Whether the packet got through.
    #[inline(always)]
    pub(crate) fn learn(&mut self, got_through: bool) {
        let longer = (2 * self.pause + 1).min(LONGEST_PAUSE);
        self.pause = if got_through { 0 } else { longer };
        self.left = self.pause;
    }
}

#[cfg(test)]
mod tests {
    use super::{LONGEST_PAUSE, Patience, WIDEST};

    /// How many packets are left alone.
    fn pause(patience: &mut Patience) -> usize {
        (0..).take_while(|_| patience.widest() < WIDEST).count()
    }

    #[test]
    fn pauses_grow_until_a_packet_gets_through() {
        let mut patience = Patience::default();
        for expected in [0, 1, 3, 7, 15, 31, LONGEST_PAUSE] {
            assert_eq!(pause(&mut patience), expected);
            patience.learn(false);
        }
        patience.learn(true);
        assert_eq!(pause(&mut patience), 0);
    }
}
