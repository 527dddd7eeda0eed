//! Draws a run as one picture: every body's rectangles at regular moments, the last one in full colour.
//!
//!     cargo run --release --example picture -- scenarios/blades/spinning_blade.rhai 400 docs/spinning_blade.svg

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use choque_engine::scene::Kind;
use choque_engine::{BodyId, Scene, Vec2, World, load};
use choque_scripting::{Options, Overrides, Scenario, Step};

/// Moments drawn besides the last.
const MOMENTS: u64 = 14;

/// Colours that colour-blind people tell apart (Okabe and Ito 2008).
const COLOURS: [&str; 6] = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00"];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [script, steps, picture] = arguments.as_slice() else {
        return Err("usage: picture SCRIPT.rhai STEPS PICTURE.svg".into());
    };
    let overrides = Overrides { steps: Some(steps.parse()?), ..Overrides::default() };
    let scenario = Scenario::load(Path::new(script), &Options { overrides, ..Options::default() })?;
    let scene = scenario.scene().clone();
    let mut run = scenario.start()?;
    let mut canvas = Canvas::new(&scene);
    let every = (scene.settings.steps / MOMENTS).max(1);
    loop {
        let iteration = run.world().iteration();
        if iteration.is_multiple_of(every) {
            let age = iteration as f64 / scene.settings.steps as f64;
            canvas.draw(&run.world(), 0.06 + 0.22 * age);
        }
        if run.step()? == Step::Done {
            break;
        }
    }
    canvas.draw(&run.world(), 1.0);
    std::fs::write(picture, canvas.finish())?;
    Ok(())
}

/// Shapes drawn so far, and how far they reach.
struct Canvas<'a> {
    scene: &'a Scene,
    shapes: String,
    low: Vec2,
    high: Vec2,
}

impl<'a> Canvas<'a> {
    fn new(scene: &'a Scene) -> Self {
        let none = Vec2::repeat(f64::INFINITY);
        Canvas { scene, shapes: String::new(), low: none, high: -none }
    }

    fn draw(&mut self, world: &World, opacity: f64) {
        for id in world.ids() {
            let still = world.kind(id) == Kind::Fixed && world.spin(id) == 0.0 && world.velocity(id) == Vec2::zeros();
            if !still || opacity == 1.0 {
                self.draw_body(world, id, opacity);
            }
        }
    }

    fn draw_body(&mut self, world: &World, id: BodyId, opacity: f64) {
        let colour = match world.kind(id) {
            Kind::Fixed => "#555555",
            Kind::Mobile => COLOURS[id.index() % COLOURS.len()],
        };
        let (sin, cos) = libm::sincos(world.angle(id));
        for rect in load::areas(&self.scene.bodies[id.index()], self.scene.settings.plane) {
            let corners =
                rect.vertices().map(|v| world.position(id) + Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y));
            self.shapes.push_str("<polygon points=\"");
            for corner in corners {
                self.low = self.low.inf(&corner);
                self.high = self.high.sup(&corner);
                let _ = write!(self.shapes, "{:.2},{:.2} ", corner.x, -corner.y); // +z upwards
            }
            let _ = writeln!(self.shapes, "\" fill=\"{colour}\" fill-opacity=\"{opacity:.2}\"/>");
        }
    }

    fn finish(&self) -> String {
        let margin = 1.0;
        let size = self.high - self.low + Vec2::repeat(2.0 * margin);
        let width = 760.0;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{:.0}\" viewBox=\"{:.2} {:.2} {:.2} {:.2}\">\n\
             <rect x=\"{:.2}\" y=\"{:.2}\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{}</svg>\n",
            width * size.y / size.x,
            self.low.x - margin,
            -self.high.y - margin,
            size.x,
            size.y,
            self.low.x - margin,
            -self.high.y - margin,
            self.shapes,
        )
    }
}
