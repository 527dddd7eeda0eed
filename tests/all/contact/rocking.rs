//! P6, P6b, P6c, P6d: blocks that rock from foot to foot (Housner 1963).

use super::kit::{G, State, assert_first_order, course, floor, grounded, on_a_corner, steps};

/// How late or early an impact may be, in time steps, for itself and each before it. Observed: 0.001 at 1/240 s, falling at third order.
const STEPS_OFF: f64 = 0.002;

/// How far off the spin before an impact may be, as a share of it, per time step of 1/240 s and impact. Observed: 1.2e-5.
const SPIN_OFF: f64 = 3e-5;

/// A block of b × 1 m that rocks with friction 1, released at a tilt.
fn rocker(b: f64, tilt: f64, time_step: f64, time: f64) -> Vec<State> {
    let scene = grounded(time_step, 1.0, vec![floor(), on_a_corner("block", (b, 1.0), tilt)]);
    course(&scene, "block", steps(time, time_step))
}

/// An impact: when, and with how much spin.
struct Impact {
    time: f64,
    spin: f64,
}

/// The impacts: before each the spin grows and after it shrinks. When it was and how fast is worked out from the last state before it,
/// by the acceleration that the block has there.
fn impacts(b: f64, course: &[State], time_step: f64) -> Vec<Impact> {
    let alpha = libm::atan(b);
    let squared = 1.5 * G / libm::sqrt(b * b + 1.0);
    let mut impacts = Vec::new();
    for (k, pair) in course.windows(2).enumerate() {
        let (before, after) = (&pair[0], &pair[1]);
        let falls = before.angle * before.spin < 0.0 && after.spin * before.spin > 0.0;
        let (tilt, spin) = (before.angle.abs(), before.spin.abs());
        if falls && after.spin.abs() < spin && tilt <= 3.0 * spin * time_step {
            let acceleration = squared * libm::sin(alpha - tilt);
            let last = libm::sqrt(spin * spin + 2.0 * acceleration * tilt);
            impacts.push(Impact { time: k as f64 * time_step + 2.0 * tilt / (spin + last), spin: last });
        }
    }
    impacts
}

/// Impact times and the spins before them, b and how long.
struct Reference {
    b: f64,
    times: &'static [f64],
    spins: &'static [f64],
}

const HOUSNER: [Reference; 3] = [
    Reference {
        b: 0.2,
        times: &[
            0.34709358678888131,
            0.95092053647766824,
            1.487939643105267,
            1.9720723345114981,
            2.4125504879839928,
            2.8159656585835404,
        ],
        spins: &[
            0.64804901226753,
            0.61066156925210,
            0.57543109410294,
            0.54223314636623,
            0.51095046484510,
            0.48147255341173,
        ],
    },
    Reference { b: 0.25, times: &[0.34917160197396, 0.91745000301839, 1.3996407500339], spins: &[] },
    Reference { b: 0.5, times: &[0.36531268399866, 0.75950158995632, 1.0145709496040763], spins: &[] },
];

#[test]
fn p6_housners_impacts_come_on_time_and_as_fast() {
    for Reference { b, times, spins } in HOUSNER {
        let alpha = libm::atan(b);
        let run = |time_step: f64| {
            let found = impacts(b, &rocker(b, alpha / 2.0, time_step, times[times.len() - 1] + 0.1), time_step);
            assert!(found.len() >= times.len(), "b = {b}: {} impacts", found.len());
            found
        };
        let (coarse, fine) = (run(1.0 / 240.0), run(1.0 / 1000.0));
        for (k, time) in times.iter().enumerate() {
            let errors = [(1.0 / 240.0, coarse[k].time - time), (1.0 / 1000.0, fine[k].time - time)];
            let allowed = STEPS_OFF * (k + 1) as f64;
            assert_first_order(&errors, allowed, 1e-6, &format!("P6: b = {b}, impact {}", k + 1));
        }
        for (k, spin) in spins.iter().enumerate() {
            let errors = [(1.0 / 240.0, coarse[k].spin / spin - 1.0), (1.0 / 1000.0, fine[k].spin / spin - 1.0)];
            let allowed = 240.0 * SPIN_OFF * (k + 1) as f64;
            assert_first_order(&errors, allowed, 1e-5, &format!("P6: b = {b}, spin before impact {}", k + 1));
        }
    }
}

/// The highest tilts, between impacts.
fn peaks(course: &[State]) -> Vec<f64> {
    let turns = course.windows(2).filter(|pair| pair[0].spin * pair[1].spin <= 0.0 && pair[0].spin != 0.0);
    turns.map(|pair| pair[0].angle.abs().max(pair[1].angle.abs())).collect()
}

/// How far the tilts may be off at 1/1000 s, as a share of α. Observed: 3e-6.
const TILT_OFF: f64 = 1e-5;

/// After n impacts cos(α − θ) − cos α is r²ⁿ of what it was; Housner's own formula has the angles' squares in place of the cosines.
#[test]
fn p6b_each_tilt_is_as_much_lower_as_the_energy_left() {
    let alpha = libm::atan(0.2);
    let left = 49.0_f64 / 52.0 * 49.0 / 52.0;
    let found = peaks(&rocker(0.2, alpha / 2.0, 1e-3, 3.1));
    let linear = [0.42203620, 0.36072942, 0.31084877, 0.26940651, 0.23448634, 0.20476344];
    assert!(found.len() >= linear.len(), "{found:?}");
    let start = libm::cos(alpha / 2.0) - libm::cos(alpha);
    let mut energy = 1.0;
    for (n, (tilt, linear)) in found.iter().zip(linear).enumerate() {
        energy *= left;
        let exact = 1.0 - libm::acos(libm::cos(alpha) + energy * start) / alpha;
        let tilt = tilt / alpha;
        println!("P6b: after {} impacts {tilt:.6} of α; exact {exact:.6}, linearised {linear:.6}", n + 1);
        assert!((exact - linear).abs() <= 1e-3, "the linearised one is near the exact one");
        assert!((tilt - exact).abs() <= TILT_OFF, "{tilt} instead of {exact} after {} impacts", n + 1);
    }
}

/// What may be left of the spin where nothing is, as a share. Observed: not yet.
const DEAD: f64 = 1e-9;

/// e = 0 at both corners leaves 1 − 1.5 sin² α, 1/148 for b/h = 7/5, and nothing from √2 on.
#[test]
fn p6d_too_stout_a_block_stops_dead() {
    for (b, most) in [(1.4, 1.0 / 148.0), (1.5, 0.0)] {
        let course = rocker(b, 0.1, 1.0 / 240.0, 1.0);
        let fastest = course.iter().map(|s| s.spin.abs()).fold(0.0, f64::max);
        let landed = course.iter().position(|s| s.spin.abs() == fastest).expect("it is there") + 2;
        let left = course[landed..].iter().map(|s| s.spin.abs()).fold(0.0, f64::max) / fastest;
        println!("P6d: b = {b}: {left:e} of {fastest} rad/s are left");
        assert!(left <= most + DEAD, "b = {b}: {left:e}");
        let end = course.last().expect("a state");
        assert!(end.angle.abs() <= 1e-6 && end.spin.abs() <= 1e-6 && (end.z - 0.5).abs() <= 1e-6, "{end:?}");
    }
}
