//! Work shared out between threads: in parts that depend on nothing but the work, with what comes of them in the order of the parts.
//!
//! A step shares out many small pieces, one shortly after the other. The threads that help wait for the next awake: a thread that
//! sleeps takes longer to be up than many a piece takes to be done. Where the processors are busy with something else, helpers come
//! late: then work is done on the first thread for a while.

use core::hint::spin_loop;
use core::ops::Range;
use core::sync::atomic::{AtomicUsize, Ordering};
use rayon::{ThreadPool, ThreadPoolBuilder, Yield};
use std::sync::Arc;

/// More threads than this are of no use.
const MOST: usize = 64;

/// Fewer things than so many for a thread are not worth being shared out.
pub(crate) const PER_THREAD: usize = 2048;

/// How often a helper looks for something to do before it goes to sleep: for about half a millisecond.
const LINGERS: u32 = 1 << 14;

/// How long the first thread waits for the others before it goes to sleep itself: a millisecond or two.
const WAITS: u32 = 1 << 15;

/// Whoever has not begun when the first thread is done, and keeps it waiting for so long, comes late: waking up takes less.
const LATE: usize = 1 << 12;

/// What others need to leave once their work is done, which the first thread better waits for awake too.
const LEAVING: u32 = 64;

/// For so many times 2 to the power of how often helpers came late lately, up to a limit, nothing is shared out.
const PAUSE: usize = 8;
const MOST_LATE: usize = 10;

/// How many threads an iteration may be shared by, and those that help the first.
#[derive(Clone, Debug)]
pub(crate) struct Threads(Option<Arc<Crew>>);

/// The threads that help.
#[derive(Debug)]
struct Crew {
    pool: ThreadPool,
    /// How many of them stay awake for what comes next.
    awake: Arc<AtomicUsize>,
    /// Whether there are processors enough for all of them to do so.
    linger: bool,
    /// How often they came late, less how often they did not; and how many times more nothing is shared out for that.
    late: AtomicUsize,
    pause: AtomicUsize,
}

impl Threads {
    /// This one alone: for work so light that bodies are sooner done than brought from one processor to the other.
    pub(crate) const ONE: Threads = Threads(None);

    /// One at least; one only where the system gives no more.
    pub(crate) fn new(count: usize) -> Threads {
        Threads(Crew::of(count.min(MOST).saturating_sub(1)).map(Arc::new))
    }

    pub(crate) fn count(&self) -> usize {
        1 + self.0.as_ref().map_or(0, |crew| crew.pool.current_num_threads())
    }

    /// So many things in a part for each thread, all but the last of a multiple of `multiple`; one part where a thread would have fewer
    /// than `least`.
    pub(crate) fn parts(&self, things: usize, multiple: usize, least: usize) -> Vec<Range<usize>> {
        let parts = self.count().min(things / least.max(1)).max(1);
        let each = things.div_ceil(parts).next_multiple_of(multiple).max(1);
        (0..parts).map(|part| (part * each).min(things)..((part + 1) * each).min(things)).collect()
    }

    /// Does something with all of a list, or of some lists as long as each other, in such parts; told where each begins. Gives what
    /// comes of them.
    pub(crate) fn each<L: Parted, R: Send>(
        &self,
        list: L,
        (multiple, least): (usize, usize),
        act: impl Fn(usize, L) -> R + Sync,
    ) -> Vec<R> {
        let (mut rest, act) = (list, &act);
        let mut tasks = Vec::new();
        for part in self.parts(rest.count(), multiple, least) {
            let (own, others) = rest.part(part.len());
            rest = others;
            tasks.push(move || act(part.start, own));
        }
        self.share(tasks)
    }

    /// Does a task for every part, the first on this thread.
    pub(crate) fn share<T: Send, F: FnOnce() -> T + Send>(&self, tasks: Vec<F>) -> Vec<T> {
        match &self.0 {
            Some(crew) if tasks.len() > 1 && !crew.pauses() => crew.share(tasks),
            _ => tasks.into_iter().map(|task| task()).collect(),
        }
    }
}

/// What can be shared out in parts: a list, or lists that go together.
pub(crate) trait Parted: Sized + Send {
    fn count(&self) -> usize;

    /// The first so many, and the others.
    fn part(self, count: usize) -> (Self, Self);
}

impl<T: Send> Parted for &mut [T] {
    fn count(&self) -> usize {
        self.len()
    }

    fn part(self, count: usize) -> (Self, Self) {
        self.split_at_mut(count)
    }
}

impl<T: Sync> Parted for &[T] {
    fn count(&self) -> usize {
        self.len()
    }

    fn part(self, count: usize) -> (Self, Self) {
        self.split_at(count)
    }
}

impl<A: Parted, B: Parted> Parted for (A, B) {
    fn count(&self) -> usize {
        self.0.count()
    }

    fn part(self, count: usize) -> (Self, Self) {
        let ((a, more_a), (b, more_b)) = (self.0.part(count), self.1.part(count));
        ((a, b), (more_a, more_b))
    }
}

impl Crew {
    /// `None` of nobody, and where the system gives no threads.
    fn of(count: usize) -> Option<Crew> {
        if count == 0 {
            return None;
        }
        let pool = ThreadPoolBuilder::new().num_threads(count).thread_name(|k| format!("choque {k}")).build().ok()?;
        let linger = std::thread::available_parallelism().is_ok_and(|processors| count < processors.get());
        Some(Crew { pool, awake: Arc::default(), linger, late: AtomicUsize::new(0), pause: AtomicUsize::new(0) })
    }

    /// Whether the helpers are not waited for this time.
    fn pauses(&self) -> bool {
        self.pause.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_ok()
    }

    /// Helpers had begun by the time the first thread was done, or had not.
    fn judge(&self, in_time: bool) {
        let late = self.late.load(Ordering::Relaxed);
        if in_time {
            self.late.store(late.saturating_sub(1), Ordering::Relaxed);
        } else {
            self.pause.store(PAUSE << late, Ordering::Relaxed);
            self.late.store((late + 1).min(MOST_LATE), Ordering::Relaxed);
        }
    }

    fn share<T: Send, F: FnOnce() -> T + Send>(&self, tasks: Vec<F>) -> Vec<T> {
        self.wake();
        let others = tasks.len() - 1;
        let (begun, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let mut results: Vec<Option<T>> = tasks.iter().map(|_| None).collect();
        self.pool.in_place_scope(|scope| {
            let mut tasks = tasks.into_iter().zip(&mut results);
            let first = tasks.next();
            for (task, result) in tasks {
                let (begun, done) = (&begun, &done);
                scope.spawn(move |_| {
                    begun.fetch_add(1, Ordering::Relaxed);
                    *result = Some(task());
                    done.fetch_add(1, Ordering::Release);
                });
            }
            if let Some((task, result)) = first {
                *result = Some(task());
            }
            let have_begun = begun.load(Ordering::Relaxed) == others;
            let is_over = || done.load(Ordering::Acquire) == others;
            let waited = (0..WAITS).take_while(|_| !is_over()).map(|_| spin_loop()).count();
            self.judge(waited < if have_begun { WAITS as usize } else { LATE });
            (0..LEAVING).for_each(|_| spin_loop());
        });
        results.into_iter().map(|result| result.expect("a task that panics ends the scope so")).collect()
    }

    /// Where all of them sleep they are woken, to stay awake for a while.
    fn wake(&self) {
        if !self.linger || self.awake.load(Ordering::Acquire) > 0 {
            return;
        }
        self.awake.store(self.pool.current_num_threads(), Ordering::Release);
        let awake = Arc::clone(&self.awake);
        self.pool.spawn_broadcast(move |_| {
            let mut idle = 0;
            while idle < LINGERS {
                idle = if rayon::yield_now() == Some(Yield::Executed) { 0 } else { idle + 1 };
                spin_loop();
            }
            awake.fetch_sub(1, Ordering::Release);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_all_there_is_and_in_order() {
        for threads in 1..9 {
            let threads = Threads::new(threads);
            for things in [0, 1, 7, 8, 9, 100, 1000, 12_345] {
                let parts = threads.parts(things, 8, 16);
                assert!(parts.len() <= threads.count() && !parts.is_empty());
                assert_eq!(parts.into_iter().flatten().collect::<Vec<_>>(), (0..things).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn results_come_in_the_order_of_the_parts() {
        for threads in 1..9 {
            let tasks: Vec<_> = (0..5).map(|k| move || k * k).collect();
            assert_eq!(Threads::new(threads).share(tasks), [0, 1, 4, 9, 16]);
        }
    }

    #[test]
    fn every_thing_is_done_once_and_told_where_it_is() {
        for threads in 1..9 {
            let threads = Threads::new(threads);
            for count in [0, 1, 7, 100, 1001] {
                let mut list = vec![0; count];
                let sizes = threads.each(&mut list[..], (8, 16), |from, part| {
                    part.iter_mut().enumerate().for_each(|(k, thing)| *thing += from + k);
                    part.len()
                });
                assert_eq!(list, (0..count).collect::<Vec<_>>());
                assert_eq!(sizes.into_iter().sum::<usize>(), count);
            }
        }
    }

    #[test]
    #[should_panic(expected = "of the third")]
    fn a_panic_of_a_task_goes_on_to_whoever_shared_it_out() {
        let tasks: Vec<_> = (0..4).map(|k| move || assert!(k != 2, "of the third")).collect();
        Threads::new(3).share(tasks);
    }
}
