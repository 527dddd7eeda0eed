//! What a script hands over, turned into numbers and strings: one place for "must be a number, not a string".
//!
//! Whole numbers are welcome wherever numbers are; NaN and infinities are refused here, at the word,
//! with the name of the argument. `what` is that name: `rect: width`.

use choque_engine::check;
use rhai::{Array, Dynamic, ImmutableString};

use crate::error::Complaint;

/// Whole numbers up to here are exact as f64 too.
const MOST_EXACT: f64 = 9_007_199_254_740_992.0;

/// A number, NaN and infinities included: for mathematics.
pub(crate) fn any(what: &str, value: &Dynamic) -> Result<f64, Complaint> {
    match (value.as_int(), value.as_float()) {
        (Ok(whole), _) => Ok(whole as f64),
        (_, Ok(number)) => Ok(number),
        _ => Err(must_be(what, "a number", value)),
    }
}

/// A number that is neither NaN nor infinite.
pub(crate) fn finite(what: &str, value: &Dynamic) -> Result<f64, Complaint> {
    Ok(check::finite(what, any(what, value)?)?)
}

/// A number greater than 0.
pub(crate) fn positive(what: &str, value: &Dynamic) -> Result<f64, Complaint> {
    Ok(check::positive(what, any(what, value)?)?)
}

/// A number that is 0 or more.
pub(crate) fn not_negative(what: &str, value: &Dynamic) -> Result<f64, Complaint> {
    Ok(check::not_negative(what, any(what, value)?)?)
}

/// A number between 0 and 1.
pub(crate) fn unit_range(what: &str, value: &Dynamic) -> Result<f64, Complaint> {
    Ok(check::unit_range(what, any(what, value)?)?)
}

/// Two numbers of the same sort, each with its name.
pub(crate) fn pair(
    sort: fn(&str, &Dynamic) -> Result<f64, Complaint>,
    first: (&str, &Dynamic),
    second: (&str, &Dynamic),
) -> Result<(f64, f64), Complaint> {
    Ok((sort(first.0, first.1)?, sort(second.0, second.1)?))
}

/// A whole number; `3.0` is one.
pub(crate) fn whole(what: &str, value: &Dynamic) -> Result<i64, Complaint> {
    if let Ok(whole) = value.as_int() {
        return Ok(whole);
    }
    let number = value.as_float().map_err(|_| must_be(what, "a whole number", value))?;
    if libm::trunc(number) != number {
        return Err(Complaint::new(format!("{what} must be a whole number, not {number}")));
    }
    let is_exact = number.abs() <= MOST_EXACT;
    is_exact
        .then_some(number as i64)
        .ok_or_else(|| Complaint::new(format!("{what} must be between -{MOST_EXACT} and {MOST_EXACT}, not {number:e}")))
}

/// A whole number that is 0 or more.
pub(crate) fn count(what: &str, value: &Dynamic) -> Result<u64, Complaint> {
    let whole = whole(what, value)?;
    u64::try_from(whole).map_err(|_| Complaint::new(format!("{what} must be 0 or more, not {whole}")))
}

/// A number of sub-steps.
pub(crate) fn substeps(what: &str, value: &Dynamic) -> Result<u32, Complaint> {
    Ok(check::substeps(what, whole(what, value)?)?)
}

/// True or false.
pub(crate) fn truth(what: &str, value: &Dynamic) -> Result<bool, Complaint> {
    value.as_bool().map_err(|_| must_be(what, "true or false", value))
}

/// A string.
pub(crate) fn text(what: &str, value: &Dynamic) -> Result<ImmutableString, Complaint> {
    value.clone().into_immutable_string().map_err(|_| must_be(what, "a string", value))
}

/// A string of no more than `most` characters, and not an empty one.
pub(crate) fn label(what: &str, value: &Dynamic, most: usize) -> Result<ImmutableString, Complaint> {
    let text = text(what, value)?;
    let length = text.chars().count();
    if length == 0 {
        return Err(Complaint::new(format!("{what} must not be empty")));
    }
    if length > most {
        return Err(Complaint::new(format!("{what} must have {most} characters at most, not {length}")));
    }
    if text.chars().any(char::is_control) {
        return Err(Complaint::new(format!("{what} must be plain text on one line, without control characters")));
    }
    Ok(text)
}

/// An array of arrays of N numbers: `[[x, z], …]`.
pub(crate) fn tuples<const N: usize>(what: &str, shape: &str, value: &Dynamic) -> Result<Vec<[f64; N]>, Complaint> {
    let wrong = |place: &str, value: &Dynamic| {
        must_be(&format!("{what}{place}"), &format!("an array of {shape}"), value).hint(format!("write [{shape}, …]"))
    };
    let rows = value.read_lock::<Array>().ok_or_else(|| wrong("", value))?;
    let mut tuples = Vec::with_capacity(rows.len());
    for (at, row) in rows.iter().enumerate() {
        let place = format!("{what}, entry {at}");
        let numbers = row.read_lock::<Array>().ok_or_else(|| must_be(&place, shape, row))?;
        if numbers.len() != N {
            let count = if numbers.len() == 1 { "1 number".to_owned() } else { format!("{} numbers", numbers.len()) };
            return Err(Complaint::new(format!("{place} must be {shape}, not {count}")));
        }
        let mut tuple = [0.0; N];
        for (at, (slot, number)) in tuple.iter_mut().zip(numbers.iter()).enumerate() {
            *slot = finite(&format!("{place}, number {at}"), number)?;
        }
        tuples.push(tuple);
    }
    Ok(tuples)
}

/// "… must be a number, not a string".
pub(crate) fn must_be(what: &str, must: &str, value: &Dynamic) -> Complaint {
    Complaint::new(format!("{what} must be {must}, not {}", kind_of(value)))
}

/// "stop_when must give true or false, not a string".
pub(crate) fn must_give(who: &str, answer: &Dynamic) -> Complaint {
    Complaint::new(format!("{who} must give true or false, not {}", kind_of(answer)))
}

/// What a value is, in words.
pub(crate) fn kind_of(value: &Dynamic) -> &'static str {
    kind_named(value.type_name())
}

/// What a value of a type is, in words: a designer never meets a Rust type.
pub(crate) fn kind_named(type_name: &str) -> &'static str {
    match type_name.rsplit("::").next().unwrap_or(type_name).trim() {
        "i64" | "INT" => "a whole number",
        "f64" | "FLOAT" => "a number with decimals",
        "bool" => "true or false",
        "char" => "a character",
        "string" | "String" | "ImmutableString" | "&str" | "&str | ImmutableString | String" => "a string",
        "()" => "nothing",
        "array" | "Array" | "Vec<Dynamic>" => "an array",
        "map" | "Map" => "a map",
        "Fn" | "FnPtr" => "a function",
        "range" | "range=" | "Range<i64>" | "RangeInclusive<i64>" => "a range",
        "blob" | "Blob" => "a sequence of bytes",
        "Body" => "a body",
        "World" => "the world",
        "Hit" => "a hit",
        "Ledger" => "the ledger",
        "Account" => "an account of the ledger",
        _ => "a value of another kind",
    }
}
