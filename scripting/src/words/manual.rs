//! The documentation of the words, taken from the words themselves.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use rhai::{Engine, FuncInfo};

use super::{CONSTANTS, groups, register_types};
use crate::callbacks::CALLBACKS;

/// A word of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Its name.
    pub name: String,
    /// Every way of writing it: `body.rect(width, depth)`.
    pub signatures: Vec<String>,
    /// Its documentation, in Markdown; a paragraph for each way of writing it.
    pub docs: String,
    /// `settings`, `bodies`, `expectations`, `fit`, `callbacks`, `world`, `ledger`, `motion`, `random` or
    /// `mathematics`.
    pub group: &'static str,
}

/// All words, group by group, the names of a group in alphabetical order. A property of a body and one of a hit
/// are two words, even of one name.
#[must_use]
pub fn all() -> Vec<Word> {
    let mut words = Vec::new();
    for (group, engine) in engines() {
        if group == "world" {
            words.extend(callbacks());
        }
        words.extend(words_of(group, &engine));
        if group == "mathematics" {
            words.extend(constants(group));
        }
    }
    words
}

/// Writes `.d.rhai` files for editors into a folder, which is made if need be: one for each group of words.
/// Gives the files written.
///
/// # Errors
/// A folder or a file that cannot be written.
pub fn write_definitions(folder: &Path) -> io::Result<Vec<PathBuf>> {
    fs::create_dir_all(folder)?;
    let mut files = vec![("callbacks", definitions_of_callbacks())];
    files.extend(engines().map(|(group, engine)| (group, definitions(&engine))));
    let write = |(group, text): (&str, String)| {
        let file = folder.join(format!("{group}.d.rhai"));
        fs::write(&file, text).map(|()| file)
    };
    files.into_iter().map(write).collect()
}

/// An engine for each group, that knows its words and no others.
fn engines() -> impl Iterator<Item = (&'static str, Engine)> {
    groups().into_iter().map(|(group, module)| {
        let mut engine = Engine::new_raw();
        register_types(&mut engine);
        engine.register_global_module(module.into());
        (group, engine)
    })
}

/// A way of writing a word, as the engine knows it.
struct Entry {
    /// `body`, `world`, `hit`, `ledger`, `account`, or nothing before a plain word.
    receiver: &'static str,
    name: String,
    arity: usize,
    signature: String,
    docs: String,
}

fn words_of(group: &'static str, engine: &Engine) -> Vec<Word> {
    let mut entries: Vec<Entry> = engine.collect_fn_metadata(None, |info| entry(&info), false);
    entries.sort_by(|a, b| (&a.name, a.arity, &a.signature).cmp(&(&b.name, b.arity, &b.signature)));
    let mut words: BTreeMap<(&str, String), Word> = BTreeMap::new();
    for entry in entries {
        let word = words.entry((entry.receiver, entry.name.clone())).or_insert_with(|| Word {
            name: entry.name,
            signatures: Vec::new(),
            docs: String::new(),
            group,
        });
        word.signatures.push(entry.signature);
        if !entry.docs.is_empty() {
            let gap = if word.docs.is_empty() { "" } else { "\n\n" };
            word.docs += &format!("{gap}{}", entry.docs);
        }
    }
    words.into_values().collect()
}

/// `None` of what is no word: signs, and what only Rhai itself calls.
fn entry(info: &FuncInfo) -> Option<Entry> {
    let function = info.metadata;
    let parameters: Vec<(&str, &str)> = function.params_info.iter().map(|parameter| named_type(parameter)).collect();
    let receiver = match parameters.first() {
        Some((_, "Body")) => "body",
        Some((_, "World")) => "world",
        Some((_, "Hit")) => "hit",
        Some((_, "Ledger")) => "ledger",
        Some((_, "Account")) => "account",
        _ => "",
    };
    let shown = parameters.iter().map(|(name, kind)| if *kind == "Closure" { "|world| …" } else { *name });
    let shown: Vec<&str> = shown.collect();
    let arguments = |skipped: usize| shown[skipped..].join(", ");
    let (name, signature) = match &*function.name {
        "index$get$" => ("[]".to_owned(), format!("{receiver}[{}]", arguments(1))),
        "index$set$" | "to_string" | "to_debug" => return None,
        name if name.starts_with(|c: char| !c.is_alphabetic()) => return None,
        name => match name.split_once('$') {
            Some(("get", property)) => (property.to_owned(), format!("{receiver}.{property}")),
            Some((_, property)) => (property.to_owned(), format!("{receiver}.{property} = …")),
            None if receiver.is_empty() => (name.to_owned(), format!("{name}({})", arguments(0))),
            None => (name.to_owned(), format!("{receiver}.{name}({})", arguments(1))),
        },
    };
    let docs = plain_docs(function.comments.iter().map(|comment| comment.as_str()));
    Some(Entry { receiver, name, arity: function.num_params, signature, docs })
}

/// `body: &mut Body` as `("body", "Body")`.
fn named_type(parameter: &str) -> (&str, &str) {
    let (name, kind) = parameter.split_once(':').unwrap_or((parameter, ""));
    (name.trim(), kind.rsplit(['&', ' ']).next().unwrap_or(kind).trim())
}

/// Documentation without its slashes, and without the backslashes that Rust's own documentation wants.
fn plain_docs<'a>(comments: impl Iterator<Item = &'a str>) -> String {
    let lines = comments.flat_map(str::lines).map(|line| {
        let text = line.trim_start_matches('/');
        text.strip_prefix(' ').unwrap_or(text)
    });
    lines.collect::<Vec<_>>().join("\n").replace("\\[", "[").replace("\\]", "]")
}

fn constants(group: &'static str) -> impl Iterator<Item = Word> {
    CONSTANTS.iter().map(move |constant| Word {
        name: constant.name.to_owned(),
        signatures: vec![constant.name.to_owned()],
        docs: constant.docs.to_owned(),
        group,
    })
}

fn callbacks() -> impl Iterator<Item = Word> {
    CALLBACKS.iter().map(|callback| Word {
        name: callback.name.to_owned(),
        signatures: vec![format!("fn {}({})", callback.name, callback.parameters.join(", "))],
        docs: callback.docs.to_owned(),
        group: "callbacks",
    })
}

/// The engine's own definitions, without what only Rhai itself calls.
fn definitions(engine: &Engine) -> String {
    let text = engine.definitions().with_headers(true).include_standard_packages(false).static_module();
    let kept = text.split("\n\n").filter(|block| !block.contains("fn index$") && !block.trim().is_empty());
    let blocks: Vec<String> = kept.map(|block| block.trim().replace("\\[", "[").replace("\\]", "]")).collect();
    blocks.join("\n\n") + "\n"
}

fn definitions_of_callbacks() -> String {
    let mut text = "module static;\n".to_owned();
    for callback in &CALLBACKS {
        let docs: Vec<String> = callback.docs.lines().map(|line| format!("/// {line}").trim_end().to_owned()).collect();
        let typed = |name: &&str| if *name == "hit" { "hit: Hit".to_owned() } else { "world: World".to_owned() };
        let parameters: Vec<String> = callback.parameters.iter().map(typed).collect();
        text += &format!("\n{}\nfn {}({}) -> ?;\n", docs.join("\n"), callback.name, parameters.join(", "));
    }
    text
}
