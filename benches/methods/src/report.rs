//! What was measured, as a line, a page, a table for other programs, and pictures.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use choque::plot::{Axis, Figure, Look, Point, Series, svg};

use crate::suite::{Run, USUAL};

/// What a logarithmic axis shows in place of 0.
const LEAST: f64 = 1e-16;

/// Scenes with a picture: what the error is.
const DRAWN: [(&str, &str); 4] = [
    ("pyramid 100", "error of the top box [m]"),
    ("dropped pyramid 20", "error of the top box [m]"),
    ("drop, e = 0.5", "error of the apex [m]"),
    ("slide", "error of the way [m]"),
];

const CELLS: [&str; 11] = [
    "scene",
    "method",
    "n",
    "error [m]",
    "shape [m]",
    "asymmetry",
    "deepest [m]",
    "energy gained [J]",
    "speed at end [m/s]",
    "passes / step",
    "rounds",
];

fn cells(run: &Run) -> [String; 11] {
    let o = &run.outcome;
    let number = |x: f64| if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") };
    [
        run.scene.clone(),
        run.method.to_owned(),
        run.effort.to_string(),
        number(o.error),
        number(o.shape),
        number(o.asymmetry),
        number(o.deepest),
        number(o.gained),
        number(o.speed),
        format!("{:.1}", o.passes),
        o.rounds.to_string(),
    ]
}

/// A run in one line.
pub(crate) fn line(run: &Run) -> String {
    let cells = cells(run);
    let mut text = format!("{:20} {:15} n = {:2}", cells[0], cells[1], cells[2]);
    for (name, cell) in CELLS.iter().zip(&cells).skip(3) {
        let _ = write!(text, "  {} {cell:>7}", name.split(" [").next().unwrap_or(name));
    }
    let _ = write!(text, "  {:.3} ms", run.outcome.ms);
    text
}

/// Writes all of it into a folder.
pub(crate) fn write(folder: &Path, runs: &[Run]) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("methods.csv"), csv(runs))?;
    let mut pictures = String::new();
    for (scene, error) in DRAWN {
        let name =
            format!("methods_{}", scene.replace([',', '='], "").replace('.', "").replace("  ", " ").replace(' ', "_"));
        let figure = figure(runs, scene, error);
        std::fs::write(folder.join(format!("{name}.svg")), svg::svg(&figure.draw()))?;
        let _ = writeln!(pictures, "![{}]({name}.svg)\n", figure.title);
    }
    let page =
        include_str!("methods.md").replace("{{table}}", &table(runs)).replace("{{pictures}}", pictures.trim_end());
    std::fs::write(folder.join("methods.md"), page)?;
    Ok(())
}

fn csv(runs: &[Run]) -> String {
    let mut text = String::from(
        "scene,method,n,error,shape,asymmetry,deepest,energy_gained,end_speed,passes_per_step,rounds,most_rounds,residual\n",
    );
    for run in runs {
        let o = &run.outcome;
        let scene = run.scene.replace(',', "");
        let _ = writeln!(
            text,
            "{scene},{},{},{:e},{:e},{:e},{:e},{:e},{:e},{},{},{},{:e}",
            run.method,
            run.effort,
            o.error,
            o.shape,
            o.asymmetry,
            o.deepest,
            o.gained,
            o.speed,
            o.passes,
            o.rounds,
            o.most_rounds,
            o.residual
        );
    }
    text
}

/// Every scene with every method at the usual effort.
fn table(runs: &[Run]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut text = line(&CELLS.map(str::to_owned));
    text += "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    runs.iter().filter(|run| run.effort == USUAL).for_each(|run| text += &line(&cells(run)));
    text.trim_end().to_owned()
}

/// Error against cost, a curve per method.
fn figure(runs: &[Run], scene: &str, error: &str) -> Figure {
    let mut series: Vec<Series> = Vec::new();
    for run in runs.iter().filter(|run| run.scene == scene) {
        if series.iter().all(|series| series.name != run.method) {
            let look = Look(series.len());
            series.push(Series { name: run.method.to_owned(), look, joined: true, points: Vec::new() });
        }
        let y = if run.outcome.error.is_finite() { run.outcome.error.max(LEAST) } else { continue };
        let point = Point { x: run.outcome.passes, y, label: Some(run.effort.to_string()) };
        series
            .iter_mut()
            .filter(|series| series.name == run.method)
            .for_each(|series| series.points.push(point.clone()));
    }
    Figure {
        title: format!("Cost and error: {scene}"),
        subtitle: "1, 2, 4, 8 and 16 sub-steps (AVBD: iterations) of a step of 1/60 s; 1e-16 stands for exact"
            .to_owned(),
        x: Axis::log("passes over all contacts, a step"),
        y: Axis::log(error),
        series,
    }
}
