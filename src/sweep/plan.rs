//! A plan: which scenarios to run with which numbers, and what to draw of it.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

use choque_scripting::Diagnostic;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};

use super::axis::{self, Axis, Value};
use super::points::Points;
use super::sobol;
use crate::Error;

/// What a `.ron` file says; paths count from its folder.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename = "Sweep", deny_unknown_fields)]
pub struct Plan {
    /// Scenarios, or patterns with `*` and `**`.
    pub scenarios: Vec<String>,
    /// How points are laid over what varies.
    #[serde(default)]
    pub points: Points,
    /// What varies.
    #[serde(default)]
    pub vary: Vec<Axis>,
    /// What is the same in every run.
    #[serde(default)]
    pub set: BTreeMap<String, Value>,
    /// Seeds that every point is run with; none: the scenario's own.
    #[serde(default, deserialize_with = "seeds")]
    pub seeds: Vec<i64>,
    /// What else to tell of each run's end: `car.x`, a body and one of x, z, angle, vx, vz, spin, speed.
    #[serde(default)]
    pub read: Vec<String>,
    /// What to draw; left out: what suits the points.
    #[serde(default)]
    pub plots: Option<Vec<Drawn>>,
}

/// A plot that a plan asks for.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Drawn {
    /// A column over two others, as colours.
    HeatMap {
        /// Along the bottom.
        x: String,
        /// Along the left side.
        y: String,
        /// What the colours tell.
        value: String,
    },
    /// Columns over another, a curve each, or one for each value of `by`.
    Curves {
        /// Along the bottom.
        x: String,
        /// Along the left side; several in one unit.
        y: Vec<String>,
        /// What tells curves apart.
        #[serde(default)]
        by: Option<String>,
    },
}

impl Drawn {
    /// The columns it needs, and whether each has to be a number.
    pub fn columns(&self) -> impl Iterator<Item = (&String, bool)> {
        let (x, y, value, by): (_, &[String], _, _) = match self {
            Drawn::HeatMap { x, y, value } => (x, std::slice::from_ref(y), Some(value), None),
            Drawn::Curves { x, y, by } => (x, y.as_slice(), None, by.as_ref()),
        };
        std::iter::once(x).chain(y).chain(value).map(|name| (name, true)).chain(by.map(|name| (name, false)))
    }
}

/// A plan with the file it stands in.
#[derive(Clone, Debug)]
pub struct PlanFile {
    /// The file, as the caller wrote it.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
    /// What it says.
    pub plan: Plan,
}

/// Seeds a range may have, and points a plan.
const MOST: usize = 10_000_000;

const FIELDS: &str = "a plan has scenarios, points, vary, set, seeds, read and plots";

impl PlanFile {
    /// Reads a plan and checks what can be checked without its scenarios.
    ///
    /// # Errors
    /// What is no plan, or asks for what cannot be: with line, column and what to write instead.
    pub fn read(path: &Path) -> Result<PlanFile, Error> {
        if path.extension().is_none_or(|extension| extension != "ron") {
            let message = format!("{} is no name for a plan", path.display());
            return Err(Error::Call { message, hint: "a plan's file name ends in .ron".to_owned() });
        }
        if !path.is_file() {
            let message = format!("cannot read {}: there is no such file", path.display());
            return Err(Diagnostic::new(message).in_file(path).into());
        }
        let text = std::fs::read_to_string(path).map_err(|source| Error::File {
            verb: "read",
            path: path.to_owned(),
            source,
        })?;
        let options = ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME);
        let plan: Plan = options.from_str(&text).map_err(|error| not_a_plan(path, &text, &error))?;
        let file = PlanFile { path: path.to_owned(), text, plan };
        file.check()?;
        Ok(file)
    }

    /// A complaint shown where a name first stands in quotes or as a key, or else about the whole file.
    #[must_use]
    pub fn complain(&self, about: &str, message: String, hint: Option<String>) -> Error {
        let forms = [format!("{about:?}"), format!("{about}:")];
        let uncommented = |line: &str| line.find("//").map_or(line.len(), |comment| comment);
        let found = self.text.lines().enumerate().find_map(|(number, line)| {
            let at = forms.iter().find_map(|form| line.find(form.as_str()).filter(|at| *at < uncommented(line)))?;
            Some((number + 1, line[..at].chars().count() + 1))
        });
        let diagnostic = match found {
            Some((line, column)) => Diagnostic::new(message).at(&self.path, &self.text, line, column),
            None => Diagnostic::new(message).in_file(&self.path),
        };
        diagnostic.with_hint(hint).into()
    }

    fn check(&self) -> Result<(), Error> {
        let plan = &self.plan;
        if plan.scenarios.is_empty() {
            let hint = "scenarios: [\"crash.rhai\"]".to_owned();
            return Err(self.complain("scenarios", "a plan needs scenarios".to_owned(), Some(hint)));
        }
        for (place, axis) in plan.vary.iter().enumerate() {
            self.check_axis(axis)?;
            let again = plan.vary[..place].iter().any(|other| other.name == axis.name);
            if again || plan.set.contains_key(&axis.name) {
                let twice = if again { "is varied twice" } else { "is varied and set" };
                return Err(self.complain(&axis.name, format!("{} {twice}", axis.name), None));
            }
        }
        for (name, value) in &plan.set {
            axis::check_value(name, value).map_err(|why| self.complain(name, why, None))?;
        }
        self.check_points()
    }

    fn check_axis(&self, axis: &Axis) -> Result<(), Error> {
        let Axis { name, from, to, count, values, .. } = axis;
        let refuse = |message: String, hint: &str| Err(self.complain(name, message, Some(hint.to_owned())));
        let forms = "(name: \"speed\", from: 5, to: 30, count: 6), or values: [5, 10, 20]";
        if values.is_empty() != (from.is_some() && to.is_some()) || !values.is_empty() && (from.or(*to)).is_some() {
            return refuse(format!("{name} needs from and to, or values"), forms);
        }
        if let Some((from, to)) = axis.range().filter(|(from, to)| from > to) {
            return refuse(format!("{name}: from must not be above to, but {from} is above {to}"), forms);
        }
        match (&self.plan.points, values.is_empty(), count) {
            (Points::Grid, true, None | Some(0)) => return refuse(format!("{name}: a grid needs a count"), forms),
            (Points::Grid, true, Some(count)) if *count > MOST => {
                return refuse(format!("{name}: {count} values are too many"), "a plan may have 10000000 points");
            }
            (Points::Grid, true, _) | (_, _, None) => {}
            _ => return refuse(format!("{name}: count says nothing here"), "only a grid counts, from … to …"),
        }
        let ends = axis.range().map(|(from, to)| [Value::Number(from), Value::Number(to)]);
        let levels = (0..if ends.is_none() || self.plan.points == Points::Grid { axis.levels() } else { 0 })
            .map(|place| axis.level(place));
        let mut values = levels.chain(ends.into_iter().flatten());
        values.try_for_each(|value| axis::check_value(name, &value)).map_err(|why| self.complain(name, why, None))
    }

    fn check_points(&self) -> Result<(), Error> {
        let plan = &self.plan;
        let refuse = |message: String, hint: &str| Err(self.complain("points", message, Some(hint.to_owned())));
        if matches!(plan.points, Points::Sobol { .. }) && plan.vary.len() > sobol::MOST_DIMENSIONS {
            let most = sobol::MOST_DIMENSIONS;
            return refuse(format!("{} things vary; Sobol has {most} at most", plan.vary.len()), "use LatinHypercube");
        }
        match plan.points.count(&plan.vary).filter(|count| *count <= MOST) {
            Some(0) => refuse("points: count is 0, and a plan needs points".to_owned(), "count: 1 or more"),
            Some(_) => Ok(()),
            None => refuse(format!("these are more than {MOST} points"), "vary less, or take a LatinHypercube"),
        }
    }
}

/// What the text has that no plan has.
fn not_a_plan(path: &Path, text: &str, error: &ron::error::SpannedError) -> Error {
    let said = match error.code {
        ron::Error::ExpectedFloat => "a number is expected".to_owned(),
        ron::Error::ExpectedInteger => "a whole number is expected".to_owned(),
        ron::Error::ExpectedString => "a text in quotes is expected".to_owned(),
        _ => error.code.to_string(),
    };
    let mut letters = said.chars();
    let said: String = letters.next().into_iter().flat_map(char::to_lowercase).chain(letters).collect();
    let hint = match error.code {
        ron::Error::NoSuchStructField { .. } | ron::Error::MissingStructField { .. } => Some(FIELDS.to_owned()),
        ron::Error::NoSuchEnumVariant { .. } => {
            Some("points are Grid, LatinHypercube(count: 100) or Sobol(count: 128); plots HeatMap or Curves".to_owned())
        }
        _ => None,
    };
    let at = error.span.start;
    let said = match key_of(text, error) {
        Some((key, value)) => format!("{key} is {value}: {said}"),
        None => said,
    };
    Diagnostic::new(format!("not a plan: {said}")).at(path, text, at.line, at.col).with_hint(hint).into()
}

/// The key whose value an error is about, and that value as it is written.
fn key_of<'a>(text: &'a str, error: &ron::error::SpannedError) -> Option<(&'a str, &'a str)> {
    use ron::Error::{ExpectedFloat, ExpectedInteger, ExpectedString, IntegerOutOfBounds, InvalidValueForType};
    let of_value = [ExpectedFloat, ExpectedInteger, ExpectedString, IntegerOutOfBounds].contains(&error.code);
    if !of_value && !matches!(error.code, InvalidValueForType { .. }) {
        return None;
    }
    let at = error.span.start;
    let (number, row) = text.lines().enumerate().find(|(number, _)| number + 1 == at.line)?;
    let column = row.char_indices().nth(at.col.saturating_sub(1)).map_or(row.len(), |(byte, _)| byte);
    let before = text.lines().take(number).map(|line| line.len() + 1).sum::<usize>() + column;
    let colon = text.get(..before)?.rfind(':')?;
    let key =
        text[..colon].rsplit(|c: char| !(c.is_alphanumeric() || c == '_')).next().filter(|key| !key.is_empty())?;
    let value = text[colon + 1..].split([',', ')', ']', '\n']).next()?.trim();
    Some((key, value))
}

/// `[1, 2, 3]` or `(first: 1, count: 3)`.
fn seeds<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<i64>, D::Error> {
    deserializer.deserialize_any(ListOrRange)
}

struct ListOrRange;

impl<'de> Visitor<'de> for ListOrRange {
    type Value = Vec<i64>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("seeds as [1, 2, 3] or (first: 1, count: 3)")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<i64>, A::Error> {
        std::iter::from_fn(|| list.next_element().transpose()).collect()
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Vec<i64>, A::Error> {
        let (mut first, mut count) = (0, None);
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "first" => first = map.next_value()?,
                "count" => count = Some(map.next_value::<u32>()?),
                other => return Err(de::Error::unknown_field(other, &["first", "count"])),
            }
        }
        let count = count.ok_or_else(|| de::Error::missing_field("count"))?;
        let last = i64::checked_add(first, i64::from(count)).filter(|_| count as usize <= MOST);
        last.map(|last| (first..last).collect()).ok_or_else(|| de::Error::custom("these are too many seeds"))
    }
}
