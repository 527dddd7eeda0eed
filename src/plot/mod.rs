//! Plots without a font, a browser or a style sheet: the same picture as SVG and as PNG, on every machine.
//!
//! | what | file |
//! |---|---|
//! | a plot with its curves | [`figure`] |
//! | a quantity over two others, as colours | [`heat_map`] |
//! | axes and ticks; labels where there is room | [`axis`], `labels` |
//! | colours, dashes, markers | [`palette`] |
//! | text, as strokes of a pen | [`lettering`], [`glyphs`], `marks` |
//! | shapes on a page, and what they are written as | [`drawing`], [`svg`], [`raster`] |

pub mod axis;
pub mod drawing;
pub mod figure;
pub mod glyphs;
pub mod heat_map;
pub(crate) mod labels;
pub mod lettering;
mod marks;
pub mod palette;
pub mod raster;
pub mod svg;

pub use axis::{Axis, Scale};
pub use drawing::Drawing;
pub use figure::{Figure, Point, Series};
pub use heat_map::HeatMap;
pub use palette::Look;
