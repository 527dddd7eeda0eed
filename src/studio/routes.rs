//! What a page may ask.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use axum::Router;
use axum::body::Bytes;
use axum::extract::{DefaultBodyLimit, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::middleware::from_fn_with_state;
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use choque_scripting::{Options, Output};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::json;

use super::catalogue::Catalogue;
use super::files::{Seen, digest};
use super::guard::{self, Guard};
use super::job::{Job, Shelf, run};
use super::queue::Queue;
use super::save::{Refused, save};
use crate::arguments::ScenarioArguments;
use crate::player;

/// Bytes of a question: a thousand sliders fit.
const LONGEST_QUESTION: usize = 256 * 1024;

/// What all answers are made from.
pub(super) struct Studio {
    catalogue: Catalogue,
    arguments: ScenarioArguments,
    run_timeout: Duration,
    queue: Queue<Shelf>,
    /// Of each scenario that was run, the files it was made of.
    seen: Mutex<BTreeMap<String, Seen>>,
    /// Two pages do not write at once; whoever waits takes no thread meanwhile.
    writing: Arc<tokio::sync::Mutex<()>>,
}

impl Studio {
    pub(super) fn new(
        catalogue: Catalogue,
        arguments: ScenarioArguments,
        run_timeout: Duration,
        places: usize,
    ) -> Self {
        let (queue, seen, writing) = (Queue::new(places), Mutex::default(), Arc::default());
        Studio { catalogue, arguments, run_timeout, queue, seen, writing }
    }

    fn seen(&self) -> std::sync::MutexGuard<'_, BTreeMap<String, Seen>> {
        self.seen.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

type Shared = State<Arc<Studio>>;

/// The page's own files: name, kind, content.
const ASSETS: [(&str, &str, &str); 8] = [
    ("", "text/html; charset=utf-8", include_str!("web/index.html")),
    ("studio.css", CSS, include_str!("web/studio.css")),
    ("studio.js", JS, include_str!("web/studio.js")),
    ("server.js", JS, include_str!("web/server.js")),
    ("list.js", JS, include_str!("web/list.js")),
    ("sliders.js", JS, include_str!("web/sliders.js")),
    ("readout.js", JS, include_str!("web/readout.js")),
    ("dom.js", JS, include_str!("web/dom.js")),
];
const CSS: &str = "text/css; charset=utf-8";
const JS: &str = "text/javascript; charset=utf-8";

/// The page, its files and its questions, all of them below the token.
pub(super) fn router(studio: Studio, guard: Guard) -> Router {
    let mut router = Router::new();
    for (name, kind, content) in ASSETS {
        router = router.route(&guard.path(name), get(move || async move { ([(header::CONTENT_TYPE, kind)], content) }));
    }
    let script: Bytes = player::script().into();
    router
        .route(&guard.path("player.js"), get(move || async move { ([(header::CONTENT_TYPE, JS)], script) }))
        .route(&guard.path("player.css"), get(|| async { ([(header::CONTENT_TYPE, CSS)], player::style()) }))
        .route(&guard.path("scenarios"), get(scenarios))
        .route(&guard.path("run"), post(start_run))
        .route(&guard.path("state"), post(state))
        .route(&guard.path("save"), post(write_back))
        .fallback(guard::nothing_here)
        .layer(DefaultBodyLimit::max(LONGEST_QUESTION))
        .layer(from_fn_with_state(guard, guard::check))
        .with_state(Arc::new(studio))
}

/// The list, and a few digits that differ when it does.
async fn scenarios(State(studio): Shared) -> Answer {
    elsewhere(move || {
        let entries = json!(studio.catalogue.entries());
        let folder = studio.catalogue.root().display().to_string();
        Ok(json!({ "folder": folder, "stamp": digest(&entries.to_string()), "scenarios": entries }).to_string())
    })
    .await
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RunQuestion {
    scenario: String,
    set: Vec<(String, f64)>,
}

/// Runs a scenario; what comes of it is sent as it comes.
async fn start_run(State(studio): Shared, headers: HeaderMap, body: Bytes) -> Result<Response, Refusal> {
    let RunQuestion { scenario, set } = question(&headers, &body)?;
    let path = script(&studio, scenario.clone()).await?;
    let (arguments, time) = (studio.arguments.clone(), studio.run_timeout);
    let shared = studio.clone();
    let what = scenario.clone();
    let work = move |shelf: &mut Shelf, answer: &_, stop: &_| {
        let seen = run(&Job { path, set, arguments, time }, shelf, answer, stop);
        shared.seen().insert(scenario, seen);
    };
    let body = studio.queue.run(what, work).await.map_err(|error| Refusal::here(&error))?;
    Ok(([(header::CONTENT_TYPE, "application/octet-stream")], body).into_response())
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StateQuestion {
    scenario: String,
}

/// Whether the files of a scenario are still what they were when it was run last.
async fn state(State(studio): Shared, headers: HeaderMap, body: Bytes) -> Answer {
    let StateQuestion { scenario } = question(&headers, &body)?;
    let seen = studio.seen().get(&scenario).cloned();
    elsewhere(move || Ok(json!({ "stamp": seen.map(|seen| seen.stamp_now()) }).to_string())).await
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SaveQuestion {
    scenario: String,
    digest: String,
    set: Vec<(String, f64)>,
}

/// Writes values into a script.
async fn write_back(State(studio): Shared, headers: HeaderMap, body: Bytes) -> Answer {
    let SaveQuestion { scenario, digest, set } = question(&headers, &body)?;
    let path = script(&studio, scenario).await?;
    let alone = studio.writing.clone().lock_owned().await;
    elsewhere(move || {
        let _alone = alone;
        // What the script prints has been on the page already.
        let options = Options { output: Output::to(|_| ()), ..studio.arguments.options() };
        match save(&path, &digest, &set, &options) {
            Ok(saved) => Ok(json!(saved).to_string()),
            Err(refused) => {
                let status = if matches!(refused, Refused::File(_)) {
                    StatusCode::INTERNAL_SERVER_ERROR
                } else {
                    StatusCode::CONFLICT
                };
                Err(Refusal { status, why: refused.to_string() })
            }
        }
    })
    .await
}

/// A question that is not answered.
struct Refusal {
    status: StatusCode,
    why: String,
}

type Answer = Result<Response, Refusal>;

impl Refusal {
    fn of(status: StatusCode, why: impl Into<String>) -> Self {
        Refusal { status, why: why.into() }
    }

    /// What is no fault of the page.
    fn here(error: &dyn std::error::Error) -> Self {
        Refusal::of(StatusCode::INTERNAL_SERVER_ERROR, error.to_string())
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        let body = json!({ "error": self.why }).to_string();
        (self.status, [(header::CONTENT_TYPE, "application/json")], body).into_response()
    }
}

/// Reads a question. Only JSON is one: other sites' forms cannot send that.
fn question<T: DeserializeOwned>(headers: &HeaderMap, body: &Bytes) -> Result<T, Refusal> {
    if headers.get(header::CONTENT_TYPE).is_none_or(|kind| kind != "application/json") {
        return Err(Refusal::of(StatusCode::UNSUPPORTED_MEDIA_TYPE, "a question is application/json"));
    }
    serde_json::from_slice(body).map_err(|error| Refusal::of(StatusCode::BAD_REQUEST, error.to_string()))
}

/// The script of a scenario in the list.
async fn script(studio: &Arc<Studio>, id: String) -> Result<PathBuf, Refusal> {
    let shared = studio.clone();
    let wanted = id.clone();
    let found = tokio::task::spawn_blocking(move || shared.catalogue.find(&wanted)).await;
    let missing = || Refusal::of(StatusCode::NOT_FOUND, format!("there is no scenario {id} below the studio's folder"));
    found.map_err(|error| Refusal::here(&error))?.ok_or_else(missing)
}

/// Work on files, away from the thread that talks to pages; its text is the answer.
async fn elsewhere(work: impl FnOnce() -> Result<String, Refusal> + Send + 'static) -> Answer {
    let text = tokio::task::spawn_blocking(work).await.map_err(|error| Refusal::here(&error))??;
    Ok(([(header::CONTENT_TYPE, "application/json")], text).into_response())
}
