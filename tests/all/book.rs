//! The book in `docs/book`: every command in it runs, its words are those of the program, its links lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};

use choque_scripting::words;

use crate::support::{choque, folder, stderr};

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

/// The lines of the fenced blocks in one of these languages.
fn blocks<'a>(text: &'a str, languages: &[&str]) -> Vec<&'a str> {
    let mut lines = Vec::new();
    let mut inside = false;
    for line in text.lines() {
        match line.strip_prefix("```") {
            Some(_) if inside => inside = false,
            Some(language) => inside = languages.contains(&language),
            None if inside => lines.push(line),
            None => {}
        }
    }
    lines
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

/// A picture of the book that a command has just made anew is the one that is shown; gives how many there were.
fn check_pictures(page: &Path, scratch: &Path) -> usize {
    let pictures = fs::read_dir(root().join("docs/book/src/pictures")).expect("pictures");
    let mut made = 0;
    for shown in pictures.map(|entry| entry.expect("a picture").path()) {
        let below = fs::read_dir(scratch).expect("a folder").map(|entry| entry.expect("an entry").path());
        for folder in std::iter::once(scratch.to_owned()).chain(below) {
            let anew = folder.join(shown.file_name().expect("a name"));
            if anew.is_file() {
                let [shown, anew] = [&shown, &anew].map(|path| fs::read(path).expect("a picture"));
                assert!(shown == anew, "{}: a picture is not what its command makes", page.display());
                made += 1;
            }
        }
    }
    made
}

/// Page by page in a folder with the shipped scenarios, one command after the other: none may be told that it is wrong.
#[test]
fn every_command_in_the_book_runs() {
    let (mut commands, mut pictures) = (0, 0);
    for (page, text) in pages() {
        let scratch = folder(&[]);
        copy(&root().join("scenarios"), &scratch.path().join("scenarios"));
        for line in blocks(&text, &["console"]) {
            let Some(call) = line.strip_prefix("$ choque ") else { continue };
            let output =
                choque().current_dir(scratch.path()).args(call.split_whitespace()).output().expect("it starts");
            let code = output.status.code();
            assert!(matches!(code, Some(0 | 1)), "{}: {line}: {}", page.display(), stderr(&output));
            commands += 1;
            pictures += check_pictures(&page, scratch.path());
        }
    }
    assert!(commands > 20 && pictures >= 5, "{commands} commands, {pictures} pictures");
}

/// What no test can run is marked, and rare.
#[test]
fn commands_that_are_not_run_are_marked() {
    for (page, text) in pages().iter().filter(|(page, _)| !page.ends_with("README.md")) {
        for line in blocks(text, &["console"]) {
            assert!(line.starts_with("$ choque "), "{}: {line}", page.display());
        }
        let by_hand = blocks(text, &["sh"]);
        assert!(by_hand.is_empty() || by_hand[0].starts_with("# by hand"), "{}", page.display());
    }
}

/// `UPDATE_BOOK=1 cargo test` writes the page anew.
#[test]
fn the_words_of_the_book_are_those_of_the_program() {
    let mut page = "# The words\n".to_owned();
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
