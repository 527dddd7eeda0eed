//! One run of a sweep, from what it is asked for to its row.

use choque_engine::World;
use choque_scripting::Scenario;

use super::runs::Runs;
use super::table::{Cell, Columns, Row, on_one_line};
use crate::Error;
use crate::outcome::{hexadecimal, positive_zero};
use crate::play::{Unwatched, play};

/// Makes runs one after the other; every script it meets is compiled once.
#[derive(Debug)]
pub struct Worker<'a> {
    runs: &'a Runs,
    columns: &'a Columns,
    /// What is told of bodies.
    read: &'a [String],
    /// By scenario, once it was needed.
    loaded: Vec<Option<Scenario>>,
}

impl<'a> Worker<'a> {
    /// A worker that has done nothing yet.
    #[must_use]
    pub fn new(runs: &'a Runs, columns: &'a Columns, read: &'a [String]) -> Self {
        Worker { runs, columns, read, loaded: runs.scenarios.iter().map(|_| None).collect() }
    }

    /// Makes a run. Whatever ends it, there is a row.
    pub fn row(&mut self, run: usize) -> Row {
        let asked = self.runs.asked(run);
        let mut seed = None;
        let made = self.scenario(asked.scenario).and_then(|scenario| {
            let scenario = scenario.with(&asked.set, asked.overrides)?;
            seed = Some(scenario.scene().settings.seed);
            Ok(scenario)
        });
        let results = made.and_then(|scenario| results(&scenario, self.read));
        let asked = self.runs.cells(run, &asked, seed);
        match results {
            Ok(results) => self.columns.row(asked, results),
            Err(error) => self.columns.error(asked, &told(&error)),
        }
    }

    fn scenario(&mut self, index: usize) -> Result<&Scenario, Error> {
        let slot = &mut self.loaded[index];
        match slot {
            Some(scenario) => Ok(scenario),
            None => Ok(slot.insert(Scenario::load(&self.runs.scenarios[index].1, &self.runs.options())?)),
        }
    }
}

fn results(scenario: &Scenario, read: &[String]) -> Result<Vec<Cell>, Error> {
    let mut run = scenario.start()?;
    let expectations = play(&mut run, &mut Unwatched)?;
    let world = run.world();
    let totals = world.totals().to_array().map(positive_zero);
    if totals.iter().any(|total| !total.is_finite()) {
        let message = "a total is beyond the range of numbers, though no single body is".to_owned();
        return Err(Error::Call { message, hint: "look for a huge mass or velocity".to_owned() });
    }
    let mut cells = vec![Cell::Number(world.time()), Cell::Whole(world.collisions() as i64)];
    cells.extend(totals.map(Cell::Number));
    cells.push(Cell::Number(world.deepest()));
    cells.push(Cell::Text(hexadecimal(world.digest())));
    let failed = expectations.iter().filter(|expectation| !expectation.held);
    let first = failed.clone().next().map(|expectation| on_one_line(&expectation.text)).filter(|text| !text.is_empty());
    let failed = failed.count();
    cells.extend([expectations.len() - failed, failed].map(|count| Cell::Whole(count as i64)));
    cells.push(first.map_or(Cell::Missing, Cell::Text));
    cells.extend(read.iter().map(|read| reading(&world, read)));
    cells.extend(world.work().rows().into_iter().map(|(_, count)| Cell::Whole(count as i64)));
    Ok(cells)
}

/// What a plan reads of a body: `car.speed`.
fn reading(world: &World, read: &str) -> Cell {
    let Some((name, quantity)) = read.rsplit_once('.') else { return Cell::Missing };
    let Some(id) = world.find(name) else { return Cell::Missing };
    Cell::Number(match quantity {
        "x" => world.position(id).x,
        "z" => world.position(id).y,
        "angle" => world.angle(id),
        "vx" => world.velocity(id).x,
        "vz" => world.velocity(id).y,
        "spin" => world.spin(id),
        _ => world.velocity(id).norm(),
    })
}

/// An error in a cell: where, what, what to do.
fn told(error: &Error) -> String {
    let Error::Scenario(diagnostic) = error else { return error.to_string() };
    let name = diagnostic.file.as_ref().and_then(|file| file.file_name()).map(|name| name.to_string_lossy());
    let place = [diagnostic.line, diagnostic.column].map(|at| at.map_or_else(String::new, |at| format!(":{at}")));
    let hint = diagnostic.hint.as_ref().map_or_else(String::new, |hint| format!(" ({hint})"));
    format!("{}{}{}: {}{hint}", name.unwrap_or_default(), place[0], place[1], diagnostic.message)
}
