//! Many copies of a chaotic scene, each started a hair's breadth beside the next: what can be said of all of them, where
//! nothing can be said of one.

use serde::{Deserialize, Serialize};

use super::jobs::share;
use super::ladder::Ladder;
use super::method::Method;
use super::quantities::Quantities;
use super::recipe::{Recipe, Start, Variant};
use super::statistics::{interquartile_range, median, median_interval, same_kind};
use crate::Error;

/// How far copies start from the scene, in half diagonals.
const BESIDE: f64 = 1e-9;
/// Below this probability two samples are of different kinds.
const LEAST_LIKELY: f64 = 0.01;

/// A quantity with one method, beside the same with the reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// What was measured.
    pub quantity: String,
    /// The method …
    pub method: Method,
    /// … and its time step \[s\].
    pub time_step: f64,
    /// Its median over the copies, and where that lies with a confidence of 95 %.
    pub median: f64,
    /// From, to.
    pub interval: [f64; 2],
    /// The same of the reference.
    pub reference: f64,
    /// From, to.
    pub reference_interval: [f64; 2],
    /// How far the medians are apart, in interquartile ranges of the reference; nothing when the reference does not vary and
    /// they differ.
    pub off: Option<f64>,
    /// How likely two samples of one kind are as different as these (Kolmogorov and Smirnov).
    pub likelihood: f64,
    /// Whether the intervals overlap and the samples may be of one kind.
    pub agree: bool,
}

/// One way to simulate the copies.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Setting {
    method: Method,
    rung: usize,
}

/// Compares every method with a time step of 1/60 to the reference method with one of 1/240.
///
/// # Errors
/// A scenario that cannot be loaded. A method whose runs fail is left out.
pub fn compare(
    recipe: &Recipe,
    ladder: &Ladder,
    methods: &[Method],
    reference: Method,
    copies: usize,
    threads: usize,
) -> Result<Vec<Comparison>, Error> {
    let usual = ladder.usual();
    let mut settings = vec![Setting { method: reference, rung: (usual + 2).min(ladder.rungs - 1) }];
    settings.extend(methods.iter().map(|method| Setting { method: *method, rung: usual }));
    let quantities = Quantities::of(recipe.as_written()?.scene());
    // Seeds of their own for every setting: two samples that share their starts are not independent.
    let seeds = (0..).flat_map(|setting: u64| (0..copies as u64).map(move |copy| 1000 * setting + copy));
    let jobs: Vec<(Setting, u64)> =
        settings.iter().flat_map(|setting| std::iter::repeat_n(*setting, copies)).zip(seeds).collect();
    let read = share(&jobs, threads, "copies", |(setting, seed)| {
        let start = Start::Jittered { by: BESIDE, seed: *seed };
        let variant = Variant::of(ladder, setting.method, setting.rung, start);
        let every = ladder.steps(setting.rung) / ladder.coarsest;
        quantities.read(recipe, &variant, every).ok()
    });
    let samples: Vec<Option<Vec<Vec<f64>>>> =
        read.chunks(copies).map(|copies| copies.iter().cloned().collect::<Option<Vec<_>>>()).collect();
    let Some(Some(truth)) = samples.first() else { return Ok(Vec::new()) };
    let mut comparisons = Vec::new();
    for (q, quantity) in quantities.names().into_iter().enumerate() {
        let column = |sample: &[Vec<f64>]| sample.iter().map(|copy| copy[q]).collect::<Vec<f64>>();
        for (setting, sample) in settings[1..].iter().zip(&samples[1..]) {
            let Some(sample) = sample else { continue };
            let of = |values: &[f64]| (median(values), median_interval(values, 1));
            let (values, truth) = (column(sample), column(truth));
            comparisons.push(comparison(quantity, *setting, ladder, (&values, of(&values)), (&truth, of(&truth))));
        }
    }
    Ok(comparisons)
}

type Sample<'a> = (&'a [f64], (f64, [f64; 2]));

fn comparison(quantity: &str, setting: Setting, ladder: &Ladder, tried: Sample<'_>, truth: Sample<'_>) -> Comparison {
    let (values, (median, interval)) = tried;
    let (expected, (reference, reference_interval)) = truth;
    let likelihood = same_kind(values, expected);
    let (gap, range) = ((median - reference).abs(), interquartile_range(expected));
    let overlap = interval[0] <= reference_interval[1] && reference_interval[0] <= interval[1];
    Comparison {
        quantity: quantity.to_owned(),
        method: setting.method,
        time_step: ladder.time_step(setting.rung),
        median,
        interval,
        reference,
        reference_interval,
        off: if gap == 0.0 { Some(0.0) } else { (range > 0.0).then(|| gap / range) },
        likelihood,
        agree: overlap && likelihood > LEAST_LIKELY,
    }
}
