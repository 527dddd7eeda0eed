//! What made a run, what it is made of, and what it came to: small, so kept as text.

use choque_engine::area::Rect;
use choque_engine::ledger::{Amounts, Cause};
use choque_engine::scene::{Kind, Param, Scene, Settings};
use choque_engine::{World, load};
use choque_scripting::{Options, Scenario};
use serde::{Deserialize, Serialize};

use super::frame::State;
use crate::outcome::Judgement;

/// What made a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct About {
    /// choque's version.
    pub choque: String,
    /// How choque was built.
    pub build: Build,
    /// The file's stem.
    pub scenario: String,
    /// What the script calls itself, or the file's stem.
    pub title: String,
    /// The call that made it, word by word; empty when it was no call.
    pub command: Vec<String>,
    /// The script or scene first, then all that it imported, and the models it read.
    pub sources: Vec<Source>,
    /// What was said from outside.
    pub given: Given,
    /// The tunable numbers and the values they had.
    pub params: Vec<Param>,
    /// μ_L, μ_A, ε and the other settings as they held.
    pub settings: Settings,
    /// What was modelled, a line each, and what was left out.
    pub plan: Vec<String>,
    /// Length of one iteration \[s\].
    pub time_step: f64,
    /// Iterations that were asked for.
    pub steps: u64,
    /// Iterations from one frame to the next.
    pub every: u64,
    /// Whether bodies tell of restitution and friction of their own; the first recordings do not.
    pub surfaces: bool,
    /// The causes of its ledger, and what the mobile bodies had at the start, by [`Amounts::NAMES`]; without causes no
    /// ledger was kept.
    pub causes: Vec<String>,
    /// See `causes`.
    pub initial: [f64; Amounts::COUNT],
}

/// How choque was built: what a difference between two builds may come from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Build {
    /// The compiler and its version.
    pub rustc: String,
    /// The platform.
    pub target: String,
    /// The processor it was built for.
    pub cpu: String,
    /// The level of optimisation.
    pub optimisation: String,
}

/// A text that the run was made from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Source {
    /// As errors show it.
    pub name: String,
    /// All of it.
    pub text: String,
}

/// What was said from outside; what was not said is empty.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Given {
    /// `--set NAME=VALUE`.
    pub set: Vec<(String, f64)>,
    /// `--steps`.
    pub steps: Option<u64>,
    /// `--time-step` \[s\].
    pub time_step: Option<f64>,
    /// `--substeps`.
    pub substeps: Option<u32>,
    /// `--exchange`, its word.
    pub exchange: Option<String>,
    /// `--detection`, its word.
    pub detection: Option<String>,
    /// `--motion`, its word.
    pub motion: Option<String>,
    /// `--broad-phase`, its word.
    pub broad_phase: Option<String>,
}

/// A body as it is all through the run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Mobile or fixed.
    pub kind: Kind,
    /// \[kg\].
    pub mass: f64,
    /// About O \[kg·m²\].
    pub inertia: f64,
    /// Free labels.
    #[serde(default)]
    pub tags: Vec<String>,
    /// In the body's own frame; none of a body that does not cross the collision plane.
    pub rects: Vec<Rect>,
    /// Its own restitution, where the scene's is overridden.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Its own friction, where the scene's is overridden.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
}

/// How a run ended.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Ending {
    /// Iterations made.
    pub steps: u64,
    /// Exchanges in all.
    pub collisions: u64,
    /// What the script expected, and whether it held.
    pub expectations: Vec<Judgement>,
}

impl About {
    pub(super) fn of(scenario: &Scenario, world: &World, command: Vec<String>, every: u64) -> Self {
        let plan = world.plan();
        let mut lines = plan.modelled();
        lines.push(format!("left out: {}", plan.left_out().join(", ")));
        let ledger = world.ledger();
        let Scene { settings, params, .. } = scenario.scene();
        About {
            choque: env!("CARGO_PKG_VERSION").to_owned(),
            build: Build::this(),
            scenario: scenario.name().to_owned(),
            title: scenario.title(),
            command,
            sources: scenario.sources().into_iter().map(|(name, text)| Source { name, text }).collect(),
            given: Given::of(scenario.options()),
            params: params.clone(),
            settings: settings.clone(),
            plan: lines,
            time_step: plan.time_step,
            steps: plan.steps,
            every,
            surfaces: true,
            causes: ledger.as_ref().map(|_| Cause::WORDS.map(str::to_owned).to_vec()).unwrap_or_default(),
            initial: ledger.map(|ledger| ledger.initial().to_array()).unwrap_or_default(),
        }
    }
}

/// The call that this process was started with, word by word.
#[must_use]
pub fn this_call() -> Vec<String> {
    std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect()
}

impl Build {
    /// How this program was built.
    #[must_use]
    pub fn this() -> Self {
        Build {
            rustc: env!("CHOQUE_RUSTC").to_owned(),
            target: env!("CHOQUE_TARGET").to_owned(),
            cpu: env!("CHOQUE_TARGET_CPU").to_owned(),
            optimisation: env!("CHOQUE_OPT_LEVEL").to_owned(),
        }
    }
}

impl Given {
    fn of(options: &Options) -> Self {
        let given = &options.overrides;
        Given {
            set: options.set.clone(),
            steps: given.steps,
            time_step: given.time_step,
            substeps: given.substeps,
            exchange: given.exchange.map(|rule| rule.word().to_owned()),
            detection: given.detection.map(|rule| rule.word().to_owned()),
            motion: given.motion.map(|rule| rule.word().to_owned()),
            broad_phase: given.broad_phase.map(|way| way.word().to_owned()),
        }
    }
}

impl Body {
    pub(super) fn all(scene: &Scene, world: &World) -> Vec<Body> {
        let body = |(id, body): (choque_engine::BodyId, &choque_engine::scene::Body)| Body {
            name: body.name.clone(),
            kind: world.kind(id),
            mass: world.mass(id),
            inertia: world.inertia(id),
            tags: body.tags.clone(),
            rects: load::areas(body, scene.settings.plane).collect(),
            restitution: body.restitution,
            friction: body.friction,
        };
        world.ids().zip(&scene.bodies).map(body).collect()
    }

    /// The corners of its rectangles in the world, when it is there \[m\].
    #[must_use]
    pub fn corners(&self, state: &State) -> Vec<[[f64; 2]; 4]> {
        let (sin, cos) = libm::sincos(state.angle);
        let place = |x: f64, z: f64| [state.x + cos * x - sin * z, state.z + sin * x + cos * z];
        self.rects.iter().map(|rect| rect.vertices().map(|v| place(v.x, v.y))).collect()
    }
}
