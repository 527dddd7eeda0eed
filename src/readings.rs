//! What a failed expectation had read: names and numbers, in that order, written as a map.

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde::ser::{Serialize, Serializer};

/// Quantities an expectation read, such as `car2.speed`, in the order of reading; each name once, with its last value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Readings(Vec<(String, f64)>);

impl Readings {
    /// Whether nothing was read.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The names and numbers, in the order of reading.
    #[must_use]
    pub fn as_slice(&self) -> &[(String, f64)] {
        &self.0
    }
}

impl FromIterator<(String, f64)> for Readings {
    fn from_iter<I: IntoIterator<Item = (String, f64)>>(readings: I) -> Self {
        let mut kept: Vec<(String, f64)> = Vec::new();
        for (name, number) in readings {
            match kept.iter().position(|(known, _)| *known == name) {
                Some(known) => kept[known].1 = number,
                None => kept.push((name, number)),
            }
        }
        Readings(kept)
    }
}

impl Serialize for Readings {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, number)| (name, number)))
    }
}

impl<'de> Deserialize<'de> for Readings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(InOrder)
    }
}

struct InOrder;

impl<'de> Visitor<'de> for InOrder {
    type Value = Readings;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map of names to numbers")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Readings, A::Error> {
        let mut readings = Vec::new();
        while let Some(reading) = map.next_entry()? {
            readings.push(reading);
        }
        Ok(Readings(readings))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_keep_their_order_through_a_file() {
        let readings: Readings = [("b.x", 1.0), ("a.x", 2.0), ("b.x", 3.0)]
            .map(|(name, number)| (name.to_owned(), number))
            .into_iter()
            .collect();
        let text = ron::to_string(&readings).expect("RON");
        assert_eq!(text, r#"{"b.x":3.0,"a.x":2.0}"#);
        assert_eq!(ron::from_str::<Readings>(&text).expect("the same"), readings);
    }
}
