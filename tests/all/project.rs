//! A project laid out by `choque init`, as a designer gets it: its scenario is a test that passes and is pinned.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::{choque, folder, isolated, stderr, stdout};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

#[test]
fn files_that_are_there_are_not_overwritten() {
    let folder = folder(&[("mine/README.md", "mine")]);
    let output = choque().current_dir(folder.path()).args(["init", "mine"]).output().expect("the command starts");
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("README.md is there already; nothing was written"), "{}", stderr(&output));
    assert_eq!(fs::read_dir(folder.path().join("mine")).expect("the folder").count(), 1);
}

#[test]
fn a_project_depends_on_this_version_unless_told_otherwise() {
    let folder = folder(&[]);
    let output = choque().current_dir(folder.path()).args(["init", "deep/game"]).output().expect("the command starts");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let manifest = fs::read_to_string(folder.path().join("deep/game/Cargo.toml")).expect("the manifest");
    let version = concat!(env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR"));
    assert!(manifest.contains(&format!("choque = \"{version}\"")), "{manifest}");
    assert!(manifest.contains("name = \"game-scenarios\""), "{manifest}");
}

/// Runs the project's tests with the registry crates this workspace has compiled already: it stands at the same
/// place every time and builds into the same folder, so only what changed is compiled.
fn cargo_test(project: &Path, update: &str) -> Output {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder");
    let mut cargo = isolated(Command::new(env!("CARGO")));
    cargo.args(["test", "--offline", "--quiet"]).current_dir(project);
    cargo.env("CARGO_TARGET_DIR", target).env("INSTA_UPDATE", update);
    for variable in ["INSTA_WORKSPACE_ROOT", "NEXTEST", "RUSTFLAGS"] {
        cargo.env_remove(variable);
    }
    cargo.output().expect("cargo can be started")
}

fn laid_out() -> PathBuf {
    let project = Path::new(env!("CARGO_TARGET_TMPDIR")).join("first-project");
    let _ = fs::remove_dir_all(&project); // of an earlier run, if there was one
    let init = choque().arg("init").arg(&project).args(["--choque-path", ROOT]).output().expect("the command starts");
    assert_eq!(init.status.code(), Some(0), "{}", stderr(&init));
    fs::copy(Path::new(ROOT).join("Cargo.lock"), project.join("Cargo.lock")).expect("the lock file can be copied");
    project
}

#[test]
fn a_new_project_is_tested_and_pinned() {
    let project = laid_out();
    let first = cargo_test(&project, "always");
    assert!(first.status.success(), "{}{}", stdout(&first), stderr(&first));
    let snapshot = fs::read_to_string(project.join("snapshots/first.snap")).expect("the snapshot was written");
    assert!(snapshot.contains("source: tests/scenarios.rs"), "{snapshot}");

    let again = cargo_test(&project, "no");
    assert!(again.status.success(), "{}{}", stdout(&again), stderr(&again));

    let script = project.join("scenarios/first.rhai");
    let text = fs::read_to_string(&script).expect("the scenario");
    fs::write(&script, text.replace(".at(-8, 1)", ".at(-8, 1.25)")).expect("the scenario can be written");
    let changed = cargo_test(&project, "no");
    assert!(!changed.status.success());
    let said = stdout(&changed);
    assert!(said.contains("first: the scene itself is another"), "{said}");
    assert!(said.contains("of 2 ended otherwise"), "{said}");
}
