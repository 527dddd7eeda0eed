//! Operators that Rhai leaves to packages, or reads otherwise than a designer would.

use std::any::TypeId;

use rhai::plugin::*;
use rhai::{Dynamic, Engine};

use super::math::{power, too_large};
use crate::number;
use crate::session::{RhaiResultOf, complain};

/// The signs Rhai leaves to packages, and those it would read otherwise: `7 / 2` is 3.5, `2 ** -1` is 0.5.
#[export_module]
pub(crate) mod module {
    #[rhai_fn(name = "/")]
    pub fn quotient(a: i64, b: i64) -> f64 {
        a as f64 / b as f64
    }

    #[rhai_fn(name = "**", return_raw)]
    pub fn power_of_whole(context: NativeCallContext, x: i64, y: i64) -> RhaiResultOf<Dynamic> {
        power(&context, &x.into(), &y.into())
    }

    #[rhai_fn(name = "**")]
    pub fn power_of_floats(x: f64, y: f64) -> f64 {
        libm::pow(x, y)
    }

    #[rhai_fn(name = "**")]
    pub fn whole_to_float(x: i64, y: f64) -> f64 {
        libm::pow(x as f64, y)
    }

    #[rhai_fn(name = "**")]
    pub fn float_to_whole(x: f64, y: i64) -> f64 {
        libm::pow(x, y as f64)
    }

    #[rhai_fn(name = "-", return_raw)]
    pub fn minus_whole(context: NativeCallContext, x: i64) -> RhaiResultOf<i64> {
        x.checked_neg().ok_or_else(|| complain(too_large("-"), context.call_position()))
    }

    #[rhai_fn(name = "-")]
    pub fn minus_float(x: f64) -> f64 {
        -x
    }

    #[rhai_fn(name = "+")]
    pub fn plus_whole(x: i64) -> i64 {
        x
    }

    #[rhai_fn(name = "+")]
    pub fn plus_float(x: f64) -> f64 {
        x
    }

    #[rhai_fn(name = "!")]
    pub fn not(x: bool) -> bool {
        !x
    }
}

/// `x /= 2` and `x **= 2` may turn a whole number into one with decimals, which no typed function could.
pub(crate) fn register_assignments(engine: &mut Engine) {
    let (whole, float) = (TypeId::of::<i64>(), TypeId::of::<f64>());
    engine.register_raw_fn("/=", [whole, whole], |_, args| {
        let quotient = number::any("/=", args[0]).and_then(|a| Ok(a / number::any("/=", args[1])?));
        *args[0] = quotient.map_err(|wrong| complain(wrong, rhai::Position::NONE))?.into();
        Ok(Dynamic::UNIT)
    });
    for types in [[whole, whole], [whole, float], [float, whole], [float, float]] {
        engine.register_raw_fn("**=", types, |context, args| {
            *args[0] = power(&context, args[0], args[1])?;
            Ok(Dynamic::UNIT)
        });
    }
}
