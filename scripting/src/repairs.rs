//! What Rhai's own packages do that a sandbox cannot leave so.
//!
//! Its sorting and its `dedup` pass over errors in the closure they are given, an endless loop included, and may
//! panic on NaN; its `replace` makes a string of any size before anyone asks how long it is; its `range` wants
//! three numbers of one type.

#![allow(unreachable_pub, clippy::unwrap_used)] // of the plugin macro: it takes `pub` functions only, and unwraps

use std::cmp::Ordering;

use rhai::plugin::*;
use rhai::{Array, Dynamic, FnPtr, ImmutableString};

use crate::error::Complaint;
use crate::number::{self, kind_of};
use crate::sandbox::{MOST_ENTRIES, MOST_TEXT};
use crate::session::{RhaiResultOf, complain};

#[export_module]
pub(crate) mod module {
    #[rhai_fn(name = "sort", return_raw)]
    pub fn sort(context: NativeCallContext, array: &mut Array) -> RhaiResultOf<()> {
        sort_in_place(array, |a, b| natural(&context, a, b))
    }

    #[rhai_fn(name = "sort_desc", return_raw)]
    pub fn sort_desc(context: NativeCallContext, array: &mut Array) -> RhaiResultOf<()> {
        sort_in_place(array, |a, b| natural(&context, b, a))
    }

    #[rhai_fn(name = "sort", name = "sort_by", return_raw)]
    pub fn sort_by(context: NativeCallContext, array: &mut Array, comparer: FnPtr) -> RhaiResultOf<()> {
        sort_in_place(array, |a, b| asked(&context, &comparer, a, b))
    }

    #[rhai_fn(name = "order", return_raw, pure)]
    pub fn order(context: NativeCallContext, array: &mut Array) -> RhaiResultOf<Array> {
        sorted(array, |a, b| natural(&context, a, b))
    }

    #[rhai_fn(name = "order_desc", return_raw, pure)]
    pub fn order_desc(context: NativeCallContext, array: &mut Array) -> RhaiResultOf<Array> {
        sorted(array, |a, b| natural(&context, b, a))
    }

    #[rhai_fn(name = "order", name = "order_by", return_raw, pure)]
    pub fn order_by(context: NativeCallContext, array: &mut Array, comparer: FnPtr) -> RhaiResultOf<Array> {
        sorted(array, |a, b| asked(&context, &comparer, a, b))
    }

    #[rhai_fn(name = "dedup", return_raw)]
    pub fn dedup_by(context: NativeCallContext, array: &mut Array, comparer: FnPtr) -> RhaiResultOf<()> {
        let mut kept: Array = Vec::with_capacity(array.len());
        for entry in array.iter() {
            let is_same = match kept.last() {
                Some(last) => {
                    comparer.call_raw(&context, None, [entry.clone(), last.clone()])?.as_bool().unwrap_or(false)
                }
                None => false,
            };
            if !is_same {
                kept.push(entry.clone());
            }
        }
        *array = kept;
        Ok(())
    }

    #[rhai_fn(name = "range", return_raw)]
    pub fn range(context: NativeCallContext, from: Dynamic, to: Dynamic) -> RhaiResultOf<Array> {
        spread(&from, &to, &Dynamic::ONE).map_err(|wrong| complain(wrong, context.call_position()))
    }

    #[rhai_fn(name = "range", return_raw)]
    pub fn range_by(context: NativeCallContext, from: Dynamic, to: Dynamic, step: Dynamic) -> RhaiResultOf<Array> {
        spread(&from, &to, &step).map_err(|wrong| complain(wrong, context.call_position()))
    }

    #[rhai_fn(name = "replace", return_raw)]
    pub fn replace_text(
        context: NativeCallContext,
        text: &mut ImmutableString,
        find: ImmutableString,
        substitute: ImmutableString,
    ) -> RhaiResultOf<()> {
        replace(&context, text, &find, &substitute)
    }

    #[rhai_fn(name = "replace", return_raw)]
    pub fn replace_text_with_character(
        context: NativeCallContext,
        text: &mut ImmutableString,
        find: ImmutableString,
        substitute: char,
    ) -> RhaiResultOf<()> {
        replace(&context, text, &find, substitute.encode_utf8(&mut [0; 4]))
    }

    #[rhai_fn(name = "replace", return_raw)]
    pub fn replace_character(
        context: NativeCallContext,
        text: &mut ImmutableString,
        find: char,
        substitute: ImmutableString,
    ) -> RhaiResultOf<()> {
        replace(&context, text, find.encode_utf8(&mut [0; 4]), &substitute)
    }

    #[rhai_fn(name = "replace", return_raw)]
    pub fn replace_character_with_character(
        context: NativeCallContext,
        text: &mut ImmutableString,
        find: char,
        substitute: char,
    ) -> RhaiResultOf<()> {
        replace(&context, text, find.encode_utf8(&mut [0; 4]), substitute.encode_utf8(&mut [0; 4]))
    }
}

/// The numbers from `from` to before `to`, each computed by itself, so that none gathers the errors of the others.
fn spread(from: &Dynamic, to: &Dynamic, step: &Dynamic) -> Result<Array, Complaint> {
    let (from, to) = (number::finite("range: from", from)?, number::finite("range: to", to)?);
    let step = number::finite("range: step", step)?;
    let count = libm::ceil((to - from) / step);
    if step == 0.0 || count.is_nan() || count > MOST_ENTRIES as f64 {
        return Err(Complaint::new(format!(
            "range: from {from} to {to} by {step} are more than {MOST_ENTRIES} numbers"
        )));
    }
    Ok((0..count as i64).map(|i| Dynamic::from_float(from + i as f64 * step)).collect())
}

/// Numbers by size (NaN last), strings and characters by their letters.
fn natural(context: &NativeCallContext, a: &Dynamic, b: &Dynamic) -> RhaiResultOf<Ordering> {
    let number = |value: &Dynamic| value.as_int().map(|whole| whole as f64).or_else(|_| value.as_float());
    if let (Ok(a), Ok(b)) = (a.as_int(), b.as_int()) {
        return Ok(a.cmp(&b));
    }
    if let (Ok(a), Ok(b)) = (number(a), number(b)) {
        // Not `total_cmp`: it asks for the sign of a NaN, which processors do not agree on.
        return Ok(a.partial_cmp(&b).unwrap_or(a.is_nan().cmp(&b.is_nan())));
    }
    if let (Ok(a), Ok(b)) = (a.as_char(), b.as_char()) {
        return Ok(a.cmp(&b));
    }
    if let (Ok(a), Ok(b)) = (a.as_immutable_string_ref(), b.as_immutable_string_ref()) {
        return Ok(a.cmp(&b));
    }
    let wrong = format!("{}: {} and {} have no order of their own", context.fn_name(), kind_of(a), kind_of(b));
    Err(complain(Complaint::new(wrong).hint("give a closure: array.sort(|a, b| a.x - b.x)"), context.call_position()))
}

/// What the closure says: below 0, or true, when `a` comes first.
fn asked(context: &NativeCallContext, comparer: &FnPtr, a: &Dynamic, b: &Dynamic) -> RhaiResultOf<Ordering> {
    let answer = comparer.call_raw(context, None, [a.clone(), b.clone()])?;
    let by_number = |number: f64| number.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
    if let Ok(comes_first) = answer.as_bool() {
        return Ok(if comes_first { Ordering::Less } else { Ordering::Greater });
    }
    let number = answer.as_int().map(|whole| whole as f64).or_else(|_| answer.as_float());
    number.map(by_number).map_err(|_| {
        let wrong =
            format!("{}: the closure must give a number or true or false, not {}", context.fn_name(), kind_of(&answer));
        complain(
            Complaint::new(wrong).hint("a number below 0, or true, puts the first before the second"),
            context.call_position(),
        )
    })
}

type Compare<'a> = dyn FnMut(&Dynamic, &Dynamic) -> RhaiResultOf<Ordering> + 'a;

fn sort_in_place(
    array: &mut Array,
    compare: impl FnMut(&Dynamic, &Dynamic) -> RhaiResultOf<Ordering>,
) -> RhaiResultOf<()> {
    *array = sorted(array, compare)?;
    Ok(())
}

fn sorted(array: &Array, mut compare: impl FnMut(&Dynamic, &Dynamic) -> RhaiResultOf<Ordering>) -> RhaiResultOf<Array> {
    merge_sort(array.clone(), &mut compare)
}

/// Stable, ends whatever the comparison says, and passes its errors on: what the standard library's cannot.
fn merge_sort(mut array: Array, compare: &mut Compare) -> RhaiResultOf<Array> {
    if array.len() < 2 {
        return Ok(array);
    }
    let second = array.split_off(array.len() / 2);
    let first = merge_sort(array, compare)?;
    let second = merge_sort(second, compare)?;
    let mut merged = Vec::with_capacity(first.len() + second.len());
    let (mut first, mut second) = (first.into_iter().peekable(), second.into_iter().peekable());
    while let (Some(a), Some(b)) = (first.peek(), second.peek()) {
        let is_second_first = compare(a, b)? == Ordering::Greater;
        merged.extend(if is_second_first { second.next() } else { first.next() });
    }
    merged.extend(first);
    merged.extend(second);
    Ok(merged)
}

fn replace(context: &NativeCallContext, text: &mut ImmutableString, find: &str, substitute: &str) -> RhaiResultOf<()> {
    let longer = substitute.len().saturating_sub(find.len());
    let length = text.len().saturating_add(text.matches(find).count().saturating_mul(longer));
    if length > MOST_TEXT {
        let wrong = format!("replace: the string would have {length} bytes, and {MOST_TEXT} are the most");
        return Err(complain(Complaint::new(wrong), context.call_position()));
    }
    *text = text.replace(find, substitute).into();
    Ok(())
}
