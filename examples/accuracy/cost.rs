//! What each cure costs, on the scenarios a designer starts from.

use std::error::Error;
use std::time::Duration;

use choque::arguments::ScenarioArguments;
use choque::output::numbers::duration;
use choque::report::course::watch;
use choque::report::format::{significant, times};
use choque::report::method::ALL;
use choque::report::recipe::{Recipe, Start, Variant};
use choque::report::timing::{Patience, measure};
use clap::Parser;

use crate::Effort;
use crate::page::{Parts, table};
use crate::suite::root;

const SCENES: [&str; 3] = ["blades/spinning_blade", "vehicles/pileup_12", "walls/patrol_doors"];

#[derive(Parser)]
struct Overrides {
    #[command(flatten)]
    scenario: ScenarioArguments,
}

/// Every exchange and method at the scenario's own time step.
pub(crate) fn parts(effort: Effort) -> Result<Parts, Box<dyn Error>> {
    let mut rows = Vec::new();
    for scene in SCENES.iter().step_by(effort.every.min(2)) {
        let file = root().join(format!("scenarios/{scene}.rhai"));
        let mut own = None;
        for exchange in ["document", "impulse"] {
            let Overrides { scenario } = Overrides::parse_from(["accuracy", "--exchange", exchange]);
            let recipe = Recipe::new(&file, &scenario);
            let settings = recipe.as_written()?.scene().settings.clone();
            for method in ALL {
                let variant =
                    Variant { method, time_step: settings.time_step, steps: settings.steps, start: Start::AsWritten };
                let patience = Patience { runs: effort.depth.runs, most: Duration::from_secs(2) };
                let cost = measure(&recipe, &variant, patience)?.seconds;
                let run = watch(&recipe, &variant, |_, _| {})?;
                let world = run.world();
                let deeds: u64 = world.work().rows().iter().map(|(_, count)| count).sum();
                let own = *own.get_or_insert(cost);
                rows.push(vec![
                    format!("`{scene}`, {exchange}, {}", method.name()),
                    duration(cost / world.time()),
                    times(cost / own),
                    significant(deeds as f64 / world.time()),
                    world.collisions().to_string(),
                ]);
            }
        }
    }
    let head = ["scene and model", "CPU per s", "times the document's own", "counted work per s", "exchanges"];
    Ok(Parts::from([("cost".to_owned(), table(&head, &rows))]))
}
