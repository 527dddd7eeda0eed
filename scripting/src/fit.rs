//! What a script wants and what may vary for it: `target` and `vary`, for `choque fit`.

use choque_engine::Scene;
use rhai::Dynamic;

use crate::error::{Complaint, Diagnostic};
use crate::expectation::Pending;
use crate::handles;
use crate::number;
use crate::params::{SETTINGS, check_setting, setting};
use crate::script::Script;
use crate::session::Site;
use crate::suggest::did_you_mean;

/// What a script says of one of its targets when a run has ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// What the script calls it.
    pub text: String,
    /// How much it counts, greater than 0; 1 unless the script says otherwise.
    pub weight: f64,
    /// What it came to, to be brought to zero; may be NaN or infinite, as a script may divide by zero.
    pub residual: f64,
}

/// A number that may vary, and between what.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// Of a `param`, or `mu_l`, `mu_a`, `epsilon`, `restitution`, `friction`.
    pub name: String,
    /// Least and greatest value, finite, the first below the second.
    pub range: (f64, f64),
    /// What it is in this scenario, `--set` included.
    pub value: f64,
}

/// What a scenario says for a fit.
#[derive(Default)]
pub(crate) struct Wanted {
    pub(crate) varied: Vec<Varied>,
    /// How many targets it has.
    pub(crate) targets: usize,
}

/// A target as a script declares it.
pub(crate) struct Aim {
    pub(crate) pending: Pending,
    pub(crate) weight: f64,
}

/// What a script says may vary; whether there is such a name is known at the end of its main part only.
pub(crate) struct Variable {
    pub(crate) name: String,
    /// `None`: that of the param.
    pub(crate) range: Option<(f64, f64)>,
    pub(crate) site: Site,
}

impl Variable {
    /// For a name and a range, wherever they are said.
    pub(crate) fn new(name: &str, range: Option<(f64, f64)>, site: Site) -> Result<Self, Complaint> {
        if let Some((min, max)) = range {
            if min >= max {
                let message = format!("vary {name}: min must be below max, but {min} is not below {max}");
                return Err(Complaint::new(message));
            }
            for bound in [min, max] {
                check_setting(name, bound).map_err(|bad| Complaint::new(format!("vary {name}: {bad}")))?;
            }
        }
        Ok(Variable { name: name.to_owned(), range, site })
    }

    /// Looked up in the scene that the script made.
    pub(crate) fn resolve(&self, scene: &Scene) -> Result<Varied, Complaint> {
        let name = &self.name;
        let param = scene.params.iter().find(|param| param.name == *name);
        let known = setting(&scene.settings, name).or(param.map(|param| param.value));
        let value = known.ok_or_else(|| self.stranger(scene))?;
        let own = param.and_then(|param| param.range);
        let range = self.range.or(own).filter(|(min, max)| min < max).ok_or_else(|| {
            let written = if SETTINGS.contains(&name.as_str()) { name.clone() } else { format!("\"{name}\"") };
            match own {
                Some((only, _)) => Complaint::new(format!("vary {name}: its param allows {only} alone"))
                    .hint("give the param a range that it can vary in"),
                None => Complaint::new(format!("vary {name}: nothing says between what it may vary"))
                    .hint(format!("write vary({written}, min, max)")),
            }
        })?;
        match own {
            Some((min, max)) if range.0 < min || range.1 > max => Err(Complaint::new(format!(
                "vary {name}: {} … {} is wider than the {min} … {max} that its param allows",
                range.0, range.1
            ))),
            _ => Ok(Varied { name: name.clone(), range, value }),
        }
    }

    fn stranger(&self, scene: &Scene) -> Complaint {
        let names = || scene.params.iter().map(|param| param.name.as_str()).chain(SETTINGS);
        let list = names().collect::<Vec<_>>().join(", ");
        Complaint::new(format!("vary {}: the scenario has no param of that name", self.name))
            .hint(format!("there are {list}"))
            .maybe_hint(did_you_mean(&self.name, names(), str::to_owned))
    }
}

/// Asks a target about the world as it stands.
pub(crate) fn measure(script: &Script, aim: &Aim) -> Result<Target, Diagnostic> {
    script.session.borrow_mut().start_reading(); // it only looks, as an expectation does
    let answer = script.ask(&aim.pending, Dynamic::from(handles::World));
    let mut session = script.session.borrow_mut();
    let readings = session.readings.take().unwrap_or_default();
    session.reuse(readings);
    drop(session);
    let answer = answer?;
    let residual =
        number::any(&aim.pending.title(), &answer).map_err(|complaint| script.complain_of(&aim.pending, complaint))?;
    Ok(Target { text: aim.pending.text.to_string(), weight: aim.weight, residual })
}
