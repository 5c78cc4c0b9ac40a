//! Which parameters may be set when: what would make the force jump is refused while a device touches the body.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use node_kit::{Change, TogetherCheck};

use crate::model;

/// Live parameters that change the force at an unchanged depth. The others change only the picture of the surface, or
/// when a grasp begins and ends, which ramps.
const CHANGE_THE_FORCE: [&str; 4] =
    ["chains.normal_stiffness", "chains.tangential_stiffness", "chains.tangential_growth", "grasp.lateral"];

/// Whether any device touches the body; shared with the check of new parameter values.
#[derive(Clone, Debug, Default)]
pub(crate) struct InContact(Arc<AtomicBool>);

impl InContact {
    pub(crate) fn set(&self, in_contact: bool) {
        self.0.store(in_contact, Ordering::Relaxed);
    }

    fn get(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The check of values that are about to be set: they describe a model, and no hand feels a jump.
    pub(crate) fn check(&self) -> TogetherCheck {
        let in_contact = self.clone();
        Box::new(move |values, changes| {
            if let Some(name) = changes_the_force(changes).filter(|_| in_contact.get()) {
                return Err(format!(
                    "{name} would make the force jump: accepted while no device touches the body"
                ));
            }
            let scene = model::check(values).map_err(|error| error.to_string())?;
            match changes_the_shape(changes).filter(|_| scene.body.response.is_some()) {
                Some(name) => Err(format!(
                    "{name} is that of the calibrated body (body.response); accepted: the chains that it was made for"
                )),
                None => Ok(()),
            }
        })
    }
}

/// Live parameters that a calibrated body is made for.
fn changes_the_shape(changes: &[Change]) -> Option<&'static str> {
    changes.iter().map(|change| change.name).find(|name| *name == "chains.pitch")
}

fn changes_the_force(changes: &[Change]) -> Option<&'static str> {
    changes.iter().map(|change| change.name).find(|name| CHANGE_THE_FORCE.contains(name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::schema::{schema, spec};
    use scene::{Node, Value};

    #[test]
    fn what_changes_the_force_waits_until_nothing_is_touched() {
        let change = |name| Change { name, value: Value::Double(1.0) };
        assert_eq!(changes_the_force(&[change("surface.rate"), change("surface.cutoff")]), None);
        assert_eq!(
            changes_the_force(&[change("surface.rate"), change("grasp.lateral")]),
            Some("grasp.lateral")
        );
        for name in CHANGE_THE_FORCE {
            assert!(spec(name).is_some_and(|spec| spec.live), "{name}");
        }
    }

    #[test]
    fn a_calibrated_body_keeps_the_shape_of_its_chains() {
        let change = |name| Change { name, value: Value::Double(1.0) };
        assert_eq!(changes_the_shape(&[change("surface.cutoff"), change("probe.contact_radius")]), None);
        assert_eq!(
            changes_the_shape(&[change("surface.cutoff"), change("chains.pitch")]),
            Some("chains.pitch")
        );
        // What decides a chain's shape beside its pitch cannot be set live.
        assert!(
            ["chains.ratio", "chains.units"].iter().all(|name| spec(name).is_some_and(|spec| !spec.live))
        );
    }

    #[test]
    fn every_live_parameter_of_the_model_has_been_judged() {
        const HARMLESS: [&str; 7] = [
            "chains.weight",
            "chains.pitch",
            "surface.cutoff",
            "surface.expansion",
            "surface.rate",
            "probe.contact_radius",
            "grasp.close_below",
        ];
        let live = schema().filter(|spec| spec.live && spec.used_by(Node::Deformation));
        for spec in live {
            assert!(CHANGE_THE_FORCE.contains(&spec.name) || HARMLESS.contains(&spec.name), "{}", spec.name);
        }
    }
}
