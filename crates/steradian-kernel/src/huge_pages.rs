//! Large pages for large trees.
//!
//! A reflected ray visits some twenty places of a tree that may be larger than a gigabyte, and in pages of four kilobytes nearly every one
//! has to be looked up in the page tables first. Linux gives pages of two megabytes to memory for which that is asked.

use std::mem::MaybeUninit;

/// Asks for large pages where they fit; must come before the memory is first written.
#[cfg(target_os = "linux")]
pub(crate) fn ask_for<T>(memory: &mut [MaybeUninit<T>]) {
    const PAGE: usize = 2 << 20;
    let range = memory.as_mut_ptr_range();
    let first = range.start.addr().next_multiple_of(PAGE);
    let end = range.end.addr() / PAGE * PAGE;
    if first < end {
        let start = range.start.cast::<u8>().with_addr(first);
        // SAFETY: the pages lie within the slice, and the advice changes no byte of them; one that is refused changes nothing at all.
        unsafe { libc::madvise(start.cast(), end - first, libc::MADV_HUGEPAGE) };
    }
}

/// Only Linux is asked.
#[cfg(not(target_os = "linux"))]
pub(crate) fn ask_for<T>(_: &mut [MaybeUninit<T>]) {}

#[cfg(test)]
mod tests {
    use super::ask_for;

    /// Sizes without a whole page, with one and with several.
    #[test]
    fn what_was_written_before_and_after_is_there() {
        for length in [0, 100, 700_000, 1_500_000] {
            let mut numbers: Vec<u64> = Vec::with_capacity(length);
            numbers.extend(0..length as u64 / 2);
            ask_for(numbers.spare_capacity_mut());
            numbers.extend(length as u64 / 2..length as u64);
            assert!((0..length as u64).eq(numbers), "{length}");
        }
    }
}
