//! Work shared out over all cores; answers come back in the order of the questions.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use crate::progress::Progress;

/// Does every job, on that many threads, and tells how far it has come.
pub fn share<J: Sync, A: Send>(
    jobs: &[J],
    threads: usize,
    what: &'static str,
    work: impl Fn(&J) -> A + Sync,
) -> Vec<A> {
    let progress = Mutex::new((Progress::of(jobs.len() as u64, what), 0));
    spread(jobs, threads, |job| {
        let answer = work(job);
        let (bar, done) = &mut *locked(&progress);
        *done += 1;
        bar.reached(*done);
        answer
    })
}

/// Does every job, on that many threads.
pub fn spread<J: Sync, A: Send>(jobs: &[J], threads: usize, work: impl Fn(&J) -> A + Sync) -> Vec<A> {
    spread_with(jobs, threads, || (), |(), job| work(job))
}

/// Does every job, on that many threads, each with something of its own that is made once.
pub fn spread_with<J: Sync, T, A: Send>(
    jobs: &[J],
    threads: usize,
    own: impl Fn() -> T + Sync,
    work: impl Fn(&T, &J) -> A + Sync,
) -> Vec<A> {
    let next = AtomicUsize::new(0);
    let answers = Mutex::new(Vec::with_capacity(jobs.len()));
    thread::scope(|scope| {
        for _ in 0..threads.clamp(1, jobs.len().max(1)) {
            scope.spawn(|| {
                let own = own();
                while let Some((index, job)) =
                    Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|i| Some((i, jobs.get(i)?)))
                {
                    let answer = work(&own, job);
                    locked(&answers).push((index, answer));
                }
            });
        }
    });
    let mut answers = answers.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    answers.sort_by_key(|(index, _)| *index);
    answers.into_iter().map(|(_, answer)| answer).collect()
}

/// A lock whose holder died is still a lock: the thread's own panic is passed on by the scope.
pub(crate) fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// As many threads as there are cores.
#[must_use]
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_keep_the_order_of_the_questions() {
        let jobs: Vec<u64> = (0..100).collect();
        let squares: Vec<u64> = jobs.iter().map(|n| n * n).collect();
        for threads in [1, 3, 200] {
            assert_eq!(share(&jobs, threads, "jobs", |n| n * n), squares);
        }
        assert!(share(&Vec::<u64>::new(), 2, "jobs", |n| *n).is_empty());
    }
}
