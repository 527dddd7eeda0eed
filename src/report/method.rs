//! What is compared: when collisions are treated, and how they are found.

use choque_engine::scene::{Detection, MotionRule};
use serde::{Deserialize, Serialize};

/// A way to simulate a scene; what happens at a collision (the exchange) is the scene's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Method {
    /// When collisions are treated.
    pub motion: MotionRule,
    /// How they are found.
    pub detection: Detection,
}

/// All four.
pub const ALL: [Method; 4] = [
    Method { motion: MotionRule::Stepped, detection: Detection::Vertices },
    Method { motion: MotionRule::Stepped, detection: Detection::Complete },
    Method { motion: MotionRule::Continuous, detection: Detection::Vertices },
    Method { motion: MotionRule::Continuous, detection: Detection::Complete },
];

impl Method {
    /// `stepped, vertices`.
    #[must_use]
    pub fn name(self) -> String {
        format!("{}, {}", self.motion.word(), self.detection.word())
    }

    /// Its place among [`ALL`].
    #[must_use]
    pub fn number(self) -> usize {
        ALL.iter().position(|method| *method == self).unwrap_or(0)
    }
}
