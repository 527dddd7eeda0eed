//! Texts that become parts of a page, whatever is in them.

/// A text as it stands between tags or in a quoted attribute.
pub(super) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            // What HTML forbids in a text is shown as what it is: something that cannot be shown.
            '\0'..='\u{8}' | '\u{b}'..='\u{1f}' | '\u{7f}'..='\u{9f}' if character != '\r' => safe.push('\u{fffd}'),
            _ => safe.push(character),
        }
    }
    safe
}

/// A call as one can type it again: words with anything but plain characters are quoted.
pub(super) fn command_line(words: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./:,+@%".contains(c);
    let quoted = |word: &String| match word {
        word if !word.is_empty() && word.chars().all(plain) => word.clone(),
        word => format!("'{}'", word.replace('\'', r"'\''")),
    };
    words.iter().map(quoted).collect::<Vec<_>>().join(" ")
}

/// A template with every `{name}` replaced, in one pass: what is put in is never looked at again. Braces around anything but
/// lower-case letters and dashes stay as they are.
pub(super) fn filled(template: &str, value: impl Fn(&str) -> Option<String>) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once('{') {
        page.push_str(before);
        let named = after.split_once('}').and_then(|(name, after)| Some((value(name)?, after)));
        match named {
            Some((text, after)) => {
                page.push_str(&text);
                rest = after;
            }
            None => {
                page.push('{');
                rest = after;
            }
        }
    }
    page.push_str(rest);
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_a_text_is_markup() {
        assert_eq!(escaped("</script><b a='\"'>&\u{0}"), "&lt;/script&gt;&lt;b a=&#39;&quot;&#39;&gt;&amp;\u{fffd}");
    }

    #[test]
    fn what_is_put_in_is_not_looked_at_again() {
        let values = |name: &str| match name {
            "a" => Some("{b}".to_owned()),
            "b" => Some("{a}".to_owned()),
            _ => None,
        };
        assert_eq!(filled("{a} {b} {c} { {a}", values), "{b} {a} {c} { {b}");
    }

    #[test]
    fn a_command_line_can_be_typed_again() {
        let words = ["choque", "run", "a b.rhai", "--set", "x=1", "it's", ""].map(str::to_owned);
        assert_eq!(command_line(&words), r"choque run 'a b.rhai' --set x=1 'it'\''s' ''");
    }
}
