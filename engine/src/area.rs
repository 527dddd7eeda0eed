//! The collision area (§2.2): from 3D vertices to a rectangle, once, at load.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// A point or a vector in the collision plane. The document's (x, z) are nalgebra's `.x` and `.y`.
pub type Vec2 = Vector2<f64>;

/// A rectangle in a body's own frame (SRO); it need not be centred on the body \[m\].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[repr(C)]
pub struct Rect {
    /// X_min.
    pub x_min: f64,
    /// X_max, > X_min.
    pub x_max: f64,
    /// Z_min.
    pub z_min: f64,
    /// Z_max, > Z_min.
    pub z_max: f64,
}

impl Rect {
    /// As it lies in memory: X_min, X_max, Z_min, Z_max.
    #[inline(always)]
    pub(crate) fn row(&self) -> [f64; 4] {
        [self.x_min, self.x_max, self.z_min, self.z_max]
    }

    /// The rectangle of that width (along X) and depth (along Z) centred on its body.
    #[must_use]
    pub fn centred(width: f64, depth: f64) -> Self {
        Rect { x_min: -0.5 * width, x_max: 0.5 * width, z_min: -0.5 * depth, z_max: 0.5 * depth }
    }

    /// Size along X \[m\].
    #[must_use]
    pub fn width(&self) -> f64 {
        self.x_max - self.x_min
    }

    /// Size along Z \[m\].
    #[must_use]
    pub fn depth(&self) -> f64 {
        self.z_max - self.z_min
    }

    /// Its middle.
    #[must_use]
    pub fn centre(&self) -> Vec2 {
        Vec2::new(0.5 * (self.x_min + self.x_max), 0.5 * (self.z_min + self.z_max))
    }

    /// Half its size along X and Z.
    #[must_use]
    pub fn half(&self) -> Vec2 {
        Vec2::new(0.5 * self.width(), 0.5 * self.depth())
    }

    /// The greatest distance of any of its points from its body's centre \[m\].
    #[must_use]
    #[inline]
    pub fn radius(&self) -> f64 {
        let (x, z) = (self.x_min.abs().max(self.x_max.abs()), self.z_min.abs().max(self.z_max.abs()));
        (x * x + z * z).sqrt()
    }

    /// A quick bound on [`Rect::radius`] \[m\].
    #[must_use]
    #[inline]
    pub fn far(&self) -> f64 {
        self.x_min.abs().max(self.x_max.abs()) + self.z_min.abs().max(self.z_max.abs())
    }

    /// Its vertices in the order of reading R4.
    ///
    /// ```text
    ///   z
    ///   ^   3 ───── 2
    ///   │   │       │
    ///   │   0 ───── 1
    ///   └──────────────> x
    /// ```
    #[must_use]
    #[inline]
    pub fn vertices(&self) -> [Vec2; 4] {
        [
            Vec2::new(self.x_min, self.z_min),
            Vec2::new(self.x_max, self.z_min),
            Vec2::new(self.x_max, self.z_max),
            Vec2::new(self.x_min, self.z_max),
        ]
    }

    /// The rectangle with its frame scaled along X and Z.
    #[must_use]
    pub fn scaled(&self, scale_x: f64, scale_z: f64) -> Rect {
        Rect {
            x_min: self.x_min * scale_x,
            x_max: self.x_max * scale_x,
            z_min: self.z_min * scale_z,
            z_max: self.z_max * scale_z,
        }
    }

    /// The smallest rectangle around both.
    #[must_use]
    pub fn joined(&self, other: &Rect) -> Rect {
        Rect {
            x_min: self.x_min.min(other.x_min),
            x_max: self.x_max.max(other.x_max),
            z_min: self.z_min.min(other.z_min),
            z_max: self.z_max.max(other.z_max),
        }
    }
}

/// The extent of a mesh in its own frame \[m\]: all that the area needs of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Extent {
    /// Least and greatest x of any vertex.
    pub x: (f64, f64),
    /// Least and greatest y (height) of any vertex.
    pub y: (f64, f64),
    /// Least and greatest z of any vertex.
    pub z: (f64, f64),
}

impl Extent {
    /// Least and greatest coordinates over the vertices `[x, y, z]`; `None` of no vertices.
    #[must_use]
    pub fn of(vertices: impl IntoIterator<Item = [f64; 3]>) -> Option<Extent> {
        let widen = |(least, greatest): (f64, f64), v: f64| (v.min(least), v.max(greatest));
        vertices.into_iter().fold(None, |extent, [x, y, z]| {
            let e = extent.unwrap_or(Extent { x: (x, x), y: (y, y), z: (z, z) });
            Some(Extent { x: widen(e.x, x), y: widen(e.y, y), z: widen(e.z, z) })
        })
    }

    /// Whether the mesh, scaled and raised to `height`, crosses the plane (reading R2; touching counts).
    #[must_use]
    pub fn crosses(&self, scale_y: f64, height: f64, plane: f64) -> bool {
        self.y.0 * scale_y + height <= plane && plane <= self.y.1 * scale_y + height
    }

    /// The area: the rectangle of the extremes, scaled (reading R1).
    #[must_use]
    pub fn area(&self, scale_x: f64, scale_z: f64) -> Rect {
        Rect { x_min: self.x.0, x_max: self.x.1, z_min: self.z.0, z_max: self.z.1 }.scaled(scale_x, scale_z)
    }
}
