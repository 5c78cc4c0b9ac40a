//! The parameters that a page may set: read from the nodes that have them, set on all of those or on none.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::time::{Duration, Instant};

use node_kit::{
    NodeKit, ParameterClient, ParameterListener, Pending, RemoteError, RemoteParameter, StartError,
};
use scene::Value;

use super::link::Page;
use super::protocol::{self, ShownParameter};

/// Groups that are not for a page: what protects a hand, what drives a motor, what switches protection off.
const NOT_FOR_PAGES: [&str; 3] = ["safety.", "device.", "unsafe."];
/// Only the markers follow it; a page has a switch of its own for the same thing.
const OF_MARKERS: &str = "visualization.show_chains";
/// Nodes whose parameters are read; a client of r2r is never given back.
const MAX_NODES: usize = 32;
/// Changes of all pages that may wait.
const MAX_WAITING: usize = 32;
/// A node that could not be read is asked again after this time.
const ASK_AGAIN: Duration = Duration::from_secs(1);

/// What is known of every node's parameters, and the changes that are under way.
pub(crate) struct NodeParameters {
    news: ParameterListener,
    nodes: BTreeMap<String, Remote>,
    /// Names of the nodes that are there.
    present: BTreeSet<String>,
    waiting: VecDeque<Asked>,
    change: Option<Change>,
    is_changed: bool,
}

/// One node.
struct Remote {
    client: ParameterClient,
    reading: Option<Pending<Vec<RemoteParameter>>>,
    ask_at: Option<Instant>,
    parameters: Vec<RemoteParameter>,
}

/// What a page has asked for.
struct Asked {
    page: Page,
    id: u64,
    name: String,
    value: serde_json::Value,
}

/// A change that goes from node to node.
struct Change {
    asked: Asked,
    value: Value,
    /// Nodes that have not been asked yet, the next one last.
    left: Vec<String>,
    /// Nodes that have it, each with the value it had before.
    done: Vec<(String, Value)>,
    under_way: UnderWay,
    /// Why it failed; then `done` is being undone.
    failed: Option<String>,
}

/// A node that has been asked.
struct UnderWay {
    node: String,
    /// The value it had. Its own news of the change may come before its answer.
    before: Option<Value>,
    answer: Pending<()>,
}

impl NodeParameters {
    /// Listen for changes.
    pub(crate) fn new(kit: &mut NodeKit) -> Result<NodeParameters, StartError> {
        Ok(NodeParameters {
            news: ParameterListener::new(kit)?,
            nodes: BTreeMap::new(),
            present: BTreeSet::new(),
            waiting: VecDeque::new(),
            change: None,
            is_changed: true,
        })
    }

    /// Which nodes are there now.
    pub(crate) fn set_present<'a>(
        &mut self,
        kit: &mut NodeKit,
        names: impl Iterator<Item = &'a str>,
    ) -> Result<(), StartError> {
        let present: BTreeSet<String> = names.map(str::to_owned).collect();
        if present == self.present {
            return Ok(());
        }
        for name in present.difference(&self.present) {
            if let Some(remote) = self.nodes.get_mut(name) {
                remote.ask_at = Some(Instant::now());
            } else if self.nodes.len() < MAX_NODES {
                let client = ParameterClient::new(kit, name)?;
                let ask_at = Some(Instant::now());
                let remote = Remote { client, reading: None, ask_at, parameters: Vec::new() };
                self.nodes.insert(name.clone(), remote);
            }
        }
        self.present = present;
        self.is_changed = true;
        Ok(())
    }

    /// Take over what nodes say of changes.
    pub(crate) fn hear(&mut self, now: Instant) {
        while let Some(news) = self.news.take() {
            let Some(remote) = self.nodes.get_mut(&news.node) else { continue };
            if news.declared {
                remote.ask_at = Some(now);
            }
            for (name, value) in news.changed {
                if let Some(known) = remote.parameters.iter_mut().find(|known| known.name == name) {
                    known.value = value;
                    self.is_changed = true;
                }
            }
        }
    }

    /// A page wants a change.
    pub(crate) fn ask(&mut self, page: Page, id: u64, name: String, value: serde_json::Value) {
        if self.waiting.len() >= MAX_WAITING {
            page.tell(protocol::parameter_result(id, Err("too many changes wait; try again")));
            return;
        }
        self.waiting.push_back(Asked { page, id, name, value });
    }

    /// Go on with what is under way.
    pub(crate) fn advance(&mut self, now: Instant) {
        for remote in self.nodes.values_mut() {
            self.is_changed |= remote.advance(now);
        }
        if self.change.is_none()
            && let Some(asked) = self.waiting.pop_front()
        {
            match self.begin(&asked.name, &asked.value) {
                Ok((value, mut left)) => {
                    if let Some(under_way) = self.next(&mut left, &asked.name, &value) {
                        let done = Vec::new();
                        self.change = Some(Change { asked, value, left, done, under_way, failed: None });
                    }
                }
                Err(reason) => asked.page.tell(protocol::parameter_result(asked.id, Err(&reason))),
            }
        }
        if let Some(change) = self.change.take() {
            self.change = self.advance_change(change);
        }
    }

    /// The list for pages, when it has changed since the last call.
    pub(crate) fn news(&mut self) -> Option<Vec<ShownParameter>> {
        std::mem::take(&mut self.is_changed).then(|| self.shown())
    }

    fn shown(&self) -> Vec<ShownParameter> {
        let mut shown: BTreeMap<&str, ShownParameter> = BTreeMap::new();
        for (node, parameter) in self.settable() {
            let entry = shown.entry(&parameter.name).or_insert_with(|| as_shown(parameter));
            entry.nodes.push(node.to_owned());
        }
        shown.into_values().collect()
    }

    /// What a page may set, of each node that is there.
    fn settable(&self) -> impl Iterator<Item = (&str, &RemoteParameter)> {
        self.nodes
            .iter()
            .filter(|(node, _)| self.present.contains(*node))
            .flat_map(|(node, remote)| {
                remote.parameters.iter().map(move |parameter| (node.as_str(), parameter))
            })
            .filter(|(_, parameter)| is_for_pages(parameter))
    }

    /// The value as the nodes want it, and the nodes, the first one last.
    fn begin(&self, name: &str, value: &serde_json::Value) -> Result<(Value, Vec<String>), String> {
        let mut having = self.settable().filter(|(_, parameter)| parameter.name == name);
        let Some((first, parameter)) = having.next() else {
            return Err(format!("{name:?} is no parameter that a page may set; \"parameters\" lists those"));
        };
        let value = like(&parameter.value, value)
            .ok_or_else(|| format!("{name}: {value} is not accepted; accepted: {}", parameter.constraints))?;
        let mut nodes: Vec<String> =
            std::iter::once(first).chain(having.map(|(node, _)| node)).map(str::to_owned).collect();
        nodes.reverse();
        Ok((value, nodes))
    }

    fn next(&self, left: &mut Vec<String>, name: &str, value: &Value) -> Option<UnderWay> {
        let node = left.pop()?;
        let answer = self.nodes.get(&node)?.client.set(name, value);
        Some(UnderWay { before: self.value(&node, name).cloned(), node, answer })
    }

    fn advance_change(&mut self, mut change: Change) -> Option<Change> {
        let Some(answer) = change.under_way.answer.poll() else { return Some(change) };
        let (node, before) = (change.under_way.node.clone(), change.under_way.before.take());
        match (answer, change.failed.is_some()) {
            (Ok(()), false) => {
                self.take_over(&node, &change.asked.name, &change.value);
                change.done.extend(before.map(|before| (node, before)));
            }
            (Ok(()), true) => {}
            (Err(error), false) => {
                change.failed = Some(in_words(&node, &error));
                // One that hangs may accept it yet; what takes it back is then behind it in the same queue.
                if matches!(error, RemoteError::Silent { .. }) {
                    change.done.extend(before.map(|before| (node, before)));
                }
            }
            (Err(error), true) => {
                let words = format!("; when it was taken back: {}", in_words(&node, &error));
                change.failed.get_or_insert_default().push_str(&words);
            }
        }
        let name = &change.asked.name;
        let next = match &change.failed {
            None => self.next(&mut change.left, name, &change.value),
            // The nodes that had accepted it get their own value back.
            Some(_) => change.done.pop().and_then(|(node, before)| {
                self.take_over(&node, name, &before);
                self.next(&mut vec![node], name, &before)
            }),
        };
        if let Some(next) = next {
            change.under_way = next;
            return Some(change);
        }
        let Asked { page, id, .. } = &change.asked;
        page.tell(protocol::parameter_result(*id, change.failed.as_deref().map_or(Ok(()), Err)));
        None
    }

    fn value(&self, node: &str, name: &str) -> Option<&Value> {
        let parameters = &self.nodes.get(node)?.parameters;
        parameters.iter().find(|parameter| parameter.name == name).map(|parameter| &parameter.value)
    }

    /// Note the new value.
    fn take_over(&mut self, node: &str, name: &str, value: &Value) {
        let Some(remote) = self.nodes.get_mut(node) else { return };
        for known in remote.parameters.iter_mut().filter(|parameter| parameter.name == name) {
            known.value = value.clone();
            self.is_changed = true;
        }
    }
}

impl Remote {
    /// True when something new is known.
    fn advance(&mut self, now: Instant) -> bool {
        if self.ask_at.is_some_and(|at| now >= at) {
            self.ask_at = None;
            self.reading = Some(self.client.read());
        }
        let Some(answer) = self.reading.as_mut().and_then(Pending::poll) else { return false };
        self.reading = None;
        match answer {
            Ok(parameters) => self.parameters = parameters,
            Err(_) => self.ask_at = Some(now + ASK_AGAIN),
        }
        true
    }
}

fn in_words(node: &str, error: &RemoteError) -> String {
    match error {
        RemoteError::Refused(reason) => format!("{node}: {reason}"),
        other => other.to_string(),
    }
}

fn is_for_pages(parameter: &RemoteParameter) -> bool {
    // use_sim_time and other parameters that every ROS node has carry no range and no unit, and are read at the start.
    !parameter.read_only
        && parameter.name.contains('.')
        && !parameter.name.starts_with("qos_overrides.")
        && parameter.name != OF_MARKERS
        && !NOT_FOR_PAGES.iter().any(|group| parameter.name.starts_with(group))
}

fn as_shown(parameter: &RemoteParameter) -> ShownParameter {
    let (help, unit) = match parameter.description.strip_suffix(']').and_then(|text| text.rsplit_once(" [")) {
        Some((help, unit)) => (help, unit),
        None => (parameter.description.as_str(), ""),
    };
    // "number, > 0 [Hz]": type, range, unit.
    let constraints =
        parameter.constraints.strip_suffix(&format!(" [{unit}]")).unwrap_or(&parameter.constraints);
    let accepted = constraints.split_once(", ").map_or("", |(_, range)| range);
    let bound = |x: f64| (x.abs() < f64::MAX).then_some(x);
    ShownParameter {
        name: parameter.name.clone(),
        value: parameter.value.clone(),
        unit: unit.to_owned(),
        min: parameter.range.and_then(|(min, _)| bound(min)),
        max: parameter.range.and_then(|(_, max)| bound(max)),
        exclusive_min: accepted.split(", ").any(|part| part.starts_with("> ")),
        help: help.to_owned(),
        accepted: accepted.to_owned(),
        nodes: Vec::new(),
    }
}

/// JSON as a value of the same type as `like`; none when it is of another.
fn like(like: &Value, json: &serde_json::Value) -> Option<Value> {
    fn all<T>(json: &serde_json::Value, one: impl Fn(&serde_json::Value) -> Option<T>) -> Option<Vec<T>> {
        json.as_array()?.iter().map(one).collect()
    }
    let text = |json: &serde_json::Value| json.as_str().map(str::to_owned);
    Some(match like {
        Value::Bool(_) => Value::Bool(json.as_bool()?),
        Value::Integer(_) => Value::Integer(json.as_i64()?),
        Value::Double(_) => Value::Double(json.as_f64()?),
        Value::String(_) => Value::String(text(json)?),
        Value::BoolArray(_) => Value::BoolArray(all(json, serde_json::Value::as_bool)?),
        Value::IntegerArray(_) => Value::IntegerArray(all(json, serde_json::Value::as_i64)?),
        Value::DoubleArray(_) => Value::DoubleArray(all(json, serde_json::Value::as_f64)?),
        Value::StringArray(_) => Value::StringArray(all(json, text)?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn remote(name: &str) -> RemoteParameter {
        RemoteParameter {
            name: name.to_owned(),
            value: Value::Double(60.0),
            read_only: false,
            description: "Updates sent to each page. [Hz]".to_owned(),
            constraints: "number, > 0 and < 120 [Hz]".to_owned(),
            range: Some((0.0, f64::MAX)),
        }
    }

    #[test]
    fn help_unit_and_range_come_from_the_descriptor() {
        let shown = as_shown(&remote("viewer.rate"));
        assert_eq!((shown.help.as_str(), shown.unit.as_str()), ("Updates sent to each page.", "Hz"));
        assert_eq!((shown.min, shown.max, shown.exclusive_min), (Some(0.0), None, true));
        assert_eq!(shown.accepted, "> 0 and < 120");
        let closed = RemoteParameter { constraints: "number, >= 0".to_owned(), ..remote("x.y") };
        assert!(!as_shown(&closed).exclusive_min);
        let text = RemoteParameter { constraints: "boolean".to_owned(), range: None, ..remote("x.y") };
        assert_eq!((as_shown(&text).accepted, as_shown(&text).min), (String::new(), None));
    }

    #[test]
    fn what_protects_a_hand_is_not_for_pages() {
        for name in ["safety.slew", "device.max_force", "unsafe.parameters", "use_sim_time"] {
            assert!(!is_for_pages(&remote(name)), "{name}");
        }
        assert!(is_for_pages(&remote("chains.normal_stiffness")));
        assert!(!is_for_pages(&RemoteParameter { read_only: true, ..remote("body.scale") }));
    }

    #[test]
    fn a_value_has_the_type_of_the_parameter_or_is_none() {
        assert_eq!(like(&Value::Double(1.0), &json!(3)), Some(Value::Double(3.0)));
        assert_eq!(like(&Value::Integer(1), &json!(3.5)), None);
        assert_eq!(
            like(&Value::DoubleArray(vec![]), &json!([1, 2.5])),
            Some(Value::DoubleArray(vec![1.0, 2.5]))
        );
        assert_eq!(like(&Value::DoubleArray(vec![]), &json!([1, "x"])), None);
        assert_eq!(like(&Value::Bool(true), &json!(1)), None);
    }
}
