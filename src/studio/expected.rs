//! The end that a scenario's snapshot expects: what a page lays over the end that came out.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use choque_engine::World;
use serde::Serialize;

use crate::harness::{BodyRow, Snapshot, pinned};

/// Rows of a snapshot are rounded to a millionth: a difference below that is none.
const ROUNDING: f64 = 1e-6;

/// What a snapshot says of the end.
#[derive(Clone, Debug)]
pub(super) struct Expected {
    snapshot: Snapshot,
}

/// The end of the bodies that a snapshot tells of, as the player takes it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Ghosts<'a> {
    /// Bodies of a large scene that the snapshot leaves out.
    untold: usize,
    bodies: Vec<Ghost<'a>>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Ghost<'a> {
    name: &'a str,
    x: f64,
    z: f64,
    angle: f64,
}

/// How far the end of a run is from the expected one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Difference {
    /// Bodies that are elsewhere, or turned otherwise, by more than the snapshot's rounding.
    moved: usize,
    /// Bodies in the snapshot that the scene does not have.
    missing: usize,
    /// The body that is furthest from where it should be.
    furthest: Option<String>,
    /// How far \[m\].
    distance: f64,
}

impl Expected {
    /// The snapshot of a script, at the same path below `snapshots`, if it has one.
    pub(super) fn of(snapshot: &Path) -> Option<Result<Self, String>> {
        fs::metadata(snapshot).ok()?;
        Some(pinned(snapshot).map(|snapshot| Expected { snapshot }))
    }

    pub(super) fn ghosts<'a>(&'a self) -> Ghosts<'a> {
        let ghost = |row: &'a BodyRow| Ghost { name: &row.name, x: row.x, z: row.z, angle: row.angle };
        let bodies = self.snapshot.bodies.iter().map(ghost).collect();
        Ghosts { untold: self.snapshot.untold, bodies }
    }

    pub(super) fn difference(&self, world: &World) -> Difference {
        let mut difference = Difference { moved: 0, missing: 0, furthest: None, distance: 0.0 };
        for row in &self.snapshot.bodies {
            let Some(id) = world.find(&row.name) else {
                difference.missing += 1;
                continue;
            };
            let position = world.position(id);
            let (x, z) = (position.x - row.x, position.y - row.z);
            let distance = (x * x + z * z).sqrt();
            let turned = (world.angle(id) - row.angle).abs();
            let turned = turned.min(TAU - turned); // half a turn either way is the same
            if distance > 2.0 * ROUNDING || turned > 2.0 * ROUNDING {
                difference.moved += 1;
            }
            if distance > difference.distance {
                difference.distance = distance;
                difference.furthest = Some(row.name.clone());
            }
        }
        difference
    }
}
