//! Ways to solve lasting contact, measured on the same scenes: errors, and what they cost.
//!
//!     cargo run --release -p choque-methods                    # a table
//!     cargo run --release -p choque-methods -- -o docs/accuracy  # methods.md, methods.csv and pictures there

mod avbd;
mod block;
mod contact;
mod detect;
mod finish;
mod measure;
mod method;
mod report;
mod scenes;
mod soft;
mod suite;
mod world;

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (folder, only) = match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        [] => (None, None),
        ["-o", folder] => (Some(PathBuf::from(folder)), None),
        ["--scene", scene] => (None, Some((*scene).to_owned())),
        _ => return Err("usage: choque-methods [-o DIR | --scene NAME]".into()),
    };
    let runs = suite::played(only.as_deref(), |run| {
        // Whoever has read enough may close the pipe.
        let _ = writeln!(std::io::stdout(), "{}", report::line(run));
    });
    if runs.is_empty() {
        return Err(format!("no such scene; there are: {}", suite::names().join(", ")).into());
    }
    match folder {
        Some(folder) => report::write(&folder, &runs),
        None => Ok(()),
    }
}
