//! skeleton of the public API; bodies follow
mod options;
pub use options::{Options, Overrides};

use std::cell::Ref;
use std::path::{Path, PathBuf};
use choque_engine::{Scene, World};

/// A scenario that was read and compiled: the scene it describes and the callbacks it defines.
pub struct Scenario {}
impl Scenario {
    /// .rhai, or .ron (plain scene, no callbacks)
    pub fn load(_path: &Path, _options: &Options) -> Result<Scenario, Diagnostic> { unimplemented!() }
    /// overrides applied
    pub fn scene(&self) -> &Scene { unimplemented!() }
    /// the file's stem
    pub fn name(&self) -> &str { unimplemented!() }
    /// the script's title, or the name
    pub fn title(&self) -> String { unimplemented!() }
    /// for `explain`
    pub fn callbacks(&self) -> Callbacks { unimplemented!() }
    /// builds the World; scene errors carry the line where the body was made
    pub fn start(&self) -> Result<Run, Diagnostic> { unimplemented!() }
}

/// Which callbacks and expectations a script has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Callbacks {
    /// `fn on_step(world)`
    pub on_step: bool,
    /// `fn on_collision(world, hit)`
    pub on_collision: bool,
    /// `fn stop_when(world)`
    pub stop_when: bool,
    /// How many `expect(…)`.
    pub expect: usize,
    /// How many `always(…)`.
    pub always: usize,
}

/// A scenario being run.
pub struct Run {}
impl Run {
    /// on_step → begin → (treat_next → on_collision)* → finish → always → stop_when
    pub fn step(&mut self) -> Result<Step, Diagnostic> { unimplemented!() }
    /// the world as it stands
    pub fn world(&self) -> Ref<'_, World> { unimplemented!() }
    /// judges expect; all expectations in the script's order
    pub fn conclude(&mut self) -> Result<Vec<Expectation>, Diagnostic> { unimplemented!() }
}

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// There are iterations left.
    Going,
    /// All iterations were made, or `stop_when` said so.
    Done,
}

/// A judged `expect` or `always`.
#[derive(Clone, Debug, PartialEq)]
pub struct Expectation {
    /// What the script says.
    pub text: String,
    /// Whether it held.
    pub held: bool,
    /// The first iteration it did not hold in, if it did not.
    pub first_failure: Option<u64>,
    /// What was read to judge it, when it failed: `("car2.speed", 2.71)`.
    pub numbers: Vec<(String, f64)>,
}

/// An error in a script, a scene or a call, ready to be shown: `Display` is the whole text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file, as it was given.
    pub file: Option<PathBuf>,
    /// Line, from 1.
    pub line: Option<usize>,
    /// Column, from 1.
    pub column: Option<usize>,
    /// What was wrong.
    pub message: String,
    /// What to do instead.
    pub hint: Option<String>,
}
impl std::fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result { f.write_str(&self.message) }
}
impl std::error::Error for Diagnostic {}

/// Every word of a script, with its documentation.
pub mod words {
    /// A word a script may use.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub struct Word {
        /// Its name.
        pub name: String,
        /// Every way of calling it: `rect(width, depth)`.
        pub signatures: Vec<String>,
        /// Its documentation, Markdown.
        pub docs: String,
        /// Settings, bodies, world, expectations, random, mathematics.
        pub group: &'static str,
    }
    /// Every word, by group, in the order of the manual.
    pub fn all() -> Vec<Word> { unimplemented!() }
    /// Writes `.d.rhai` files for editors into `dir`; gives the files written.
    pub fn write_definitions(_dir: &std::path::Path) -> std::io::Result<Vec<std::path::PathBuf>> { unimplemented!() }
}
