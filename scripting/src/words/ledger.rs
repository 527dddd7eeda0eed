//! The words of the ledger: what changed energy and momenta, and by how much.

use choque_engine::Ledger as EngineLedger;
use choque_engine::ledger::{Amounts, Cause};
use rhai::plugin::*;

use crate::error::Complaint;
use crate::handles::{Account, Ledger, World};
use crate::session::{self, RhaiResultOf, Session};

#[export_module]
pub(crate) mod module {
    /// What changed the kinetic energy, the momentum and the angular momentum of the mobile bodies since the start, by cause:
    /// `world.ledger.kinetic_energy.mu_l`. What was there at the start and all causes add up to what is there now.
    ///
    /// ```rhai
    /// expect("drag took the most", |world| world.ledger.kinetic_energy.drag <= world.ledger.kinetic_energy.friction);
    /// ```
    #[rhai_fn(get = "ledger", pure)]
    pub fn ledger(_world: &mut World) -> Ledger {
        Ledger
    }

    /// The ledger as a string: a line for each account.
    #[rhai_fn(name = "to_string", name = "to_debug", return_raw, pure)]
    pub fn ledger_to_string(context: NativeCallContext, _ledger: &mut Ledger) -> RhaiResultOf<String> {
        let lines = |ledger: &EngineLedger| {
            let line = |quantity: usize| format!("{}: {}", Amounts::NAMES[quantity], told(ledger, quantity));
            [0, 1, 2, 3].map(line).join("\n")
        };
        with_ledger(&context, |ledger, _| lines(ledger))
    }

    /// An account as a string: what was there at the start, and what each cause changed that changed anything.
    #[rhai_fn(name = "to_string", name = "to_debug", return_raw, pure)]
    pub fn account_to_string(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<String> {
        let Account { quantity } = *account;
        with_ledger(&context, |ledger, _| told(ledger, quantity))
    }

    /// The account of the kinetic energy, in J.
    ///
    /// ```rhai
    /// expect("nothing is lost in friction", |world| world.ledger.kinetic_energy.friction == 0);
    /// ```
    #[rhai_fn(get = "kinetic_energy", pure)]
    pub fn of_kinetic_energy(_ledger: &mut Ledger) -> Account {
        Account { quantity: 0 }
    }

    /// The account of the momentum along X, in kg·m/s.
    ///
    /// ```rhai
    /// expect("nobody steered", |world| world.ledger.momentum_x.commands == 0);
    /// ```
    #[rhai_fn(get = "momentum_x", pure)]
    pub fn of_momentum_x(_ledger: &mut Ledger) -> Account {
        Account { quantity: 1 }
    }

    /// The account of the momentum along Z, in kg·m/s.
    ///
    /// ```rhai
    /// expect("nothing falls", |world| world.ledger.momentum_z.gravity == 0);
    /// ```
    #[rhai_fn(get = "momentum_z", pure)]
    pub fn of_momentum_z(_ledger: &mut Ledger) -> Account {
        Account { quantity: 2 }
    }

    /// The account of the angular momentum about the world's origin, in kg·m²/s.
    ///
    /// ```rhai
    /// expect("nobody steered", |world| world.ledger.angular_momentum.commands == 0);
    /// ```
    #[rhai_fn(get = "angular_momentum", pure)]
    pub fn of_angular_momentum(_ledger: &mut Ledger) -> Account {
        Account { quantity: 3 }
    }

    /// How far bodies were relocated in all \[m\].
    ///
    /// ```rhai
    /// expect("little is moved about", |world| world.ledger.relocated < 10);
    /// ```
    #[rhai_fn(get = "relocated", pure, return_raw)]
    pub fn relocated(context: NativeCallContext, _ledger: &mut Ledger) -> RhaiResultOf<f64> {
        read(&context, "ledger.relocated", EngineLedger::relocated)
    }

    /// How often bodies were relocated.
    ///
    /// ```rhai
    /// expect("and seldom", |world| world.ledger.relocations < 20);
    /// ```
    #[rhai_fn(get = "relocations", pure, return_raw)]
    pub fn relocations(context: NativeCallContext, _ledger: &mut Ledger) -> RhaiResultOf<i64> {
        read(&context, "ledger.relocations", |ledger| ledger.relocations() as f64).map(|count| count as i64)
    }

    /// What was there at the start.
    ///
    /// ```rhai
    /// expect("it began at rest", |world| world.ledger.kinetic_energy.initial == 0);
    /// ```
    #[rhai_fn(get = "initial", pure, return_raw)]
    pub fn initial(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, INITIAL)
    }

    /// What collisions added by themselves. The document's exchange: what its rule does at mu_l = mu_a = 1, taking the
    /// fixed body to be at rest. The impulse exchange: the momentum that fixed bodies gave along the normal.
    ///
    /// ```rhai
    /// expect("the exchange makes little", |world| world.ledger.kinetic_energy.exchange < 1e5);
    /// ```
    #[rhai_fn(get = "exchange", pure, return_raw)]
    pub fn exchange(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::Exchange as usize)
    }

    /// What mu_l below 1 changed of that.
    ///
    /// ```rhai
    /// expect("mu_l takes", |world| world.ledger.kinetic_energy.mu_l <= 0);
    /// ```
    #[rhai_fn(get = "mu_l", pure, return_raw)]
    pub fn mu_l(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::MuL as usize)
    }

    /// What mu_a below 1 changed of that.
    ///
    /// ```rhai
    /// expect("mu_a is not used", |world| world.ledger.kinetic_energy.mu_a == 0);
    /// ```
    #[rhai_fn(get = "mu_a", pure, return_raw)]
    pub fn mu_a(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::MuA as usize)
    }

    /// What restitution below 1 took: the work of the normal impulses.
    ///
    /// ```rhai
    /// expect("hits take", |world| world.ledger.kinetic_energy.restitution <= 0);
    /// ```
    #[rhai_fn(get = "restitution", pure, return_raw)]
    pub fn restitution(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::Restitution as usize)
    }

    /// What friction took: the work of the tangential impulses, and the momentum that fixed bodies gave by them.
    ///
    /// ```rhai
    /// expect("friction takes", |world| world.ledger.kinetic_energy.friction <= 0);
    /// ```
    #[rhai_fn(get = "friction", pure, return_raw)]
    pub fn friction(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::Friction as usize)
    }

    /// What moving bodies apart changed: their angular momentum.
    ///
    /// ```rhai
    /// expect("no work is done by relocation", |world| world.ledger.kinetic_energy.relocation == 0);
    /// ```
    #[rhai_fn(get = "relocation", pure, return_raw)]
    pub fn relocation(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::Relocation as usize)
    }

    /// What drag took.
    ///
    /// ```rhai
    /// expect("drag takes", |world| world.ledger.kinetic_energy.drag <= 0);
    /// ```
    #[rhai_fn(get = "drag", pure, return_raw)]
    pub fn drag(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::Drag as usize)
    }

    /// What gravity gave.
    ///
    /// ```rhai
    /// expect("nothing falls", |world| world.ledger.kinetic_energy.gravity == 0);
    /// ```
    #[rhai_fn(get = "gravity", pure, return_raw)]
    pub fn gravity(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::Gravity as usize)
    }

    /// What the script changed: by writing, pushing and twisting.
    ///
    /// ```rhai
    /// expect("nobody steered", |world| world.ledger.kinetic_energy.commands == 0);
    /// ```
    #[rhai_fn(get = "commands", pure, return_raw)]
    pub fn commands(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::Commands as usize)
    }

    /// What moving fixed bodies gave: blades, doors, lifts.
    ///
    /// ```rhai
    /// expect("the blade gives", |world| world.ledger.kinetic_energy.fixed_bodies >= 0);
    /// ```
    #[rhai_fn(get = "fixed_bodies", pure, return_raw)]
    pub fn fixed_bodies(context: NativeCallContext, account: &mut Account) -> RhaiResultOf<f64> {
        of_account(&context, *account, Cause::FixedBodies as usize)
    }
}

/// The entry of an account after those of the causes.
const INITIAL: usize = Cause::ALL.len();

/// How an expectation that failed names what it read of an account: the causes in their order, then the start.
macro_rules! entries_of {
    ($quantity:literal) => {
        entries_of!($quantity, "exchange", "mu_l", "mu_a", "restitution", "friction", "relocation", "drag", "gravity",
            "commands", "fixed_bodies", "initial")
    };
    ($quantity:literal, $($entry:literal),+) => { [$(concat!("ledger.", $quantity, ".", $entry)),+] };
}

const READ_AS: [[&str; INITIAL + 1]; Amounts::COUNT] = [
    entries_of!("kinetic_energy"),
    entries_of!("momentum_x"),
    entries_of!("momentum_z"),
    entries_of!("angular_momentum"),
];

fn of_account(context: &NativeCallContext, account: Account, entry: usize) -> RhaiResultOf<f64> {
    let Account { quantity } = account;
    read(context, READ_AS[quantity][entry], |ledger| {
        let amounts = Cause::ALL.get(entry).map_or(ledger.initial(), |cause| ledger.booked(*cause));
        amounts.to_array()[quantity]
    })
}

/// `initial 6, exchange 12, mu_l -13.5`.
fn told(ledger: &EngineLedger, quantity: usize) -> String {
    let of = |amounts: Amounts| amounts.to_array()[quantity];
    let causes = Cause::ALL.into_iter().map(|cause| (cause.word(), of(ledger.booked(cause))));
    let told = causes.filter(|(_, amount)| *amount != 0.0).map(|(word, amount)| format!(", {word} {amount}"));
    format!("initial {}{}", of(ledger.initial()), told.collect::<String>())
}

fn read(context: &NativeCallContext, name: &'static str, of: impl FnOnce(&EngineLedger) -> f64) -> RhaiResultOf<f64> {
    with_ledger(context, |ledger, session| session.read(None, name, of(ledger)))
}

fn with_ledger<T>(context: &NativeCallContext, look: impl FnOnce(&EngineLedger, &mut Session) -> T) -> RhaiResultOf<T> {
    session::with(context, |session| {
        let world = session.running()?.world.clone();
        let world = world.borrow();
        let ledger = world.ledger().ok_or_else(|| {
            Complaint::new("no ledger was kept: nothing spoke of it when the run began")
                .hint("import the module that reads it at the top of the script, not within a function")
        })?;
        Ok(look(&ledger, session))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_named_as_the_engine_names_them() {
        for (quantity, entries) in Amounts::NAMES.iter().zip(READ_AS) {
            for (word, entry) in Cause::WORDS.iter().chain(&["initial"]).zip(entries) {
                assert_eq!(entry, format!("ledger.{quantity}.{word}"));
            }
        }
    }
}
