//! Where the document's own model breaks, as curves.

use std::error::Error;
use std::path::Path;

use choque::plot::{Axis, Figure, Look, Point, Series};
use choque::report::format::significant;

use crate::Effort;
use crate::page::{Parts, picture, table};
use crate::{overlaps, scenes};

/// Measures every curve and draws it.
pub(crate) fn parts(effort: Effort, pictures: &Path) -> Result<Parts, Box<dyn Error>> {
    let mut parts = Parts::new();
    let mut say = |name: &str, figure: &Figure, table: String| -> Result<(), Box<dyn Error>> {
        parts.insert(format!("{name}_plot"), picture(pictures, name, figure)?);
        parts.insert(format!("{name}_table"), table);
        Ok(())
    };
    let (figure, told) = energy()?;
    say("energy", &figure, told)?;
    let (figure, told) = overlaps::measured(effort.samples)?;
    say("overlaps", &figure, told)?;
    let (figure, told) = tunnels(effort.samples / 100)?;
    say("tunnels", &figure, told)?;
    let (figure, told) = stuck()?;
    say("stuck", &figure, told)?;
    let (figure, told) = kicks()?;
    say("kicks", &figure, told)?;
    Ok(parts)
}

fn series(name: &str, look: usize, points: Vec<(f64, f64)>) -> Series {
    let points = points.into_iter().map(|(x, y)| Point { x, y, label: None }).collect();
    Series { name: name.to_owned(), look: Look(look), joined: true, points }
}

/// A table whose first column is the x of every series.
fn side_by_side(head: &[&str], all: &[Series]) -> String {
    let row = |i: usize| {
        let x = all[0].points[i].x;
        let ys = all.iter().map(|series| significant(series.points[i].y));
        [significant(x)].into_iter().chain(ys).collect::<Vec<_>>()
    };
    table(head, &(0..all[0].points.len()).map(row).collect::<Vec<_>>())
}

/// Energy after a head-on hit over energy before, against the mass of the striking body over the other's.
fn energy() -> Result<(Figure, String), Box<dyn Error>> {
    let ratios: Vec<f64> = (-4..=4).map(|k| libm::pow(10.0, 0.5 * f64::from(k))).collect();
    let measured = |hit: &dyn Fn(f64) -> Result<f64, Box<dyn Error>>| -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
        ratios.iter().map(|ratio| Ok((*ratio, hit(*ratio)?))).collect()
    };
    let all = vec![
        series("m1/m2", 4, ratios.iter().map(|ratio| (*ratio, *ratio)).collect()),
        series("document, μ = 1", 0, measured(&|ratio| scenes::head_on(ratio, 1.0, true))?),
        series("document, μ = 0.5", 1, measured(&|ratio| scenes::head_on(ratio, 0.5, true))?),
        series("impulse, restitution 1", 2, measured(&|ratio| scenes::head_on(ratio, 1.0, false))?),
    ];
    let told = side_by_side(&["m1/m2", "exact m1/m2", "document, μ = 1", "document, μ = 0.5", "impulse, e = 1"], &all);
    let figure = Figure {
        title: "Energy after a head-on hit over energy before".to_owned(),
        subtitle: "two mobile bodies, the struck one at rest; 1 keeps all energy, more comes from nowhere".to_owned(),
        x: Axis::log("mass of the striking body / mass of the struck one"),
        y: Axis::log("energy after / before"),
        series: all,
    };
    Ok((figure, told))
}

/// Bodies that end beyond a wall, against how far they fly in an iteration.
fn tunnels(phases: usize) -> Result<(Figure, String), Box<dyn Error>> {
    let reaches = [0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0];
    let through = |model| -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
        reaches.iter().map(|reach| Ok((*reach, 100.0 * scenes::share_through(model, *reach, phases.max(8))?))).collect()
    };
    let [vertices, complete, impulse, continuous] = scenes::TUNNELLERS;
    let all = vec![
        series("document, vertices", 0, through(vertices)?),
        series("document, complete", 1, through(complete)?),
        series("impulse, complete", 2, through(impulse)?),
        series("document, continuous", 3, through(continuous)?),
    ];
    let told = side_by_side(
        &["flight / room", "document, vertices", "document, complete", "impulse, complete", "document, continuous"],
        &all,
    );
    let figure = Figure {
        title: "Bodies that end beyond a wall".to_owned(),
        subtitle: "a box of 1 m flies at a wall of 0.3 m, a corner ahead, from starts spread over an iteration; room = 1.71 m, the way on which the two overlap".to_owned(),
        x: Axis::log("speed · time_step / room"),
        y: Axis::linear("bodies beyond the wall [%]"),
        series: all,
    };
    Ok((figure, told))
}

/// Exchanges of one pair that should have met once, against ε.
fn stuck() -> Result<(Figure, String), Box<dyn Error>> {
    let gaps: Vec<f64> = (0..=10).map(|k| 1e-6 * libm::pow(10.0, 0.5 * f64::from(k))).collect();
    let counted = |mu: f64| -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
        gaps.iter().map(|gap| Ok((*gap, scenes::exchanges(Some(mu), *gap)? as f64))).collect()
    };
    let impulse = scenes::exchanges(None, 0.0)? as f64;
    let all = vec![
        series("μ_L = 0.5", 0, counted(0.5)?),
        series("μ_L = 0.9", 1, counted(0.9)?),
        series("μ_L = 0.99", 2, counted(0.99)?),
        series("μ_L = 1", 3, counted(1.0)?),
        series("impulse, restitution 0", 4, gaps.iter().map(|gap| (*gap, impulse)).collect()),
    ];
    let told = side_by_side(&["ε [m]", "μ_L = 0.5", "0.9", "0.99", "1", "impulse, e = 0"], &all);
    let figure = Figure {
        title: "Exchanges of a pair that meets once".to_owned(),
        subtitle: format!(
            "a wall at 1 m/s pushes a car for {} iterations; with ε = 0 and μ_L = 1 they exchange {} times",
            scenes::PUSHED_FOR,
            scenes::exchanges(Some(1.0), 0.0)?
        ),
        x: Axis::log("ε [m]"),
        y: Axis::log("exchanges"),
        series: all,
    };
    Ok((figure, told))
}

/// What a flat, centred hit leaves, against how long the body is.
fn kicks() -> Result<(Figure, String), Box<dyn Error>> {
    let aspects: Vec<f64> = (-4..=4).map(|k| libm::pow(10.0, 0.25 * f64::from(k))).collect();
    let hits = |model| aspects.iter().map(|aspect| scenes::flat_hit(model, *aspect)).collect::<Result<Vec<_>, _>>();
    let [document, complete, impulse] = scenes::FLAT.map(hits);
    let (document, complete, impulse) = (document?, complete?, impulse?);
    let pick = |hits: &[scenes::Leaving], what: fn(&scenes::Leaving) -> f64| {
        aspects.iter().zip(hits).map(|(aspect, hit)| (*aspect, what(hit))).collect::<Vec<_>>()
    };
    let sideways = |hit: &scenes::Leaving| hit.sideways;
    let forwards = |hit: &scenes::Leaving| hit.forwards;
    let all = vec![
        series("exact a/(1 + a²)", 4, aspects.iter().map(|a| (*a, a / (1.0 + a * a))).collect()),
        series("document: sideways", 0, pick(&document, sideways)),
        series("forwards", 1, pick(&document, forwards)),
        series("document, complete: sideways", 5, pick(&complete, sideways)),
        series("forwards", 3, pick(&complete, forwards)),
        series("impulse: forwards", 2, pick(&impulse, forwards)),
    ];
    let told = side_by_side(
        &[
            "length / width a",
            "exact a/(1 + a²)",
            "document: sideways / v",
            "forwards / v",
            "document, complete: sideways / v",
            "forwards / v",
            "impulse: forwards / v",
        ],
        &all,
    );
    let figure = Figure {
        title: "What a flat, centred hit leaves of a speed".to_owned(),
        subtitle: "a box flies straight at a wall with its face first; right is 0 sideways (as impulse has it) and, with restitution 1, −1 forwards".to_owned(),
        x: Axis::log("length along the flight / width"),
        y: Axis::linear("speed after / speed before"),
        series: all,
    };
    Ok((figure, told))
}
