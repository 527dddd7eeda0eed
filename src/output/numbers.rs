//! Numbers for people: four decimals where that says something, powers of ten where it does not.

/// A number in at most a dozen characters: `0`, `-3.1416`, `1.2000e9`.
#[must_use]
pub fn short(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e7).contains(&size) => format!("{number:.4}"),
        _ => format!("{number:.3e}"),
    }
}

/// A number in four figures, as one says it: `412.5`, `2856000`, `1.177e7`.
#[must_use]
pub fn rough(number: f64) -> String {
    let figures = format!("{number:.3e}");
    match figures.parse::<f64>() {
        Ok(0.0) => "0".to_owned(),
        Ok(rounded) if (1e-3..1e7).contains(&rounded.abs()) => rounded.to_string(),
        Ok(rounded) => format!("{rounded:e}"),
        Err(_) => figures,
    }
}

/// A duration in the unit that suits it: `8.33 ms`, `5 s`.
#[must_use]
pub fn duration(seconds: f64) -> String {
    let (scale, unit) = match seconds {
        s if s >= 1.0 || s == 0.0 => (1.0, "s"),
        s if s >= 1e-3 => (1e3, "ms"),
        s if s >= 1e-6 => (1e6, "µs"),
        _ => (1e9, "ns"),
    };
    let size = seconds * scale;
    let decimals = match size {
        s if s >= 100.0 => 1,
        s if s >= 10.0 => 2,
        _ => 3,
    };
    format!("{} {unit}", trimmed(&format!("{size:.decimals$}")))
}

/// Without the zeros at the end that say nothing: `1200` for `1200.0000`.
#[must_use]
pub fn trimmed(number: &str) -> &str {
    if number.contains('e') || !number.contains('.') {
        return number;
    }
    number.trim_end_matches('0').trim_end_matches('.')
}

/// A count with its noun: `1 body`, `3 bodies`.
#[must_use]
pub fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let expected =
            [(0.0, "0"), (-0.0, "0"), (2.5, "2.5000"), (-1e-9, "-1.000e-9"), (1.2e9, "1.200e9"), (0.001, "0.0010")];
        for (number, text) in expected {
            assert_eq!(short(number), text);
        }
    }

    #[test]
    fn rough_numbers_have_four_figures() {
        let expected = [
            (0.0, "0"),
            (-0.0, "0"),
            (13.5, "13.5"),
            (2_855_972.6, "2856000"),
            (11_771_809.0, "1.177e7"),
            (-2e-9, "-2e-9"),
            (0.1 + 0.2, "0.3"),
        ];
        for (number, text) in expected {
            assert_eq!(rough(number), text);
        }
    }

    #[test]
    fn durations_take_the_unit_that_suits_them() {
        let expected = [(0.0, "0 s"), (5.0, "5 s"), (1.0 / 120.0, "8.333 ms"), (0.5156, "515.6 ms"), (2e-9, "2 ns")];
        for (seconds, text) in expected {
            assert_eq!(duration(seconds), text);
        }
    }
}
