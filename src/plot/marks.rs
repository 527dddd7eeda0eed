//! Letters that carry a mark, as é or ş: a letter, and the mark's strokes over or under its middle.

/// A letter with a mark.
pub(super) struct Marked {
    /// The letter that carries it.
    pub(super) letter: char,
    /// The mark's strokes, as those of a glyph, about x = 0.
    pub(super) mark: &'static str,
    /// How much they stand above that.
    pub(super) up: f64,
}

/// What a letter with a mark is made of; `None` where it is none, or has a glyph of its own.
pub(super) fn marked(character: char) -> Option<Marked> {
    let of = |(mark, pairs): &(&'static str, &'static str)| {
        let letters = pairs.split_whitespace().find_map(|pair| pair.strip_prefix(character))?;
        let letter = letters.chars().next()?;
        Some((letter, *mark))
    };
    if let Some((letter, mark)) = OVER.iter().find_map(of) {
        let is_tall = letter.is_uppercase() || "hl".contains(letter);
        return Some(Marked { letter, mark, up: if is_tall { 7.4 } else { 5.4 } });
    }
    UNDER.iter().find_map(of).map(|(letter, mark)| Marked { letter, mark, up: 0.0 })
}

/// Marks over a letter, from its top on; and pairs of what is written and the letter that carries the mark.
const OVER: &[(&str, &str)] = &[
    // Grave.
    ("l -.9 1.8 .3 .3", "ÀA ÈE ÌI ÒO ÙU ǸN àa èe ìı òo ùu ǹn ЀЕ ѐе ЍИ ѝи"),
    // Acute, and the tonos.
    (
        "l .9 1.8 -.3 .3",
        "ÁA ÉE ÍI ÓO ÚU ÝY ĆC ĹL ŃN ŔR ŚS ŹZ áa ée íı óo úu ýy ćc ĺl ńn ŕr śs źz ЃГ ЌК ѓг ќк \
         ΆΑ ΈΕ ΉΗ ΊΙ ΌΟ ΎΥ ΏΩ άα έε ήη ίι όο ύυ ώω ΐι ΰυ",
    ),
    // Circumflex.
    ("l -1.2 .3 0 1.7 1.2 .3", "ÂA ÊE ÎI ÔO ÛU ĈC ĜG ĤH ĴJ ŜS ŴW ŶY âa êe îı ôo ûu ĉc ĝg ĥh ĵȷ ŝs ŵw ŷy"),
    // Tilde.
    ("a -.7 .7 .7 .7 170 10; a .68 .95 .7 .7 190 350", "ÃA ÑN ÕO ĨI ŨU ãa ñn õo ĩı ũu"),
    // Two dots.
    ("l -.9 1 -.9 1.1; l .9 1 .9 1.1", "ÄA ËE ÏI ÖO ÜU ŸY äa ëe ïı öo üu ÿy ЁЕ ёе ЇІ їı ΪΙ ϊι ΫΥ ϋυ"),
    // Ring.
    ("a 0 1.1 .8 .8 0 360", "ÅA ŮU åa ůu"),
    // Macron.
    ("l -1.2 1 1.2 1", "ĀA ĒE ĪI ŌO ŪU āa ēe īı ōo ūu"),
    // Breve.
    ("a 0 1.6 1.2 1.2 200 340", "ĂA ĔE ĞG ĬI ŎO ŬU ăa ĕe ğg ĭı ŏo ŭu ЙИ йи ЎУ ўу"),
    // A dot.
    ("l 0 1 0 1.1", "ĊC ĖE ĠG İI ŻZ ċc ėe ġg żz"),
    // Two acutes.
    ("l .1 1.8 -.9 .3; l 1.4 1.8 .4 .3", "ŐO ŰU őo űu"),
    // Caron.
    ("l -1.2 1.7 0 .3 1.2 1.7", "ČC ĎD ĚE ŇN ŘR ŠS ŤT ŽZ ǍA čc ěe ňn řr šs žz ǎa"),
];

/// Marks under a letter, from the line it stands on.
const UNDER: &[(&str, &str)] = &[
    // Cedilla.
    ("l .1 0 .1 -.5; a 0 -1.2 .7 .7 85 -150", "ÇC ŞS ŢT çc şs ţt"),
    // Ogonek.
    ("a 1.3 -.9 .7 .9 110 300", "ĄA ĘE ĮI ŲU ąa ęe įi ųu"),
    // A comma.
    ("l .2 -.8 -.2 -2", "ĢG ĶK ĻL ŅN ŖR ȘS ȚT ķk ļl ņn ŗr șs țt"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::glyphs::glyph;

    #[test]
    fn every_mark_stands_on_a_letter_that_is_drawn_and_has_no_glyph_of_its_own() {
        for pair in OVER.iter().chain(UNDER).flat_map(|(_, pairs)| pairs.split_whitespace()) {
            let letters: Vec<char> = pair.chars().collect();
            assert_eq!(letters.len(), 2, "{pair}");
            assert!(glyph(letters[0]).is_none(), "{pair}: it has a glyph, which is never looked at");
            assert!(glyph(letters[1]).is_some(), "{pair}");
        }
    }
}
