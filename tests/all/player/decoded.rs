//! What a browser makes of a film, read here by other means than it was written: see `src/player/unpack.js`.

use std::f64::consts::{PI, TAU};
use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use flate2::read::ZlibDecoder;
use serde_json::Value;

/// A film as numbers.
pub(super) struct Decoded {
    pub(super) head: Value,
    pub(super) iterations: Vec<i64>,
    pub(super) times: Vec<f64>,
    /// By frame and body.
    pub(super) states: Vec<Vec<[f64; 6]>>,
    /// Frame, iteration, a, b; then x, z, the direction of the normal and the depth.
    pub(super) hits: Vec<([i64; 4], [f64; 4])>,
    pub(super) series: Vec<(String, Vec<f64>)>,
}

impl Decoded {
    /// The films that a page carries.
    pub(super) fn of_page(html: &str) -> Vec<Decoded> {
        let carriers = html.split("<script type=\"text/plain\" class=\"film\"").skip(1);
        let texts = carriers.map(|rest| rest.split_once('>').expect("a tag").1.split_once('<').expect("its end").0);
        texts.map(|text| Decoded::of(&BASE64.decode(text).expect("base64"))).collect()
    }

    pub(super) fn of(film: &[u8]) -> Decoded {
        let mut bytes = Vec::new();
        ZlibDecoder::new(film).read_to_end(&mut bytes).expect("deflated bytes");
        let (length, rest) = bytes.split_at(4);
        let length = u32::from_le_bytes(length.try_into().expect("four")) as usize;
        let (head, mut rest) = rest.split_at(length);
        let head: Value = serde_json::from_slice(head).expect("JSON");
        let sections: Vec<&[u8]> = (0..5)
            .map(|k| {
                let (section, after) = rest.split_at(head["sections"][k].as_u64().expect("a length") as usize);
                rest = after;
                section
            })
            .collect();
        assert!(rest.is_empty());
        let frames = head["frames"].as_u64().expect("a count") as usize;
        let names =
            head["series"].as_array().expect("names").iter().map(|name| name.as_str().expect("a name").to_owned());
        let columns = sections[4].chunks(8 * frames.max(1)).map(|column| {
            column.chunks(8).map(|number| f64::from_le_bytes(number.try_into().expect("eight"))).collect::<Vec<f64>>()
        });
        let series: Vec<(String, Vec<f64>)> = names.zip(columns).collect();
        let times = series.iter().find(|(name, _)| name == "time").map(|(_, times)| times.clone()).unwrap_or_default();
        let states = states(&head, sections[1], &times);
        let hits = hits(&head, sections[2], &states);
        Decoded { iterations: Numbers(sections[0]).column(frames), times, states, hits, series, head }
    }

    pub(super) fn quantum(&self, name: &str) -> f64 {
        self.head["quantum"][name].as_f64().expect("a step")
    }
}

struct Numbers<'a>(&'a [u8]);

impl Numbers<'_> {
    fn next(&mut self) -> i64 {
        let (mut value, mut shift) = (0_u64, 0);
        loop {
            let (byte, rest) = self.0.split_first().expect("a number");
            self.0 = rest;
            value |= u64::from(byte & 0x7f) << shift;
            shift += 7;
            if byte & 0x80 == 0 {
                return (value >> 1) as i64 ^ -((value & 1) as i64);
            }
        }
    }

    fn column(&mut self, count: usize) -> Vec<i64> {
        let mut last = 0;
        (0..count)
            .map(|_| {
                last += self.next();
                last
            })
            .collect()
    }
}

fn states(head: &Value, bytes: &[u8], times: &[f64]) -> Vec<Vec<[f64; 6]>> {
    let bodies = head["bodies"].as_array().expect("bodies");
    let quantum = |name: &str| head["quantum"][name].as_f64().expect("a step");
    let middle = [0, 1].map(|k| head["middle"][k].as_f64().expect("a place"));
    let channels = [
        (quantum("place"), quantum("velocity"), middle[0]),
        (quantum("place"), quantum("velocity"), middle[1]),
        (quantum("angle"), quantum("spin"), 0.0),
    ];
    let mut numbers = Numbers(bytes);
    let mut states = vec![vec![[0.0; 6]; bodies.len()]; times.len()];
    for (body, actor) in bodies.iter().enumerate() {
        for (k, (step, unit, zero)) in channels.into_iter().enumerate() {
            let moves = actor["moves"].as_bool().expect("yes or no");
            let motion = if moves { numbers.column(times.len()) } else { vec![0; times.len()] };
            let mut last = 0;
            for frame in 0..times.len() {
                if moves && frame > 0 {
                    let mean = 0.5 * (motion[frame - 1] + motion[frame]) as f64;
                    let led = (mean * (unit / step) * (times[frame] - times[frame - 1]) + 0.5).floor();
                    last += if led.abs() < (1_u64 << 50) as f64 { led as i64 } else { 0 };
                }
                if moves || frame == 0 {
                    last += numbers.next();
                }
                states[frame][body][k] = zero + last as f64 * step;
                states[frame][body][k + 3] = motion[frame] as f64 * unit;
            }
        }
        for state in states.iter_mut().map(|bodies| &mut bodies[body]) {
            state[2] -= ((state[2] - PI) / TAU).ceil() * TAU;
        }
    }
    assert!(numbers.0.is_empty());
    states
}

fn hits(head: &Value, bytes: &[u8], states: &[Vec<[f64; 6]>]) -> Vec<([i64; 4], [f64; 4])> {
    let count = head["hits"].as_u64().expect("a count") as usize;
    let quantum = |name: &str| head["quantum"][name].as_f64().expect("a step");
    let mut numbers = Numbers(bytes);
    let columns: Vec<Vec<i64>> = (0..8).map(|_| numbers.column(count)).collect();
    let hit = |k: usize| {
        let whole = [0, 1, 2, 3].map(|column| columns[column][k]);
        let a = states[whole[0] as usize][whole[2] as usize];
        let number = |column: usize| columns[column][k] as f64;
        let depth = f64::from(f32::from_bits((columns[7][k] as u32) << 14));
        let normal = number(6) * quantum("normal");
        (whole, [a[0] + number(4) * quantum("point"), a[1] + number(5) * quantum("point"), normal, depth])
    };
    (0..count).map(hit).collect()
}
