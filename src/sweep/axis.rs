//! What a plan varies: a param, a setting, over a range or a list of values.

use std::fmt;

use choque_engine::check;
use choque_engine::scene::{Detection, ExchangeRule, MotionRule};
use choque_scripting::Overrides;
use serde::de::{self, Deserialize, Deserializer, Visitor};

/// A number or a setting's word.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Of a param, or of a setting that is a number.
    Number(f64),
    /// Of `exchange`, `detection` or `motion`.
    Word(String),
}

/// One thing that a plan varies, as it is written.
#[derive(Clone, Debug, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// A `param` of the scenarios, or a setting.
    pub name: String,
    /// The unit that plots show.
    #[serde(default)]
    pub unit: Option<String>,
    /// Where it begins; with `to`.
    #[serde(default)]
    pub from: Option<f64>,
    /// Where it ends, included.
    #[serde(default)]
    pub to: Option<f64>,
    /// How many values a grid takes from there to there.
    #[serde(default)]
    pub count: Option<usize>,
    /// The values, in place of `from` and `to`.
    #[serde(default)]
    pub values: Vec<Value>,
}

/// Settings that are words, each with the words it takes.
const WORDS: [(&str, &[&str]); 3] =
    [("exchange", ExchangeRule::WORDS), ("detection", Detection::WORDS), ("motion", MotionRule::WORDS)];

/// Settings that are numbers but no `--set`.
const NUMBERS: [&str; 3] = ["time_step", "steps", "substeps"];

/// Settings that `--set` reaches.
const SET: [&str; 5] = ["mu_l", "mu_a", "epsilon", "restitution", "friction"];

/// Every setting a plan may vary.
pub fn settings() -> impl Iterator<Item = &'static str> {
    SET.into_iter().chain(NUMBERS).chain(WORDS.map(|(name, _)| name))
}

/// Whether a name is a setting's: no scenario needs a param for it.
#[must_use]
pub fn is_setting(name: &str) -> bool {
    settings().any(|setting| setting == name)
}

/// Refuses a value that no run could have under that name.
///
/// # Errors
/// Why not.
pub fn check_value(name: &str, value: &Value) -> Result<(), String> {
    let words = WORDS.iter().find(|(setting, _)| *setting == name).map(|(_, words)| *words);
    match (words, value) {
        (Some(words), Value::Word(word)) if words.contains(&word.as_str()) => Ok(()),
        (Some(words), _) => Err(format!("{name} must be one of {}, not {value}", words.join(", "))),
        (None, Value::Word(_)) => Err(format!("{name} must be a number, not {value}")),
        (None, Value::Number(number)) => check_number(name, *number),
    }
}

fn check_number(name: &str, number: f64) -> Result<(), String> {
    let checked = match name {
        "time_step" => check::positive(name, number),
        "restitution" => check::unit_range(name, number),
        "mu_l" | "mu_a" | "epsilon" | "friction" => check::not_negative(name, number),
        "steps" if number.fract() != 0.0 => return Err(format!("steps must be a whole number, not {number}")),
        "steps" => check::not_negative(name, number),
        "substeps" if number.fract() != 0.0 => return Err(format!("substeps must be a whole number, not {number}")),
        "substeps" => check::substeps(name, number as i64).map(f64::from),
        _ => check::finite(name, number),
    };
    checked.map(drop).map_err(|bad| bad.to_string())
}

/// Puts a value where a run takes it from.
pub fn apply(name: &str, value: &Value, set: &mut Vec<(String, f64)>, overrides: &mut Overrides) {
    match (name, value) {
        ("exchange", Value::Word(word)) => overrides.exchange = ExchangeRule::from_word(word),
        ("detection", Value::Word(word)) => overrides.detection = Detection::from_word(word),
        ("motion", Value::Word(word)) => overrides.motion = MotionRule::from_word(word),
        ("time_step", Value::Number(number)) => overrides.time_step = Some(*number),
        ("steps", Value::Number(number)) => overrides.steps = Some(*number as u64),
        ("substeps", Value::Number(number)) => overrides.substeps = Some(*number as u32),
        (_, Value::Number(number)) => set.push((name.to_owned(), *number)),
        (_, Value::Word(_)) => {} // refused by `check_value`
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Number(number) => f.write_str(&check::shown(*number)),
            Value::Word(word) => write!(f, "\"{word}\""),
        }
    }
}

impl Axis {
    /// The ends of its range, if it has one.
    #[must_use]
    pub fn range(&self) -> Option<(f64, f64)> {
        self.from.zip(self.to)
    }

    /// Whether every value is a number.
    #[must_use]
    pub fn is_numeric(&self) -> bool {
        self.values.iter().all(|value| matches!(value, Value::Number(_)))
    }

    /// How many values a grid takes.
    #[must_use]
    pub fn levels(&self) -> usize {
        if self.values.is_empty() { self.count.unwrap_or(0) } else { self.values.len() }
    }

    /// A grid's value by its place. The ends are exact.
    #[must_use]
    pub fn level(&self, place: usize) -> Value {
        match self.range() {
            None => self.values[place].clone(),
            Some((_, to)) if place > 0 && place + 1 == self.levels() => Value::Number(to),
            Some((from, to)) => {
                let gaps = self.levels().saturating_sub(1).max(1) as f64;
                Value::Number(from + (to - from) * (place as f64 / gaps))
            }
        }
    }

    /// The value at a share from 0 up to 1 of the way; whole for settings that are.
    #[must_use]
    pub fn at(&self, share: f64) -> Value {
        match self.range() {
            None => self.values[((share * self.values.len() as f64) as usize).min(self.values.len() - 1)].clone(),
            Some((from, to)) => {
                let number = from + (to - from) * share;
                Value::Number(if matches!(self.name.as_str(), "steps" | "substeps") { number.round() } else { number })
            }
        }
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberOrWord)
    }
}

struct NumberOrWord;

impl Visitor<'_> for NumberOrWord {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a word in quotes")
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Value, E> {
        Ok(Value::Number(number))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Value, E> {
        Ok(Value::Number(number as f64))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Value, E> {
        Ok(Value::Number(number as f64))
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Value, E> {
        Ok(Value::Word(word.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_ends_where_it_says() {
        let axis = Axis {
            name: "x".to_owned(),
            unit: None,
            from: Some(0.1),
            to: Some(0.7),
            count: Some(4),
            values: Vec::new(),
        };
        assert_eq!(axis.level(0), Value::Number(0.1));
        assert_eq!(axis.level(3), Value::Number(0.7));
        assert_eq!(Axis { count: Some(1), ..axis.clone() }.level(0), Value::Number(0.1));
        assert_eq!(axis.at(0.0), Value::Number(0.1));
    }

    #[test]
    fn settings_refuse_what_they_cannot_be() {
        let refused = [
            ("steps", Value::Number(1.5)),
            ("substeps", Value::Number(0.0)),
            ("time_step", Value::Number(0.0)),
            ("mu_l", Value::Number(-1.0)),
            ("restitution", Value::Number(1.5)),
            ("exchange", Value::Word("magic".to_owned())),
            ("exchange", Value::Number(1.0)),
            ("speed", Value::Word("fast".to_owned())),
            ("speed", Value::Number(f64::INFINITY)),
        ];
        for (name, value) in refused {
            assert!(check_value(name, &value).is_err(), "{name}: {value:?}");
        }
    }
}
