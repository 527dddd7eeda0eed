//! The ledger of a run as data: the object that `run --format json` prints under `ledger`.

use choque_engine::Ledger;
use choque_engine::ledger::{Amounts, Cause};
use serde::ser::{Serialize, SerializeStruct, Serializer};

use crate::outcome::positive_zero;

/// What a run's ledger came to: `initial`, `booked` by quantity and cause, `relocated` and `relocations`. What was there at
/// the start and all that was booked add up to the totals of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Books {
    /// What was there at the start.
    pub initial: Amounts,
    /// What each cause changed, in the order of [`Cause::ALL`].
    pub booked: [Amounts; Cause::ALL.len()],
    /// How far bodies were relocated in all \[m\].
    pub relocated: f64,
    /// How often bodies were relocated.
    pub relocations: u64,
}

impl Books {
    /// A ledger as it stands.
    #[must_use]
    pub fn of(ledger: &Ledger) -> Self {
        Books {
            initial: ledger.initial(),
            booked: Cause::ALL.map(|cause| ledger.booked(cause)),
            relocated: ledger.relocated(),
            relocations: ledger.relocations(),
        }
    }

    /// What each cause changed of one quantity, by its place among [`Amounts::NAMES`].
    #[must_use]
    pub fn account(&self, quantity: usize) -> [f64; Cause::ALL.len()] {
        self.booked.map(|amounts| amounts.to_array()[quantity])
    }
}

impl Serialize for Books {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let accounts = [0, 1, 2, 3].map(|quantity| Named(Cause::WORDS, self.account(quantity).map(positive_zero)));
        let mut books = serializer.serialize_struct("Books", 4)?;
        books.serialize_field("initial", &Named(Amounts::NAMES, self.initial.to_array().map(positive_zero)))?;
        books.serialize_field("booked", &Named(Amounts::NAMES, accounts))?;
        books.serialize_field("relocated", &self.relocated)?;
        books.serialize_field("relocations", &self.relocations)?;
        books.end()
    }
}

/// Values under the names that the engine gives them.
struct Named<T, const N: usize>([&'static str; N], [T; N]);

impl<T: Serialize, const N: usize> Serialize for Named<T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut named = serializer.serialize_struct("Named", N)?;
        for (name, value) in self.0.iter().zip(&self.1) {
            named.serialize_field(name, value)?;
        }
        named.end()
    }
}
