//! YAML from a recording, refused where reading it would take minutes or gigabytes.
//!
//! The parser takes time with the square of how deep brackets are nested and of how many tags are declared, and what an
//! alias names is read again for each alias. No recorder writes such texts.

use serde::de::DeserializeOwned;

/// Brackets inside of each other. Recorders write none or two.
const DEEPEST: usize = 64;
/// Aliases. They can name each other, so that each three of them make a text at most three times as long.
const MOST_ALIASES: usize = 8;
/// Lines that begin as a directive does.
const MOST_DIRECTIVES: usize = 64;

/// Why a text is not read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum YamlError {
    /// It would take too long, or too much memory.
    #[error("{0}")]
    Refused(String),
    /// It is no YAML, or says something else than it should.
    #[error(transparent)]
    Invalid(#[from] serde_yaml::Error),
}

/// What a text says.
///
/// # Errors
/// When it is not that, or not worth the time.
pub(crate) fn from_str<T: DeserializeOwned>(text: &str) -> Result<T, YamlError> {
    let refused = |what: &str, most: usize| Err(YamlError::Refused(format!("{what} than {most}")));
    if is_deeper_than(DEEPEST, text.as_bytes()) {
        return refused("brackets are nested deeper", DEEPEST);
    }
    if count(text, is_alias) > MOST_ALIASES {
        return refused("more aliases (`*name`)", MOST_ALIASES);
    }
    if count(text, is_directive) > MOST_DIRECTIVES {
        return refused("more directives (`%`)", MOST_DIRECTIVES);
    }
    Ok(serde_yaml::from_str(text)?)
}

/// What came last inside of brackets.
#[derive(Clone, Copy, PartialEq)]
enum Last {
    /// A value can begin.
    Separator,
    /// A text in double or single quotes.
    Quoted,
    Other,
}

/// Whether brackets may be nested deeper than that.
///
/// Every opening bracket counts, wherever it stands. A closing one ends the last opening one only where it would do so for
/// the parser as well: what is between them cannot be a comment, or a text in quotes that goes on behind the bracket. So
/// the parser finds no greater depth, and a text with brackets in its comments and quoted texts may be taken as deeper.
fn is_deeper_than(most: usize, text: &[u8]) -> bool {
    // Of each open bracket, whether its end can be told.
    let mut open: Vec<bool> = Vec::new();
    let mut last = Last::Other;
    let mut at = 0;
    while let Some((byte, rest)) = text.get(at..).and_then(<[u8]>::split_first) {
        at += 1;
        let mut is_clear = true;
        last = match *byte {
            b'[' | b'{' if open.len() == most => return true,
            b'[' | b'{' => {
                open.push(true);
                Last::Separator
            }
            b']' | b'}' => {
                open.pop_if(|is_clear| *is_clear);
                Last::Other
            }
            b',' => Last::Separator,
            b':' if last == Last::Quoted || rest.first().is_some_and(u8::is_ascii_whitespace) => {
                Last::Separator
            }
            b' ' | b'\t' | b'\r' | b'\n' => last,
            b'"' | b'\'' | b'\\' if last == Last::Separator => {
                match quoted(text.get(at - 1..).unwrap_or_default()) {
                    Some(length) => {
                        at += length - 1;
                        // An escaped quote is part of a text around the brackets, or no quote at all.
                        if *byte == b'\\' { Last::Other } else { Last::Quoted }
                    }
                    None => {
                        is_clear = false;
                        Last::Other
                    }
                }
            }
            b'"' | b'\'' | b'\\' | b'#' | b'!' | b'&' | b'*' | b'|' | b'>' | b'%' | b'@' | b'`' | b'?' => {
                is_clear = false;
                Last::Other
            }
            _ => Last::Other,
        };
        if let Some(innermost) = open.last_mut() {
            *innermost &= is_clear;
        }
    }
    false
}

/// How long a text in quotes is, quotes included; `None` where brackets, other quotes or escapes are in it.
fn quoted(text: &[u8]) -> Option<usize> {
    let quote: &[u8] = if text.starts_with(b"\\\"") { b"\\\"" } else { text.get(..1)? };
    let inside = text.get(quote.len()..)?;
    let end = inside.iter().position(|byte| b"[]{}\"'\\".contains(byte))?;
    inside.get(end..)?.starts_with(quote).then_some(end + 2 * quote.len())
}

/// How many bytes of a text are something, by the byte before and the byte behind; 0 where there is none.
fn count(text: &str, is_it: fn(u8, u8, u8) -> bool) -> usize {
    let bytes = text.as_bytes();
    let before = std::iter::once(&0).chain(bytes);
    let behind = bytes.iter().skip(1).chain([&0]);
    before.zip(bytes).zip(behind).filter(|((before, byte), behind)| is_it(**before, **byte, **behind)).count()
}

/// Lines also end with letters beyond ASCII.
fn is_alias(before: u8, byte: u8, behind: u8) -> bool {
    let begins = before.is_ascii_whitespace() || b"\0[{,:-?".contains(&before) || !before.is_ascii();
    byte == b'*' && begins && (behind.is_ascii_alphanumeric() || b"_-".contains(&behind))
}

fn is_directive(before: u8, byte: u8, _: u8) -> bool {
    byte == b'%' && (b"\0\r\n".contains(&before) || !before.is_ascii())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_deep(text: &str) -> bool {
        is_deeper_than(DEEPEST, text.as_bytes())
    }

    #[test]
    fn a_text_is_refused_for_its_depth_and_not_for_its_length() {
        let deep = |count: usize| format!("- a: {}{}", "[".repeat(count), "]".repeat(count));
        assert!(!is_deep(&deep(DEEPEST)) && is_deep(&deep(DEEPEST + 1)));
        for flat in [
            "offered_qos_profiles: []\n",
            "- {sec: 0, nsec: 0}\n",
            "- {\"sec\": 0, 'a b' : [1, -2], \"c\":\"d\"}\n",
            "- '{\"a\": {\"b\": [1, [2, 3]]}}'\n",
            "- \"[[1, 2], [\\\"a\\\", \\\"b\\\"]]\"\n",
        ] {
            assert!(!is_deep(&flat.repeat(1000)), "{flat}");
        }
    }

    /// Each hides from a count of brackets that the parser goes deeper.
    #[test]
    fn brackets_that_close_nothing_do_not_count() {
        for step in [
            "[\"]\", ",
            "[']', ",
            "[\"\\\"]\", ",
            "[ # ]\n",
            "[a: \"]\", ",
            "[{\"a\":\"}]\"}, ",
            "[a 'b', ']', ",
            "[!<]> a, ",
            "[&a ']', ",
            "['a'']', ",
            "[a:\"b, \"]\", ",
            "[\\\"a\\\":\"b, \"]\", ",
            "[b', 'd]', ",
            "[? ']' : a, ",
        ] {
            assert!(is_deep(&step.repeat(DEEPEST + 1)), "{step}");
        }
        assert!(is_deep(&format!("a: b # [\"\nc: {}\n", "[".repeat(DEEPEST + 1))));
    }

    #[test]
    fn aliases_and_tags_are_accepted_up_to_a_bound() {
        let read = |text: &str| from_str::<serde_yaml::Value>(text).map_err(|error| error.to_string());
        let aliases = |count: usize| format!("- &a [1, 2]\n{}", "- *a\n".repeat(count));
        assert_eq!(read(&aliases(MOST_ALIASES)).unwrap()[MOST_ALIASES], read("[1, 2]").unwrap());
        assert_eq!(read(&aliases(MOST_ALIASES + 1)).unwrap_err(), "more aliases (`*name`) than 8");
        assert!(read("- a ** b *c* 2*3\n").is_ok());
        let tags = |count: usize| {
            (0..count).map(|number| format!("%TAG !{number}! a\n")).collect::<String>() + "--- a"
        };
        assert!(read(&tags(MOST_DIRECTIVES)).is_ok());
        assert_eq!(read(&tags(MOST_DIRECTIVES + 1)).unwrap_err(), "more directives (`%`) than 64");
        assert_eq!(read(&"[".repeat(65)).unwrap_err(), "brackets are nested deeper than 64");
    }
}
