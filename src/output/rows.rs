//! The ledger exchange by exchange, as CSV: `run --ledger FILE`.
//!
//! | column | what it says |
//! |---|---|
//! | `iteration`, `time` | when; the first iteration is 0, the time in s |
//! | `a`, `b`, `kind` | the pair, in order of creation; `mobile`, `fixed_with_physics` or `fixed` |
//! | `x`, `z`, `depth`, `relocated` | where, how deep, and how far a body was moved, in m |
//! | `kinetic_energy_…` | what each cause changed of it, in J |
//! | `momentum_x`, `momentum_z`, `angular_momentum` | what the exchange changed of them in all |
//!
//! Contacts that last are no exchanges and have no rows; what they change is in the totals.

use std::io;
use std::path::{Path, PathBuf};

use choque_engine::ledger::{Cause, Entry};
use choque_engine::{Hit, PairKind, World};

use crate::Error;
use crate::play::Watch;
use crate::written::{Kind, Nameless};

/// How a file of rows is named.
pub const LEDGER: Kind = Kind { what: "ledger", extension: "csv", flag: "--ledger" };

/// Causes that change the kinetic energy in an exchange.
const CAUSES: [Cause; 6] =
    [Cause::Exchange, Cause::MuL, Cause::MuA, Cause::Restitution, Cause::Friction, Cause::FixedBodies];

/// Gathers a row for each exchange, in a file without a name: nothing is left of a run that is broken off.
#[derive(Debug)]
pub struct Rows {
    /// Or what went wrong first; it is told in the end.
    rows: io::Result<csv::Writer<Nameless>>,
    path: PathBuf,
}

impl Rows {
    /// None yet, under their headings; the file gets its name in the end.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn begin(path: &Path) -> Result<Self, Error> {
        let mut rows = csv::Writer::from_writer(Nameless::to_become(path)?);
        let headed = rows.write_record(headings());
        Ok(Rows { rows: headed.map(|()| rows).map_err(io::Error::from), path: path.to_owned() })
    }

    /// Gives the file of all rows its name.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(self) -> Result<(), Error> {
        let whole = |rows: csv::Writer<Nameless>| rows.into_inner().map_err(|error| error.into_error());
        let file = self.rows.and_then(whole);
        file.map_err(|source| Error::File { verb: "write", path: self.path, source })?.give_name()
    }
}

impl Watch for Rows {
    fn iteration(&mut self, world: &World, hits: &[Hit]) {
        let (Some(ledger), Ok(rows)) = (world.ledger(), &mut self.rows) else { return };
        let mut all = hits.iter().zip(ledger.entries()).map(|(hit, entry)| row(world, hit, entry));
        if let Err(error) = all.try_for_each(|row| rows.write_record(row)) {
            self.rows = Err(error.into());
        }
    }
}

fn headings() -> impl Iterator<Item = String> {
    let before = ["iteration", "time", "a", "b", "kind", "x", "z", "depth", "relocated"].map(str::to_owned);
    let energies = CAUSES.map(|cause| format!("kinetic_energy_{}", cause.word()));
    let after = ["momentum_x", "momentum_z", "angular_momentum"].map(str::to_owned);
    before.into_iter().chain(energies).chain(after)
}

fn row(world: &World, hit: &Hit, entry: &Entry) -> impl Iterator<Item = String> {
    let Entry { time, relocated, booked } = *entry;
    let kind = match hit.kind {
        PairKind::Mobile => "mobile",
        PairKind::FixedWithPhysics => "fixed_with_physics",
        PairKind::Fixed => "fixed",
    };
    let names = [world.name(hit.a), world.name(hit.b), kind].map(str::to_owned);
    let [_, momentum_x, momentum_z, angular_momentum] = booked.total().to_array();
    let energies = CAUSES.map(|cause| booked[cause].kinetic_energy);
    let numbers = [hit.point.x, hit.point.y, hit.depth, relocated].into_iter().chain(energies).chain([
        momentum_x,
        momentum_z,
        angular_momentum,
    ]);
    let numbers: Vec<String> = numbers.map(number).collect();
    [hit.iteration.to_string(), number(time)].into_iter().chain(names).chain(numbers)
}

/// The shortest text that reads back to the same number; 0 for −0.
fn number(number: f64) -> String {
    format!("{}", number + 0.0)
}
