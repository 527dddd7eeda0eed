//! How many overlaps a look at vertices misses, against how long the rectangles are.

use std::error::Error;
use std::f64::consts::{PI, TAU};

use choque::plot::{Axis, Figure, Look, Point, Series};
use choque::report::random::Random;
use choque_engine::scene::{Body, Kind};

use crate::page::table;
use crate::stage::{DOCUMENT, Model, body, run};

/// Lengths of two bars 1 m wide, and what another program found in millions of poses \[%\].
const LENGTHS: [(f64, Option<f64>); 8] = [
    (1.0, Some(1.7)),
    (2.0, Some(3.3)),
    (4.0, Some(13.2)),
    (7.0, None),
    (10.0, Some(40.6)),
    (20.0, None),
    (50.0, None),
    (100.0, Some(90.4)),
];

struct Sampled {
    length: f64,
    /// Share of poses that overlap, measured and exact.
    overlapping: f64,
    exact: f64,
    /// Share of overlaps that vertices miss, and its standard deviation.
    missed: f64,
    deviation: f64,
}

/// Samples every length.
pub(crate) fn measured(samples: usize) -> Result<(Figure, String), Box<dyn Error>> {
    let sampled = LENGTHS.iter().map(|(length, _)| sample(*length, samples)).collect::<Result<Vec<_>, _>>()?;
    let points =
        |y: &dyn Fn(&Sampled) -> f64| sampled.iter().map(|s| Point { x: s.length, y: y(s), label: None }).collect();
    let figure = Figure {
        title: "Overlaps that a look at vertices misses".to_owned(),
        subtitle: format!("two bars 1 m wide in random poses that overlap; {samples} poses of each length"),
        x: Axis::log("length / width"),
        y: Axis::linear("overlaps missed [%]"),
        series: vec![
            Series {
                name: "detection vertices".to_owned(),
                look: Look(0),
                joined: true,
                points: points(&|s| 100.0 * s.missed),
            },
            Series { name: "detection complete".to_owned(), look: Look(3), joined: true, points: points(&|_| 0.0) },
        ],
    };
    let row = |(s, (_, known)): (&Sampled, &(f64, Option<f64>))| {
        vec![
            format!("{} × 1", s.length),
            format!("{:.1} ± {:.1} %", 100.0 * s.missed, 200.0 * s.deviation),
            known.map_or("–".to_owned(), |known| format!("{known} %")),
            format!("{:.5}", s.overlapping),
            format!("{:.5}", s.exact),
        ]
    };
    let head =
        ["both bars", "missed by vertices (2 σ)", "another program, millions of poses", "poses that overlap", "exact"];
    Ok((figure, table(&head, &sampled.iter().zip(&LENGTHS).map(row).collect::<Vec<_>>())))
}

/// Random poses of two bars in a square that holds every pose that can overlap.
fn sample(length: f64, samples: usize) -> Result<Sampled, Box<dyn Error>> {
    let mut random = Random::new(length.to_bits());
    let side = 2.0 * (length * length + 1.0).sqrt();
    let (mut overlaps, mut seen) = (0.0, 0.0);
    for _ in 0..samples {
        let at = (0.5 * side * random.signed(), 0.5 * side * random.signed());
        let angles = [TAU * random.unit(), TAU * random.unit()];
        let bars = || -> Vec<Body> {
            let a = Body { angle: angles[0], ..body("a", Kind::Mobile, [length, 1.0], (0.0, 0.0)) };
            let b = Body { angle: angles[1], ..body("b", Kind::Mobile, [length, 1.0], at) };
            vec![a, b]
        };
        let listed = |detection| -> Result<bool, Box<dyn Error>> {
            let model = Model { detection, ..DOCUMENT };
            Ok(run(model.settings(1.0), bars(), 1, |_| false)?.work().pairs_listed > 0)
        };
        if listed(choque_engine::scene::Detection::Complete)? {
            overlaps += 1.0;
            seen += if listed(choque_engine::scene::Detection::Vertices)? { 1.0 } else { 0.0 };
        }
    }
    let missed = 1.0 - seen / f64::max(overlaps, 1.0);
    let perimeter = 2.0 * (length + 1.0);
    Ok(Sampled {
        length,
        overlapping: overlaps / samples as f64,
        exact: (2.0 * length + perimeter * perimeter / (2.0 * PI)) / (side * side),
        missed,
        deviation: (missed * (1.0 - missed) / f64::max(overlaps, 1.0)).sqrt(),
    })
}
