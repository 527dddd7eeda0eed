//! Work shared out between threads: in parts that depend on nothing but the work, with what comes of them in the order of the parts.

use core::ops::Range;

/// More threads than this are of no use.
const MOST: usize = 64;

/// Fewer things than so many for a thread are not worth being shared out.
pub(crate) const PER_THREAD: usize = 2048;

/// How many threads an iteration may be shared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Threads(usize);

impl Threads {
    /// One at least.
    pub(crate) fn new(count: usize) -> Threads {
        Threads(count.clamp(1, MOST))
    }

    pub(crate) fn count(self) -> usize {
        self.0
    }

    /// So many things in a part for each thread, all but the last of a multiple of `multiple`; one part where a thread would have fewer
    /// than `least`.
    pub(crate) fn parts(self, things: usize, multiple: usize, least: usize) -> Vec<Range<usize>> {
        let parts = self.0.min(things / least.max(1)).max(1);
        let each = things.div_ceil(parts).next_multiple_of(multiple).max(1);
        (0..parts).map(|part| (part * each).min(things)..((part + 1) * each).min(things)).collect()
    }

    /// Does a task for every part, all but the first on threads of their own.
    pub(crate) fn share<T: Send, F: FnOnce() -> T + Send>(tasks: Vec<F>) -> Vec<T> {
        let mut tasks = tasks.into_iter();
        let Some(first) = tasks.next() else { return Vec::new() };
        std::thread::scope(|scope| {
            let others: Vec<_> = tasks.map(|task| scope.spawn(task)).collect();
            let mut all = vec![first()];
            for other in others {
                match other.join() {
                    Ok(result) => all.push(result),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            all
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_all_there_is_and_in_order() {
        for threads in 1..9 {
            for things in [0, 1, 7, 8, 9, 100, 1000, 12_345] {
                let parts = Threads::new(threads).parts(things, 8, 16);
                assert!(parts.len() <= threads && !parts.is_empty());
                assert_eq!(parts.into_iter().flatten().collect::<Vec<_>>(), (0..things).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn results_come_in_the_order_of_the_parts() {
        let tasks: Vec<_> = (0..5).map(|k| move || k * k).collect();
        assert_eq!(Threads::share(tasks), [0, 1, 4, 9, 16]);
    }
}
