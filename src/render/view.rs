//! The window onto the plane: which part of it is shown, and where on the page.

use choque_engine::scene::Kind;

use crate::plot::drawing::At;
use crate::recording::{Frame, Recording};

/// A part of the plane on a page.
#[derive(Clone, Debug)]
pub(super) struct View {
    /// The least x and z shown \[m\].
    low: [f64; 2],
    /// Pixels a metre.
    pub(super) scale: f64,
    /// Where the plane's part stands on the page.
    pub(super) from: At,
    /// Its size \[px\].
    pub(super) size: At,
}

/// Around everything [px].
const MARGIN: f64 = 14.0;
/// What is above the plane's part: title and moment.
const ABOVE: f64 = 46.0;
/// What is below: the scale.
const BELOW: f64 = 34.0;
/// Height of the plane's part by its width, at least and at most.
const SHAPE: [f64; 2] = [0.3, 1.1];
/// What lies so far out is shown only when it costs little room: this part of all numbers on either side.
const OUTLIERS: f64 = 0.02;
/// Fixed bodies are shown whole where they reach out so far at most, by the length of where things move; else so little.
const NEAR: f64 = 0.4;
const A_LITTLE: f64 = 0.08;
/// Frames looked at to find the part that is shown.
const LOOKS: usize = 64;

impl View {
    /// The part of the plane in which things happen between two frames, on a page of that width.
    pub(super) fn of(recording: &Recording, frames: &[Frame], width: f64) -> Self {
        let [x, z] = [0, 1].map(|axis| span(recording, frames, axis));
        let wide = width - 2.0 * MARGIN;
        let (mut x, mut z) = (padded(x), padded(z));
        let shape = ((z[1] - z[0]) / (x[1] - x[0])).clamp(SHAPE[0], SHAPE[1]);
        widen(&mut x, (z[1] - z[0]) / shape);
        widen(&mut z, (x[1] - x[0]) * shape);
        let scale = wide / (x[1] - x[0]);
        View { low: [x[0], z[0]], scale, from: [MARGIN, ABOVE], size: [wide, libm::ceil(wide * shape)] }
    }

    /// Size of the page \[px\].
    pub(super) fn page(&self) -> At {
        [self.size[0] + 2.0 * MARGIN, self.from[1] + self.size[1] + BELOW]
    }

    /// Where a point of the plane stands on the page; +z is up.
    pub(super) fn place(&self, [x, z]: [f64; 2]) -> At {
        let far = |length: f64| length.clamp(-1e6, 1e6); // further out nothing can be told apart
        [
            self.from[0] + far((x - self.low[0]) * self.scale),
            self.from[1] + self.size[1] - far((z - self.low[1]) * self.scale),
        ]
    }

    /// A direction on the page.
    pub(super) fn along([x, z]: [f64; 2], length: f64) -> At {
        [x * length, -z * length]
    }
}

/// From where to where things happen along an axis: mobile bodies, and fixed ones as far as those give a reason.
fn span(recording: &Recording, frames: &[Frame], axis: usize) -> [f64; 2] {
    let every = frames.len().div_ceil(LOOKS).max(1);
    let looked = frames.iter().rev().step_by(every);
    let mut mobile = Vec::new();
    let mut fixed = Vec::new();
    for frame in looked {
        for (body, state) in recording.bodies.iter().zip(&frame.states) {
            let numbers = body.corners(state).into_iter().flatten().map(|corner| corner[axis]);
            if body.kind == Kind::Mobile { mobile.extend(numbers) } else { fixed.extend(numbers) }
        }
    }
    let within = |mut numbers: Vec<f64>| {
        numbers.retain(|number| number.is_finite());
        numbers.sort_by(f64::total_cmp);
        let ends = [*numbers.first()?, *numbers.last()?];
        let out = (OUTLIERS * numbers.len() as f64) as usize;
        let most = [numbers[out], numbers[numbers.len() - 1 - out]];
        Some(if ends[1] - ends[0] <= 3.0 * (most[1] - most[0]) { ends } else { most })
    };
    let (mobile, fixed) = (within(mobile), within(fixed));
    let Some(mobile) = mobile else { return fixed.unwrap_or([-1.0, 1.0]) };
    let Some(fixed) = fixed else { return mobile };
    let length = (mobile[1] - mobile[0]).max(1e-9);
    // A wall near by is shown whole; of a floor without end no more than a little.
    let reach = |beyond: f64| if beyond <= NEAR * length { beyond.max(0.0) } else { A_LITTLE * length };
    [mobile[0] - reach(mobile[0] - fixed[0]), mobile[1] + reach(fixed[1] - mobile[1])]
}

fn padded([low, high]: [f64; 2]) -> [f64; 2] {
    let pad = 0.04 * (high - low) + 1e-6 * (1.0 + low.abs().max(high.abs()));
    [low - pad, high + pad]
}

/// To a length at least, on both sides alike.
fn widen(span: &mut [f64; 2], length: f64) {
    let lacking = 0.5 * (length - (span[1] - span[0])).max(0.0);
    *span = [span[0] - lacking, span[1] + lacking];
}
