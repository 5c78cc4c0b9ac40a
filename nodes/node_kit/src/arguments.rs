//! What the command line says to this library: parameter files (for error messages and relative paths) and log level.
//! Remappings and parameter overrides are rcl's business; it reads the same command line.

use std::path::PathBuf;

/// Least severity that reaches `/rosout`, in rcl's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Severity {
    /// For developers.
    Debug = 10,
    /// Progress.
    Info = 20,
    /// Something is off; the node copes.
    Warn = 30,
    /// Something does not work.
    Error = 40,
    /// The node cannot go on.
    Fatal = 50,
}

impl Severity {
    fn from_word(word: &str) -> Option<Severity> {
        match word.to_ascii_lowercase().as_str() {
            "debug" => Some(Severity::Debug),
            "info" => Some(Severity::Info),
            "warn" => Some(Severity::Warn),
            "error" => Some(Severity::Error),
            "fatal" => Some(Severity::Fatal),
            _ => None,
        }
    }
}

/// The part of `--ros-args` that this library reads itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct RosArguments {
    /// Values of `--params-file`, in order.
    pub(crate) parameter_files: Vec<PathBuf>,
    /// Values of `-r`/`--remap` ("from:=to"), in order.
    remappings: Vec<String>,
    /// Values of `--log-level` ("warn" or "logger:=warn"), in order.
    log_levels: Vec<String>,
}

impl RosArguments {
    /// Read the command line of this process.
    pub(crate) fn from_process() -> RosArguments {
        RosArguments::parse(std::env::args())
    }

    /// Read the sections between `--ros-args` and `--`.
    pub(crate) fn parse(arguments: impl IntoIterator<Item = String>) -> RosArguments {
        let mut found = RosArguments::default();
        let mut arguments = arguments.into_iter();
        let mut in_ros_arguments = false;
        while let Some(argument) = arguments.next() {
            match (in_ros_arguments, argument.as_str()) {
                (false, "--ros-args") => in_ros_arguments = true,
                (true, "--") => in_ros_arguments = false,
                (true, "--params-file") => found.parameter_files.extend(arguments.next().map(PathBuf::from)),
                (true, "-r" | "--remap") => found.remappings.extend(arguments.next()),
                (true, "--log-level") => found.log_levels.extend(arguments.next()),
                _ => {}
            }
        }
        found
    }

    /// Least severity of one logger: what names it, else what names none, else info.
    pub(crate) fn severity_of(&self, logger: &str) -> Severity {
        let mut general = Severity::Info;
        let mut own = None;
        for level in &self.log_levels {
            match level.split_once(":=") {
                Some((name, word)) if name == logger => own = Severity::from_word(word).or(own),
                Some(_) => {}
                None => general = Severity::from_word(level).unwrap_or(general),
            }
        }
        own.unwrap_or(general)
    }

    /// Full name the node is going to have: "/left/deformation". For messages before the node exists.
    pub(crate) fn full_name(&self, default_name: &str) -> String {
        let target = |words: [&str; 2]| {
            self.remappings.iter().find_map(|remapping| {
                let (from, to) = remapping.split_once(":=")?;
                let from =
                    from.strip_prefix(default_name).and_then(|rest| rest.strip_prefix(':')).unwrap_or(from);
                words.contains(&from).then_some(to)
            })
        };
        let namespace = target(["__ns", "__namespace"]).unwrap_or("/").trim_end_matches('/');
        format!("{namespace}/{}", target(["__node", "__name"]).unwrap_or(default_name))
    }

    /// The name that a topic of the node has in the graph: expanded, then remapped, as rcl does it.
    pub(crate) fn topic_in_graph(&self, name: &str, full_node_name: &str) -> String {
        let (namespace, node) = full_node_name.rsplit_once('/').unwrap_or_default();
        let expand = |name: &str| match (name.strip_prefix('~'), name.starts_with('/')) {
            (Some(rest), _) => format!("{full_node_name}{rest}"),
            (None, true) => name.to_owned(),
            (None, false) => format!("{namespace}/{name}"),
        };
        let own = expand(name);
        let remapped = self.remappings.iter().find_map(|remapping| {
            let (from, to) = remapping.split_once(":=")?;
            let from = from.strip_prefix("rostopic://").unwrap_or(from);
            let from = match from.split_once(':') {
                Some((of, from)) if of == node => from,
                Some(_) => return None,
                None => from,
            };
            (expand(from) == own).then(|| expand(to))
        });
        remapped.unwrap_or(own)
    }

    /// Where the parameters came from, for error messages: the files, or the command line.
    pub(crate) fn source(&self) -> String {
        if self.parameter_files.is_empty() {
            return "command line".to_owned();
        }
        self.parameter_files.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(line: &str) -> RosArguments {
        RosArguments::parse(line.split(' ').map(str::to_owned))
    }

    #[test]
    fn parameter_files_are_read_only_between_ros_args_and_the_end_mark() {
        let line = "node --params-file no.yaml --ros-args --params-file a.yaml -p x:=1 --params-file b.yaml -- \
                    --params-file no.yaml --ros-args --params-file c.yaml";
        let found = parse(line);
        assert_eq!(found.parameter_files, ["a.yaml", "b.yaml", "c.yaml"].map(PathBuf::from));
        assert_eq!(found.source(), "a.yaml, b.yaml, c.yaml");
        assert_eq!(parse("node").source(), "command line");
    }

    #[test]
    fn the_name_and_namespace_follow_the_remappings() {
        assert_eq!(parse("node").full_name("deformation"), "/deformation");
        let remapped = parse("node --ros-args -r __ns:=/left --remap deformation:__node:=model");
        assert_eq!(remapped.full_name("deformation"), "/left/model");
        assert_eq!(remapped.full_name("visualization"), "/left/visualization");
    }

    #[test]
    fn a_topic_in_the_graph_has_its_namespace_and_the_first_remapping_that_fits() {
        let plain = parse("node");
        assert_eq!(plain.topic_in_graph("servo_cf", "/driver"), "/servo_cf");
        assert_eq!(plain.topic_in_graph("body/servo_cf", "/left/driver"), "/left/body/servo_cf");
        assert_eq!(plain.topic_in_graph("~/event", "/left/driver"), "/left/driver/event");
        let remapped = parse(
            "node --ros-args -r __ns:=/left -r other:servo_cf:=/no -r driver:servo_cf:=master/servo_cf \
             -r servo_cf:=/late -r /left/body/servo_cf:=/tip",
        );
        assert_eq!(remapped.topic_in_graph("servo_cf", "/left/driver"), "/left/master/servo_cf");
        assert_eq!(remapped.topic_in_graph("body/servo_cf", "/left/driver"), "/tip");
        assert_eq!(remapped.topic_in_graph("contact_law", "/left/driver"), "/left/contact_law");
    }

    #[test]
    fn a_level_for_the_logger_wins_over_the_general_one() {
        let found = parse("node --ros-args --log-level warn --log-level left.deformation:=debug");
        assert_eq!(found.severity_of("left.deformation"), Severity::Debug);
        assert_eq!(found.severity_of("deformation"), Severity::Warn);
        assert_eq!(parse("node").severity_of("deformation"), Severity::Info);
    }
}
