//! A watch over values that grow where Rhai does not look.
//!
//! Rhai weighs what literals and functions give, but not what `a[0] = a` or `m[key] = …` make: a few lines would
//! fill the memory, or nest so deeply that printing the value overflows the stack. A value can grow only through
//! a variable, so every few reads of a variable it is weighed. The reads in between are too few for even a
//! doubling at each of them to do harm, and their number varies, so that no loop falls into step with the watch.

use std::cell::Cell;

use rhai::{Array, Dynamic, Engine, EvalAltResult, FnPtr, Map, Position};

use crate::sandbox::{MOST_ENTRIES, MOST_TEXT};

/// How deep values may lie within values.
pub(crate) const MOST_NESTING: usize = 64;

/// Has every variable of an engine's scripts watched.
#[allow(deprecated)] // `on_var` is not deprecated: Rhai marks so what may still change
pub(crate) fn watch_variables(engine: &mut Engine) {
    let (reads, turn) = (Cell::new(0_u32), Cell::new(0_u32));
    engine.on_var(move |name, _, context| {
        if reads.get() > 0 {
            reads.set(reads.get() - 1);
            return Ok(None);
        }
        // 4 to 12 reads, in an order that repeats only after 2³² turns.
        turn.set(turn.get().wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
        reads.set(4 + (turn.get() >> 29));
        match context.scope().get(name).map(weigh) {
            Some(Err(excess)) => Err(excess.into_error()),
            _ => Ok(None),
        }
    });
}

/// What a value has too much of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Excess {
    Entries,
    Text,
    Nesting,
}

impl Excess {
    fn into_error(self) -> Box<EvalAltResult> {
        let what = match self {
            Excess::Entries => "Size of array or map",
            Excess::Text => "Length of string",
            Excess::Nesting => NESTING,
        };
        EvalAltResult::ErrorDataTooLarge(what.to_owned(), Position::NONE).into()
    }
}

/// How Rhai's error says that values nest too deeply.
pub(crate) const NESTING: &str = "Nesting";

#[derive(Default)]
struct Weight {
    entries: usize,
    text: usize,
}

fn weigh(value: &Dynamic) -> Result<(), Excess> {
    Weight::default().add(value, 0)
}

impl Weight {
    fn add(&mut self, value: &Dynamic, depth: usize) -> Result<(), Excess> {
        if depth > MOST_NESTING {
            return Err(Excess::Nesting);
        }
        if value.is_string() {
            self.text += value.as_immutable_string_ref().map_or(0, |text| text.len());
        } else if let Some(array) = value.read_lock::<Array>() {
            self.count(array.len())?;
            array.iter().try_for_each(|entry| self.add(entry, depth + 1))?;
        } else if let Some(map) = value.read_lock::<Map>() {
            self.count(map.len())?;
            self.text += map.keys().map(|key| key.len()).sum::<usize>();
            map.values().try_for_each(|entry| self.add(entry, depth + 1))?;
        } else if let Some(function) = value.read_lock::<FnPtr>() {
            // What it captures may be all that is left of a variable.
            self.count(function.curry().len())?;
            function.curry().iter().try_for_each(|captured| self.add(captured, depth + 1))?;
        }
        if self.text > MOST_TEXT { Err(Excess::Text) } else { Ok(()) }
    }

    fn count(&mut self, entries: usize) -> Result<(), Excess> {
        self.entries += entries;
        if self.entries > MOST_ENTRIES { Err(Excess::Entries) } else { Ok(()) }
    }
}
