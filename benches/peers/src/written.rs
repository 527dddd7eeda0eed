//! `docs/accuracy/peers.md`: a part per table, each with what it was measured on and by which command.

use std::error::Error;
use std::fs;
use std::path::Path;

use choque::plot::{Figure, raster, svg};
use choque::report::study::machine;
use choque::written::replace;

/// The page's name.
const PAGE: &str = "peers.md";

/// Parts of the page: a word, and a heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Marks where it begins.
    pub word: &'static str,
    /// Its heading.
    pub heading: &'static str,
}

/// The parts in the page's order.
pub const PARTS: [Part; 4] = [
    Part { word: "speed", heading: "The same scenes, the same steps" },
    Part { word: "equal-error", heading: "What the same error costs" },
    Part { word: "growth", heading: "How cost grows" },
    Part { word: "accuracy", heading: "Cases whose answers are known" },
];

const HEAD: &str = "# Choque beside Box2D and Rapier\n\n\
Written by the crate `benches/peers`; each part says by which call. All engines run in one process, in turns. Box2D is 3.2 with AVX2 in single precision \
(`boxdd-sys` 0.6.0), Rapier is 0.36.1 in single and in double precision; choque computes in double precision.\n";

/// Puts a part into the page in a folder, in place of the one that was there.
///
/// # Errors
/// A page that cannot be read or written.
pub fn part(folder: &Path, word: &str, call: &str, text: &str) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    let path = folder.join(PAGE);
    let old = if path.exists() { fs::read_to_string(&path)? } else { String::new() };
    let mut page = HEAD.to_owned();
    for Part { word: this, heading } in PARTS {
        let body = if this == word {
            let measured = format!("`{call}`, on {}.", machine());
            Some(format!("\n## {heading}\n\n{measured}\n\n{}\n", text.trim()))
        } else {
            body_of(&old, this).map(str::to_owned)
        };
        if let Some(body) = body {
            page += &format!("\n{}{body}", mark(this));
        }
    }
    Ok(replace(&path, page.as_bytes())?)
}

fn mark(word: &str) -> String {
    format!("<!-- {word} -->\n")
}

/// What stands under a mark, up to the next.
fn body_of<'a>(page: &'a str, word: &str) -> Option<&'a str> {
    let (_, rest) = page.split_once(&mark(word))?;
    Some(rest.split("\n<!-- ").next().unwrap_or(rest))
}

/// Writes a plot as SVG and PNG; gives the line of Markdown that shows it.
///
/// # Errors
/// A file that cannot be written.
pub fn plot(folder: &Path, name: &str, figure: &Figure) -> Result<String, Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    let drawing = figure.draw();
    let png = raster::png(&drawing, 2.0).ok_or("a plot too large for a picture")?;
    replace(&folder.join(format!("{name}.svg")), svg::svg(&drawing).as_bytes())?;
    replace(&folder.join(format!("{name}.png")), png.as_slice())?;
    Ok(format!("![{}]({name}.svg)\n", figure.title))
}

/// Writes data.
///
/// # Errors
/// A file that cannot be written.
pub fn data(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    Ok(replace(&folder.join(name), bytes)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_takes_the_place_of_its_old_self_and_leaves_the_others() {
        let folder = tempfile::TempDir::new().expect("a folder");
        part(folder.path(), "growth", "call one", "first growth").expect("written");
        part(folder.path(), "speed", "call two", "the speed").expect("written");
        part(folder.path(), "growth", "call three", "second growth").expect("written");
        let page = fs::read_to_string(folder.path().join(PAGE)).expect("a page");
        assert!(!page.contains("first growth") && page.contains("`call three`"), "{page}");
        assert!(page.find("the speed") < page.find("second growth"), "{page}");
        assert_eq!(page.matches("## ").count(), 2, "{page}");
    }
}
