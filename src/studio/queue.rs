//! Runs wait for one of a few places, and end when nobody waits for them any more.

use std::convert::Infallible;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use axum::body::{Body, Bytes};
use choque_scripting::Stop;
use futures_core::Stream;
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};
use tokio::sync::{AcquireError, Semaphore};

/// As many places as runs may go on at once.
#[derive(Clone, Debug)]
pub(super) struct Queue(Arc<Semaphore>);

/// How a run answers its page. A run sends a few films and a few lines, so nothing needs to wait for a slow reader.
pub(super) struct Answer(UnboundedSender<Bytes>);

impl Answer {
    /// Sends a piece; a page that is gone needs none.
    pub(super) fn send(&self, piece: Bytes) {
        let _ = self.0.send(piece);
    }
}

impl Queue {
    pub(super) fn new(places: usize) -> Self {
        Queue(Arc::new(Semaphore::new(places)))
    }

    /// Waits for a place, runs there, and gives what the run sends as a body. Dropping the future gives up the wait; dropping
    /// the body stops the run.
    pub(super) async fn run(&self, run: impl FnOnce(&Answer, &Stop) + Send + 'static) -> Result<Body, AcquireError> {
        let place = self.0.clone().acquire_owned().await?;
        let (sender, receiver) = unbounded_channel();
        let stop = Stop::default();
        let pieces = Pieces { receiver, stop: stop.clone() };
        tokio::task::spawn_blocking(move || {
            run(&Answer(sender), &stop);
            drop(place);
        });
        Ok(Body::from_stream(pieces))
    }
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
