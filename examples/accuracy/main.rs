//! Writes ACCURACY.md and its pictures: speed against error of the hard suite and the main scenarios, and where the document's
//! own model breaks.
//!
//!     cargo run --release --example accuracy                   # about a quarter of an hour; nothing else should run meanwhile
//!     cargo run --release --example accuracy -- --quick DIR    # a first impression, elsewhere

mod cost;
mod curves;
mod overlaps;
mod page;
mod scenes;
mod stage;
mod suite;

use std::error::Error;
use std::path::{Path, PathBuf};

use choque::report::assemble::Depth;

/// How thorough to be.
#[derive(Clone, Copy)]
struct Effort {
    /// Of a scenario's study.
    depth: Depth,
    /// Points of a random sample.
    samples: usize,
    /// Which scenarios: every one whose number is a multiple of this.
    every: usize,
}

const FULL: Effort = Effort { depth: Depth::FULL, samples: 40_000, every: 1 };
const QUICK: Effort = Effort { depth: Depth::QUICK, samples: 400, every: 6 };

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        [] => write(Path::new(env!("CARGO_MANIFEST_DIR")), FULL),
        ["--quick", folder] => write(Path::new(folder), QUICK),
        _ => Err("usage: accuracy [--quick DIR]".into()),
    }
}

/// Measures everything and writes the page and its pictures below a folder.
fn write(folder: &Path, effort: Effort) -> Result<(), Box<dyn Error>> {
    let pictures: PathBuf = folder.join("docs/accuracy");
    std::fs::create_dir_all(&pictures)?;
    let mut parts = suite::parts(effort, &pictures)?;
    parts.extend(curves::parts(effort, &pictures)?);
    parts.extend(cost::parts(effort)?);
    std::fs::write(folder.join("ACCURACY.md"), page::filled(include_str!("accuracy.md"), &parts)?)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_first_impression_fills_the_whole_page() {
        let folder = tempfile::TempDir::new().expect("a folder");
        write(folder.path(), QUICK).expect("it is written");
        let page = std::fs::read_to_string(folder.path().join("ACCURACY.md")).expect("the page");
        assert!(!page.contains("{{"), "{page}");
        for picture in
            page.split("](").skip(1).filter_map(|rest| rest.split(')').next()).filter(|p| p.ends_with(".svg"))
        {
            // The crate of the peers draws these, and a call of its own writes them.
            let drawn_elsewhere = picture.contains("/peers_");
            let base = if drawn_elsewhere { Path::new(env!("CARGO_MANIFEST_DIR")) } else { folder.path() };
            assert!(base.join(picture).is_file(), "{picture}");
        }
        assert!(page.contains("| stepped, complete |"), "{page}");
    }
}
