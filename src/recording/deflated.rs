//! Deflating of which parts are only stored: what deflates to nothing less is not tried.

use std::io;
use std::ops::Range;

use flate2::{Compress, Compression, FlushCompress};

/// Bytes in a stored block of RFC 1951 at most.
const STORED: usize = 0xffff;

/// Deflates one content after the other in the same room.
pub(super) struct Deflater {
    deflate: Compress,
    packed: Vec<u8>,
}

impl Deflater {
    pub(super) fn new() -> Self {
        Deflater { deflate: Compress::new(Compression::fast(), false), packed: Vec::new() }
    }

    /// One stream as RFC 1951 has it; the ranges, in order, as they are.
    pub(super) fn deflate(&mut self, content: &[u8], stored: &[Range<usize>]) -> io::Result<&[u8]> {
        self.packed.clear();
        let mut at = 0;
        for range in stored.iter().filter(|range| !range.is_empty()) {
            // A flush ends at a whole byte; what comes after it refers to nothing before.
            self.pack(&content[at..range.start], FlushCompress::Full)?;
            for chunk in content[range.clone()].chunks(STORED) {
                let length = chunk.len() as u16;
                self.packed.push(0);
                self.packed.extend_from_slice(&length.to_le_bytes());
                self.packed.extend_from_slice(&(!length).to_le_bytes());
                self.packed.extend_from_slice(chunk);
            }
            self.deflate.reset();
            at = range.end;
        }
        self.pack(&content[at..], FlushCompress::Finish)?;
        self.deflate.reset();
        Ok(&self.packed)
    }

    fn pack(&mut self, mut content: &[u8], flush: FlushCompress) -> io::Result<()> {
        let Deflater { deflate, packed } = self;
        loop {
            packed.reserve(content.len() + 64);
            let before = deflate.total_in();
            deflate.compress_vec(content, packed, flush)?;
            content = &content[(deflate.total_in() - before) as usize..];
            // Room is left only where nothing waited to be written.
            if content.is_empty() && packed.len() < packed.capacity() {
                return Ok(());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::DeflateDecoder;

    use super::*;

    #[test]
    fn what_was_stored_and_what_was_deflated_come_back() {
        let content: Vec<u8> =
            (0..200_000u32).map(|i| if i < 90_000 { 7 } else { (i.wrapping_mul(i) >> 7) as u8 }).collect();
        let surprises = 90_000..200_000;
        let cases: [&[Range<usize>]; 4] = [&[], &[0..0, surprises.clone()], &[0..10, 90_000..160_000], &[5..5, 6..7]];
        let mut deflater = Deflater::new();
        for stored in cases {
            let packed = deflater.deflate(&content, stored).expect("it deflates");
            let mut back = Vec::new();
            DeflateDecoder::new(packed).read_to_end(&mut back).expect("it inflates");
            assert!(back == content, "{stored:?}");
        }
        let packed = deflater.deflate(&content, std::slice::from_ref(&surprises)).expect("it deflates");
        assert!(packed.len() < 111_000);
        assert_eq!(
            packed,
            Deflater::new().deflate(&content, &[surprises]).expect("it deflates"),
            "nothing is remembered"
        );
    }
}
