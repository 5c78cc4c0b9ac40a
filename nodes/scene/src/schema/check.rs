//! What a single entry of a parameter may be. The words are made from the check, so that they cannot disagree.

use std::fmt;

/// Which numbers or texts are accepted. Numbers must be finite in any case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Check {
    /// Anything of the right type.
    Any,
    /// `min < x`.
    Above(f64),
    /// `min <= x`.
    AtLeast(f64),
    /// `min < x < max`.
    Between(f64, f64),
    /// `min <= x <= max`.
    Within(f64, f64),
    /// `min <= x < max`.
    WithinBelow(f64, f64),
    /// One of these numbers, in ascending order.
    OneOfNumbers(&'static [f64]),
    /// One of these texts.
    OneOf(&'static [&'static str]),
    /// A frame id or a host name: not empty, no white space.
    FrameId,
    /// `x y z qx qy qz qw`: finite, quaternion norm within 1e-3 of 1.
    Pose,
}

impl Check {
    /// Whether a finite number is accepted.
    pub fn accepts_number(&self, x: f64) -> bool {
        x.is_finite()
            && match *self {
                Check::Above(min) => min < x,
                Check::AtLeast(min) => min <= x,
                Check::Between(min, max) => min < x && x < max,
                Check::Within(min, max) => min <= x && x <= max,
                Check::WithinBelow(min, max) => min <= x && x < max,
                Check::OneOfNumbers(numbers) => numbers.contains(&x),
                Check::Any | Check::OneOf(_) | Check::FrameId | Check::Pose => true,
            }
    }

    /// Whether a text is accepted.
    pub fn accepts_text(&self, text: &str) -> bool {
        match *self {
            Check::OneOf(words) => words.contains(&text),
            Check::FrameId => !text.is_empty() && !text.contains(char::is_whitespace),
            _ => true,
        }
    }

    /// Closed bounds for a ROS parameter descriptor: the nearest range ROS can express (its bounds are inclusive).
    pub fn bounds(&self) -> Option<(f64, f64)> {
        match *self {
            Check::Above(min) | Check::AtLeast(min) => Some((min, f64::MAX)),
            Check::Between(min, max) | Check::Within(min, max) | Check::WithinBelow(min, max) => {
                Some((min, max))
            }
            Check::OneOfNumbers(numbers) => Some((*numbers.first()?, *numbers.last()?)),
            Check::Any | Check::OneOf(_) | Check::FrameId | Check::Pose => None,
        }
    }
}

/// The range in words; empty when anything of the type is accepted.
impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Check::Any => Ok(()),
            Check::Above(min) => write!(f, "> {min}"),
            Check::AtLeast(min) => write!(f, ">= {min}"),
            Check::Between(min, max) => write!(f, "> {min} and < {max}"),
            Check::Within(min, max) => write!(f, "{min} to {max}"),
            Check::WithinBelow(min, max) => write!(f, ">= {min} and < {max}"),
            Check::OneOfNumbers(numbers) => {
                let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
                f.write_str(&words.join(" or "))
            }
            Check::OneOf(words) => {
                for (i, word) in words.iter().enumerate() {
                    if i > 0 {
                        f.write_str(" or ")?;
                    }
                    write!(f, "\"{word}\"")?;
                }
                Ok(())
            }
            Check::FrameId => f.write_str("not empty, without spaces"),
            Check::Pose => f.write_str("x y z qx qy qz qw with a unit quaternion"),
        }
    }
}

/// How many entries an array parameter may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// Not an array, or any number of entries.
    Any,
    /// Exactly this many.
    Exactly(usize),
    /// One entry or more.
    AtLeastOne,
    /// One for each parallel chain.
    PerChain,
}

impl Length {
    /// Whether `count` entries are accepted (that all chain arrays agree is checked where they are read together).
    pub fn accepts(self, count: usize) -> bool {
        match self {
            Length::Any => true,
            Length::Exactly(n) => count == n,
            Length::AtLeastOne | Length::PerChain => count >= 1,
        }
    }

    /// In words; empty when there is nothing to say.
    pub fn in_words(self) -> String {
        match self {
            Length::Any => String::new(),
            Length::Exactly(n) => format!("{n} entries"),
            Length::AtLeastOne => "one entry or more".to_owned(),
            Length::PerChain => "one entry for each chain".to_owned(),
        }
    }
}
