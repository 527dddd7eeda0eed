//! Counted work: what a run cost, in deeds rather than seconds, so that it can be compared and tested.

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::exchange::PairKind;

macro_rules! work {
    ($($(#[$doc:meta])* $field:ident: $label:literal,)+) => {
        /// How often each kind of work was done since the world was made. What a scene does not need stays 0.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default)]
        pub struct Work { $($(#[$doc])* pub $field: u64,)+ }

        impl Work {
            /// Each count with its label, in the order of the pipeline.
            #[must_use]
            pub fn rows(&self) -> Vec<(&'static str, u64)> {
                vec![$(($label, self.$field)),+]
            }
        }
    };
}

work! {
    /// Iterations made.
    iterations: "iterations",
    /// Commands obeyed: pushes and twists.
    commands: "commands",
    /// Bodies advanced freely, one count per body and iteration.
    bodies_advanced: "bodies advanced",
    /// Of these, with gravity or drag.
    bodies_forced: "with gravity or drag",
    /// Prescribed motions evaluated (patrol, swing).
    prescribed: "prescribed motions",
    /// Bounds computed by the broad phase.
    bounds: "bounds computed",
    /// Comparisons of bounds in the broad phase.
    bounds_compared: "bounds compared",
    /// Pairs handed to the detection.
    pairs_tested: "pairs tested",
    /// Vertices brought into another body's frame.
    vertices_transformed: "vertices transformed",
    /// Separating axes tried by the complete test.
    axes_tested: "axes tested",
    /// Searches for the moment of impact of two rectangles.
    touches_sought: "moments of impact sought",
    /// Pairs listed as overlapping.
    pairs_listed: "pairs listed",
    /// Touches solved, one count per touch and sweep.
    touches_solved: "touches solved",
    /// Relocations made.
    relocations: "relocations",
    /// Exchanges mobile–mobile (§2.5.1).
    exchanges_mobile: "exchanges mobile–mobile",
    /// Exchanges mobile–fixed with physics (§2.5.2).
    exchanges_physics: "exchanges mobile–fixed with physics",
    /// Exchanges mobile–fixed without physics (§2.5.3).
    exchanges_fixed: "exchanges mobile–fixed",
}

impl Work {
    /// Counts an exchange under its case.
    pub(crate) fn count_exchange(&mut self, kind: PairKind) {
        *match kind {
            PairKind::Mobile => &mut self.exchanges_mobile,
            PairKind::FixedWithPhysics => &mut self.exchanges_physics,
            PairKind::Fixed => &mut self.exchanges_fixed,
        } += 1;
    }
}

impl fmt::Display for Work {
    /// What was done, a line each; what was not done is not mentioned.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (label, count) in self.rows().into_iter().filter(|(_, count)| *count > 0) {
            writeln!(f, "{label:<36} {count:>14}")?;
        }
        Ok(())
    }
}
