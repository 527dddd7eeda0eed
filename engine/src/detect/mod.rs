//! Detection (§2.3): whether and where two bodies overlap.

pub mod complete;
pub mod overlap;
pub mod vertices;

use crate::area::{Rect, Vec2};

/// A face of a rectangle, in the order in which reading R5 breaks ties.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// The face at X_max; its outward normal is +X.
    XMax,
    /// The face at X_min; its outward normal is −X.
    XMin,
    /// The face at Z_max; its outward normal is +Z.
    ZMax,
    /// The face at Z_min; its outward normal is −Z.
    ZMin,
}

impl Face {
    /// The outward normal, in the rectangle's own frame.
    #[must_use]
    pub fn normal(self) -> Vec2 {
        match self {
            Face::XMax => Vec2::new(1.0, 0.0),
            Face::XMin => Vec2::new(-1.0, 0.0),
            Face::ZMax => Vec2::new(0.0, 1.0),
            Face::ZMin => Vec2::new(0.0, -1.0),
        }
    }

    /// The point put onto the face, along its normal.
    #[must_use]
    pub fn project(self, rect: &Rect, point: Vec2) -> Vec2 {
        match self {
            Face::XMax => Vec2::new(rect.x_max, point.y),
            Face::XMin => Vec2::new(rect.x_min, point.y),
            Face::ZMax => Vec2::new(point.x, rect.z_max),
            Face::ZMin => Vec2::new(point.x, rect.z_min),
        }
    }
}

/// A vertex of one body found inside another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The body whose vertex it is.
    pub owner: usize,
    /// The body it lies in.
    pub reference: usize,
    /// The vertex in its owner's frame.
    pub vertex: Vec2,
    /// The vertex put onto the nearest face, in the reference's frame.
    pub on_face: Vec2,
    /// The face it is nearest to.
    pub face: Face,
    /// How far inside that face it lies \[m\], ≥ 0.
    pub depth: f64,
}
