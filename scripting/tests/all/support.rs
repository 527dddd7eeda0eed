//! Scripts written into a folder of their own, loaded and run.

use std::cell::RefCell;
use std::fs;
use std::path::PathBuf;
use std::rc::Rc;

use choque_engine::Scene;
use choque_scripting::{Expectation, Options, Output, Run, Scenario, Step};
use tempfile::TempDir;

/// A folder with files, gone when dropped.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn with(files: &[(&str, &str)]) -> Self {
        let folder = Folder(TempDir::new().unwrap());
        for (name, text) in files {
            let path = folder.path(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn load(&self, name: &str, options: &Options) -> Result<Scenario, String> {
        Scenario::load(&self.path(name), options).map_err(|error| self.shorten(&error.to_string()))
    }

    /// Loads, runs to the end and concludes; gives the first error on the way, with short file names.
    pub(crate) fn run(&self, name: &str, options: &Options) -> Result<(Run, Vec<Expectation>), String> {
        let scenario = self.load(name, options)?;
        let short = |error: choque_scripting::Diagnostic| self.shorten(&error.to_string());
        let mut run = scenario.start().map_err(short)?;
        while run.step().map_err(short)? == Step::Going {}
        let expectations = run.conclude().map_err(short)?;
        Ok((run, expectations))
    }

    fn shorten(&self, text: &str) -> String {
        let folder = self.0.path().to_str().unwrap();
        text.replace(&format!("{folder}/"), "").replace(folder, "FOLDER")
    }
}

/// The scene a script makes.
pub(crate) fn scene(script: &str) -> Scene {
    scene_with(script, &Options::default())
}

pub(crate) fn scene_with(script: &str, options: &Options) -> Scene {
    let folder = Folder::with(&[("scene.rhai", script)]);
    folder.load("scene.rhai", options).unwrap_or_else(|error| panic!("{error}")).scene().clone()
}

/// A script run to its end.
pub(crate) fn run(script: &str) -> (Run, Vec<Expectation>) {
    Folder::with(&[("scene.rhai", script)])
        .run("scene.rhai", &Options::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

/// What a script prints, up to the end of its main part.
pub(crate) fn printed(script: &str) -> Vec<String> {
    let folder = Folder::with(&[("scene.rhai", script)]);
    let (options, lines) = listening();
    folder.load("scene.rhai", &options).unwrap_or_else(|error| panic!("{error}"));
    lines.take()
}

/// Options whose output is gathered.
pub(crate) fn listening() -> (Options, Rc<RefCell<Vec<String>>>) {
    let lines = Rc::new(RefCell::new(Vec::new()));
    let heard = lines.clone();
    let output = Output::to(move |line| heard.borrow_mut().push(line.to_owned()));
    (Options { output, ..Options::default() }, lines)
}

/// The whole text of the error a script ends with, loading or running.
pub(crate) fn error(script: &str) -> String {
    error_with(script, &Options::default())
}

pub(crate) fn error_with(script: &str, options: &Options) -> String {
    error_in(&[("scene.rhai", script)], options)
}

/// The same of the first of several files.
pub(crate) fn error_in(files: &[(&str, &str)], options: &Options) -> String {
    match Folder::with(files).run(files[0].0, options) {
        Ok(_) => panic!("no error from:\n{}", files[0].1),
        Err(error) => error,
    }
}

/// The error of a script with a body that runs, and what goes wrong on its second line.
pub(crate) fn while_running(callback: &str) -> String {
    error(&format!("mobile(\"car\").rect(1, 1);\n{callback}"))
}

/// `--set` options.
pub(crate) fn set(values: &[(&str, f64)]) -> Options {
    let set = values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    Options { set, ..Options::default() }
}
