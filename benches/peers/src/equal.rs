//! Cost at equal error: the coarsest setting with which each engine comes close enough, and its CPU time.

use std::error::Error;

use choque::output::numbers::duration;
use choque::report::format::error as short;

use crate::accuracy::play::Play;
use crate::accuracy::{self, Case, Phases};
use crate::engine::{Engine, How};
use crate::judge::judge;
use crate::scene::Name;
use crate::table::Table;

/// Steps a second and sub-steps of each, from the cheapest to the dearest.
const SETTINGS: [(u32, u32); 14] = [
    (60, 1),
    (60, 2),
    (60, 4),
    (60, 8),
    (120, 4),
    (60, 16),
    (240, 4),
    (60, 32),
    (480, 4),
    (960, 4),
    (1920, 4),
    (3840, 4),
    (7680, 4),
    (15360, 4),
];

/// A run that took longer than this is the last one tried \[s of CPU\].
const PATIENCE: f64 = 10.0;

/// An error to come below, and what is known to come below it.
struct Goal {
    case: Case,
    error: f64,
    /// Who takes part: continuous motion is not made for thousands of boxes that touch.
    engines: &'static [Engine],
}

const STACKERS: [Engine; 4] = crate::engine::USUAL;

fn goals() -> Vec<Goal> {
    let pyramid = Case {
        name: "large_pyramid",
        title: "large pyramid: the top box after 500/60 s",
        error: "distance from where it began [m]",
        phases: Phases::One,
        finest: 15360,
        crowded: true,
        scene: |_| Name::LargePyramid.scene(),
        judge: |play: &mut Play| {
            let start = play.motions();
            play.to(500.0 / 60.0);
            judge(play.scene(), &start, &play.motions()).shape_error.unwrap_or(f64::NAN)
        },
    };
    let mut goals = vec![Goal { case: pyramid, error: 0.1, engines: &STACKERS }];
    for case in accuracy::cases() {
        let error = match case.name {
            "p1" | "p6" => 1e-3,
            "e3" => 1e-2,
            "e4" => 0.1,
            _ => continue,
        };
        goals.push(Goal { case, error, engines: &accuracy::CONTENDERS });
    }
    goals
}

/// What an engine needs to come below an error.
enum Reached {
    With { setting: (u32, u32), error: f64, seconds: f64 },
    Never { best: f64, seconds: f64 },
}

/// Tries every engine on every goal.
///
/// # Errors
/// A scene that an engine refuses.
pub fn table(told: impl Fn(&str)) -> Result<Table, Box<dyn Error>> {
    let mut table = Table::new(&["scene", "error below", "engine", "1/time step", "sub-steps", "error", "CPU time"]);
    for Goal { case, error, engines } in goals() {
        for engine in engines {
            told(&format!("{}, {}", case.title, engine.word()));
            let cells = match search(&case, *engine, error)? {
                Reached::With { setting: (rate, substeps), error, seconds } => {
                    [rate.to_string(), substeps.to_string(), short(Some(error)), duration(seconds)]
                }
                Reached::Never { best, seconds } => {
                    let never = format!("not reached by runs up to {}", duration(seconds));
                    ["–".to_owned(), "–".to_owned(), short(Some(best)), never]
                }
            };
            let head = [case.title.to_owned(), short(Some(error)), engine.word()];
            table.rows.push(head.into_iter().chain(cells).collect());
        }
    }
    Ok(table)
}

fn search(case: &Case, engine: Engine, goal: f64) -> Result<Reached, Box<dyn Error>> {
    let (mut best, mut seconds) = (f64::INFINITY, 0.0);
    for setting in SETTINGS {
        let how = How { time_step: 1.0 / f64::from(setting.0), substeps: setting.1, exact: true, threads: 1 };
        let outcome = accuracy::outcome(case, engine, how)?;
        seconds = outcome.seconds;
        if outcome.error <= goal {
            return Ok(Reached::With { setting, error: outcome.error, seconds });
        }
        best = best.min(outcome.error);
        if seconds > PATIENCE {
            break;
        }
    }
    Ok(Reached::Never { best, seconds })
}
