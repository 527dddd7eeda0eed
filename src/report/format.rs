//! Numbers of a report as people read them.

/// `1/60` for what is a whole fraction of a second, else a short number.
#[must_use]
pub fn time_step_in_words(time_step: f64) -> String {
    let inverse = 1.0 / time_step;
    if inverse >= 1.5 && (inverse - inverse.round()).abs() <= 1e-6 * inverse {
        format!("1/{inverse:.0}")
    } else {
        significant(time_step)
    }
}

/// Three digits: `0.0123`, `1.23e-7`, `1230`.
#[must_use]
pub fn significant(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e6).contains(&size) => {
            let decimals = (2.0 - libm::floor(libm::log10(size))).max(0.0) as usize;
            crate::output::numbers::trimmed(&format!("{number:.decimals$}")).to_owned()
        }
        _ => format!("{number:.1e}"),
    }
}

/// Two digits, as an error is told; nothing is told of one that is not known.
#[must_use]
pub fn error(error: Option<f64>) -> String {
    error.map_or_else(|| "–".to_owned(), |error| if error == 0.0 { "0".to_owned() } else { format!("{error:.1e}") })
}

/// How many times: `7.3`, `250`, `1.2e7`.
#[must_use]
pub fn times(ratio: f64) -> String {
    match ratio {
        r if r >= 1e6 => format!("{r:.0e}"),
        r if r >= 10.0 => {
            let unit = libm::pow(10.0, libm::floor(libm::log10(r)) - 1.0);
            format!("{:.0}", (r / unit).round() * unit)
        }
        r => format!("{r:.1}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_steps_are_written_as_fractions() {
        let expected = [(1.0 / 60.0, "1/60"), (1.0 / 15360.0, "1/15360"), (0.3, "0.3"), (2.0, "2"), (0.01, "1/100")];
        for (time_step, text) in expected {
            assert_eq!(time_step_in_words(time_step), text);
        }
    }

    #[test]
    fn numbers_have_as_many_digits_as_say_something() {
        assert_eq!([significant(0.012345), significant(1234.5), significant(1.2e-7)], ["0.0123", "1234", "1.2e-7"]);
        assert_eq!([times(7.31), times(254.0), times(12.0), times(1.23e7)], ["7.3", "250", "12", "1e7"]);
        assert_eq!([error(None), error(Some(0.0)), error(Some(1.24e-3))], ["–", "0", "1.2e-3"]);
    }
}
