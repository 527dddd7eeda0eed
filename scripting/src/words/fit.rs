//! The words for what a scenario is fitted to, and what may vary for it.

use rhai::Dynamic;
use rhai::plugin::*;

use super::{Closure, Number, Text, expect};
use crate::error::Complaint;
use crate::expectation::When;
use crate::fit::{Aim, Variable};
use crate::number;
use crate::session::{self, RhaiResultOf, Site};

/// Targets a script may have.
const MOST_TARGETS: usize = 1000;
/// Numbers a script may let vary: what is more, no search finds its way in.
const MOST_VARIED: usize = 50;
/// Characters the name of a tunable number may have.
const LONGEST_NAME: usize = 100;

#[export_module]
pub(crate) mod module {
    /// A number that should be 0 at the end of the run. `run` prints what it came to; `fit` finds values
    /// of what may `vary` that bring it there. Write it so that 1 is a lot: it is met when it is within 0.001.
    ///
    /// ```rhai
    /// target("car2 stops near the kerb", |world| world["car2"].x - 12);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn target(context: NativeCallContext, text: Text, residual: Closure) -> RhaiResultOf<()> {
        aim(&context, &text, &Dynamic::from_float(1.0), &residual)
    }

    /// A target that counts more or less than others: its number is multiplied by `weight`, greater than 0, before it is
    /// compared with anything.
    ///
    /// ```rhai
    /// target("it stands straight", 10, |world| world["car2"].angle);
    /// ```
    #[rhai_fn(name = "target", return_raw)]
    pub fn weighted_target(
        context: NativeCallContext,
        text: Text,
        weight: Number,
        residual: Closure,
    ) -> RhaiResultOf<()> {
        aim(&context, &text, &weight, &residual)
    }

    /// What `fit` may change, and between what: `mu_l`, `mu_a`, `epsilon`, `restitution`, `friction`, or a
    /// `param` by its name in quotes. It changes nothing in other calls.
    ///
    /// ```rhai
    /// vary(mu_l, 0, 1);
    /// vary("push", 5, 20);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn vary(context: NativeCallContext, name: Text, min: Number, max: Number) -> RhaiResultOf<()> {
        let range = number::pair(number::finite, ("vary: min", &min), ("vary: max", &max));
        let range = range.map_err(|complaint| session::complain(complaint, context.call_position()))?;
        let_vary(&context, &name, Some(range))
    }

    /// A `param` that `fit` may change within its own range.
    ///
    /// ```rhai
    /// let push = param("push", 8, 0, 30);
    /// vary("push");
    /// ```
    #[rhai_fn(name = "vary", return_raw)]
    pub fn vary_param(context: NativeCallContext, name: Text) -> RhaiResultOf<()> {
        let_vary(&context, &name, None)
    }
}

fn aim(context: &NativeCallContext, text: &Dynamic, weight: &Dynamic, residual: &Dynamic) -> RhaiResultOf<()> {
    session::with(context, |session| {
        let pending = expect::pending(context, session, text, residual, When::Measured)?;
        if session.aims.len() >= MOST_TARGETS {
            return Err(Complaint::new(format!("a script may have {MOST_TARGETS} targets at most")));
        }
        let weight = number::positive(&format!("target \"{}\": weight", pending.text), weight)?;
        session.aims.push(Aim { pending, weight });
        Ok(())
    })
}

fn let_vary(context: &NativeCallContext, name: &Dynamic, range: Option<(f64, f64)>) -> RhaiResultOf<()> {
    session::with(context, |session| {
        session.draft("vary")?;
        if !name.is_string() {
            return Err(
                number::must_be("vary: name", "a string", name).hint("write vary(mu_l, …) or vary(\"push\", …)")
            );
        }
        let name = number::label("vary: name", name, LONGEST_NAME)?;
        let site = Site::of(context);
        if let Some(known) = session.variables.iter().find(|known| known.name == name.as_str()) {
            let line = known.site.seen_from(&site);
            return Err(Complaint::new(format!("vary {name}: that stands in {line} already")));
        }
        if session.variables.len() >= MOST_VARIED {
            return Err(Complaint::new(format!("a script may let {MOST_VARIED} numbers vary at most")));
        }
        session.variables.push(Variable::new(&name, range, site)?);
        Ok(())
    })
}
