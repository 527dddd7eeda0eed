//! Every method with every time step, run once each.

use super::course::{self, Course, Plan};
use super::jobs::share;
use super::ladder::Ladder;
use super::method::Method;
use super::recipe::{Recipe, Start, Variant};
use super::timing::{self, Patience};
use crate::Error;

/// The runs of one method, longest time step first.
#[derive(Clone, Debug)]
pub struct Runs {
    /// The method.
    pub method: Method,
    /// As far as they are affordable; those after a failure are left out.
    pub courses: Vec<Course>,
    /// What ended them early.
    pub ended: Option<String>,
    /// CPU time of a run with the longest time step \[s\].
    pub cheapest: f64,
}

impl Runs {
    /// What a run with that time step costs, roughly and at most \[s\].
    #[must_use]
    pub fn expected_cost(&self, rung: usize) -> f64 {
        self.cheapest * (1u64 << rung) as f64
    }
}

/// Runs every method with every time step whose run is not expected to take longer than that \[s\].
///
/// # Errors
/// A scenario that cannot be loaded.
pub fn survey(recipe: &Recipe, plan: &Plan<'_>, threads: usize, longest: f64) -> Result<Vec<Runs>, Error> {
    let mut all = Vec::new();
    for method in recipe.methods() {
        all.push(first_look(recipe, plan.ladder, method)?);
    }
    let affordable = |runs: &Runs, rung: usize| rung < 4 || runs.expected_cost(rung) <= longest;
    // The longest runs first, so that no core is left with one at the end.
    let mut jobs: Vec<(usize, usize)> = Vec::new();
    for rung in (0..plan.ladder.rungs).rev() {
        jobs.extend(
            (0..all.len()).filter(|i| all[*i].ended.is_none() && affordable(&all[*i], rung)).map(|i| (i, rung)),
        );
    }
    let made =
        share(&jobs, threads, "runs", |(i, rung)| course::run(recipe, plan, all[*i].method, *rung, Start::AsWritten));
    let mut made: Vec<_> = jobs.into_iter().zip(made).collect();
    made.sort_by_key(|((i, rung), _)| (*i, *rung));
    for ((i, rung), made) in made {
        match made {
            Ok(course) if all[i].courses.len() == rung => all[i].courses.push(course),
            Ok(_) => {} // beyond one that failed
            Err(error) => drop(all[i].ended.get_or_insert_with(|| first_line(&error))),
        }
    }
    Ok(all)
}

/// What the cheapest run of a method costs.
fn first_look(recipe: &Recipe, ladder: &Ladder, method: Method) -> Result<Runs, Error> {
    let variant = Variant::of(ladder, method, 0, Start::AsWritten);
    recipe.load(&variant)?; // what is wrong with the scenario ends the report; what goes wrong in a run ends its method
    let patience = Patience { runs: 1, most: std::time::Duration::ZERO };
    let looked = timing::measure(recipe, &variant, patience);
    let cheapest = looked.as_ref().map_or(0.0, |cost| cost.seconds);
    Ok(Runs { method, courses: Vec::new(), ended: looked.err().map(|error| first_line(&error)), cheapest })
}

/// An error without the place it points at.
pub(super) fn first_line(error: &Error) -> String {
    error.to_string().lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned()
}
