//! The book in `docs/book`: every command in it runs, its words are those of the program, its links lead somewhere.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use choque_scripting::words;

use crate::support::{choque, folder, stderr, stdout};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The pages with commands: the chapters and the README.
fn pages() -> Vec<(PathBuf, String)> {
    let chapters =
        fs::read_dir(root().join("docs/book/src")).expect("the book").map(|entry| entry.expect("a file").path());
    let mut pages: Vec<PathBuf> = chapters.filter(|path| path.extension().is_some_and(|e| e == "md")).collect();
    pages.push(root().join("README.md"));
    pages.sort();
    pages.into_iter().map(|path| (path.clone(), fs::read_to_string(&path).expect("a text"))).collect()
}

/// The fenced blocks: language and lines.
fn fenced(text: &str) -> Vec<(&str, Vec<&str>)> {
    let mut blocks: Vec<(&str, Vec<&str>)> = Vec::new();
    let mut inside = false;
    for line in text.lines() {
        match line.strip_prefix("```") {
            Some(_) if inside => inside = false,
            Some(language) => {
                blocks.push((language, Vec::new()));
                inside = true;
            }
            None if inside => blocks.iter_mut().last().expect("a block").1.push(line),
            None => {}
        }
    }
    blocks
}

/// The lines of the fenced blocks in one of these languages.
fn blocks<'a>(text: &'a str, languages: &[&str]) -> Vec<&'a str> {
    fenced(text).into_iter().filter(|(language, _)| languages.contains(language)).flat_map(|(_, lines)| lines).collect()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder").map(|entry| entry.expect("an entry")) {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).expect("a copy");
        }
    }
}

/// The scripts that a page says to save: "Save it as `NAME`" after the block they stand in.
fn scripts(text: &str) -> Vec<(&str, &str)> {
    let mut parts = text.split("Save it as `");
    let mut before = parts.next().unwrap_or_default();
    let mut scripts = Vec::new();
    for part in parts {
        let name = part.split('`').next().unwrap_or_default();
        let script = before.rsplit("```rhai\n").next().and_then(|rest| rest.split("```").next());
        scripts.push((name, script.expect("a script before its name")));
        before = part;
    }
    scripts
}

/// A picture of the book or the README that a command has just made anew is the one that is shown; gives how many there were.
fn check_pictures(page: &Path, scratch: &Path) -> usize {
    let shown =
        ["docs/book/src/pictures", "docs/pictures"].map(|folder| fs::read_dir(root().join(folder)).expect("pictures"));
    let inside = fs::read_dir(scratch).expect("a folder").map(|entry| entry.expect("an entry").path());
    let folders: Vec<PathBuf> = inside.filter(|path| path.is_dir()).chain([scratch.to_owned()]).collect();
    let mut made = 0;
    for shown in shown.into_iter().flatten().map(|entry| entry.expect("a picture").path()) {
        for folder in &folders {
            let anew = folder.join(shown.file_name().expect("a name"));
            if anew.is_file() && std::env::var_os("UPDATE_BOOK").is_some() {
                fs::copy(&anew, &shown).expect("a copy");
            }
            if anew.is_file() {
                let [was, is] = [&shown, &anew].map(|path| fs::read(path).expect("a picture"));
                assert!(was == is, "{}: {} is not what its command makes", page.display(), shown.display());
                made += 1;
            }
        }
    }
    made
}

/// Page by page in a folder with the shipped scenarios and the scripts that it says to save, one command after the other: none may be
/// told that it is wrong, and what a script that is run expects holds unless the page says so. A block of text that follows stands in
/// what was said.
#[test]
fn every_command_in_the_book_runs() {
    let (mut commands, mut told) = (0, 0);
    let mut pictures = BTreeSet::new();
    for (page, text) in pages() {
        let scratch = folder(&[]);
        copy(&root().join("scenarios"), &scratch.path().join("scenarios"));
        for (name, script) in scripts(&text) {
            fs::write(scratch.path().join(name), script).expect("a script");
        }
        let mut said = String::new();
        let blocks = fenced(&text);
        for (at, (language, lines)) in blocks.iter().enumerate() {
            let language = *language;
            let told_next = blocks.get(at + 1).filter(|(next, _)| *next == "text");
            let may_fail = told_next.is_some_and(|(_, lines)| lines.iter().any(|line| line.starts_with('✗')));
            if language == "text" {
                for line in lines.iter().filter(|line| !line.trim().is_empty() && line.trim() != "…") {
                    assert!(said.contains(line.trim()), "{}: \"{line}\" is not in\n{said}", page.display());
                    told += 1;
                }
            }
            for call in lines.iter().filter(|_| language == "console").filter_map(|line| line.strip_prefix("$ choque "))
            {
                let output =
                    choque().current_dir(scratch.path()).args(call.split_whitespace()).output().expect("it starts");
                let code = output.status.code();
                let most = i32::from(may_fail || !call.starts_with("run "));
                let said_so = format!("{}: {call}: {}", page.display(), stderr(&output));
                assert!(code.is_some_and(|code| (0..=most).contains(&code)), "{said_so}");
                said = format!("{}{}", stdout(&output), stderr(&output));
                commands += 1;
                if check_pictures(&page, scratch.path()) > 0 {
                    pictures.insert(call.to_owned());
                }
            }
        }
    }
    assert!(commands > 30 && pictures.len() >= 6 && told > 3, "{commands} commands, {pictures:?}, {told} lines");
}

/// What no test can run is marked, and rare.
#[test]
fn commands_that_are_not_run_are_marked() {
    for (page, text) in &pages() {
        for line in blocks(text, &["console"]) {
            assert!(line.starts_with("$ choque "), "{}: {line}", page.display());
        }
        if page.ends_with("README.md") {
            continue;
        }
        let by_hand = blocks(text, &["sh"]);
        assert!(by_hand.is_empty() || by_hand[0].starts_with("# by hand"), "{}", page.display());
    }
}

/// Whole scenarios, each of them saved and therefore run.
#[test]
fn every_recipe_is_a_scenario_that_is_run() {
    let (_, text) = pages().into_iter().find(|(page, _)| page.ends_with("recipes.md")).expect("the recipes");
    let told = fenced(&text).into_iter().filter(|(language, _)| *language == "rhai").count();
    let saved = scripts(&text);
    assert!(told == saved.len() && told >= 10, "{told} scenarios, {} saved", saved.len());
    for (name, script) in saved {
        assert!(script.contains("expect(") || script.contains("target("), "{name} expects nothing");
        assert!(
            text.contains(&format!("$ choque run {name}")) || text.contains(&format!("$ choque fit {name}")),
            "{name}"
        );
    }
}

/// `UPDATE_BOOK=1 cargo test` writes the page anew.
#[test]
fn the_words_of_the_book_are_those_of_the_program() {
    let mut page = "# The words\n\n\
        A scenario is a script in [Rhai](https://rhai.rs/book): `let`, `if`, `for`, `fn`, arrays, texts and `print` are its own. These are the \
        words that choque\nadds, with units in brackets. `choque words swing` prints one, `choque words --definitions DIR` writes them for editors.\n"
        .to_owned();
    let mut group = "";
    let all = words::all();
    for word in &all {
        if word.group != group {
            group = word.group;
            page += &format!("\n## {group}\n");
        }
        let signatures: Vec<String> = word.signatures.iter().map(|signature| format!("`{signature}`")).collect();
        page += &format!("\n### {}\n\n{}\n", signatures.join(" · "), word.docs.trim());
    }
    let path = root().join("docs/book/src/words.md");
    if std::env::var_os("UPDATE_BOOK").is_some() {
        fs::write(&path, &page).expect("the page");
    }
    assert_eq!(fs::read_to_string(path).unwrap_or_default(), page, "UPDATE_BOOK=1 cargo test writes it anew");
}

#[test]
fn every_link_in_the_book_leads_somewhere() {
    let summary = fs::read_to_string(root().join("docs/book/src/SUMMARY.md")).expect("a summary");
    for (page, text) in pages().iter().filter(|(page, _)| !page.ends_with("README.md")) {
        let name = page.file_name().expect("a name").to_string_lossy();
        assert!(name == "SUMMARY.md" || summary.contains(&format!("({name})")), "{name} is in the summary");
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let is_local = !target.contains("://")
                && Path::new(target).extension().is_some_and(|e| e == "md" || e == "svg" || e == "png");
            assert!(!is_local || root().join("docs/book/src").join(target).exists(), "{name}: {target}");
        }
    }
}
