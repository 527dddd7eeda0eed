//! How far a run is from a recording: bodies compared pose by pose, in shares of their own size.

use choque_engine::scene::{Kind, Scene};
use choque_engine::{BodyId, World};

use crate::Error;
use crate::recording::Recording;
use crate::report::poses::half_diagonals;

/// A frame falls on an iteration when it is no further from it than that share of the time step.
const ON_TIME: f64 = 1e-6;

/// What a recording says of the mobile bodies that a scenario shares with it.
#[derive(Clone, Debug)]
pub struct Recorded {
    moments: Vec<Moment>,
    bodies: Vec<Body>,
}

/// A frame that falls on an iteration of the run.
#[derive(Clone, Debug)]
struct Moment {
    iteration: u64,
    /// Of each body: x, z \[m\], angle.
    poses: Vec<[f64; 3]>,
}

#[derive(Clone, Debug)]
struct Body {
    /// In the scenario's order of creation.
    index: usize,
    /// Half its diagonal \[m\].
    size: f64,
}

impl Recorded {
    /// What can be compared with runs of a scene.
    ///
    /// # Errors
    /// A recording without a body of the scene, or without a frame after the start that falls on one of its iterations.
    pub fn new(recording: &Recording, scene: &Scene) -> Result<Self, Error> {
        let sizes = half_diagonals(scene);
        let known = |name: &str| recording.bodies.iter().position(|body| body.name == name);
        let mobile = scene.bodies.iter().enumerate().filter(|(_, body)| body.kind == Kind::Mobile);
        let (bodies, places): (Vec<Body>, Vec<usize>) = mobile
            .filter_map(|(index, body)| known(&body.name).map(|place| (Body { index, size: sizes[index] }, place)))
            .unzip();
        let refuse = |message: &str, hint: &str| Error::Call { message: message.to_owned(), hint: hint.to_owned() };
        if bodies.is_empty() {
            return Err(refuse(
                "the recording has none of the scenario's mobile bodies",
                "bodies are found by their names: is it a recording of this scenario?",
            ));
        }
        let time_step = scene.settings.time_step;
        let moment = |frame: &crate::recording::Frame| {
            let iteration = (frame.time / time_step).round();
            let is_on_time = (frame.time - iteration * time_step).abs() <= ON_TIME * time_step;
            let is_reached = iteration <= scene.settings.steps as f64;
            let pose = |place: &usize| frame.states.get(*place).map(|state| [state.x, state.z, state.angle]);
            let poses = places.iter().map(pose).collect::<Option<Vec<_>>>()?;
            (is_on_time && is_reached).then_some(Moment { iteration: iteration as u64, poses })
        };
        let moments: Vec<Moment> = recording.frames.iter().filter_map(moment).collect();
        if moments.last().is_none_or(|last| last.iteration == 0) {
            return Err(refuse(
                "no frame of the recording after its start falls on an iteration of the run",
                "give the run the time step and the length of the recording: --time-step, --steps",
            ));
        }
        Ok(Recorded { moments, bodies })
    }

    /// How many frames are compared.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.moments.len()
    }

    /// How many bodies are compared.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.bodies.len()
    }

    /// The iteration that a frame falls on.
    #[must_use]
    pub fn iteration(&self, frame: usize) -> u64 {
        self.moments[frame].iteration
    }

    /// Appends how far every body is from where it is in a frame: x and z in half diagonals, the angle in radians, each divided
    /// so that over all frames and bodies their squares add up to the mean square.
    pub fn compare(&self, frame: usize, world: &World, residuals: &mut Vec<f64>) {
        let ids: Vec<BodyId> = world.ids().collect();
        let share = 1.0 / ((self.frames() * self.bodies()) as f64).sqrt();
        for (body, [x, z, angle]) in self.bodies.iter().zip(&self.moments[frame].poses) {
            let (id, per_size) = (ids[body.index], share / body.size);
            let place = world.position(id);
            residuals.extend([
                (place.x - x) * per_size,
                (place.y - z) * per_size,
                share * turn(world.angle(id) - angle),
            ]);
        }
    }
}

/// The same turn, by half a turn at most.
fn turn(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}
