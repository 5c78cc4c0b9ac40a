//! Sections of single drivers, like `/left/haptic_device:`: where each of several devices stands, and what it is.
//!
//! Such a section is a driver's own: two of them may say different things. What the driver shares with other nodes is
//! checked against what those read, because a hand that presses one body and a model that computes another would
//! feel each other's mistakes.

use std::path::Path;

use crate::schema::{Node, spec};
use crate::sections::{File, Section, read_file};
use crate::{Parameters, Problem, SceneError, Value};

/// May differ from driver to driver as long as nobody gives it for the whole scene: then only drivers read it.
const PLACE: [&str; 2] = ["device.scene_from_device", "device.frame_id"];

/// Whether a section is one driver's own: the full name of a driver in a sub-namespace.
pub(crate) fn is_of_one_driver(section: &str) -> bool {
    section
        .strip_suffix(Node::HapticDevice.name())
        .and_then(|namespace| namespace.strip_suffix('/'))
        .is_some_and(|namespace| namespace.starts_with('/') && namespace != "/")
}

impl Parameters {
    /// The full names of the drivers that have a section of their own in a parameter file, in file order. Each of them
    /// reads the file as [`Reader::Node`](crate::Reader::Node).
    ///
    /// # Errors
    /// As [`Parameters::from_file`], without looking at any parameter.
    pub fn drivers_in_file(path: &Path) -> Result<Vec<String>, SceneError> {
        let (origin, tree) = read_file(path)?;
        let sections = File { origin: &origin }.sections(&tree)?;
        let names = sections.into_iter().map(|section| section.name);
        Ok(names.filter(|name| is_of_one_driver(name)).collect())
    }
}

/// Checks every section of a single driver against `scene`, which the other sections set.
pub(crate) fn check(file: &File<'_>, sections: &[Section<'_>], scene: &Parameters) -> Result<(), SceneError> {
    for (index, section) in sections.iter().enumerate().filter(|(_, section)| is_of_one_driver(&section.name))
    {
        let later = &sections[index + 1..];
        for (key, leaf, value) in file.values(section)? {
            let problem = not_the_drivers(section, &key)
                .or_else(|| shared_and_different(section, &key, &value, scene))
                .map_or_else(|| overruled(file, section, &key, &value, later), |problem| Ok(Some(problem)))?;
            if let Some(problem) = problem {
                return Err(file.origin.error(Some(&key), Some(leaf), problem));
            }
        }
    }
    Ok(())
}

fn not_the_drivers(section: &Section<'_>, key: &str) -> Option<Problem> {
    let owners = spec(key)?.owners;
    if owners.contains(&Node::HapticDevice) {
        return None;
    }
    Some(Problem::OtherNodes { section: section.name.clone(), owners: names(owners.iter()) })
}

fn shared_and_different(
    section: &Section<'_>,
    key: &str,
    value: &Value,
    scene: &Parameters,
) -> Option<Problem> {
    let owners = spec(key)?.owners.iter().filter(|owner| **owner != Node::HapticDevice);
    let with = names(owners);
    let free = with.is_empty() || key == "use_sim_time" || (PLACE.contains(&key) && !scene.is_given(key));
    if free || scene.get(key) == Some(value) {
        return None;
    }
    Some(Problem::Shared {
        section: section.name.clone(),
        value: value.to_string(),
        with,
        theirs: scene.get(key).map_or_else(|| "none".to_owned(), ToString::to_string),
    })
}

/// The node's reader lets later sections win, whatever their name is.
fn overruled(
    file: &File<'_>,
    section: &Section<'_>,
    key: &str,
    value: &Value,
    later: &[Section<'_>],
) -> Result<Option<Problem>, SceneError> {
    for other in later.iter().filter(|other| other.applies_to(crate::Reader::Node(&section.name))) {
        let values = file.values(other)?;
        if let Some((_, _, theirs)) =
            values.into_iter().find(|(name, _, theirs)| name == key && theirs != value)
        {
            return Ok(Some(Problem::Overruled {
                section: section.name.clone(),
                value: value.to_string(),
                other_section: other.name.clone(),
                other: theirs.to_string(),
            }));
        }
    }
    Ok(None)
}

fn names<'a>(nodes: impl Iterator<Item = &'a Node>) -> String {
    nodes.map(|node| node.name()).collect::<Vec<_>>().join(", ")
}
