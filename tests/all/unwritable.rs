//! What cannot be written is said with the file's name, before anything is run where that can be known, and nothing is left of it.
#![cfg(unix)]

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Output};

use crate::support::{choque, folder, isolated, stderr};

/// It would fail in its first iteration: who is told of a file instead was told before that.
const FAILING: &str = "steps(9); mobile(\"a\").rect(1, 1); fn on_step(world) { nothing }";
const FLYING: &str = "steps(900); drag(0.1, 0.1); for i in 0..20 {
    mobile(\"a\" + i).rect(1, 1).at(2 * i, 0).velocity(30 - 3 * i, 0.01 * i).spin(i);
}";
/// A user who owns nothing.
const NOBODY: u32 = 65534;

/// The calls that write a file, each with the name of that file.
const CALLS: [(&str, &str); 7] = [
    ("run failing.rhai --record", "out.choque"),
    ("run failing.rhai --ledger", "out.csv"),
    ("render failing.rhai -o", "out.svg"),
    ("render failing.rhai -o", "out.gif"),
    ("render failing.rhai -o", "out.html"),
    ("diff failing.rhai -o", "out.html"),
    ("export failing.rhai -o", "out.ron"),
];

#[track_caller]
fn is_refused(output: &Output, file: &str, why: &str) {
    let told = stderr(output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains(file) && told.contains(why), "{file}, {why}: {told}");
    assert!(!told.contains(".choque-") && !told.contains(".tmp"), "nobody knows of that file: {told}");
}

/// What is in a folder, by name, with what is in it.
fn content(folder: &Path) -> Vec<(String, Option<Vec<u8>>)> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut all: Vec<_> = entries.map(|path| (path.display().to_string(), fs::read(&path).ok())).collect();
    all.sort();
    all
}

#[test]
fn a_file_that_is_read_only_stays_and_what_is_no_file_too() {
    for (words, name) in CALLS {
        let folder = folder(&[("failing.rhai", FAILING), (name, "mine")]);
        let call = || choque().current_dir(folder.path()).args(words.split(' ')).arg(name).output().expect("it runs");
        let file = folder.path().join(name);
        fs::set_permissions(&file, Permissions::from_mode(0o444)).expect("its permissions");
        let before = content(folder.path());
        is_refused(&call(), name, "cannot write");
        is_refused(&call(), name, "it is read-only");
        assert_eq!(content(folder.path()), before);
        for (target, why) in
            [(".", "is there already and is no file"), ("/dev/full", "is there already and is no file")]
        {
            fs::remove_file(&file).expect("it goes");
            symlink(target, &file).expect("a link");
            is_refused(&call(), name, why);
        }
        let missing = format!("none/{name}");
        let output =
            choque().current_dir(folder.path()).args(words.split(' ')).arg(&missing).output().expect("it runs");
        is_refused(&output, &missing, "is in a folder that is not there");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2, "nothing is left");
    }
}

/// Who may write anywhere is made to be someone else.
#[test]
fn nothing_is_run_where_nothing_may_be_written() {
    let is_root = rustix::process::geteuid().is_root();
    for (words, name) in CALLS {
        let folder = folder(&[("failing.rhai", FAILING), (name, "mine")]);
        let program = folder.path().join("choque");
        fs::copy(env!("CARGO_BIN_EXE_choque"), &program).expect("a copy that anyone may start");
        let locked = folder.path().join("locked");
        fs::create_dir(&locked).expect("a folder");
        let call = |file: &str| {
            let mut command = isolated(Command::new(&program));
            if is_root {
                command.uid(NOBODY).gid(NOBODY);
            }
            command.current_dir(folder.path()).args(words.split(' ')).arg(file).output().expect("it runs")
        };
        fs::set_permissions(&locked, Permissions::from_mode(0o555)).expect("its permissions");
        fs::set_permissions(folder.path(), Permissions::from_mode(0o777)).expect("its permissions");
        // Someone else's file, in a folder where files may be replaced; one's own is read-only.
        let closed = Permissions::from_mode(if is_root { 0o644 } else { 0o444 });
        fs::set_permissions(folder.path().join(name), closed).expect("its permissions");
        let before = content(folder.path());
        is_refused(&call(&format!("locked/{name}")), &format!("cannot write locked/{name}"), "ermission denied");
        is_refused(
            &call(name),
            &format!("cannot write {name}"),
            if is_root { "ermission denied" } else { "read-only" },
        );
        assert_eq!(content(folder.path()), before);
        assert_eq!(content(&locked), []);
    }
}

/// A limit on the size of files is met by whoever runs the tests.
#[test]
fn nothing_half_written_is_left_where_there_is_no_room() {
    for (words, name) in [("run --record", "out.choque"), ("run --ledger", "out.csv"), ("render -o", "out.html")] {
        let folder = folder(&[("flying.rhai", FLYING), (name, "mine")]);
        let before = content(folder.path());
        let limited = "trap '' XFSZ; ulimit -f 8; exec \"$@\"";
        let mut command = isolated(Command::new("sh"));
        command
            .args(["-c", limited, "sh", env!("CARGO_BIN_EXE_choque")])
            .args(words.split(' '))
            .args([name, "flying.rhai"]);
        let output = command.current_dir(folder.path()).output().expect("it runs");
        is_refused(&output, &format!("cannot write {name}"), "File too large");
        assert_eq!(content(folder.path()), before);
    }
}
