//! Runs wait for one of a few places, and end when nobody waits for them any more.

use std::convert::Infallible;
use std::io;
use std::pin::Pin;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};
use std::task::{Context, Poll};

use axum::body::{Body, Bytes};
use choque_scripting::Stop;
use futures_core::Stream;
use tokio::sync::Semaphore;
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};

use super::STACK;
use crate::report::jobs::locked;

/// As many places as runs may go on at once. Each has a thread that outlives its runs, and keeps what it made for them.
pub(super) struct Queue<K> {
    places: Arc<Semaphore>,
    idle: Arc<Mutex<Vec<Worker<K>>>>,
}

/// A thread that waits for a run.
struct Worker<K> {
    /// What it ran last.
    knows: String,
    todo: Sender<Work<K>>,
}

/// A run, with what its thread has kept of the runs before it.
type Work<K> = Box<dyn FnOnce(&mut K) + Send>;

/// How a run answers its page. A run sends a few films and a few lines, so nothing needs to wait for a slow reader.
pub(super) struct Answer(UnboundedSender<Bytes>);

impl Answer {
    /// Sends a piece; a page that is gone needs none.
    pub(super) fn send(&self, piece: Bytes) {
        let _ = self.0.send(piece);
    }
}

impl<K: Default + 'static> Queue<K> {
    pub(super) fn new(places: usize) -> Self {
        Queue { places: Arc::new(Semaphore::new(places)), idle: Arc::default() }
    }

    /// Waits for a place, runs there, and gives what the run sends as a body: where the same was run before, if that is free.
    /// Dropping the future gives up the wait; dropping the body stops the run.
    ///
    /// # Errors
    /// A thread that cannot be made.
    pub(super) async fn run(
        &self,
        what: String,
        run: impl FnOnce(&mut K, &Answer, &Stop) + Send + 'static,
    ) -> io::Result<Body> {
        let place = self.places.clone().acquire_owned().await.map_err(io::Error::other)?;
        let (sender, receiver) = unbounded_channel();
        let stop = Stop::default();
        let pieces = Pieces { receiver, stop: stop.clone() };
        let worker = match self.idle_worker(&what) {
            Some(todo) => todo,
            None => new_worker()?,
        };
        let (idle, todo) = (self.idle.clone(), worker.clone());
        let work: Work<K> = Box::new(move |kept| {
            run(kept, &Answer(sender), &stop);
            // After a panic neither comes to pass: the thread ends, and the next run has a new one.
            locked(&idle).push(Worker { knows: what, todo });
            drop(place);
        });
        worker.send(work).map_err(|_| io::Error::other("the thread of a run has ended"))?;
        Ok(Body::from_stream(pieces))
    }

    fn idle_worker(&self, what: &str) -> Option<Sender<Work<K>>> {
        let mut idle = locked(&self.idle);
        let known = idle.iter().rposition(|worker| worker.knows == what);
        let at = known.or(idle.len().checked_sub(1))?;
        Some(idle.remove(at).todo)
    }
}

fn new_worker<K: Default + 'static>() -> io::Result<Sender<Work<K>>> {
    let (todo, works) = channel::<Work<K>>();
    let work = move || {
        let mut kept = K::default();
        works.into_iter().for_each(|work| work(&mut kept));
    };
    std::thread::Builder::new().name("run".to_owned()).stack_size(STACK).spawn(work)?;
    Ok(todo)
}

/// What a run sends, as the body of a response.
struct Pieces {
    receiver: UnboundedReceiver<Bytes>,
    stop: Stop,
}

impl Stream for Pieces {
    type Item = Result<Bytes, Infallible>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        self.receiver.poll_recv(context).map(|piece| piece.map(Ok))
    }
}

impl Drop for Pieces {
    fn drop(&mut self) {
        self.stop.ask();
    }
}
