//! C3, C4: impacts with friction, the table F0 … F7.
//!
//! A corner of a rectangle strikes a fixed floor. Where slip neither stops nor turns during the impact, all laws agree: F0, F1, F4, F5, F6
//! against fractions. F2, F3, F7 and C4 are held to the law the engine states, Routh's process with Stronge's restitution, in closed form.

use choque_engine::scene::Body;

use super::kit::{State, assert_close, at_first_hit, block, continuous, mirrored, state, wall};

/// A corner at `r` from the centre of a body of 1 kg comes to a floor.
struct Corner {
    size: (f64, f64),
    /// The turn that brings the body's corner to `r`, as (sin, cos).
    turn: (f64, f64),
    r: (f64, f64),
    /// 1/I.
    per_inertia: f64,
}

/// r = (−3/5, −4/5), I = 1/3: the corner (−4/5, −3/5) turned by atan(7/24).
const SHALLOW: Corner = Corner { size: (1.6, 1.2), turn: (7.0, 24.0), r: (-0.6, -0.8), per_inertia: 3.0 };

/// r = (1, −2), I = 5/3, steep enough to jam (Painlevé): the corner (2, −1) turned by −atan(3/4).
const STEEP: Corner = Corner { size: (4.0, 2.0), turn: (-3.0, 4.0), r: (1.0, -2.0), per_inertia: 0.6 };

impl Corner {
    fn strike(&self, restitution: f64, friction: f64, v: (f64, f64)) -> State {
        // Half a metre to fall, straight down but for where it starts.
        let fall = 0.5 / -v.1;
        let at = (-v.0 * fall, -self.r.1 + 0.5);
        let body = Body { angle: libm::atan2(self.turn.0, self.turn.1), ..block("body", self.size, at, v, 1.0) };
        let mut scene = continuous(restitution, 1.0, vec![wall("floor", (99.0, 1.0), (0.0, -0.5)), body]);
        scene.settings.friction = friction;
        let world = at_first_hit(&scene);
        assert_close(&[world.time()], &[fall], 1e-15, "the time of the hit");
        let found = state(&world, "body");
        let mirror = state(&at_first_hit(&mirrored(&scene)), "body");
        assert_eq!(found.mirrored(), mirror, "mirror images to the bit");
        let before = 0.5 * (v.0 * v.0 + v.1 * v.1);
        assert!(world.kinetic_energy() <= before * (1.0 + 1e-12), "{} from {before}", world.kinetic_energy());
        found
    }

    /// The velocity of the corner.
    fn slip_and_rise(&self, s: &State) -> (f64, f64) {
        (s.vx - s.spin * self.r.1, s.vz + s.spin * self.r.0)
    }

    /// K_tt, K_tn, K_nn.
    fn response(&self) -> (f64, f64, f64) {
        let (x, y, i) = (self.r.0, self.r.1, self.per_inertia);
        (1.0 + y * y * i, -x * y * i, 1.0 + x * x * i)
    }
}

#[test]
fn c3_friction_where_all_laws_agree() {
    // μ, v, then p_n, p_t, v_t⁺, v_n⁺, ω⁺
    let cases = [
        ("F0 without friction", 0.0, (1.0, -2.0), [75.0 / 52.0, 0.0, -14.0 / 13.0, 1.0, -135.0 / 52.0]),
        ("F1 slips through", 0.2, (4.0, -2.0), [375.0 / 296.0, -75.0 / 296.0, 425.0 / 296.0, 1.0, -855.0 / 296.0]),
        ("F4 sticks at once", 0.9, (0.0, -2.0), [219.0 / 100.0, 27.0 / 25.0, 0.0, 1.0, -27.0 / 20.0]),
        ("F5 slips from rest", 0.4, (0.0, -2.0), [375.0 / 188.0, 75.0 / 94.0, -51.0 / 94.0, 1.0, -315.0 / 188.0]),
        ("F6 slips away", 0.3, (-1.0, -2.0), [375.0 / 206.0, 225.0 / 412.0, -835.0 / 412.0, 1.0, -405.0 / 206.0]),
    ];
    for (name, friction, v, expected) in cases {
        let after = SHALLOW.strike(0.5, friction, v);
        let (slip, rise) = SHALLOW.slip_and_rise(&after);
        assert_close(&[after.vz - v.1, after.vx - v.0, slip, rise, after.spin], &expected, 4e-15, name);
    }
}

/// The impulse under the stated law when slip forward at `u_t` stops on the way, and then sticks (`back` = None) or turns round with
/// friction +μ: p_n, p_t, u_t⁺, u_n⁺.
fn stops_on_the_way(corner: &Corner, e: f64, mu: f64, u: (f64, f64), back: Option<f64>) -> [f64; 4] {
    let (k_tt, k_tn, k_nn) = corner.response();
    let stop = -u.0 / (k_tn - mu * k_tt); // normal impulse at which slip stops
    let u_n = u.1 + (k_nn - mu * k_tn) * stop;
    let drag = back.unwrap_or(-k_tn / k_tt);
    let rate = k_nn + drag * k_tn;
    assert!(u_n < 0.0 && rate > 0.0, "slip stops before compression ends");
    let compression = stop * (u.1 + 0.5 * (k_nn - mu * k_tn) * stop) - 0.5 * u_n * u_n / rate;
    let rise = (2.0 * rate * e * e * -compression).sqrt();
    let rest = (rise - u_n) / rate;
    [stop + rest, -mu * stop + drag * rest, (k_tn + drag * k_tt) * rest, rise]
}

#[test]
fn c3_where_slip_stops_turns_or_jams_the_stated_law_holds() {
    let cases = [
        ("F2 slips, then sticks", &SHALLOW, 0.9, (1.0, -2.0), None),
        ("F3 slips, then slips back", &SHALLOW, 0.3, (1.0, -2.0), Some(0.3)),
        ("F7 jams", &STEEP, 1.5, (2.0, -1.0), None),
    ];
    for (name, corner, mu, v, back) in cases {
        let after = corner.strike(0.5, mu, v);
        let (slip, rise) = corner.slip_and_rise(&after);
        let found = [after.vz - v.1, after.vx - v.0, slip, rise];
        assert_close(&found, &stops_on_the_way(corner, 0.5, mu, v, back), 4e-15, name);
    }
}

/// Newton's law would end with 148/125 of the energy. Stronge: v_n⁺² = 1325/2117, and 28/29 of the energy.
#[test]
fn c4_where_newtons_law_would_gain_energy_this_one_does_not() {
    let after = SHALLOW.strike(1.0, 0.5, (0.5, -1.0));
    let (slip, rise) = SHALLOW.slip_and_rise(&after);
    assert_close(&[slip, rise], &[0.0, (1325.0_f64 / 2117.0).sqrt()], 1e-15, "slip and rise");
    let energy = 0.5 * (after.vx * after.vx + after.vz * after.vz + after.spin * after.spin / 3.0);
    assert_close(&[energy / 0.625], &[28.0 / 29.0], 1e-15, "energy");
}
