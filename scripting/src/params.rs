//! Tunable numbers: `param` in the script, `--set NAME=VALUE` from outside.

use std::collections::BTreeMap;

use choque_engine::check;
use choque_engine::scene::{Param, Settings};
use rhai::{Dynamic, ImmutableString};

use crate::control::Control;
use crate::error::Complaint;
use crate::number;
use crate::session::Site;
use crate::suggest::did_you_mean;

/// Settings that `--set` reaches by their own names.
pub(crate) const SETTINGS: [&str; 5] = ["mu_l", "mu_a", "epsilon", "restitution", "friction"];

/// The value of one of them.
pub(crate) fn setting(settings: &Settings, name: &str) -> Option<f64> {
    match name {
        "mu_l" => Some(settings.mu_l),
        "mu_a" => Some(settings.mu_a),
        "epsilon" => Some(settings.epsilon),
        "restitution" => Some(settings.restitution),
        "friction" => Some(settings.friction),
        _ => None,
    }
}

/// Tunable numbers a script may declare.
const MOST_PARAMS: usize = 1000;

/// The tunable numbers of a script.
#[derive(Default)]
pub(crate) struct Params {
    /// What `--set` says.
    given: BTreeMap<String, f64>,
    declared: Vec<Declared>,
}

struct Declared {
    param: Param,
    default: f64,
    /// Whether the script wrote its default, and its bounds if any, as whole numbers.
    is_whole: bool,
    /// What the script gets: a whole number stays one, so that it can count.
    value: Dynamic,
    site: Site,
}

impl Params {
    /// With what `--set` says; of a name given twice the last value counts.
    ///
    /// # Errors
    /// A value that is not finite, or that a setting cannot have.
    pub(crate) fn new(given: &[(String, f64)]) -> Result<Self, Complaint> {
        for (name, value) in given {
            let checked = check_setting(name, *value);
            checked.map_err(|bad| Complaint::new(format!("--set {name}={value}: {bad}")))?;
        }
        Ok(Params { given: given.iter().cloned().collect(), declared: Vec::new() })
    }

    /// Declares a number, or reads one declared before.
    pub(crate) fn declare(
        &mut self,
        name: &ImmutableString,
        default: &Dynamic,
        range: Option<(f64, f64)>,
        site: Site,
    ) -> Result<Dynamic, Complaint> {
        let number = number::finite(&format!("param \"{name}\": default"), default)?;
        if let Some(known) = self.declared.iter().find(|known| known.param.name == name.as_str()) {
            return known.again(number, range, &site);
        }
        check_range(name, number, range)?;
        if self.declared.len() >= MOST_PARAMS {
            return Err(Complaint::new(format!("a script may have {MOST_PARAMS} params at most")));
        }
        let given = self.given.get(name.as_str()).copied();
        let value = given.unwrap_or(number);
        check_given(name, value, range)?;
        let param = Param { name: name.to_string(), value, range };
        let is_whole = default.is_int() && range.is_none_or(|(min, max)| is_whole(min) && is_whole(max));
        let declared = Declared { param, default: number, is_whole, value: as_written(default, value), site };
        let value = declared.value.clone();
        self.declared.push(declared);
        Ok(value)
    }

    /// A number declared in the main part, read again in a callback.
    pub(crate) fn recall(
        &self,
        name: &str,
        default: &Dynamic,
        range: Option<(f64, f64)>,
        site: &Site,
    ) -> Result<Dynamic, Complaint> {
        let number = number::finite(&format!("param \"{name}\": default"), default)?;
        match self.declared.iter().find(|known| known.param.name == name) {
            Some(known) => known.again(number, range, site),
            None => Err(Complaint::new(format!("param(\"{name}\", …) is not declared in the main part of the script"))
                .hint("declare it there too, so that --set and the tools know it before the run begins")),
        }
    }

    /// Where a number is declared.
    pub(crate) fn site_of(&self, name: &str) -> Option<&Site> {
        self.declared.iter().find(|known| known.param.name == name).map(|known| &known.site)
    }

    /// The first name of `--set` that nothing answers to.
    pub(crate) fn unanswered(&self) -> Option<Complaint> {
        let names = || self.declared.iter().map(|known| known.param.name.as_str()).chain(SETTINGS);
        let stranger = self.given.keys().find(|given| names().all(|name| name != given.as_str()))?;
        let list = names().collect::<Vec<_>>().join(", ");
        Some(
            Complaint::new(format!("--set {stranger}: the scenario has no param of that name"))
                .hint(format!("there are {list}"))
                .maybe_hint(did_you_mean(stranger, names(), str::to_owned)),
        )
    }

    /// Has `--set` win over what the script said of the settings it reaches.
    pub(crate) fn apply_to(&self, settings: &mut Settings) {
        for (name, value) in &self.given {
            match name.as_str() {
                "mu_l" => settings.mu_l = *value,
                "mu_a" => settings.mu_a = *value,
                "epsilon" => settings.epsilon = *value,
                "restitution" => settings.restitution = *value,
                "friction" => settings.friction = *value,
                _ => {}
            }
        }
    }

    /// What may be tuned of it, in order of declaration.
    pub(crate) fn controls(&self) -> impl Iterator<Item = Control> {
        self.declared.iter().map(|known| Control {
            name: known.param.name.clone(),
            is_param: true,
            value: known.param.value,
            written: known.default,
            range: known.param.range,
            is_whole: known.is_whole,
        })
    }

    /// The numbers and their values, for the scene's record.
    pub(crate) fn record(&self) -> Vec<Param> {
        self.declared.iter().map(|known| known.param.clone()).collect()
    }
}

impl Declared {
    fn again(&self, default: f64, range: Option<(f64, f64)>, site: &Site) -> Result<Dynamic, Complaint> {
        let name = &self.param.name;
        let line = self.site.seen_from(site);
        if default != self.default {
            return Err(Complaint::new(format!(
                "param \"{name}\" has the default {} in {line}, and {default} here",
                self.default
            ))
            .hint("use one default, or keep the value in a variable"));
        }
        if range.is_some() && range != self.param.range {
            return Err(Complaint::new(format!("param \"{name}\" has another range in {line}")));
        }
        Ok(self.value.clone())
    }
}

pub(crate) fn check_setting(name: &str, value: f64) -> Result<f64, choque_engine::BadNumber> {
    match name {
        "mu_l" | "mu_a" | "epsilon" | "friction" => check::not_negative(name, value),
        "restitution" => check::unit_range(name, value),
        _ => check::finite(name, value),
    }
}

fn check_range(name: &str, default: f64, range: Option<(f64, f64)>) -> Result<(), Complaint> {
    if SETTINGS.contains(&name) {
        return Err(Complaint::new(format!("param \"{name}\": a setting has that name, and --set reaches it already"))
            .hint(format!("name it otherwise, or write {name}(…)")));
    }
    let Some((min, max)) = range else { return Ok(()) };
    if min > max {
        return Err(Complaint::new(format!("param \"{name}\": min must not be above max, but {min} is above {max}")));
    }
    if default < min || default > max {
        return Err(Complaint::new(format!("param \"{name}\": the default {default} is outside {min} … {max}")));
    }
    Ok(())
}

fn check_given(name: &str, value: f64, range: Option<(f64, f64)>) -> Result<(), Complaint> {
    match range {
        Some((min, max)) if value < min || value > max => {
            Err(Complaint::new(format!("--set {name}={value}: the script allows {min} … {max}")))
        }
        _ => Ok(()),
    }
}

fn is_whole(bound: f64) -> bool {
    libm::trunc(bound) == bound
}

/// Where the script wrote a whole number and the value is whole, a whole number.
fn as_written(default: &Dynamic, value: f64) -> Dynamic {
    match number::whole("", &Dynamic::from_float(value)) {
        Ok(whole) if default.is_int() => Dynamic::from_int(whole),
        _ => Dynamic::from_float(value),
    }
}
