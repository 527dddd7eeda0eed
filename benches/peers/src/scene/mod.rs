//! Scenes that belong to no engine: what there is, and by what its outcome is judged.

mod drums;
mod pileup;
mod pyramids;
mod smash;

use clap::ValueEnum;

/// A scene as every engine is given it.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Acceleration of every mobile body \[m/s²\].
    pub gravity: [f64; 2],
    /// Decay rate of mobile bodies' velocity \[1/s\].
    pub drag: f64,
    /// Whether what has come to rest may be left out of the computation.
    pub sleeping: bool,
    /// Steps of a whole run.
    pub steps: usize,
    /// The bodies, in order of creation.
    pub bodies: Vec<Body>,
    /// By what the outcome is judged.
    pub judge: Judge,
}

/// Whether and by what a body is moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Never moves.
    Fixed,
    /// Moves as it was told, whatever it hits.
    Driven,
    /// Moves as it is hit.
    Mobile,
}

/// One body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Whether and by what it is moved.
    pub role: Role,
    /// Its centre of mass \[m\].
    pub at: [f64; 2],
    /// Its angle, anticlockwise \[rad\].
    pub angle: f64,
    /// \[m/s\].
    pub velocity: [f64; 2],
    /// \[rad/s\].
    pub spin: f64,
    /// What it is made of.
    pub rects: Vec<Rect>,
    /// \[kg/m²\].
    pub density: f64,
    /// Coefficient of friction. All engines here are made to take the geometric mean of a pair's.
    pub friction: f64,
    /// Coefficient of restitution. All engines here take the greater of a pair's.
    pub restitution: f64,
    /// Whether it sleeps until it is touched.
    pub asleep: bool,
    /// Whether an engine that asks for it shall sweep it along its path.
    pub bullet: bool,
    /// Whether an engine that can shall give it an infinite moment of inertia; choque needs no such help and ignores it.
    pub locked: bool,
}

/// A rectangle of a body, sides along the body's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Half its width and half its height \[m\].
    pub half: [f64; 2],
    /// Its middle, from the body's \[m\].
    pub at: [f64; 2],
}

/// By what a scene's outcome is judged: the table's `shape_error`.
#[derive(Clone, Debug, PartialEq)]
pub enum Judge {
    /// These bodies should be where they began: the greatest distance \[m\].
    Stay(Vec<usize>),
    /// Mobile bodies should be inside that driven body, whose inside is a square of half that side \[m\]: how many are not.
    Inside {
        /// The drum.
        drum: usize,
        /// Half its inner side \[m\].
        half: f64,
    },
    /// Linear momentum should be kept, and angular momentum about the origin: the greater change, over the momentum of that
    /// body at the start and over the same times its half height.
    Momenta {
        /// The body that brings all the momentum.
        striker: usize,
    },
    /// There is nothing to say.
    Nothing,
}

impl Rect {
    /// A rectangle about the body's centre.
    #[must_use]
    pub fn centred(half: [f64; 2]) -> Self {
        Rect { half, at: [0.0, 0.0] }
    }

    fn area(self) -> f64 {
        4.0 * self.half[0] * self.half[1]
    }
}

impl Body {
    /// A body at rest made of one rectangle: density 1, friction 0.6, no restitution.
    #[must_use]
    pub fn new(role: Role, at: [f64; 2], half: [f64; 2]) -> Self {
        Body {
            role,
            at,
            angle: 0.0,
            velocity: [0.0, 0.0],
            spin: 0.0,
            rects: vec![Rect::centred(half)],
            density: 1.0,
            friction: 0.6,
            restitution: 0.0,
            asleep: false,
            bullet: false,
            locked: false,
        }
    }

    /// Its mass \[kg\].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.density * self.rects.iter().map(|rect| rect.area()).sum::<f64>()
    }

    /// Its moment of inertia about its centre \[kg·m²\].
    #[must_use]
    pub fn inertia(&self) -> f64 {
        let of = |rect: &Rect| {
            let square = |[x, y]: [f64; 2]| x * x + y * y;
            rect.area() * (square(rect.half) / 3.0 + square(rect.at))
        };
        self.density * self.rects.iter().map(of).sum::<f64>()
    }
}

impl Scene {
    /// An empty scene with gravity 10 m/s² downwards.
    #[must_use]
    pub fn new(steps: usize, judge: Judge) -> Self {
        Scene { gravity: [0.0, -10.0], drag: 0.0, sleeping: false, steps, bodies: Vec::new(), judge }
    }

    /// Whether some body is driven, so that energy comes in.
    #[must_use]
    pub fn is_driven(&self) -> bool {
        self.bodies.iter().any(|body| body.role == Role::Driven)
    }

    /// The bodies that are moved by what hits them, with their places in the order of creation.
    pub fn mobile(&self) -> impl Iterator<Item = (usize, &Body)> {
        self.bodies.iter().enumerate().filter(|(_, body)| body.role == Role::Mobile)
    }
}

/// The scenes of the speed table: what peers use for their own benchmarks, rectangles only, and pile-ups.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Name {
    /// 5,050 boxes in one pyramid.
    LargePyramid,
    /// 400 pyramids of 55 boxes on twenty floors.
    ManyPyramids,
    /// 2,025 boxes in a square drum that turns.
    Tumbler,
    /// 8,100 boxes in a wide square drum with paddles.
    Washer,
    /// A heavy box hits 9,600 boxes at rest, without gravity.
    Smash,
    /// 100 cars at random between four walls.
    #[value(name = "pileup100")]
    Pileup100,
    /// 1,000 of them.
    #[value(name = "pileup1000")]
    Pileup1000,
    /// 10,000 of them.
    #[value(name = "pileup10000")]
    Pileup10000,
    /// 100,000 of them.
    #[value(name = "pileup100000")]
    Pileup100000,
}

impl Name {
    /// The scene's word in tables and flags.
    #[must_use]
    pub fn word(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// The scene of that name.
    #[must_use]
    pub fn scene(self) -> Scene {
        match self {
            Name::LargePyramid => pyramids::large_pyramid(),
            Name::ManyPyramids => pyramids::many_pyramids(),
            Name::Tumbler => drums::tumbler(),
            Name::Washer => drums::washer(),
            Name::Smash => smash::smash([120, 80]),
            Name::Pileup100 => pileup::pileup(100),
            Name::Pileup1000 => pileup::pileup(1_000),
            Name::Pileup10000 => pileup::pileup(10_000),
            Name::Pileup100000 => pileup::pileup(100_000),
        }
    }
}

pub use pileup::pileup;
pub use smash::smash;
