//! `choque render`: a run as a picture of one moment, as a moving picture, or as a page that plays it.
//!
//! | what | file |
//! |---|---|
//! | the run itself, from a recording or played anew | [`source`] |
//! | where things stand on the page | `view` |
//! | one moment as a drawing: bodies, trails, contacts, names | [`moment`] |
//! | many moments as a GIF | `animation`, `colours` |

mod animation;
mod colours;
pub mod moment;
pub mod source;
mod view;

use std::path::PathBuf;

use crate::arguments::{ScenarioArguments, time};
use crate::plot::{raster, svg};
use crate::recording::Recording;
use crate::written::{self, Kind};
use crate::{Error, Verdict, player, terminal};
use moment::Moment;

/// What `render` is given.
#[derive(Clone, Debug, clap::Args)]
pub struct RenderArguments {
    /// A `.rhai` script, a `.ron` scene, or a `.choque` recording
    pub file: PathBuf,
    /// Where to: its extension says what is made, svg, png, gif or html
    #[arg(short, long, value_name = "PICTURE")]
    pub output: PathBuf,
    /// The moment shown, in seconds; the end unless it is said
    #[arg(long, value_name = "TIME", value_parser = time, allow_negative_numbers = true, conflicts_with = "iteration")]
    pub at: Option<f64>,
    /// The moment shown, by the iterations finished
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub iteration: Option<u64>,
    /// Pixels across, 64 … 4096
    #[arg(long, value_name = "PIXELS", default_value = "960", value_parser = clap::value_parser!(u32).range(64..=4096))]
    pub width: u32,
    /// Pictures a second in a GIF, 1 … 50
    #[arg(long, value_name = "N", default_value = "25", value_parser = clap::value_parser!(u32).range(1..=50))]
    pub fps: u32,
    /// Overrides and folders.
    #[command(flatten)]
    pub scenario: ScenarioArguments,
}

/// What can be made of a run, by the extension of its file.
const KINDS: [Kind; 4] = [
    Kind { what: "picture", extension: "svg", flag: "-o" },
    Kind { what: "picture", extension: "png", flag: "-o" },
    Kind { what: "moving picture", extension: "gif", flag: "-o" },
    Kind { what: "page", extension: "html", flag: "-o" },
];

/// Pixels of a PNG for each of the drawing's: lines of one would be thin.
const FINE: f64 = 1.5;

/// Makes a picture, a moving picture or a page of a run.
///
/// # Errors
/// A name that says none of these; a scenario that cannot be run, a recording that cannot be read; a moment that is not in the run;
/// a file that cannot be written.
pub fn render(arguments: &RenderArguments) -> Result<Verdict, Error> {
    let RenderArguments { file, output, .. } = arguments;
    let extension = output.extension().and_then(|extension| extension.to_str());
    let Some(kind) = KINDS.iter().find(|kind| Some(kind.extension) == extension) else {
        let message = format!("{} is no name for a picture", output.display());
        return Err(Error::Call {
            message,
            hint: "its extension says what is made: .svg, .png, .gif or .html".to_owned(),
        });
    };
    kind.check(output)?;
    if (arguments.at.is_some() || arguments.iteration.is_some()) && matches!(kind.extension, "gif" | "html") {
        let message = format!("a {} shows all of a run, not one moment of it", kind.what);
        return Err(Error::Call { message, hint: "--at and --iteration are for .svg and .png".to_owned() });
    }
    let recording = source::recording(file, &arguments.scenario.options())?;
    let content = content(&recording, kind.extension, arguments)?;
    written::replace(output, content.as_slice())?;
    terminal::tell(&format!("wrote {}\n", output.display()));
    Ok(Verdict::Holds)
}

fn content(recording: &Recording, extension: &str, arguments: &RenderArguments) -> Result<Vec<u8>, Error> {
    let width = f64::from(arguments.width);
    let too_large = || Error::Call {
        message: "the picture has more pixels than can be drawn".to_owned(),
        hint: "give a smaller --width".to_owned(),
    };
    match extension {
        "gif" => animation::gif(recording, width, arguments.fps),
        "html" => player::page(recording).map(String::into_bytes),
        "png" => {
            let drawing = moment(recording, arguments)?.draw(width / FINE);
            raster::png(&drawing, FINE).ok_or_else(too_large)
        }
        _ => Ok(svg::svg(&moment(recording, arguments)?.draw(width)).into_bytes()),
    }
}

/// The moment that was asked for: the frame nearest to it.
fn moment<'a>(recording: &'a Recording, arguments: &RenderArguments) -> Result<Moment<'a>, Error> {
    let last = recording.frames.last().map_or((0, 0.0), |frame| (frame.iteration, frame.time));
    let beyond = |what: String| Error::Call {
        message: format!("{what} is not in the run"),
        hint: format!("it ends at iteration {}, at {} s", last.0, last.1),
    };
    let nearest = |distance: &dyn Fn(&crate::recording::Frame) -> f64| {
        let frames = recording.frames.iter().enumerate();
        frames.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map_or(0, |(at, _)| at)
    };
    let at = match (arguments.at, arguments.iteration) {
        (Some(time), _) if time < 0.0 || time > last.1 => return Err(beyond(format!("--at {time}"))),
        (Some(time), _) => nearest(&|frame| (frame.time - time).abs()),
        (None, Some(iteration)) if iteration > last.0 => return Err(beyond(format!("--iteration {iteration}"))),
        (None, Some(iteration)) => nearest(&|frame| frame.iteration.abs_diff(iteration) as f64),
        (None, None) => recording.frames.len().saturating_sub(1),
    };
    Ok(Moment::of(recording, at))
}
