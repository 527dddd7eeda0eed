//! "Did you mean …?"

/// Nobody means a word by something longer; comparing takes time with the square of the length.
const LONGEST: usize = 100;

/// The candidate nearest to what was written, if any is near enough to be meant.
pub(crate) fn nearest<'a>(written: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = match written.chars().count() {
        0 | 1 => 0, // any other letter would be near to one letter
        LONGEST.. => 0,
        2..=5 => 1,
        6..=8 => 2,
        _ => 3,
    };
    if allowed == 0 {
        return None;
    }
    candidates
        .into_iter()
        .filter(|candidate| *candidate != written && candidate.len().abs_diff(written.len()) <= 4 * allowed)
        .map(|candidate| (distance(written, candidate), candidate))
        .filter(|(distance, _)| *distance <= allowed)
        .min()
        .map(|(_, candidate)| candidate)
}

/// A hint with the nearest candidate, shown by `show`.
pub(crate) fn did_you_mean<'a>(
    written: &str,
    candidates: impl IntoIterator<Item = &'a str>,
    show: impl Fn(&str) -> String,
) -> Option<String> {
    nearest(written, candidates).map(|name| format!("did you mean `{}`?", show(name)))
}

/// Letters to change, capitals aside: `Time_Step` is `time_step`.
fn distance(a: &str, b: &str) -> usize {
    strsim::osa_distance(&a.to_lowercase(), &b.to_lowercase())
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_of_the_pen_finds_its_word_and_a_stranger_finds_none() {
        let words = ["mobile", "fixed", "velocity", "mass"];
        assert_eq!(nearest("mobil", words), Some("mobile"));
        assert_eq!(nearest("velcoity", words), Some("velocity"));
        assert_eq!(nearest("Mass", words), Some("mass"));
        assert_eq!(nearest("teapot", words), None);
        assert_eq!(nearest("x", ["E", "y"]), None);
    }
}
