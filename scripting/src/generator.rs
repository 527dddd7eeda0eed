//! The generator behind `random`: SplitMix64 (Steele, Lea and Flood, 2014).
//!
//! Small, well known, and the same on every platform; good enough for scattering cars, not for secrets.

/// SplitMix64.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Generator {
    state: u64,
}

impl Generator {
    /// The generator of a seed; negative seeds are seeds too.
    pub(crate) fn new(seed: i64) -> Self {
        Generator { state: seed as u64 }
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.state ^ (self.state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from `min` to `max`: 53 random bits spread evenly between them.
    pub(crate) fn between(&mut self, min: f64, max: f64) -> f64 {
        let share = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        // Halves first, so that the way from the least to the greatest f64 is finite too.
        let way = 0.5 * max - 0.5 * min;
        (min + way * share) + way * share
    }

    /// A whole number from `min` to `max`, both included, each equally likely: what would favour the
    /// small ones is drawn again.
    pub(crate) fn whole_between(&mut self, min: i64, max: i64) -> i64 {
        let count = (max.wrapping_sub(min) as u64).wrapping_add(1);
        if count == 0 {
            return self.next() as i64; // every i64 there is
        }
        let surplus = count.wrapping_neg() % count;
        loop {
            let drawn = self.next();
            if drawn >= surplus {
                return min.wrapping_add((drawn % count) as i64);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Generator;

    #[test]
    fn it_is_splitmix64() {
        let mut generator = Generator::new(1_234_567);
        let published = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423_u64];
        assert_eq!(published.map(|_| generator.next()), published);
    }

    #[test]
    fn the_widest_ranges_stay_in_range() {
        let mut generator = Generator::new(-1);
        for _ in 0..1000 {
            assert!(generator.between(f64::MIN, f64::MAX).is_finite());
            let drawn = generator.whole_between(i64::MIN, i64::MAX - 1);
            assert!(drawn < i64::MAX);
        }
        assert_eq!(generator.whole_between(7, 7), 7);
        assert_eq!(generator.between(2.5, 2.5), 2.5);
    }

    #[test]
    fn whole_numbers_are_drawn_equally_often() {
        let mut generator = Generator::new(5);
        let mut drawn = [0_i32; 3];
        for _ in 0..30_000 {
            drawn[generator.whole_between(0, 2) as usize] += 1;
        }
        // 10,000 each; five standard deviations of √(30,000 · 1/3 · 2/3) ≈ 82
        assert!(drawn.iter().all(|count| (count - 10_000).abs() < 410), "{drawn:?}");
    }
}
