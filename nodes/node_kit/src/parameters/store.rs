//! The parameters of one node and the rules for changing them while it runs. Nothing here needs ROS.

use scene::schema::{schema, spec};
use scene::{Node, ParameterSpec, Parameters, Value};

/// A parameter that was changed while the node runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Full dotted name.
    pub name: &'static str,
    /// The new value, of the right type and in range.
    pub value: Value,
}

/// Whether values that are each accepted also fit together and may be changed just now. Gets all values as they would
/// be, and the changes; the error is the reason for a person.
pub type TogetherCheck = Box<dyn Fn(&Parameters, &[Change]) -> Result<(), String> + Send>;

/// Values, and what may be done with them.
pub(crate) struct Store {
    node: Node,
    values: Parameters,
    together: TogetherCheck,
}

impl Store {
    pub(crate) fn new(node: Node, values: Parameters) -> Store {
        Store { node, values, together: Box::new(|_, _| Ok(())) }
    }

    pub(crate) fn values(&self) -> &Parameters {
        &self.values
    }

    /// What else must hold for values that are set from now on.
    pub(crate) fn check_together(&mut self, check: TogetherCheck) {
        self.together = check;
    }

    /// Show what the node made of a parameter that nobody gave and that has no constant default.
    pub(crate) fn set_computed(&mut self, name: &str, value: Value) -> Result<(), scene::SceneError> {
        self.values = self.values.with(name, value)?;
        Ok(())
    }

    /// The node's own parameters that have a value, in the order of the documentation.
    pub(crate) fn declared(&self) -> impl Iterator<Item = (&'static ParameterSpec, &Value)> {
        self.own().filter_map(|spec| Some((spec, self.values.get(spec.name)?)))
    }

    fn own(&self) -> impl Iterator<Item = &'static ParameterSpec> {
        let node = self.node;
        schema().filter(move |spec| spec.used_by(node))
    }

    /// One of the node's own parameters.
    pub(crate) fn describe(&self, name: &str) -> Option<&'static ParameterSpec> {
        spec(name).filter(|spec| spec.used_by(self.node))
    }

    /// Its value.
    pub(crate) fn get(&self, name: &str) -> Option<&Value> {
        self.describe(name).and_then(|spec| self.values.get(spec.name))
    }

    /// Names and prefixes as `rcl_interfaces/srv/ListParameters` wants them; depth 0 is unlimited.
    pub(crate) fn list(&self, prefixes: &[String], depth: u64) -> (Vec<String>, Vec<String>) {
        let deep_enough = |below: &str| depth == 0 || (below.matches('.').count() as u64) < depth;
        let wanted = |name: &str| {
            if prefixes.is_empty() {
                return deep_enough(name);
            }
            prefixes.iter().any(|prefix| match name.strip_prefix(prefix.as_str()) {
                Some("") => true,
                Some(below) => below.strip_prefix('.').is_some_and(deep_enough),
                None => false,
            })
        };
        let names: Vec<String> =
            self.declared().map(|(spec, _)| spec.name.to_owned()).filter(|name| wanted(name)).collect();
        let mut found_prefixes: Vec<String> = Vec::new();
        for (prefix, _) in names.iter().filter_map(|name| name.rsplit_once('.')) {
            if !found_prefixes.iter().any(|found| found == prefix) {
                found_prefixes.push(prefix.to_owned());
            }
        }
        (names, found_prefixes)
    }

    /// Set all of them or none. What really changed, or why not.
    pub(crate) fn set(&mut self, requested: Vec<(String, Value)>) -> Result<Vec<Change>, String> {
        let mut values = self.values.clone();
        let mut changes = Vec::new();
        for (name, value) in requested {
            let spec = self.settable(&name)?;
            values = values.with(&name, value).map_err(|error| format!("{name}: {}", error.problem))?;
            if let Some(value) = values.get(&name)
                && self.values.get(&name) != Some(value)
            {
                changes.push(Change { name: spec.name, value: value.clone() });
            }
        }
        (self.together)(&values, &changes)?;
        self.values = values;
        Ok(changes)
    }

    fn settable(&self, name: &str) -> Result<&'static ParameterSpec, String> {
        let Some(spec) = self.describe(name) else {
            return Err(match scene::schema::nearest_name(name) {
                Some(nearest) if nearest != name => {
                    format!("{name}: {} has no such parameter; did you mean {nearest}?", self.node.name())
                }
                _ => format!("{name}: {} has no such parameter", self.node.name()),
            });
        };
        if !spec.live {
            let live: Vec<&str> = self.own().filter(|spec| spec.live).map(|spec| spec.name).collect();
            return Err(format!(
                "{name} is read when the node starts and cannot be changed while it runs; can be: {}",
                live.join(", ")
            ));
        }
        Ok(spec)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Origin;

    fn store() -> Store {
        Store::new(Node::Deformation, Parameters::defaults(Origin::named("a test")))
    }

    fn one(name: &str, value: Value) -> Vec<(String, Value)> {
        vec![(name.to_owned(), value)]
    }

    #[test]
    fn a_live_parameter_is_set_and_reported_once() {
        let mut store = store();
        let changes = store.set(one("surface.rate", Value::Integer(30))).unwrap();
        assert_eq!(changes, [Change { name: "surface.rate", value: Value::Double(30.0) }]);
        assert_eq!(store.get("surface.rate"), Some(&Value::Double(30.0)));
        assert_eq!(store.set(one("surface.rate", Value::Double(30.0))), Ok(vec![]), "nothing changed");
    }

    #[test]
    fn what_is_out_of_range_unknown_or_not_live_is_refused_with_the_reason() {
        let mut store = store();
        let reason = store.set(one("surface.rate", Value::Double(-1.0))).unwrap_err();
        assert!(
            reason.contains("surface.rate") && reason.contains("-1.0") && reason.contains("accepted"),
            "{reason}"
        );
        let reason = store.set(one("surface.rate", Value::String("fast".to_owned()))).unwrap_err();
        assert!(reason.contains("string"), "{reason}");
        let reason = store.set(one("surface.rat", Value::Double(1.0))).unwrap_err();
        assert!(reason.contains("surface.rate"), "{reason}");
        let reason = store.set(one("body.scale", Value::Double(2.0))).unwrap_err();
        assert!(reason.contains("surface.rate"), "says what can be set: {reason}");
        let reason = store.set(one("simulated.mass", Value::Double(2.0))).unwrap_err();
        assert!(reason.contains("deformation has no such parameter"), "another node's: {reason}");
        assert_eq!(store.get("simulated.mass"), None);
    }

    #[test]
    fn several_are_set_together_or_not_at_all() {
        let mut store = store();
        let both = vec![
            ("surface.rate".to_owned(), Value::Double(10.0)),
            ("grasp.close_below".to_owned(), Value::Double(f64::NAN)),
        ];
        assert!(store.set(both).is_err());
        assert_ne!(store.get("surface.rate"), Some(&Value::Double(10.0)));
    }

    #[test]
    fn values_that_do_not_fit_together_are_refused() {
        let mut store = store();
        store.check_together(Box::new(|_, changes| {
            assert_eq!(changes.len(), 1);
            Err("they disagree".to_owned())
        }));
        assert_eq!(store.set(one("surface.rate", Value::Double(10.0))), Err("they disagree".to_owned()));
    }

    #[test]
    fn names_are_listed_by_prefix_and_depth() {
        let store = store();
        let (all, prefixes) = store.list(&[], 0);
        assert!(all.contains(&"surface.rate".to_owned()) && all.contains(&"use_sim_time".to_owned()));
        assert!(!all.iter().any(|name| name.starts_with("simulated.")), "not the node's own");
        assert!(prefixes.contains(&"surface".to_owned()));
        let (top, _) = store.list(&[], 1);
        assert!(top.contains(&"use_sim_time".to_owned()) && !top.contains(&"surface.rate".to_owned()));
        let (surface, _) = store.list(&["surface".to_owned()], 1);
        assert!(!surface.is_empty() && surface.iter().all(|name| name.starts_with("surface.")));
        assert_eq!(store.list(&["surface.rate".to_owned()], 0).0, ["surface.rate"]);
        assert!(store.list(&["surf".to_owned()], 0).0.is_empty(), "a prefix ends at a dot");
    }
}
