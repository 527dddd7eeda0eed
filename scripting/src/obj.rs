//! The vertices of a Wavefront `.obj` file: all that an area needs of it.
//!
//! The `v` lines are read; what else the format knows is passed over, as it has no part in the area. Anything
//! the format does not know is an error with its line, for it is perhaps a mistyped vertex.

use crate::error::{Complaint, Elsewhere};
use crate::library::{Found, Library, read_text};

/// The other statements of the format (Wavefront's specification, version 3.0, and `l`, `mtllib` as written today).
const PASSED_OVER: [&str; 37] = [
    "vt",
    "vn",
    "vp",
    "cstype",
    "deg",
    "bmat",
    "step",
    "p",
    "l",
    "f",
    "fo",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "g",
    "s",
    "mg",
    "o",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "usemtl",
    "mtllib",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "usemap",
    "maplib",
];

/// Reads the vertices `[x, y, z]` of a file, which the library remembers.
///
/// # Errors
/// What cannot be read, an unknown statement, a number that is none.
pub(crate) fn read_vertices(library: &Library, found: &Found) -> Result<Vec<[f64; 3]>, Complaint> {
    let text = read_text(&found.canonical, &found.shown)
        .map_err(|error| Complaint::new(format!("model: {}", error.message)).maybe_hint(error.hint))?;
    let vertices = parse(&text).map_err(|wrong| Complaint {
        elsewhere: Some(Box::new(Elsewhere {
            file: found.shown.clone(),
            line: wrong.line,
            column: wrong.column,
            text: text.clone(),
        })),
        ..Complaint::new(wrong.message)
    })?;
    library.keep_model(&found.shown.display().to_string(), text);
    Ok(vertices)
}

/// What is wrong with a file, and where; lines and columns count from 1.
#[derive(Debug, PartialEq, Eq)]
struct Wrong {
    line: usize,
    column: usize,
    message: String,
}

fn parse(text: &str) -> Result<Vec<[f64; 3]>, Wrong> {
    let mut vertices = Vec::new();
    let mut is_continuation = false;
    for (at, line) in text.lines().enumerate() {
        let wrong = |word: &str, message: String| {
            // `word` is a piece of `line`, so their addresses tell where it stands in it.
            let before = word.as_ptr() as usize - line.as_ptr() as usize;
            Wrong { line: at + 1, column: line[..before].chars().count() + 1, message }
        };
        let mut words = line.split('#').next().unwrap_or("").split_whitespace();
        match words.next() {
            _ if is_continuation => {}
            None => {}
            Some(v @ "v") => vertices.push(vertex(v, words).map_err(|(word, message)| wrong(word, message))?),
            Some(statement) if PASSED_OVER.contains(&statement) => {}
            Some(statement) => {
                return Err(wrong(statement, format!("`{statement}` is not a statement of a .obj file")));
            }
        }
        is_continuation = line.trim_end().ends_with('\\');
    }
    Ok(vertices)
}

/// `v x y z`, with a weight or a colour after them as some programs write; or the word that is wrong, and why.
fn vertex<'a>(v: &'a str, words: impl Iterator<Item = &'a str>) -> Result<[f64; 3], (&'a str, String)> {
    let mut numbers = Vec::new();
    for word in words {
        match word.parse::<f64>() {
            Ok(number) if number.is_finite() => numbers.push(number),
            _ => return Err((word, format!("`{word}` is not a finite number"))),
        }
    }
    match numbers[..] {
        [x, y, z] | [x, y, z, _] | [x, y, z, _, _, _] | [x, y, z, _, _, _, _] => Ok([x, y, z]),
        _ => Err((v, format!("a vertex has x, y and z; here are {} numbers", numbers.len()))),
    }
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn vertices_are_read_and_the_rest_is_passed_over() {
        let text = "# a plate\no plate\nv -1 0.5 2e0 # corner\nv 1 0 -2 1.0\nvn 0 1 0\nf 1//1 2//1 \\\n 1//1\n";
        assert_eq!(parse(text), Ok(vec![[-1.0, 0.5, 2.0], [1.0, 0.0, -2.0]]));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let wrong = |text| parse(text).map_err(|wrong| (wrong.line, wrong.column, wrong.message));
        assert_eq!(wrong("v 1 2 3\nv 1 two 3"), Err((2, 5, "`two` is not a finite number".to_owned())));
        assert_eq!(wrong("v 1 2"), Err((1, 1, "a vertex has x, y and z; here are 2 numbers".to_owned())));
        assert_eq!(wrong("\n w 1 2 3"), Err((2, 2, "`w` is not a statement of a .obj file".to_owned())));
        assert_eq!(wrong("v 1 nan 3"), Err((1, 5, "`nan` is not a finite number".to_owned())));
    }
}
