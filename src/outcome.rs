//! What a run came to, as data: the object that `run --format json` prints.

use choque_engine::{Work, World};
use choque_scripting::{Expectation, Scenario, Target};
use serde::{Deserialize, Serialize, Serializer};

use crate::books::Books;
use crate::readings::Readings;

/// The outcome of a run. The order of the fields is the order in the output.
///
/// Numbers that are not finite (an energy too large for f64) are `null` in JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// The file's stem.
    pub scenario: String,
    /// What the script calls itself, or the file's stem.
    pub title: String,
    /// Length of one iteration \[s\].
    pub time_step: f64,
    /// Iterations made: those asked for, or fewer when `stop_when` ended the run.
    pub steps: u64,
    /// Time at the end \[s\].
    pub time: f64,
    /// Exchanges.
    pub collisions: u64,
    /// Of the mobile bodies \[J\].
    pub kinetic_energy: f64,
    /// Of the mobile bodies, (x, z) \[kg·m/s\].
    pub momentum: [f64; 2],
    /// Of the mobile bodies about the world's origin \[kg·m²/s\].
    pub angular_momentum: f64,
    /// Deepest overlap at the end \[m\].
    pub deepest: f64,
    /// 16 hexadecimal digits over every bit of the final state.
    pub digest: String,
    /// Every body, in order of creation.
    pub bodies: Vec<BodyOutcome>,
    /// What the script expected, and whether it held.
    pub expectations: Vec<Judgement>,
    /// What the script wants, and what that came to; left out when it wants nothing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub targets: Vec<Measured>,
    /// What changed the energy and the momenta, where it was kept account of.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "plainly")]
    pub ledger: Option<Books>,
    /// Counted work.
    pub work: Work,
}

/// Where a body is and how it moves, in metres, seconds, radians, kilograms.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyOutcome {
    /// Its name.
    pub name: String,
    /// `mobile` or `fixed`.
    pub kind: &'static str,
    /// Its centre O.
    pub x: f64,
    /// Its centre O.
    pub z: f64,
    /// In (−π, π].
    pub angle: f64,
    /// Velocity of its centre.
    pub vx: f64,
    /// Velocity of its centre.
    pub vz: f64,
    /// Spin, +X towards +Z.
    pub spin: f64,
    /// Mass.
    pub mass: f64,
}

/// A target as it was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// What the script says.
    pub text: String,
    /// How much it counts.
    pub weight: f64,
    /// What it came to; it should be 0.
    pub residual: f64,
}

/// An expectation as it was judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Judgement {
    /// What the script says.
    pub text: String,
    /// Whether it held.
    pub held: bool,
    /// The first iteration it did not hold in.
    pub first_failure: Option<u64>,
    /// What was read to judge it; left out when it held.
    #[serde(default, skip_serializing_if = "Readings::is_empty")]
    pub numbers: Readings,
}

impl Outcome {
    /// What the world of a scenario looks like at the end of its run.
    #[must_use]
    pub fn new(scenario: &Scenario, world: &World, expectations: Vec<Expectation>) -> Self {
        let [kinetic_energy, momentum_x, momentum_z, angular_momentum] = world.totals().to_array().map(positive_zero);
        Outcome {
            scenario: scenario.name().to_owned(),
            title: scenario.title(),
            time_step: world.plan().time_step,
            steps: world.iteration(),
            time: positive_zero(world.time()),
            collisions: world.collisions(),
            kinetic_energy,
            momentum: [momentum_x, momentum_z],
            angular_momentum,
            deepest: positive_zero(world.deepest()),
            digest: hexadecimal(world.digest()),
            bodies: bodies(world),
            expectations: expectations.into_iter().map(Judgement::from).collect(),
            targets: Vec::new(),
            ledger: world.ledger().map(|ledger| Books::of(&ledger)),
            work: *world.work(),
        }
    }

    /// The same outcome with what the targets came to.
    #[must_use]
    pub fn with_targets(self, targets: Vec<Target>) -> Self {
        Outcome { targets: targets.into_iter().map(Measured::from).collect(), ..self }
    }

    /// A total that is not finite: masses and velocities may each be, and their product not.
    #[must_use]
    pub fn total_beyond_numbers(&self) -> Option<&'static str> {
        let totals = [
            ("kinetic energy", self.kinetic_energy),
            ("momentum along x", self.momentum[0]),
            ("momentum along z", self.momentum[1]),
            ("angular momentum", self.angular_momentum),
        ];
        totals.into_iter().find(|(_, total)| !total.is_finite()).map(|(name, _)| name)
    }

    /// Whether every expectation held.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.expectations.iter().all(|judgement| judgement.held)
    }
}

/// What is there, without a word that it could be missing.
fn plainly<S: Serializer>(books: &Option<Books>, serializer: S) -> Result<S::Ok, S::Error> {
    match books {
        Some(books) => books.serialize(serializer),
        None => serializer.serialize_unit(),
    }
}

fn bodies(world: &World) -> Vec<BodyOutcome> {
    let body = |id| {
        let (position, velocity) = (world.position(id), world.velocity(id));
        BodyOutcome {
            name: world.name(id).to_owned(),
            kind: world.kind(id).word(),
            x: positive_zero(position.x),
            z: positive_zero(position.y),
            angle: positive_zero(world.angle(id)),
            vx: positive_zero(velocity.x),
            vz: positive_zero(velocity.y),
            spin: positive_zero(world.spin(id)),
            mass: world.mass(id),
        }
    };
    world.ids().map(body).collect()
}

impl From<Target> for Measured {
    fn from(Target { text, weight, residual }: Target) -> Self {
        Measured { text, weight, residual: positive_zero(residual) }
    }
}

impl From<Expectation> for Judgement {
    fn from(expectation: Expectation) -> Self {
        let Expectation { text, held, first_failure, numbers } = expectation;
        Judgement { text, held, first_failure, numbers: numbers.into_iter().collect() }
    }
}

/// The number itself, but 0 for −0: nobody needs to read a sign there.
#[must_use]
pub fn positive_zero(number: f64) -> f64 {
    number + 0.0
}

/// A digest as it is written everywhere.
#[must_use]
pub fn hexadecimal(digest: u64) -> String {
    format!("{digest:016x}")
}
