//! Detection (§2.3): whether and where two bodies overlap.

pub mod complete;
pub mod deepest;
pub mod manifold;
pub(crate) mod near;
pub mod overlap;
pub mod seams;
pub mod sides;
pub mod touch;
pub mod vertices;

use crate::area::{Rect, Vec2};
use crate::bodies::Bodies;
use crate::scene::Detection;
use crate::work::Work;
use manifold::Manifold;
use sides::Sides;

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
    /// All four, in the order of reading R5.
    pub const ALL: [Face; 4] = [Face::XMax, Face::XMin, Face::ZMax, Face::ZMin];

    /// How far inside the face a point lies \[m\]; negative outside (§2.4).
    #[inline]
    #[must_use]
    pub fn depth_of(self, rect: &Rect, point: Vec2) -> f64 {
        match self {
            Face::XMax => rect.x_max - point.x,
            Face::XMin => point.x - rect.x_min,
            Face::ZMax => rect.z_max - point.y,
            Face::ZMin => point.y - rect.z_min,
        }
    }

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

    /// Whether its normal points along +X or +Z.
    #[inline]
    #[must_use]
    pub fn is_positive(self) -> bool {
        matches!(self, Face::XMax | Face::ZMax)
    }

    /// The face across from it.
    #[must_use]
    pub fn opposite(self) -> Face {
        match self {
            Face::XMax => Face::XMin,
            Face::XMin => Face::XMax,
            Face::ZMax => Face::ZMin,
            Face::ZMin => Face::ZMax,
        }
    }

    /// Where along the face a point lies \[m\]: its z for a face at an x, its x for a face at a z.
    #[inline]
    #[must_use]
    pub fn along(self, point: Vec2) -> f64 {
        if matches!(self, Face::XMax | Face::XMin) { point.y } else { point.x }
    }

    /// From where to where the face reaches along itself \[m\].
    #[inline]
    #[must_use]
    pub fn width(self, rect: &Rect) -> (f64, f64) {
        match self {
            Face::XMax | Face::XMin => (rect.z_min, rect.z_max),
            Face::ZMax | Face::ZMin => (rect.x_min, rect.x_max),
        }
    }

    /// The point of the face at a place along it.
    #[must_use]
    pub fn place(self, rect: &Rect, along: f64) -> Vec2 {
        self.project(rect, Vec2::repeat(along))
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

/// The one contact that the document treats: the first vertex, or the mean of the manifold's points (R10).
#[must_use]
pub fn contact(
    detection: Detection,
    bodies: &Bodies,
    (i, j): (usize, usize),
    sides: &Sides,
    work: &mut Work,
) -> Option<Contact> {
    match detection {
        Detection::Vertices => vertices::find(bodies, i, j, work),
        Detection::Complete => complete::find(bodies, i, j, sides, work).map(|manifold| manifold.mean()),
    }
}

/// The points of contact that impulses act at: the first vertex alone, or the whole manifold.
#[must_use]
pub fn manifold(
    detection: Detection,
    bodies: &Bodies,
    (i, j): (usize, usize),
    sides: &Sides,
    work: &mut Work,
) -> Option<Manifold> {
    match detection {
        Detection::Vertices => vertices::find(bodies, i, j, work).map(Manifold::from),
        Detection::Complete => complete::find(bodies, i, j, sides, work),
    }
}
