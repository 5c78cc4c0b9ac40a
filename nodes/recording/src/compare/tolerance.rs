//! How far a computed number may be from the golden one.

use super::kind::Kind;

/// Tolerances by topic and field; everything they do not name has to be equal in every bit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tolerances {
    entries: Vec<Entry>,
}

/// A computed number c is accepted for a golden one g when |c - g| <= `absolute` + `relative` |g|.
///
/// Both zero, which is the default, asks for equal bits: then -0 is not 0. A NaN equals every NaN and nothing else.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Tolerance {
    /// In the unit of the field.
    absolute: f64,
    relative: f64,
}

/// `TOPIC[.FIELD]=ABSOLUTE,RELATIVE` as it was given.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    text: String,
    topic: String,
    /// Empty: all numbers of the message.
    field: String,
    tolerance: Tolerance,
}

/// A tolerance that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ToleranceError {
    /// Not `TOPIC[.FIELD]=ABSOLUTE,RELATIVE`.
    #[error(
        "tolerance {text:?}: accepted is TOPIC[.FIELD]=ABSOLUTE,RELATIVE with two numbers of at least 0, \
         such as servo_cf=1e-6,0 or contact_state.depth=1e-9,1e-6"
    )]
    Malformed {
        /// What was given.
        text: String,
    },
    /// No compared topic has that name.
    #[error("tolerance {text:?}: no compared topic ends with {topic:?}; accepted: {accepted}")]
    Topic {
        /// What was given.
        text: String,
        /// The topic in it.
        topic: String,
        /// The compared topics.
        accepted: String,
    },
    /// The topic's messages have no such number.
    #[error("tolerance {text:?}: {type_name} has no number {field:?}; accepted: {accepted}")]
    Field {
        /// What was given.
        text: String,
        /// The field in it.
        field: String,
        /// The type of the topic.
        type_name: &'static str,
        /// The fields of that type that are numbers.
        accepted: String,
    },
}

impl Tolerances {
    /// Reads tolerances: `servo_cf=1e-6,0` for all numbers of a topic, `contact_state.depth=1e-9,1e-6` for one field (or
    /// `servo_cf.wrench.force` for all below it).
    ///
    /// A topic is named in full (`/left/servo_cf`) or by its last words (`servo_cf` means that topic of every device). Where
    /// several fit, a field goes before a topic, a longer name before a shorter one, and the later before the earlier.
    ///
    /// # Errors
    /// When a text is not of that form. Whether topic and field exist is for [`Comparison::new`](super::Comparison::new).
    pub fn parse<S: AsRef<str>>(texts: &[S]) -> Result<Self, ToleranceError> {
        let entries = texts.iter().map(|text| {
            let text = text.as_ref();
            entry(text).ok_or_else(|| ToleranceError::Malformed { text: text.to_owned() })
        });
        Ok(Self { entries: entries.collect::<Result<_, _>>()? })
    }

    /// The tolerance of each field of a topic.
    pub(super) fn of(&self, topic: &str, kind: Kind) -> Vec<Tolerance> {
        let of_field = |(field, tolerable): (&super::kind::Field, bool)| {
            let fitting = self.entries.iter().filter(|entry| {
                tolerable
                    && entry.names_topic(topic)
                    && (entry.field.is_empty() || entry.names_field(field.name))
            });
            // The last of equal ones wins.
            let best = fitting.max_by_key(|entry| (entry.field.len(), entry.topic.len()));
            best.map_or_else(Tolerance::default, |entry| entry.tolerance)
        };
        kind.fields().iter().zip(kind.tolerable()).map(of_field).collect()
    }

    /// Refuses what would have no effect: a slip in a name must not look like a strict comparison, or a lax one.
    pub(super) fn check(&self, topics: &[(&str, Option<Kind>)]) -> Result<(), ToleranceError> {
        for entry in &self.entries {
            let mut named = topics.iter().filter(|(topic, _)| entry.names_topic(topic)).peekable();
            if named.peek().is_none() {
                let accepted: Vec<&str> = topics.iter().map(|(topic, _)| *topic).collect();
                let (text, topic) = (entry.text.clone(), entry.topic.clone());
                return Err(ToleranceError::Topic { text, topic, accepted: accepted.join(", ") });
            }
            if entry.field.is_empty() {
                continue;
            }
            for kind in named.filter_map(|(_, kind)| *kind) {
                let numbers =
                    || kind.fields().iter().zip(kind.tolerable()).filter(|(_, tolerable)| *tolerable);
                if !numbers().any(|(field, _)| entry.names_field(field.name)) {
                    let accepted: Vec<&str> = numbers().map(|(field, _)| field.name).collect();
                    let (text, field) = (entry.text.clone(), entry.field.clone());
                    let (type_name, accepted) = (kind.type_name(), accepted.join(", "));
                    return Err(ToleranceError::Field { text, field, type_name, accepted });
                }
            }
        }
        Ok(())
    }
}

impl Tolerance {
    /// Whether a difference of that size is accepted for numbers whose bits differ.
    pub(super) fn accepts(self, golden: f64, absolute: f64) -> bool {
        let asked = self.absolute > 0.0 || self.relative > 0.0;
        // The second condition: an infinite golden number would accept anything.
        asked && absolute.is_finite() && absolute <= self.absolute + self.relative * golden.abs()
    }
}

impl Entry {
    fn names_topic(&self, name: &str) -> bool {
        name == self.topic
            || name.strip_suffix(&self.topic).is_some_and(|front| front.ends_with('/'))
                && !self.topic.is_empty()
    }

    fn names_field(&self, name: &str) -> bool {
        name.strip_prefix(&self.field).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    }
}

fn entry(text: &str) -> Option<Entry> {
    let (place, numbers) = text.split_once('=')?;
    // A topic's name has no dot in it.
    let (topic, field) = match place.trim().split_once('.') {
        Some((_, "")) => return None,
        Some(both) => both,
        None => (place.trim(), ""),
    };
    let (absolute, relative) = numbers.split_once(',')?;
    let number =
        |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
    let tolerance = Tolerance { absolute: number(absolute)?, relative: number(relative)? };
    let (topic, field) = (topic.to_owned(), field.to_owned());
    (!topic.is_empty()).then_some(Entry { text: text.to_owned(), topic, field, tolerance })
}

#[cfg(test)]
mod tests {
    use super::{Kind, Tolerance, ToleranceError, Tolerances};

    fn named(tolerances: &Tolerances, topic: &str, kind: Kind) -> Vec<(&'static str, Tolerance)> {
        let own = tolerances.of(topic, kind);
        let names = kind.fields().iter().map(|field| field.name).zip(own);
        names.filter(|(_, tolerance)| *tolerance != Tolerance::default()).collect()
    }

    #[test]
    fn the_more_exact_name_goes_first_and_numbers_alone_are_meant() {
        let texts = [
            "/left/servo_cf=5,0",
            "servo_cf=1,0",
            "servo_cf.wrench.force.z=0,0.5",
            "servo_cf.wrench.force=2,0",
        ];
        let tolerances = Tolerances::parse(&texts).unwrap();
        let of = |absolute, relative| Tolerance { absolute, relative };
        let force = [
            ("wrench.force.x", of(2.0, 0.0)),
            ("wrench.force.y", of(2.0, 0.0)),
            ("wrench.force.z", of(0.0, 0.5)),
        ];
        let torque = |absolute| {
            ["wrench.torque.x", "wrench.torque.y", "wrench.torque.z"].map(|name| (name, of(absolute, 0.0)))
        };
        assert_eq!(named(&tolerances, "/left/servo_cf", Kind::Wrench), [force, torque(5.0)].concat());
        assert_eq!(named(&tolerances, "/right/servo_cf", Kind::Wrench), [force, torque(1.0)].concat());
        assert_eq!(named(&tolerances, "/my_servo_cf", Kind::Wrench), []);
        assert_eq!(named(&tolerances, "/servo_cf/other", Kind::Wrench), []);
    }

    #[test]
    fn what_is_accepted_is_absolute_plus_relative_and_never_infinite() {
        let tolerance = Tolerance { absolute: 1.0, relative: 0.5 };
        assert!(tolerance.accepts(-4.0, 3.0));
        assert!(!tolerance.accepts(-4.0, 3.000_001));
        assert!(!tolerance.accepts(f64::INFINITY, f64::INFINITY));
        assert!(!tolerance.accepts(f64::NAN, f64::INFINITY));
        assert!(
            !Tolerance::default().accepts(0.0, 0.0),
            "another sign of zero is another number when nothing is tolerated"
        );
    }

    #[test]
    fn a_text_of_another_form_is_refused_with_the_form() {
        let bad = [
            "",
            "servo_cf",
            "servo_cf=",
            "servo_cf=1e-6",
            "=1,1",
            "servo_cf=-1,0",
            "servo_cf=nan,0",
            "servo_cf=0,inf",
            "servo_cf.=0,0",
            "servo_cf=1,2,3",
            "servo_cf=a,b",
            ".depth=0,0",
        ];
        for text in bad {
            let error = Tolerances::parse(&["servo_cf=0,0", text]).unwrap_err();
            assert_eq!(error, ToleranceError::Malformed { text: text.to_owned() });
            assert!(error.to_string().contains("TOPIC[.FIELD]=ABSOLUTE,RELATIVE"));
        }
        assert!(Tolerances::parse(&[" servo_cf = 1e-6 , 0 "]).is_ok());
    }

    #[test]
    fn a_name_that_nothing_has_is_refused_with_the_names_there_are() {
        let topics =
            [("/servo_cf", Some(Kind::Wrench)), ("/contact_state", Some(Kind::Contact)), ("/new", None)];
        let refused =
            |text: &str| Tolerances::parse(&[text]).unwrap().check(&topics).unwrap_err().to_string();
        assert_eq!(
            refused("force=1,0"),
            r#"tolerance "force=1,0": no compared topic ends with "force"; accepted: /servo_cf, /contact_state, /new"#
        );
        assert!(refused("cf=1,0").contains(r#"ends with "cf""#), "words, not letters");
        let no_field = refused("servo_cf.depth=1,0");
        assert!(no_field.contains(r#"has no number "depth"; accepted: wrench.force.x, "#), "{no_field}");
        assert!(refused("contact_state.mode=1,0").contains("stiffness"), "only numbers have tolerances");
        for good in ["new.whatever=0,0", "contact_state.barycentric=1e-9,0", "/servo_cf=0,1"] {
            assert_eq!(Tolerances::parse(&[good]).unwrap().check(&topics), Ok(()), "{good}");
        }
    }
}
