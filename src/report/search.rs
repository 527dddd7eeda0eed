//! The search for references that have earned their name.

use choque_engine::scene::{Detection, MotionRule};

use super::course::{self, Apart, Course, Plan};
use super::horizon::Growth;
use super::jobs::share;
use super::method::Method;
use super::poses::Shapes;
use super::recipe::{Recipe, Start};
use super::reference::{self, Reference};
use super::study::Referred;
use super::survey::Runs;

/// The ways of finding collisions that were tried.
pub(super) fn both(all: &[Runs]) -> Vec<Detection> {
    let is_tried = |detection: &Detection| all.iter().any(|runs| runs.method.detection == *detection);
    [Detection::Vertices, Detection::Complete].into_iter().filter(is_tried).collect()
}

pub(super) type References = Vec<(Detection, Option<Reference>)>;

/// Who looks for references, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search<'a> {
    pub(super) recipe: &'a Recipe,
    /// How differences grow, and with them rounding.
    pub(super) growth: Option<Growth>,
    /// Whether bodies exchange impulses.
    pub(super) is_impulse: bool,
    pub(super) threads: usize,
}

/// Rungs beyond the ladder that a sequence may take to show that it converges.
const BEYOND: usize = 2;

impl Search<'_> {
    /// A reference for each way of finding collisions. Impulses have one law, which only complete detection gives both points of a
    /// flat hit: its limit is the reference of both. The document's rules treat one vertex with the one and the middle
    /// with the other: two models, each with a limit of its own. `grown` is how many times a difference has grown by the last
    /// moment compared.
    pub(super) fn all(&self, plan: &Plan<'_>, all: &[Runs], grown: f64) -> References {
        let tried = both(all);
        if self.is_impulse && tried.contains(&Detection::Complete) {
            let law = self.find(plan, all, Detection::Complete, grown);
            return tried.into_iter().map(|detection| (detection, law.clone())).collect();
        }
        tried.into_iter().map(|detection| (detection, self.find(plan, all, detection, grown))).collect()
    }

    /// The reference of one way to find collisions: exact if it can be, else converged.
    fn find(&self, plan: &Plan<'_>, all: &[Runs], detection: Detection, grown: f64) -> Option<Reference> {
        let of = |motion| all.iter().find(|runs| runs.method == Method { motion, detection });
        if let Some(runs) = of(MotionRule::Continuous) {
            let courses: Vec<&Course> = runs.courses.iter().collect();
            if let Some(exact) = reference::exact(plan, &courses, runs.method, grown) {
                return Some(exact);
            }
        }
        [MotionRule::Continuous, MotionRule::Stepped].into_iter().filter_map(of).find_map(|runs| {
            let finer = self.finer(plan, runs);
            let courses: Vec<&Course> = runs.courses.iter().chain(&finer).collect();
            reference::converged(plan, &courses, runs.method)
        })
    }

    /// Runs of a method beyond the ladder, when all on it could be made.
    fn finer(&self, plan: &Plan<'_>, runs: &Runs) -> Vec<Course> {
        if runs.courses.len() < plan.ladder.rungs || runs.ended.is_some() {
            return Vec::new();
        }
        let beyond: Vec<usize> = (0..BEYOND).map(|more| runs.courses.len() + more).collect();
        let run = |rung: &usize| course::run(self.recipe, plan, runs.method, *rung, Start::AsWritten).ok();
        share(&beyond, self.threads, "finer runs", run).into_iter().flatten().collect()
    }
}

/// The same as data.
pub(super) fn referred(detection: Detection, reference: Option<&Reference>) -> Referred {
    Referred {
        detection,
        earned: reference.map(|reference| reference.earned),
        method: reference.and_then(|reference| reference.method),
    }
}

/// How far two references that different methods made are apart.
pub(super) fn models_apart(shapes: &Shapes, references: &[(Detection, Option<Reference>)]) -> Option<f64> {
    match references {
        [(_, Some(a)), (_, Some(b))] if a.method != b.method => {
            Apart::between(shapes, &a.stands, &b.stands).map(|apart| apart.max)
        }
        _ => None,
    }
}
