//! Work on several threads, whose results are taken in the order of one.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError, mpsc};

/// Does all jobs, the last one first, and takes the results in this order, on the thread of the caller. A result waits for
/// those before it.
pub(crate) fn in_order<J: Send, R: Send>(
    threads: usize,
    mut jobs: Vec<J>,
    work: impl Fn(J) -> R + Sync,
    mut take: impl FnMut(R),
) {
    if threads < 2 {
        while let Some(job) = jobs.pop() {
            take(work(job));
        }
        return;
    }
    let jobs = Mutex::new(jobs.into_iter().rev().enumerate());
    let next = || jobs.lock().unwrap_or_else(PoisonError::into_inner).next();
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let (sender, next, work) = (sender.clone(), &next, &work);
            scope.spawn(move || {
                while let Some((place, job)) = next() {
                    if sender.send((place, work(job))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        let (mut waiting, mut taken) = (BTreeMap::new(), 0);
        for (place, result) in receiver {
            waiting.insert(place, result);
            while let Some(result) = waiting.remove(&taken) {
                take(result);
                taken += 1;
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::in_order;
    use std::time::Duration;

    #[test]
    fn results_come_in_the_same_order_from_any_number_of_threads() {
        let work = |job: u64| {
            std::thread::sleep(Duration::from_micros(job % 3 * 300));
            job * job
        };
        for threads in [0, 1, 2, 5, 40] {
            let mut results = Vec::new();
            in_order(threads, (0..30).collect(), work, |r| results.push(r));
            let expected: Vec<u64> = (0..30).rev().map(|job| job * job).collect();
            assert_eq!(results, expected, "{threads}");
        }
    }
}
