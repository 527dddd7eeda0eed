//! Mathematics, for whole numbers and others alike, and the same bits on every machine (`libm`).

use std::f64::consts::PI;

use rhai::plugin::*;
use rhai::{Dynamic, EvalAltResult};

use super::{Number, Text};
use crate::error::Complaint;
use crate::number;
use crate::session::{RhaiResultOf, complain};

#[export_module]
pub(crate) mod module {
    /// The constant `PI`, written as other scripts of the language write it: `PI()` is 3.1416.
    #[rhai_fn(name = "PI")]
    pub fn pi() -> f64 {
        PI
    }

    /// Degrees in radians: `deg(90)` is 1.5708, a right angle.
    #[rhai_fn(return_raw)]
    pub fn deg(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, |x| x / 180.0 * PI)
    }

    /// Radians in degrees: `to_degrees(PI)` is 180.
    #[rhai_fn(return_raw)]
    pub fn to_degrees(context: NativeCallContext, rad: Number) -> RhaiResultOf<f64> {
        real(&context, &rad, |rad| rad / PI * 180.0)
    }

    /// The sine of an angle \[rad\]: `sin(deg(30))` is 0.5.
    #[rhai_fn(return_raw)]
    pub fn sin(context: NativeCallContext, rad: Number) -> RhaiResultOf<f64> {
        real(&context, &rad, libm::sin)
    }

    /// The cosine of an angle \[rad\]: `cos(deg(60))` is 0.5.
    #[rhai_fn(return_raw)]
    pub fn cos(context: NativeCallContext, rad: Number) -> RhaiResultOf<f64> {
        real(&context, &rad, libm::cos)
    }

    /// The tangent of an angle \[rad\]: `tan(deg(45))` is 1.
    #[rhai_fn(return_raw)]
    pub fn tan(context: NativeCallContext, rad: Number) -> RhaiResultOf<f64> {
        real(&context, &rad, libm::tan)
    }

    /// The angle \[rad\] of a sine, in −π/2 … π/2; NaN outside −1 … 1. `to_degrees(asin(0.5))` is 30.
    #[rhai_fn(return_raw)]
    pub fn asin(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::asin)
    }

    /// The angle \[rad\] of a cosine, in 0 … π; NaN outside −1 … 1. `to_degrees(acos(0.5))` is 60.
    #[rhai_fn(return_raw)]
    pub fn acos(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::acos)
    }

    /// The angle \[rad\] of a tangent, in −π/2 … π/2: `to_degrees(atan(1))` is 45.
    #[rhai_fn(return_raw)]
    pub fn atan(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::atan)
    }

    /// The angle \[rad\] of the point (`x`, `y`), in −π … π. Mind the order: `atan2(z, x)`. `to_degrees(atan2(1, 0))` is 90.
    #[rhai_fn(name = "atan2", name = "atan", return_raw)]
    pub fn atan2(context: NativeCallContext, y: Number, x: Number) -> RhaiResultOf<f64> {
        real_of_two(&context, &y, &x, libm::atan2)
    }

    /// The hyperbolic sine: `sinh(1)` is 1.175.
    #[rhai_fn(return_raw)]
    pub fn sinh(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::sinh)
    }

    /// The hyperbolic cosine: `cosh(1)` is 1.543.
    #[rhai_fn(return_raw)]
    pub fn cosh(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::cosh)
    }

    /// The hyperbolic tangent: `tanh(1)` is 0.762.
    #[rhai_fn(return_raw)]
    pub fn tanh(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::tanh)
    }

    /// The number of a hyperbolic sine: `asinh(1)` is 0.881.
    #[rhai_fn(return_raw)]
    pub fn asinh(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::asinh)
    }

    /// The number of a hyperbolic cosine; NaN below 1. `acosh(2)` is 1.317.
    #[rhai_fn(return_raw)]
    pub fn acosh(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::acosh)
    }

    /// The number of a hyperbolic tangent; NaN outside −1 … 1. `atanh(0.5)` is 0.549.
    #[rhai_fn(return_raw)]
    pub fn atanh(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::atanh)
    }

    /// e to the power of `x`: `exp(1)` is 2.718.
    #[rhai_fn(return_raw)]
    pub fn exp(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::exp)
    }

    /// The natural logarithm; NaN below 0. `ln(E)` is 1.
    #[rhai_fn(return_raw)]
    pub fn ln(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::log)
    }

    /// The logarithm to base 10; NaN below 0. `log(1000)` is 3.
    #[rhai_fn(return_raw)]
    pub fn log(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::log10)
    }

    /// The logarithm to any base: `log(8, 2)` is 3.
    #[rhai_fn(name = "log", return_raw)]
    pub fn log_to_base(context: NativeCallContext, x: Number, base: Number) -> RhaiResultOf<f64> {
        real_of_two(&context, &x, &base, |x, base| libm::log(x) / libm::log(base))
    }

    /// The square root; NaN below 0. `sqrt(9)` is 3.
    #[rhai_fn(return_raw)]
    pub fn sqrt(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        real(&context, &x, libm::sqrt)
    }

    /// The length of the vector (`x`, `y`): `hypot(3, 4)` is 5.
    #[rhai_fn(return_raw)]
    pub fn hypot(context: NativeCallContext, x: Number, y: Number) -> RhaiResultOf<f64> {
        real_of_two(&context, &x, &y, libm::hypot)
    }

    /// `x` to the power of `y`, as `x ** y`: `pow(2, 10)` is 1024.
    #[rhai_fn(return_raw)]
    pub fn pow(context: NativeCallContext, x: Number, y: Number) -> RhaiResultOf<Number> {
        power(&context, &x, &y)
    }

    /// The number without its sign: `abs(-2)` is 2.
    #[rhai_fn(return_raw)]
    pub fn abs(context: NativeCallContext, x: Number) -> RhaiResultOf<Number> {
        kept(&context, &x, i64::checked_abs, libm::fabs)
    }

    /// −1, 0 or 1: `sign(-2)` is -1.
    #[rhai_fn(return_raw)]
    pub fn sign(context: NativeCallContext, x: Number) -> RhaiResultOf<Number> {
        let of_float = |x: f64| {
            if x > 0.0 {
                1.0
            } else if x < 0.0 {
                -1.0
            } else {
                x
            }
        };
        kept(&context, &x, |x| Some(x.signum()), of_float)
    }

    /// The whole number next below, or the number itself: `floor(-1.5)` is -2.
    #[rhai_fn(return_raw)]
    pub fn floor(context: NativeCallContext, x: Number) -> RhaiResultOf<Number> {
        kept(&context, &x, Some, libm::floor)
    }

    /// The whole number next above, or the number itself: `ceiling(1.2)` is 2.
    #[rhai_fn(return_raw)]
    pub fn ceiling(context: NativeCallContext, x: Number) -> RhaiResultOf<Number> {
        kept(&context, &x, Some, libm::ceil)
    }

    /// The nearest whole number; halves away from 0: `round(2.5)` is 3.
    #[rhai_fn(return_raw)]
    pub fn round(context: NativeCallContext, x: Number) -> RhaiResultOf<Number> {
        kept(&context, &x, Some, libm::round)
    }

    /// The smaller of two numbers: `min(2, 3)` is 2.
    #[rhai_fn(return_raw)]
    pub fn min(context: NativeCallContext, a: Number, b: Number) -> RhaiResultOf<Number> {
        let (x, y) = both(&context, &a, &b)?;
        Ok(if y < x { b } else { a })
    }

    /// The greater of two numbers: `max(2, 3)` is 3.
    #[rhai_fn(return_raw)]
    pub fn max(context: NativeCallContext, a: Number, b: Number) -> RhaiResultOf<Number> {
        let (x, y) = both(&context, &a, &b)?;
        Ok(if y > x { b } else { a })
    }

    /// The number, kept from `least` to `greatest`: `clamp(7, 0, 5)` is 5.
    #[rhai_fn(return_raw)]
    pub fn clamp(context: NativeCallContext, x: Number, least: Number, greatest: Number) -> RhaiResultOf<Number> {
        let (low, high) = both(&context, &least, &greatest)?;
        let value = one(&context, &x)?;
        if low > high {
            let wrong = format!("clamp: least must not be above greatest, but {low} is above {high}");
            return Err(complain(Complaint::new(wrong), context.call_position()));
        }
        Ok(if value < low {
            least
        } else if value > high {
            greatest
        } else {
            x
        })
    }

    /// The number a share of the way from `a` to `b`: `lerp(10, 20, 0.3)` is 13.
    #[rhai_fn(return_raw)]
    pub fn lerp(context: NativeCallContext, a: Number, b: Number, share: Number) -> RhaiResultOf<f64> {
        let ((a, b), share) = (both(&context, &a, &b)?, one(&context, &share)?);
        Ok(a + (b - a) * share)
    }

    /// The whole quotient of two whole numbers, towards 0: `div(7, 2)` is 3. `7 / 2` is 3.5.
    #[rhai_fn(return_raw)]
    pub fn div(context: NativeCallContext, a: Number, b: Number) -> RhaiResultOf<i64> {
        let fail = |complaint| complain(complaint, context.call_position());
        let (a, b) = (number::whole("div: a", &a).map_err(fail)?, number::whole("div: b", &b).map_err(fail)?);
        if b == 0 {
            return Err(fail(Complaint::new(format!("div: {a} cannot be divided by 0"))));
        }
        a.checked_div(b).ok_or_else(|| fail(too_large("div")))
    }

    /// A whole number of any number, towards 0: `to_int(2.7)` is 2.
    #[rhai_fn(return_raw)]
    pub fn to_int(context: NativeCallContext, x: Number) -> RhaiResultOf<i64> {
        if let Ok(whole) = x.as_int() {
            return Ok(whole);
        }
        let whole = libm::trunc(one(&context, &x)?);
        // 2⁶³ is the first f64 that no i64 reaches.
        let fits = (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&whole);
        let wrong = || complain(Complaint::new(format!("to_int: {whole} is no whole number")), context.call_position());
        fits.then_some(whole as i64).ok_or_else(wrong)
    }

    /// A number with decimals of any number: `to_float(2)` is 2.0.
    #[rhai_fn(return_raw)]
    pub fn to_float(context: NativeCallContext, x: Number) -> RhaiResultOf<f64> {
        one(&context, &x)
    }

    /// The whole number a string says: `parse_int("12")` is 12.
    #[rhai_fn(return_raw)]
    pub fn parse_int(context: NativeCallContext, text: Text) -> RhaiResultOf<i64> {
        parse(&context, &text, "a whole number")
    }

    /// The number a string says: `parse_float("1.5")` is 1.5.
    #[rhai_fn(return_raw)]
    pub fn parse_float(context: NativeCallContext, text: Text) -> RhaiResultOf<f64> {
        parse(&context, &text, "a number")
    }

    /// Whether it is NaN, which no number is: `is_nan(0.0 / 0.0)` is true.
    #[rhai_fn(return_raw)]
    pub fn is_nan(context: NativeCallContext, x: Number) -> RhaiResultOf<bool> {
        Ok(one(&context, &x)?.is_nan())
    }

    /// Whether it is neither infinite nor NaN: `is_finite(1.0 / 0.0)` is false.
    #[rhai_fn(return_raw)]
    pub fn is_finite(context: NativeCallContext, x: Number) -> RhaiResultOf<bool> {
        Ok(one(&context, &x)?.is_finite())
    }
}

fn one(context: &NativeCallContext, x: &Dynamic) -> RhaiResultOf<f64> {
    number::any("", x).map_err(|_| {
        let wrong = format!("`{}` works on numbers, not on {}", context.fn_name(), number::kind_of(x));
        complain(Complaint::new(wrong), context.call_position())
    })
}

fn both(context: &NativeCallContext, a: &Dynamic, b: &Dynamic) -> RhaiResultOf<(f64, f64)> {
    Ok((one(context, a)?, one(context, b)?))
}

fn real(context: &NativeCallContext, x: &Dynamic, f: fn(f64) -> f64) -> RhaiResultOf<f64> {
    one(context, x).map(f)
}

fn real_of_two(context: &NativeCallContext, x: &Dynamic, y: &Dynamic, f: fn(f64, f64) -> f64) -> RhaiResultOf<f64> {
    both(context, x, y).map(|(x, y)| f(x, y))
}

/// A whole number stays whole, another stays what it is.
fn kept(
    context: &NativeCallContext,
    x: &Dynamic,
    whole: fn(i64) -> Option<i64>,
    float: fn(f64) -> f64,
) -> RhaiResultOf<Dynamic> {
    match x.as_int() {
        Ok(x) => whole(x)
            .map(Dynamic::from_int)
            .ok_or_else(|| complain(too_large(context.fn_name()), context.call_position())),
        Err(_) => one(context, x).map(|x| Dynamic::from_float(float(x))),
    }
}

/// Whole to the power of whole and not negative is whole; all else is not.
pub(super) fn power(context: &NativeCallContext, x: &Dynamic, y: &Dynamic) -> RhaiResultOf<Dynamic> {
    let (Ok(base), Ok(exponent @ 0..)) = (x.as_int(), y.as_int()) else {
        return both(context, x, y).map(|(x, y)| Dynamic::from_float(libm::pow(x, y)));
    };
    let whole = u32::try_from(exponent).ok().and_then(|exponent| base.checked_pow(exponent));
    let small = matches!(base, -1..=1).then(|| if exponent % 2 == 0 { base * base } else { base });
    let too_large =
        || complain(too_large("**").hint("write a number with decimals: 10.0 ** 30"), context.call_position());
    whole.or(small).map(Dynamic::from_int).ok_or_else(too_large)
}

pub(super) fn too_large(word: &str) -> Complaint {
    Complaint::new(format!("`{word}`: the result is larger than the largest whole number"))
}

fn parse<T: std::str::FromStr>(
    context: &NativeCallContext,
    text: &Dynamic,
    what: &str,
) -> Result<T, Box<EvalAltResult>> {
    let fail = |complaint| complain(complaint, context.call_position());
    let word = context.fn_name();
    let text = number::text(&format!("{word}: text"), text).map_err(fail)?;
    text.trim().parse().map_err(|_| fail(Complaint::new(format!("{word}: \"{text}\" is not {what}"))))
}
