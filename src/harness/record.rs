//! Plays a scenario and writes down what a snapshot of it holds.

use choque_engine::{BodyId, Hit, Scene, World};
use choque_scripting::{Expectation, Options, Scenario};

use super::discover::Case;
use super::snapshot::{BodyRow, Checkpoint, ExtremeRow, MeetingRow, Snapshot, Totals, rounded, significant};
use crate::Error;
use crate::notable::{Extreme, Notable, notable};
use crate::outcome::{Judgement, hexadecimal};
use crate::output::ron;
use crate::play::{FirstMeetings, Meeting, Watch, play};

/// How many pairs that met are written down: enough to see how a scene begins.
const MEETINGS: usize = 8;
/// How many checkpoints after the start: a difference is placed to an eighth of the run.
const CHECKPOINTS: u64 = 8;

/// Plays a scenario as its script has it and gives its snapshot.
///
/// # Errors
/// A script that cannot be loaded or run; a body that left the finite numbers.
pub fn record(case: &Case) -> Result<Snapshot, Error> {
    let scenario = Scenario::load(&case.script, &Options::default())?;
    let mut run = scenario.start()?;
    let mut recorder = Recorder::new(&run.world());
    let expectations = play(&mut run, &mut recorder)?;
    snapshot(case, &scenario, &run.world(), recorder, expectations)
}

fn snapshot(
    case: &Case,
    scenario: &Scenario,
    world: &World,
    recorder: Recorder,
    expectations: Vec<Expectation>,
) -> Result<Snapshot, Error> {
    let Notable { bodies, extremes, untold } = notable(scenario.scene(), world);
    let plan = world.plan();
    let mut lines = plan.modelled();
    lines.push(format!("left out: {}", plan.left_out().join(", ")));
    let extreme = |e: Extreme| ExtremeRow {
        what: e.what.to_owned(),
        body: world.name(e.body).to_owned(),
        value: rounded(e.value),
    };
    Ok(Snapshot {
        scenario: case.path.join("/"),
        title: scenario.title(),
        plan: lines,
        scene: scene_digest(scenario.scene())?,
        time_step: plan.time_step,
        steps: world.iteration(),
        bodies: bodies.into_iter().map(|id| row(world, id)).collect(),
        untold,
        extremes: extremes.into_iter().map(extreme).collect(),
        totals: totals(world),
        first_met: recorder.meetings.meetings.iter().map(|meeting| meeting_row(world, meeting)).collect(),
        expectations: expectations.into_iter().map(Judgement::from).collect(),
        work: *world.work(),
        digest: hexadecimal(world.digest()),
        checkpoints: recorder.checkpoints,
    })
}

fn row(world: &World, id: BodyId) -> BodyRow {
    let (position, velocity) = (world.position(id), world.velocity(id));
    BodyRow {
        name: world.name(id).to_owned(),
        x: rounded(position.x),
        z: rounded(position.y),
        angle: rounded(world.angle(id)),
        vx: rounded(velocity.x),
        vz: rounded(velocity.y),
        spin: rounded(world.spin(id)),
    }
}

fn totals(world: &World) -> Totals {
    let momentum = world.momentum();
    Totals {
        time: significant(world.time()),
        collisions: world.collisions(),
        kinetic_energy: significant(world.kinetic_energy()),
        momentum: (significant(momentum.x), significant(momentum.y)),
        angular_momentum: significant(world.angular_momentum()),
        deepest: rounded(world.deepest()),
    }
}

fn meeting_row(world: &World, Meeting { first, times }: &Meeting) -> MeetingRow {
    MeetingRow {
        a: world.name(first.a).to_owned(),
        b: world.name(first.b).to_owned(),
        iteration: first.iteration,
        x: rounded(first.point.x),
        z: rounded(first.point.y),
        depth: rounded(first.depth),
        times: *times,
    }
}

/// FNV-1a over the scene's text without its title.
fn scene_digest(scene: &Scene) -> Result<String, Error> {
    let untitled = Scene { title: String::new(), ..scene.clone() };
    let text = ron::scene(&untitled)?;
    let digest = text.bytes().fold(0xcbf2_9ce4_8422_2325, |digest: u64, byte| {
        (digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    Ok(hexadecimal(digest))
}

/// Writes down who met first and the checkpoints as the run goes.
struct Recorder {
    meetings: FirstMeetings,
    checkpoints: Vec<Checkpoint>,
    due: Vec<u64>,
}

impl Recorder {
    fn new(start: &World) -> Self {
        let steps = u128::from(start.plan().steps);
        let due = (1..=CHECKPOINTS).map(|k| (steps * u128::from(k) / u128::from(CHECKPOINTS)) as u64);
        Recorder { meetings: FirstMeetings::new(MEETINGS), checkpoints: vec![checkpoint(start)], due: due.collect() }
    }
}

impl Watch for Recorder {
    fn iteration(&mut self, world: &World, hits: &[Hit]) {
        self.meetings.iteration(world, hits);
        if self.due.contains(&world.iteration()) {
            self.checkpoints.push(checkpoint(world));
        }
    }
}

fn checkpoint(world: &World) -> Checkpoint {
    Checkpoint {
        iteration: world.iteration(),
        collisions: world.collisions(),
        kinetic_energy: significant(world.kinetic_energy()),
        digest: hexadecimal(world.digest()),
    }
}
