//! A scene: what a script or a `.ron` file says, as plain data.
//!
//! Nothing here is checked or derived; [`Plan::resolve`](crate::Plan::resolve) does both, once.

use serde::{Deserialize, Serialize};

use crate::area::{Extent, Rect};

/// Everything a run needs to know: settings, and bodies in the order of their creation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scene {
    /// Shown in output. Empty: the file's name is shown instead.
    pub title: String,
    /// What holds for the whole scene.
    pub settings: Settings,
    /// The tunable numbers a script declared with `param`, for the record; the engine reads none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub params: Vec<Param>,
    /// The bodies, in order of creation: every tie in the engine is broken by this order.
    pub bodies: Vec<Body>,
}

/// A tunable number and the value it had.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Param {
    /// Its name in `--set NAME=VALUE`.
    pub name: String,
    /// The value used.
    pub value: f64,
    /// Smallest and largest value a designer wants tried, where the script gives them.
    pub range: Option<(f64, f64)>,
}

/// What holds for the whole scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Length of one iteration \[s\], > 0.
    pub time_step: f64,
    /// How many iterations a run makes.
    pub steps: u64,
    /// μ_L, the share of linear momentum that an exchange hands over (§2.5), ≥ 0.
    pub mu_l: f64,
    /// μ_A, the share of angular momentum that an exchange hands over (§2.5), ≥ 0.
    pub mu_a: f64,
    /// ε, the gap a relocation leaves (§2.4) \[m\], ≥ 0.
    pub epsilon: f64,
    /// Height Y of the collision plane (§2.1) \[m\].
    pub plane: f64,
    /// How motion is handed over at a collision.
    pub exchange: ExchangeRule,
    /// How overlaps are found; `None` takes the exchange's own: vertices with document, complete with impulse.
    pub detection: Option<Detection>,
    /// When collisions are treated.
    pub motion: MotionRule,
    /// Coefficient of restitution of the impulse exchange, 0 … 1.
    pub restitution: f64,
    /// Coefficient of friction of the impulse exchange, ≥ 0.
    pub friction: f64,
    /// Acceleration of every mobile body, (x, z) \[m/s²\].
    pub gravity: (f64, f64),
    /// Decay rates of mobile bodies' motion, (linear, angular) \[1/s\], ≥ 0.
    pub drag: (f64, f64),
    // These two are written only where they are said: a scene without them keeps its text, and so its digest in snapshots.
    /// Equal parts in which stepped motion with the impulse exchange solves contacts, 1 … 1000; `None` lets the plan pick.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub substeps: Option<u32>,
    /// Whether stepped motion with the impulse exchange puts bodies at rest to sleep.
    #[serde(skip_serializing_if = "is_default")]
    pub sleeping: bool,
    /// How the pairs worth testing are found; the result never depends on it.
    pub broad_phase: BroadPhaseChoice,
    /// Seed of the script's generator, for the record; the engine draws no random numbers.
    pub seed: i64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            time_step: 1.0 / 60.0,
            steps: 600,
            mu_l: 1.0,
            mu_a: 1.0,
            epsilon: 0.001,
            plane: 0.0,
            exchange: ExchangeRule::Document,
            detection: None,
            motion: MotionRule::Stepped,
            restitution: 0.0,
            friction: 0.0,
            gravity: (0.0, 0.0),
            drag: (0.0, 0.0),
            substeps: None,
            sleeping: false,
            broad_phase: BroadPhaseChoice::Auto,
            seed: 0,
        }
    }
}

impl Settings {
    /// The detection that holds: the one that is asked for, or else the one that goes with the exchange.
    #[must_use]
    pub fn detection_that_holds(&self) -> Detection {
        self.detection.unwrap_or(match self.exchange {
            ExchangeRule::Document => Detection::Vertices,
            ExchangeRule::Impulse => Detection::Complete,
        })
    }

    /// Whether contacts last and are solved together, in sub-steps: where bodies move in steps, hand impulses over, and every
    /// overlap is seen. An iteration then advances, finds and solves in one. With vertices alone impulses act pair by pair, when
    /// an overlap is found.
    #[must_use]
    pub fn solves_contacts(&self) -> bool {
        self.motion == MotionRule::Stepped
            && self.exchange == ExchangeRule::Impulse
            && self.detection_that_holds() == Detection::Complete
    }
}

/// Makes an enum of a setting's choices with the words that scripts, flags and output use for them.
macro_rules! choices {
    ($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $variant:ident = $word:literal,)+ }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum $name { $($(#[$doc])* $variant,)+ }

        impl $name {
            /// Every choice's word, in order.
            pub const WORDS: &'static [&'static str] = &[$($word),+];

            /// The word scripts, flags and output use.
            #[must_use]
            pub fn word(self) -> &'static str {
                match self { $($name::$variant => $word),+ }
            }

            /// The choice a word names, if it names one.
            #[must_use]
            pub fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some($name::$variant),)+ _ => None }
            }
        }
    };
}

choices! {
    /// How motion is handed over at a collision.
    ExchangeRule {
        /// The document's rules (§2.5).
        #[default]
        Document = "document",
        /// Newton–Euler impulses with restitution and friction.
        Impulse = "impulse",
    }
}

choices! {
    /// How overlaps are found.
    Detection {
        /// A vertex of one inside the other (§2.3).
        #[default]
        Vertices = "vertices",
        /// Separating axes: every overlap.
        Complete = "complete",
    }
}

choices! {
    /// When collisions are treated.
    MotionRule {
        /// Overlaps are looked for after each step (§2.1).
        #[default]
        Stepped = "stepped",
        /// Bodies stop at the moment of impact.
        Continuous = "continuous",
    }
}

choices! {
    /// How the pairs worth testing are found.
    BroadPhaseChoice {
        /// The plan picks by the number of bodies.
        #[default]
        Auto = "auto",
        /// Every pair, as the document writes it: the specification the other is held to.
        AllPairs = "all_pairs",
        /// A sweep in strips: nearly linear in the number of bodies.
        Strips = "strips",
    }
}

/// One body: what it is made of, where it stands and how it moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Unique in its scene.
    pub name: String,
    /// Mobile or fixed.
    pub kind: Kind,
    /// One part per rectangle; several make a compound body.
    pub parts: Vec<Part>,
    /// Where the mesh's own zero stands over the ground \[m\] (reading R2).
    #[serde(default, skip_serializing_if = "is_default")]
    pub height: f64,
    /// Scale along x, y and z, applied when the area is computed (reading R1), each > 0.
    #[serde(default = "unit_scale", skip_serializing_if = "is_unit_scale")]
    pub scale: (f64, f64, f64),
    /// Its centre O in the world, (x, z) \[m\].
    #[serde(default)]
    pub at: (f64, f64),
    /// Its angle, +X towards +Z \[rad\].
    #[serde(default, skip_serializing_if = "is_default")]
    pub angle: f64,
    /// Velocity (x, z) \[m/s\], if one was given; on a fixed body that makes it one with physics (R9).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<(f64, f64)>,
    /// Spin \[rad/s\], if one was given; on a fixed body that makes it one with physics (R9).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spin: Option<f64>,
    /// Fixed bodies only: a round trip at uniform speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub patrol: Option<Patrol>,
    /// Fixed bodies only: a swing to and fro at uniform speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub swing: Option<Swing>,
    /// Mass \[kg\], > 0; 1 when not given. No one asks a fixed body's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Moment of inertia about O \[kg·m²\], > 0; that of the uniform rectangles when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<f64>,
    /// Overrides the scene's restitution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Overrides the scene's friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Free labels.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
}

impl Body {
    /// A body of that name and kind at the world's origin, with no part yet and nothing else said.
    #[must_use]
    pub fn new(name: impl Into<String>, kind: Kind) -> Self {
        Body {
            name: name.into(),
            kind,
            parts: Vec::new(),
            height: 0.0,
            scale: unit_scale(),
            at: (0.0, 0.0),
            angle: 0.0,
            velocity: None,
            spin: None,
            patrol: None,
            swing: None,
            mass: None,
            inertia: None,
            restitution: None,
            friction: None,
            tags: Vec::new(),
        }
    }
}

fn unit_scale() -> (f64, f64, f64) {
    (1.0, 1.0, 1.0)
}

fn is_unit_scale(scale: &(f64, f64, f64)) -> bool {
    *scale == unit_scale()
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

choices! {
    /// Whether collisions may move a body (§2.1).
    Kind {
        /// Can be moved and have its motion changed: a vehicle.
        #[default]
        Mobile = "mobile",
        /// Never: a building. It may still carry a prescribed motion: a blade, a travelling wall.
        Fixed = "fixed",
    }
}

/// What one rectangle of a body comes from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// A rectangle given as such; it always lies in the collision plane.
    Rect(Rect),
    /// A 3D mesh, of which the area (§2.2) needs only the extent; it counts where it crosses the plane.
    Mesh(Extent),
}

/// A round trip: from where the body stands through the points and back, again and again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Patrol {
    /// The points after the start, (x, z) \[m\]; the trip closes back to the start.
    pub points: Vec<(f64, f64)>,
    /// Uniform speed \[m/s\], > 0.
    pub speed: f64,
}

/// A triangle wave about the starting angle: 0 → +angle → −angle → 0 in one period, at uniform speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Swing {
    /// Amplitude \[rad\]; negative swings the other way first.
    pub angle: f64,
    /// Time of a whole to and fro \[s\], > 0.
    pub period: f64,
}
