//! The plan: what a scene needs, decided once at load; what it does not need does not run.

mod contact;

use core::fmt;

use crate::area::Vec2;
use crate::census::Census;
use crate::check::{self, BadNumber};
use crate::error::SceneError;
use crate::exchange::document::Losses;
use crate::forces::Flight;
use crate::load;
use crate::scene::{BroadPhaseChoice, Detection, ExchangeRule, Kind, MotionRule, Scene, Settings};

pub use contact::ContactPlan;

/// What is modelled, and how. `Display` prints it for people; snapshots begin with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Length of one iteration \[s\].
    pub time_step: f64,
    /// Iterations of a run.
    pub steps: u64,
    /// How overlaps are found.
    pub detection: Detection,
    /// When collisions are treated.
    pub motion: MotionPlan,
    /// How motion is handed over.
    pub exchange: ExchangePlan,
    /// How contacts are solved, in stepped motion with the impulse exchange and complete detection.
    pub contact: Option<ContactPlan>,
    /// How bodies fly between collisions.
    pub flight: FlightPlan,
    /// How pairs worth testing are found.
    pub broad_phase: BroadPhasePlan,
    /// What the bodies are.
    pub census: Census,
    /// Where the world's coordinates have their own zero: a round number near the scene when it lies far
    /// out, (0, 0) for every other scene. All stages compute from there, so distance costs no accuracy.
    pub origin: Vec2,
}

/// How motion is handed over, with the coefficients it needs and no others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExchangePlan {
    /// Relocation (§2.4), then the document's rules (§2.5).
    Document {
        /// ε of the relocation \[m\].
        epsilon: f64,
        /// μ_L and μ_A.
        losses: Losses,
    },
    /// Newton–Euler impulses; nothing is relocated. Each body has its own restitution and friction.
    Impulse,
}

/// When collisions are treated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionPlan {
    /// After each step, where bodies overlap.
    Stepped,
    /// At the moment of impact.
    Continuous {
        /// Size of a middling body \[m\], where a scene has so many pairs that iterations are cut to segments in which a
        /// body moves about half of it; `None` where all pairs are foreseen at once.
        middling: Option<f64>,
    },
}

/// How mobile bodies fly between collisions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FlightPlan {
    /// Uniformly: `O += v·dt`, `θ += ω·dt`.
    Free,
    /// Under gravity or drag, solved exactly.
    Forced {
        /// Acceleration of every mobile body \[m/s²\].
        gravity: Vec2,
        /// Coefficients of the linear decay.
        linear: Flight,
        /// Coefficients of the angular decay.
        angular: Flight,
        /// Decay rates of velocity and of spin, which both come from \[1/s\].
        drag: (f64, f64),
    },
}

/// How the pairs worth testing are found; both ways find the same collisions in the same order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BroadPhasePlan {
    /// No pair can collide: nothing is looked for.
    Nothing,
    /// Every pair (§2.3).
    AllPairs,
    /// A sweep in strips of that depth \[m\].
    Strips {
        /// Depth of a strip along Z.
        depth: f64,
    },
}

/// Up to this many pairs testing them all is cheaper than sorting anything (measured: `cargo bench --bench
/// speed -- crossover`; three boxes between four walls are even). The result is the same either way.
const ALL_PAIRS_UP_TO: usize = 15;

impl Plan {
    /// Checks the whole scene and decides what it needs.
    ///
    /// # Errors
    /// The first thing wrong with the scene, naming the body and the value.
    pub fn resolve(scene: &Scene) -> Result<Plan, SceneError> {
        let settings = &scene.settings;
        check_settings(settings).map_err(SceneError::Setting)?;
        load::check_bodies(scene)?;
        let census = Census::of(scene);
        Ok(Plan {
            time_step: settings.time_step,
            steps: settings.steps,
            detection: settings.detection_that_holds(),
            motion: MotionPlan::resolve(scene, &census),
            exchange: match settings.exchange {
                ExchangeRule::Document => ExchangePlan::Document {
                    epsilon: settings.epsilon,
                    losses: Losses { mu_l: settings.mu_l, mu_a: settings.mu_a },
                },
                ExchangeRule::Impulse => ExchangePlan::Impulse,
            },
            contact: ContactPlan::resolve(scene, &census),
            flight: FlightPlan::resolve(settings, scene),
            broad_phase: BroadPhasePlan::resolve(scene, &census),
            census,
            origin: load::origin(scene),
        })
    }
}

fn check_settings(settings: &Settings) -> Result<(), BadNumber> {
    check::positive("time_step", settings.time_step)?;
    check::not_negative("mu_l", settings.mu_l)?;
    check::not_negative("mu_a", settings.mu_a)?;
    check::not_negative("epsilon", settings.epsilon)?;
    check::finite("plane", settings.plane)?;
    check::unit_range("restitution", settings.restitution)?;
    check::not_negative("friction", settings.friction)?;
    settings.substeps.map(|count| check::substeps("substeps", count.into())).transpose()?;
    check::finite("gravity: x", settings.gravity.0)?;
    check::finite("gravity: z", settings.gravity.1)?;
    check::not_negative("drag: linear", settings.drag.0)?;
    check::not_negative("drag: angular", settings.drag.1)?;
    Ok(())
}

impl Plan {
    /// The acceleration of every mobile body \[m/s²\].
    #[must_use]
    pub fn gravity(&self) -> Vec2 {
        self.flight.forces().0
    }
}

impl FlightPlan {
    /// The acceleration of every mobile body \[m/s²\], and the decay rates of velocity and of spin \[1/s\].
    #[must_use]
    pub fn forces(&self) -> (Vec2, (f64, f64)) {
        match *self {
            FlightPlan::Free => (Vec2::zeros(), (0.0, 0.0)),
            FlightPlan::Forced { gravity, drag, .. } => (gravity, drag),
        }
    }

    fn resolve(settings: &Settings, scene: &Scene) -> Self {
        let forced = settings.gravity != (0.0, 0.0) || settings.drag != (0.0, 0.0);
        if !forced || !scene.bodies.iter().any(|body| body.kind == Kind::Mobile) {
            return FlightPlan::Free;
        }
        FlightPlan::Forced {
            gravity: Vec2::new(settings.gravity.0, settings.gravity.1),
            linear: Flight::new(settings.drag.0, settings.time_step),
            angular: Flight::new(settings.drag.1, settings.time_step),
            drag: settings.drag,
        }
    }
}

impl MotionPlan {
    /// Whether iterations are cut depends on the pairs alone, never on how they are found: so that the way of finding
    /// them changes no bit.
    fn resolve(scene: &Scene, census: &Census) -> Self {
        match scene.settings.motion {
            MotionRule::Stepped => MotionPlan::Stepped,
            MotionRule::Continuous => {
                let many = census.pairs() > ALL_PAIRS_UP_TO;
                MotionPlan::Continuous { middling: many.then(|| load::strip_depth(scene)) }
            }
        }
    }
}

impl BroadPhasePlan {
    fn resolve(scene: &Scene, census: &Census) -> Self {
        let pairs = census.pairs();
        match scene.settings.broad_phase {
            _ if pairs == 0 => BroadPhasePlan::Nothing,
            BroadPhaseChoice::AllPairs => BroadPhasePlan::AllPairs,
            BroadPhaseChoice::Auto if pairs <= ALL_PAIRS_UP_TO => BroadPhasePlan::AllPairs,
            BroadPhaseChoice::Auto | BroadPhaseChoice::Strips => {
                BroadPhasePlan::Strips { depth: load::strip_depth(scene) }
            }
        }
    }
}

impl fmt::Display for Plan {
    /// What is modelled, a line each, and what is left out in one.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for line in self.modelled() {
            writeln!(f, "{line}")?;
        }
        write!(f, "left out: {}", self.left_out().join(", "))
    }
}

impl Plan {
    /// What is modelled, a line each.
    #[must_use]
    pub fn modelled(&self) -> Vec<String> {
        let census = &self.census;
        let mut lines = vec![
            format!("bodies: {census}"),
            format!("advance: {}", self.flight),
            format!("pairs: {}", self.broad_phase),
        ];
        if census.prescribed > 0 {
            lines.insert(2, format!("prescribed: {} patrol or swing, from the time", census.prescribed));
        }
        if self.broad_phase != BroadPhasePlan::Nothing {
            lines.push(match (self.motion, self.detection) {
                (MotionPlan::Stepped, Detection::Vertices) => "detect: vertex in rectangle (§2.3)".to_owned(),
                (MotionPlan::Stepped, Detection::Complete) => "detect: separating axes".to_owned(),
                (MotionPlan::Continuous { .. }, Detection::Vertices) => {
                    "detect: the moment of impact, at its first vertex (§2.3)".to_owned()
                }
                (MotionPlan::Continuous { .. }, Detection::Complete) => {
                    "detect: the moment of impact, at its one or two points".to_owned()
                }
            });
            lines.extend(self.exchange_lines());
        }
        if self.origin != Vec2::zeros() {
            lines.push(format!("origin: ({}, {}), for accuracy far out", self.origin.x, self.origin.y));
        }
        lines
    }

    fn exchange_lines(&self) -> Vec<String> {
        match self.exchange {
            ExchangePlan::Document { epsilon, losses: Losses { mu_l, mu_a } } => {
                let cases = self.census.exchange_cases().join(", ");
                vec![
                    match self.motion {
                        MotionPlan::Stepped => format!("relocate: least distance + ε = {epsilon} m (§2.4)"),
                        MotionPlan::Continuous { .. } => format!("relocate: ε = {epsilon} m, at the moment of impact"),
                    },
                    format!("exchange: document, μ_L = {mu_l}, μ_A = {mu_a}: {cases}"),
                ]
            }
            ExchangePlan::Impulse => match self.contact {
                None => vec!["exchange: impulse, restitution and friction of each pair".to_owned()],
                Some(contact) => {
                    vec![format!("exchange: impulse{}", contact.of_pairs()), format!("contacts: {contact}")]
                }
            },
        }
    }

    /// What this scene does not need, and therefore does not pay for.
    #[must_use]
    pub fn left_out(&self) -> Vec<&'static str> {
        let Plan { census, flight, .. } = self;
        let (gravity, linear, angular) = match *flight {
            FlightPlan::Free => (false, false, false),
            FlightPlan::Forced { gravity, linear, angular, .. } => {
                (gravity != Vec2::zeros(), linear.keep != 1.0, angular.keep != 1.0)
            }
        };
        let nothing = self.broad_phase == BroadPhasePlan::Nothing;
        let document = !nothing && self.exchange != ExchangePlan::Impulse;
        let pair_by_pair = !nothing && self.motion == MotionPlan::Stepped && self.contact.is_none();
        let contacts_lack = |of: fn(&ContactPlan) -> bool| self.contact.as_ref().is_some_and(|contact| !of(contact));
        [
            (!gravity, "gravity"),
            (!linear && !angular, "drag"),
            (census.prescribed == 0, "prescribed motion"),
            (census.compound == 0, "compound bodies"),
            (nothing, "detection, relocation and exchange"),
            (!nothing && !document, "relocation"),
            (document && census.mobile < 2, "exchange §2.5.1"),
            (document && census.fixed_with_physics == 0, "exchange §2.5.2"),
            (document && census.fixed == 0, "exchange §2.5.3"),
            (document || pair_by_pair, "lasting contact"),
            (contacts_lack(|contact| contact.restitution), "restitution"),
            (contacts_lack(|contact| contact.friction), "friction"),
            (contacts_lack(|contact| contact.sleeping), "sleeping"),
        ]
        .into_iter()
        .filter_map(|(absent, what)| absent.then_some(what))
        .collect()
    }
}

impl fmt::Display for FlightPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let FlightPlan::Forced { gravity, linear, angular, .. } = self else {
            return write!(f, "uniform between collisions (§2.1)");
        };
        let mut terms = Vec::new();
        if *gravity != Vec2::zeros() {
            terms.push(format!("gravity ({}, {}) m/s²", gravity.x, gravity.y));
        }
        if linear.keep != 1.0 || angular.keep != 1.0 {
            terms.push(format!("drag keeping {} of v and {} of ω a step", linear.keep, angular.keep));
        }
        write!(f, "{}, solved exactly", terms.join(" and "))
    }
}

impl fmt::Display for BroadPhasePlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BroadPhasePlan::Nothing => write!(f, "none can collide"),
            BroadPhasePlan::AllPairs => write!(f, "all tested (§2.3)"),
            BroadPhasePlan::Strips { depth } => write!(f, "swept in strips {depth} m deep"),
        }
    }
}
