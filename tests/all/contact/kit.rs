//! Scenes with gravity in stepped motion, and what is measured of their runs.

use choque_engine::scene::{Body, ExchangeRule, MotionRule, Settings};
use choque_engine::{Scene, World};

use crate::exact::kit::energy_under;
pub(crate) use crate::exact::kit::{Random, State, block, state, wall, watch};

/// Gravity [m/s²].
pub(crate) const G: f64 = 9.81;

/// The designers' time step [s].
pub(crate) const DT: f64 = 1.0 / 60.0;

/// A scene in stepped motion with gravity along −z, the same friction everywhere and no restitution.
pub(crate) fn grounded(time_step: f64, friction: f64, bodies: Vec<Body>) -> Scene {
    let settings = Settings {
        motion: MotionRule::Stepped,
        exchange: ExchangeRule::Impulse,
        gravity: (0.0, -G),
        friction,
        time_step,
        ..Settings::default()
    };
    Scene { settings, bodies, ..Scene::default() }
}

/// A body at rest.
pub(crate) fn resting(name: &str, size: (f64, f64), at: (f64, f64)) -> Body {
    block(name, size, at, (0.0, 0.0), 1.0)
}

/// A floor whose top is z = 0.
pub(crate) fn floor() -> Body {
    wall("floor", (400.0, 1.0), (0.0, -0.5))
}

/// A body of b × h that stands on one lower corner at the origin, turned by `angle`: on its left one if that is positive.
pub(crate) fn on_a_corner(name: &str, (b, h): (f64, f64), angle: f64) -> Body {
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    let arm = if angle >= 0.0 { b / 2.0 } else { -b / 2.0 };
    Body { angle, ..resting(name, (b, h), (arm * c - h / 2.0 * s, arm * s + h / 2.0 * c)) }
}

/// How many steps make up that time, and a little more.
pub(crate) fn steps(time: f64, time_step: f64) -> u32 {
    libm::ceil(time / time_step - 1e-9) as u32
}

/// A body's states: at the start, and after each step.
pub(crate) fn course(scene: &Scene, name: &str, steps: u32) -> Vec<State> {
    let mut states = vec![state(&World::new(scene).expect("a valid scene"), name)];
    watch(scene, steps, |world| states.push(state(world, name)));
    states
}

/// Kinetic and potential energy of the mobile bodies [J], the latter from z = 0.
pub(crate) fn energy(world: &World) -> f64 {
    energy_under(world, G)
}

/// The order in the time step that two errors show.
pub(crate) fn order(coarse: (f64, f64), fine: (f64, f64)) -> f64 {
    libm::log(coarse.1.abs() / fine.1.abs()) / libm::log(coarse.0 / fine.0)
}

/// Errors at falling time steps are within `allowed` · dt each, and fall at first order at least; those within `rounding` or a hundredth
/// of what is allowed are too small to show an order.
#[track_caller]
pub(crate) fn assert_first_order(errors: &[(f64, f64)], allowed: f64, rounding: f64, what: &str) {
    for pair in errors.windows(2) {
        let (coarse, fine) = (pair[0], pair[1]);
        let order = order(coarse, fine);
        println!("{what}: dt {:.2e} → {:.2e}: {:+.3e} → {:+.3e}, order {order:.2}", coarse.0, fine.0, coarse.1, fine.1);
        let too_small = rounding + 0.01 * allowed * fine.0;
        assert!(order > LEAST_ORDER || fine.1.abs() <= too_small, "{what}: order {order:.2} of {errors:?}");
    }
    for (time_step, error) in errors {
        let share = error / time_step;
        assert!(
            error.abs() <= allowed * time_step + rounding,
            "{what}: off by {error:e} at {time_step:e}: {share:.3} dt"
        );
    }
}

/// First order, measured over a ratio of time steps at which the next term of the error still shows.
const LEAST_ORDER: f64 = 0.8;
