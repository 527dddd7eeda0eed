//! Axes: from numbers to places along a side of the plot, and where the ticks stand.

/// How numbers are laid out along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences, equal distances.
    Linear,
    /// Equal ratios, equal distances; numbers of 0 and less have no place.
    Log,
}

/// What an axis shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is measured, with its unit.
    pub label: String,
    /// How it is laid out.
    pub scale: Scale,
}

impl Axis {
    /// Equal ratios, equal distances.
    pub fn log(label: impl Into<String>) -> Self {
        Axis { label: label.into(), scale: Scale::Log }
    }

    /// Equal differences, equal distances.
    pub fn linear(label: impl Into<String>) -> Self {
        Axis { label: label.into(), scale: Scale::Linear }
    }
}

/// An axis that knows its numbers.
#[derive(Clone, Debug)]
pub(super) struct Range {
    scale: Scale,
    /// Of the numbers, or their logarithms.
    low: f64,
    high: f64,
}

/// A tick, and what stands beside it.
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: Option<String>,
}

/// Ticks with a label that suit the eye.
const LABELLED: f64 = 7.0;

impl Range {
    /// Around all the numbers that have a place; whole decades, or whole ticks.
    pub(super) fn around(scale: Scale, numbers: impl Iterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for number in numbers.filter_map(|number| position(scale, number)) {
            (low, high) = (low.min(number), high.max(number));
        }
        if low > high {
            (low, high) = (0.0, 1.0);
        }
        if low == high && scale == Scale::Linear {
            let half = 0.5 * low.abs().max(1.0);
            (low, high) = (low - half, high + half);
        }
        let unit = if scale == Scale::Log { 1.0 } else { nice_step(high - low) };
        (low, high) = (unit * (low / unit + 1e-9).floor(), unit * (high / unit - 1e-9).ceil());
        if low == high {
            high = low + unit;
        }
        Range { scale, low, high }
    }

    /// From one number to another, both at the very ends; ticks where they fall.
    pub(super) fn exactly(low: f64, high: f64) -> Self {
        Range { scale: Scale::Linear, low, high: if high > low { high } else { low + 1.0 } }
    }

    /// Where a number stands, the ends of the axis being 0 and 1.
    pub(super) fn place(&self, number: f64) -> Option<f64> {
        Some((position(self.scale, number)? - self.low) / (self.high - self.low))
    }

    pub(super) fn ticks(&self) -> Vec<Tick> {
        match self.scale {
            Scale::Linear => self.linear_ticks(),
            Scale::Log => self.decades(),
        }
    }

    fn linear_ticks(&self) -> Vec<Tick> {
        let step = nice_step(self.high - self.low);
        let decimals = (-libm::floor(libm::log10(step) + 1e-9)).max(0.0) as usize;
        let (first, last) = ((self.low / step - 1e-9).ceil() as i64, (self.high / step + 1e-9).floor() as i64);
        let tick =
            |i: i64| Tick { value: step * i as f64, label: Some(signed(&format!("{:.decimals$}", step * i as f64))) };
        (first..=last).map(tick).collect()
    }

    fn decades(&self) -> Vec<Tick> {
        let (first, last) = (self.low.round() as i64, self.high.round() as i64);
        let every = libm::ceil((last - first) as f64 / LABELLED).max(1.0) as i64;
        let few = last - first <= 2;
        let mut ticks = Vec::new();
        for exponent in first..=last {
            let decade = libm::pow(10.0, exponent as f64);
            let labelled = exponent.rem_euclid(every) == 0;
            ticks.push(Tick { value: decade, label: labelled.then(|| power_of_ten(exponent)) });
            if few && exponent < last {
                let between = [2.0, 5.0].map(|n| Tick { value: n * decade, label: Some(plain(n * decade, exponent)) });
                ticks.extend(between);
            }
        }
        ticks
    }
}

fn position(scale: Scale, number: f64) -> Option<f64> {
    match scale {
        _ if !number.is_finite() => None,
        Scale::Linear => Some(number),
        Scale::Log => (number > 0.0).then(|| libm::log10(number)),
    }
}

/// 1, 2 or 5 times a power of ten, so that a length holds a handful.
pub(crate) fn nice_step(length: f64) -> f64 {
    let raw = length / 5.0;
    let decade = libm::pow(10.0, libm::floor(libm::log10(raw)));
    let lead = raw / decade;
    decade * [1.0, 2.0, 5.0, 10.0].into_iter().find(|step| *step >= lead - 1e-9).unwrap_or(10.0)
}

/// `1`, `10`, `100`, else with an exponent.
fn power_of_ten(exponent: i64) -> String {
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        2 => "100".to_owned(),
        _ => format!("10{}", raised(exponent)),
    }
}

/// Between two decades.
fn plain(number: f64, exponent: i64) -> String {
    if (-3..4).contains(&exponent) {
        let decimals = (-exponent).max(0) as usize;
        format!("{number:.decimals$}")
    } else {
        format!("{:.0}·10{}", number / libm::pow(10.0, exponent as f64), raised(exponent))
    }
}

fn raised(exponent: i64) -> String {
    let digit = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c.to_digit(10).unwrap_or(0) as usize).unwrap_or('⁰');
    exponent.to_string().chars().map(|c| if c == '-' { '⁻' } else { digit(c) }).collect()
}

/// With a minus as long as a plus.
fn signed(number: &str) -> String {
    number.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(range: &Range) -> Vec<String> {
        range.ticks().into_iter().filter_map(|tick| tick.label).collect()
    }

    #[test]
    fn decades_are_whole_and_few() {
        let range = Range::around(Scale::Log, [3e-16, 2.0].into_iter());
        assert_eq!(labels(&range), ["10⁻¹⁵", "10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "1"]);
        assert_eq!(range.place(1e-16), Some(0.0));
        assert_eq!(range.place(0.0), None, "nothing has no logarithm");
    }

    #[test]
    fn a_single_decade_has_ticks_within() {
        let range = Range::around(Scale::Log, [0.012, 0.07].into_iter());
        assert_eq!(labels(&range), ["10⁻²", "0.02", "0.05", "10⁻¹"]);
    }

    #[test]
    fn linear_ticks_are_round_numbers() {
        let range = Range::around(Scale::Linear, [-0.3, 1.0].into_iter());
        assert_eq!(labels(&range), ["−0.5", "0.0", "0.5", "1.0"]);
        let range = Range::around(Scale::Linear, [0.0, 97.0].into_iter());
        assert_eq!(labels(&range), ["0", "20", "40", "60", "80", "100"]);
    }

    #[test]
    fn an_axis_without_numbers_is_still_an_axis() {
        assert!(labels(&Range::around(Scale::Log, std::iter::empty())).len() >= 2);
        assert!(labels(&Range::around(Scale::Linear, [4.0].into_iter())).len() >= 2);
    }
}
