//! The ledger for people: what each cause did, causes that did nothing left out.

use choque_engine::World;
use choque_engine::ledger::{Amounts, Cause};
use choque_engine::plan::ExchangePlan;
use choque_engine::scene::Kind;

use crate::books::Books;
use crate::output::numbers::{counted, rough, short};
use crate::output::table::{Side, table};

/// An amount below this share of what its quantity can be is what rounding leaves.
const ROUNDING: f64 = 1e-9;

/// `from 6 J at the start: the document's exchange added 12 J of its own, μ_L took 13.5 J`, and how far bodies were moved. Empty
/// when nothing changed the kinetic energy and nothing was moved.
#[must_use]
pub fn sentences(books: &Books, world: &World) -> String {
    let least = ROUNDING * largest_energy(books);
    let told: Vec<String> = Cause::ALL
        .into_iter()
        .zip(books.account(0))
        .filter(|(_, amount)| amount.abs() > least)
        .map(|(cause, amount)| sentence(cause, amount, world))
        .collect();
    let mut text = String::new();
    if !told.is_empty() {
        text += &format!("  from {} J at the start: {}\n", rough(books.initial.kinetic_energy), told.join(", "));
    }
    if books.relocations > 0 {
        let times = counted(books.relocations as usize, "time", "times");
        text += &format!("  relocation moved things by {} m in all, {times}\n", rough(books.relocated));
    }
    text
}

fn sentence(cause: Cause, amount: f64, world: &World) -> String {
    let who = match cause {
        Cause::Exchange if matches!(world.plan().exchange, ExchangePlan::Document { .. }) => "the document's exchange",
        Cause::Exchange => "the exchange",
        Cause::MuL => "μ_L",
        Cause::MuA => "μ_A",
        Cause::Restitution => "restitution",
        Cause::Friction => "friction",
        Cause::Relocation => "relocation",
        Cause::Drag => "drag",
        Cause::Gravity => "gravity",
        Cause::Commands => "the script",
        Cause::FixedBodies => "fixed bodies",
    };
    let of_its_own = if cause == Cause::Exchange && amount > 0.0 { " of its own" } else { "" };
    let verb = if amount > 0.0 { "added" } else { "took" };
    format!("{who} {verb} {} J{of_its_own}", rough(amount.abs()))
}

/// A line for each cause that changed any of the four, between what was there at the start and what is there now.
#[must_use]
pub fn whole(books: &Books, world: &World) -> String {
    let columns = [
        ("ledger", Side::Left),
        ("energy [J]", Side::Right),
        ("momentum x [kg·m/s]", Side::Right),
        ("momentum z [kg·m/s]", Side::Right),
        ("angular momentum [kg·m²/s]", Side::Right),
    ];
    let sizes = sizes(books, world);
    let line = |name: &str, amounts: [f64; Amounts::COUNT]| {
        let shown = |(amount, size): (f64, f64)| short(if amount.abs() > ROUNDING * size { amount } else { 0.0 });
        [name.to_owned()].into_iter().chain(amounts.into_iter().zip(sizes).map(shown)).collect::<Vec<_>>()
    };
    let mut rows = vec![line("at the start", books.initial.to_array())];
    for (cause, amounts) in Cause::ALL.into_iter().zip(&books.booked) {
        let row = line(cause.word(), amounts.to_array());
        if row[1..].iter().any(|cell| cell != "0") {
            rows.push(row);
        }
    }
    rows.push(line("at the end", world.totals().to_array()));
    table(&columns, &rows)
}

/// What each quantity can be, given the largest energy there was: p² ≤ 2 m E, and as much at the reach of the bodies.
fn sizes(books: &Books, world: &World) -> [f64; Amounts::COUNT] {
    let mobile = || world.ids().filter(|id| world.kind(*id) == Kind::Mobile);
    let energy = largest_energy(books);
    let momentum = (2.0 * energy * mobile().map(|id| world.mass(id)).sum::<f64>()).sqrt();
    let turning = (2.0 * energy * mobile().map(|id| world.inertia(id)).sum::<f64>()).sqrt();
    let reach = mobile().map(|id| world.position(id).norm()).fold(0.0, f64::max);
    [energy, momentum, momentum, momentum * reach + turning]
}

fn largest_energy(books: &Books) -> f64 {
    books.account(0).iter().fold(books.initial.kinetic_energy, |largest, amount| largest.max(amount.abs()))
}
