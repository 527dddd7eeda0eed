//! How far apart two results are: the greatest displacement of a vertex over the body's half diagonal.
//!
//! It mixes place and angle without a weight that someone has to choose, needs no angle wrapped, and is what a person sees.

use choque_engine::scene::{Body, Kind, Scene};
use choque_engine::{Rect, Vec2, World, load};

/// The bodies whose places are compared, each with the vertices of all its rectangles in its own frame: the mobile
/// ones, or all when none is.
#[derive(Clone, Debug)]
pub struct Shapes {
    bodies: Vec<Shape>,
}

#[derive(Clone, Debug)]
struct Shape {
    index: usize,
    vertices: Vec<Vec2>,
    half_diagonal: f64,
}

/// Where the vertices of the compared bodies are, body after body \[m\].
#[derive(Clone, Debug, PartialEq)]
pub struct Stand(Vec<Vec2>);

/// Where a body is: its centre, and its angle \[m, rad\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Its centre O.
    pub at: Vec2,
    /// Its angle, of any number of turns.
    pub angle: f64,
}

/// How far two stands are apart, in half diagonals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distance {
    /// Of the body that is furthest off.
    pub max: f64,
    /// Root of the mean square over the bodies.
    pub rms: f64,
}

impl Shapes {
    /// Those of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let any_mobile = scene.bodies.iter().any(|body| body.kind == Kind::Mobile);
        let compared = |(_, body): &(usize, &Body)| !any_mobile || body.kind == Kind::Mobile;
        let shape = |(index, body): (usize, &Body)| {
            let rects: Vec<Rect> = load::all_areas(body).collect();
            let vertices = rects.iter().flat_map(Rect::vertices).collect();
            (!rects.is_empty()).then(|| Shape { index, vertices, half_diagonal: half_diagonal(&rects) })
        };
        Shapes { bodies: scene.bodies.iter().enumerate().filter(compared).filter_map(shape).collect() }
    }

    /// Those of some bodies of a scene only, told by their number.
    #[must_use]
    pub fn only(scene: &Scene, bodies: &[usize]) -> Self {
        let mut shapes = Shapes::of(scene);
        shapes.bodies.retain(|shape| bodies.contains(&shape.index));
        shapes
    }

    /// How many bodies are compared.
    #[must_use]
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Whether there is nothing to compare.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Where everything stands in a world of that scene.
    #[must_use]
    pub fn stand(&self, world: &World) -> Stand {
        let ids: Vec<_> = world.ids().collect();
        self.stand_at(|index| Pose { at: world.position(ids[index]), angle: world.angle(ids[index]) })
    }

    /// Where everything stands when each body of the scene is where it is told to be.
    pub fn stand_at(&self, pose: impl Fn(usize) -> Pose) -> Stand {
        let placed = |shape: &Shape| {
            let Pose { at, angle } = pose(shape.index);
            let (sin, cos) = libm::sincos(angle);
            let place = move |v: &Vec2| at + Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
            shape.vertices.iter().map(place).collect::<Vec<_>>()
        };
        Stand(self.bodies.iter().flat_map(placed).collect())
    }

    /// How far apart two stands are, body by body in half diagonals.
    #[must_use]
    pub fn each(&self, a: &Stand, b: &Stand) -> Vec<f64> {
        let mut vertices = a.0.iter().zip(&b.0);
        let furthest = |shape: &Shape| {
            let displacements = vertices.by_ref().take(shape.vertices.len()).map(|(a, b)| (a - b).norm());
            displacements.fold(0.0, f64::max) / shape.half_diagonal
        };
        self.bodies.iter().map(furthest).collect()
    }

    /// How far apart two stands are.
    #[must_use]
    pub fn distance(&self, a: &Stand, b: &Stand) -> Distance {
        let each = self.each(a, b);
        let squares: f64 = each.iter().map(|distance| distance * distance).sum();
        Distance { max: each.iter().copied().fold(0.0, f64::max), rms: (squares / each.len().max(1) as f64).sqrt() }
    }
}

/// Of every body of a scene \[m\]; 1 m for a body without rectangles.
#[must_use]
pub fn half_diagonals(scene: &Scene) -> Vec<f64> {
    scene.bodies.iter().map(|body| half_diagonal(&load::all_areas(body).collect::<Vec<_>>())).collect()
}

/// Half the diagonal of the rectangle around all of a body's rectangles, in its own frame.
fn half_diagonal(rects: &[Rect]) -> f64 {
    let around = rects.iter().copied().reduce(|a, b| Rect {
        x_min: a.x_min.min(b.x_min),
        x_max: a.x_max.max(b.x_max),
        z_min: a.z_min.min(b.z_min),
        z_max: a.z_max.max(b.z_max),
    });
    around.map_or(1.0, |rect| rect.half().norm())
}

#[cfg(test)]
mod tests {
    use choque_engine::scene::Part;

    use super::*;

    fn scene(rects: &[Rect]) -> Scene {
        let mut body = Body::new("a", Kind::Mobile);
        body.parts = rects.iter().map(|rect| Part::Rect(*rect)).collect();
        Scene { bodies: vec![Body::new("wall", Kind::Fixed), body], ..Scene::default() }
    }

    fn distance(scene: &Scene, from: Pose, to: Pose) -> Distance {
        let shapes = Shapes::of(scene);
        shapes.distance(&shapes.stand_at(|_| from), &shapes.stand_at(|_| to))
    }

    const HOME: Pose = Pose { at: Vec2::new(0.0, 0.0), angle: 0.0 };

    #[test]
    fn a_body_moved_by_its_half_diagonal_is_off_by_one() {
        let scene = scene(&[Rect::centred(6.0, 8.0)]); // half diagonal 5 m
        let moved = Pose { at: Vec2::new(3.0, 4.0), angle: 0.0 };
        assert_eq!(distance(&scene, HOME, moved), Distance { max: 1.0, rms: 1.0 });
    }

    #[test]
    fn a_turned_body_is_off_by_the_chord_of_its_vertices_and_a_whole_turn_by_nothing() {
        let scene = scene(&[Rect::centred(6.0, 8.0)]);
        let half = distance(&scene, HOME, Pose { angle: std::f64::consts::PI, ..HOME });
        assert!((half.max - 2.0).abs() < 1e-15, "every vertex is across: {half:?}");
        let sixth = distance(&scene, HOME, Pose { angle: std::f64::consts::FRAC_PI_3, ..HOME });
        assert!((sixth.max - 1.0).abs() < 1e-15, "the chord of 60° is the radius: {sixth:?}");
        let whole = distance(&scene, HOME, Pose { angle: std::f64::consts::TAU, ..HOME });
        assert!(whole.max < 1e-15, "{whole:?}");
    }

    #[test]
    fn a_compound_body_is_measured_over_all_its_rectangles() {
        // A bar of 6 × 2 and one beside it: together 6 × 8 about (0, 3), half diagonal 5. Turned about O by 180°, the
        // far corner (3, 7) goes to (−3, −7): √(36 + 196) m.
        let lower = Rect { x_min: -3.0, x_max: 3.0, z_min: -1.0, z_max: 1.0 };
        let upper = Rect { x_min: -3.0, x_max: -2.0, z_min: 1.0, z_max: 7.0 };
        let off = distance(&scene(&[lower, upper]), HOME, Pose { angle: std::f64::consts::PI, ..HOME });
        assert!((off.max - f64::sqrt(4.0 * (9.0 + 49.0)) / 5.0).abs() < 1e-14, "{off:?}");
    }

    #[test]
    fn the_mean_square_is_over_bodies() {
        let mut scene = scene(&[Rect::centred(6.0, 8.0)]);
        let mut other = scene.bodies[1].clone();
        other.name = "b".to_owned();
        scene.bodies.push(other);
        let shapes = Shapes::of(&scene);
        let home = shapes.stand_at(|_| HOME);
        let one_moved = shapes.stand_at(|i| if i == 1 { Pose { at: Vec2::new(5.0, 0.0), ..HOME } } else { HOME });
        assert_eq!(shapes.distance(&home, &one_moved), Distance { max: 1.0, rms: f64::sqrt(0.5) });
    }
}
