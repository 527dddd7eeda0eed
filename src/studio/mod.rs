//! `choque studio`: a page on this machine that lists scenarios, plays them, tunes them and writes them back.
//!
//! | what | file |
//! |---|---|
//! | the address, the start and the end | here |
//! | what may be asked, and by whom | `routes`, `guard` |
//! | which scenarios there are; when one of their files changed | `catalogue`, `files` |
//! | a run from its script to the page, a piece at a time | `queue`, `job`, `message` |
//! | sliders; the end that a snapshot expects | `sliders`, `expected` |
//! | sliders written into the script | `save` |
//! | the page itself | `web/` |
//!
//! Nothing runs on the thread that talks to pages: scripts and files are for threads of their own, runs for as many as the
//! machine has cores. A page that goes away, or moves a slider on, ends its run.

mod catalogue;
mod expected;
mod files;
mod guard;
mod job;
mod message;
mod queue;
mod routes;
mod save;
mod sliders;

use std::io;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::time::Duration;

use axum::serve::ListenerExt;
use tokio::net::TcpListener;

use crate::arguments::{ScenarioArguments, seconds};
use crate::{Error, Verdict, terminal};
use catalogue::Catalogue;
use guard::Guard;
use routes::Studio;

/// What `studio` is given.
#[derive(Clone, Debug, clap::Args)]
pub struct StudioArguments {
    /// The folder with the scenarios [default: the nearest one named `scenarios`, or this one]
    #[arg(value_name = "DIR")]
    directory: Option<PathBuf>,
    /// The port of the page; without it one that is free
    #[arg(long, value_name = "N")]
    port: Option<u16>,
    /// Time a whole run may take before it is stopped [s]
    #[arg(long, value_name = "S", default_value = "60", value_parser = seconds)]
    run_timeout: Duration,
    /// Overrides and folders.
    #[command(flatten)]
    scenario: ScenarioArguments,
}

/// Threads for files, which take moments.
const FILE_THREADS: usize = 4;
/// Of a thread: the deepest script needs less than 2 MiB.
const STACK: usize = 4 << 20;
/// How long what is at work when the studio ends may take to notice.
const LAST_MOMENTS: Duration = Duration::from_secs(2);

/// Serves the page until it is interrupted.
///
/// # Errors
/// A folder that is not there; a port that is taken.
pub fn studio(arguments: &StudioArguments) -> Result<Verdict, Error> {
    let root = root(arguments.directory.as_deref())?;
    let runs = std::thread::available_parallelism().map_or(1, usize::from);
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .max_blocking_threads(FILE_THREADS)
        .thread_stack_size(STACK)
        .build()
        .map_err(|error| cannot_start(&error))?;
    let served = runtime.block_on(serve(arguments, root, runs));
    // Pages are gone with the tasks that talk to them, and runs end with their pages.
    runtime.shutdown_timeout(LAST_MOMENTS);
    served.map(|()| Verdict::Holds)
}

async fn serve(arguments: &StudioArguments, root: PathBuf, runs: usize) -> Result<(), Error> {
    let wanted = SocketAddr::from((Ipv4Addr::LOCALHOST, arguments.port.unwrap_or(0)));
    let listener = TcpListener::bind(wanted).await.map_err(|error| cannot_listen(wanted.port(), &error))?;
    let port = listener.local_addr().map_err(|error| cannot_start(&error))?.port();
    let guard = Guard::new(port).map_err(|error| cannot_start(&error))?;
    let shown = root.display().to_string();
    // Before the address is told: whoever reads it may interrupt from then on.
    let interrupted = interruption().map_err(|error| cannot_start(&error))?;
    terminal::answer(&format!("{}\n", guard.address()))?;
    terminal::tell(&format!("the scenarios below {shown}, for this machine only; Ctrl-C ends it\n"));
    let studio = Studio::new(Catalogue::new(root), arguments.scenario.clone(), arguments.run_timeout, runs);
    // Small pieces go out at once: else each would wait for the page to confirm the one before it.
    let listener = listener.tap_io(|connection| drop(connection.set_nodelay(true)));
    let pages = axum::serve(listener, routes::router(studio, guard));
    tokio::select! {
        served = pages.into_future() => served.map_err(|error| cannot_start(&error)),
        () = interrupted => Ok(()),
    }
}

/// Ends when Ctrl-C is pressed, or the process is asked to end.
#[cfg(unix)]
fn interruption() -> io::Result<impl Future<Output = ()>> {
    use tokio::signal::unix::{SignalKind, signal};
    let (mut interrupt, mut terminate) = (signal(SignalKind::interrupt())?, signal(SignalKind::terminate())?);
    Ok(async move {
        tokio::select! {
            _ = interrupt.recv() => {}
            _ = terminate.recv() => {}
        }
    })
}

/// Ends when Ctrl-C is pressed.
#[cfg(not(unix))]
fn interruption() -> io::Result<impl Future<Output = ()>> {
    Ok(async {
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    })
}

/// The folder that is asked for, or the nearest one named `scenarios`: above this one, or in it.
fn root(asked: Option<&Path>) -> Result<PathBuf, Error> {
    if let Some(directory) = asked {
        if directory.is_dir() {
            return Ok(directory.to_owned());
        }
        return Err(Error::Call {
            message: format!("there is no folder {}", directory.display()),
            hint: "name the folder that the scenarios are in: choque studio scenarios".to_owned(),
        });
    }
    let here = std::env::current_dir().map_err(|error| cannot_start(&error))?;
    let above = here.ancestors().find(|folder| folder.file_name().is_some_and(|name| name == "scenarios"));
    let below = Path::new("scenarios");
    Ok(match above {
        Some(folder) => folder.to_owned(),
        None if below.is_dir() => below.to_owned(),
        None => PathBuf::from("."),
    })
}

fn cannot_listen(port: u16, error: &io::Error) -> Error {
    Error::Call {
        message: format!("cannot listen on port {port} of 127.0.0.1: {error}"),
        hint: "without --port one that is free is taken".to_owned(),
    }
}

fn cannot_start(error: &io::Error) -> Error {
    Error::Call { message: format!("the studio cannot start: {error}"), hint: "try it again".to_owned() }
}
