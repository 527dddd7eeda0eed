//! The words of the one reproducible generator.

use rhai::plugin::*;

use super::Number;
use crate::error::Complaint;
use crate::generator::Generator;
use crate::number;
use crate::session::{self, Phase, RhaiResultOf};

#[export_module]
pub(crate) mod module {
    /// Starts the generator of random numbers anew from a whole number. Default: 0. The same seed gives the same
    /// numbers on every machine (the generator is SplitMix64). `--seed` wins over what the main part says.
    ///
    /// ```rhai
    /// seed(7);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn seed(context: NativeCallContext, n: Number) -> RhaiResultOf<()> {
        session::with(&context, |session| {
            let mut seed = number::whole("seed", &n)?;
            if let Phase::Building(draft) = &mut session.phase {
                seed = session.seed.unwrap_or(seed);
                draft.scene.settings.seed = seed;
            }
            session.generator = Generator::new(seed);
            Ok(())
        })
    }

    /// A random number from `min` to `max`. Also in callbacks: they go on where the main part stopped.
    ///
    /// ```rhai
    /// for i in 0..5 { mobile("crate" + i).rect(1, 1).at(random(-10, 10), random(-10, 10)); }
    /// ```
    #[rhai_fn(return_raw)]
    pub fn random(context: NativeCallContext, min: Number, max: Number) -> RhaiResultOf<f64> {
        session::with(&context, |session| {
            let (min, max) = (number::finite("random: min", &min)?, number::finite("random: max", &max)?);
            in_order("random", min <= max, min, max)?;
            Ok(session.generator.between(min, max))
        })
    }

    /// A random whole number from `min` to `max`, both included, each equally likely.
    ///
    /// ```rhai
    /// let lane = random_int(0, 2);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn random_int(context: NativeCallContext, min: Number, max: Number) -> RhaiResultOf<i64> {
        session::with(&context, |session| {
            let (min, max) = (number::whole("random_int: min", &min)?, number::whole("random_int: max", &max)?);
            in_order("random_int", min <= max, min, max)?;
            Ok(session.generator.whole_between(min, max))
        })
    }
}

fn in_order<T: std::fmt::Display>(word: &str, holds: bool, min: T, max: T) -> Result<(), Complaint> {
    let wrong = || Complaint::new(format!("{word}: min must not be above max, but {min} is above {max}"));
    if holds { Ok(()) } else { Err(wrong()) }
}
