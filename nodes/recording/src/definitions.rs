//! Message definitions from an installed ROS 2: plain files, no ROS code.
//!
//! A recording carries the text of every type in it, and a hash, so that it can be read where the type is not known.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The text and the hash of a message type.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct MessageDefinition {
    /// `ros2msg`, or `ros2idl` in recordings of others. Empty without a text.
    pub encoding: String,
    /// The `.msg` file and, behind lines of 80 `=`, the `.msg` files of all types in it.
    pub text: String,
    /// `RIHS01_...`, which changes with every change of the type. Empty: not known.
    pub type_hash: String,
}

/// Why a type has no definition.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DefinitionError {
    /// The name is none of a message type.
    #[error("{0:?} is not the name of a message type; accepted: package/msg/Type")]
    Name(String),
    /// No prefix has the file.
    #[error("share/{package}/msg/{name}.msg is in none of the prefixes of AMENT_PREFIX_PATH: {prefixes}")]
    NotFound {
        /// Package of the type.
        package: String,
        /// Type without its package.
        name: String,
        /// What was searched.
        prefixes: String,
    },
}

/// Finds `share/PACKAGE/msg/TYPE.msg` and its hash in `TYPE.json` under a list of prefixes, first hit wins.
#[derive(Debug, Clone)]
pub struct MessageDefinitions {
    prefixes: Vec<PathBuf>,
}

impl MessageDefinitions {
    /// With the prefixes of `AMENT_PREFIX_PATH`.
    pub fn from_environment() -> Self {
        let variable = std::env::var_os("AMENT_PREFIX_PATH").unwrap_or_default();
        Self::new(std::env::split_paths(&variable).filter(|path| !path.as_os_str().is_empty()).collect())
    }

    /// With the given prefixes.
    pub fn new(prefixes: Vec<PathBuf>) -> Self {
        Self { prefixes }
    }

    /// The definition of a type such as `geometry_msgs/msg/PoseStamped`, with those of all types in it.
    ///
    /// # Errors
    /// When the type or one in it has no `.msg` file. A missing hash is no error: ROS 2 before Iron has none.
    pub fn get(&self, type_name: &str) -> Result<MessageDefinition, DefinitionError> {
        let root = TypeName::parse(type_name, "")?;
        let mut text = String::new();
        self.append(&root, &mut text, &mut BTreeSet::from([root.clone()]))?;
        let type_hash =
            self.find(&root, "json").and_then(|path| hash_in(&path, type_name)).unwrap_or_default();
        Ok(MessageDefinition { encoding: "ros2msg".to_owned(), text, type_hash })
    }

    /// Appends the text of one type and of those it needs that are not in `seen`.
    fn append(
        &self,
        name: &TypeName,
        text: &mut String,
        seen: &mut BTreeSet<TypeName>,
    ) -> Result<(), DefinitionError> {
        let own = self.find(name, "msg").and_then(|path| std::fs::read_to_string(path).ok());
        let own = own.ok_or_else(|| self.not_found(name))?;
        text.push_str(&own);
        for needed in types_in(&own, &name.package)? {
            if seen.insert(needed.clone()) {
                let line = "=".repeat(80);
                text.push_str(&format!("\n{line}\nMSG: {}/{}\n", needed.package, needed.name));
                self.append(&needed, text, seen)?;
            }
        }
        Ok(())
    }

    fn find(&self, name: &TypeName, extension: &str) -> Option<PathBuf> {
        let relative = format!("share/{}/msg/{}.{extension}", name.package, name.name);
        self.prefixes.iter().map(|prefix| prefix.join(&relative)).find(|path| path.is_file())
    }

    fn not_found(&self, name: &TypeName) -> DefinitionError {
        let prefixes: Vec<_> = self.prefixes.iter().map(|prefix| prefix.display().to_string()).collect();
        DefinitionError::NotFound {
            package: name.package.clone(),
            name: name.name.clone(),
            prefixes: prefixes.join(":"),
        }
    }
}

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct TypeName {
    package: String,
    name: String,
}

impl TypeName {
    /// `package/msg/Type`, `package/Type`, or `Type` in `home`. Nothing else gets near a path.
    fn parse(text: &str, home: &str) -> Result<Self, DefinitionError> {
        let parts: Vec<_> = text.split('/').collect();
        let (package, name) = match parts[..] {
            [name] => (home, name),
            [package, name] | [package, "msg", name] => (package, name),
            _ => return Err(DefinitionError::Name(text.to_owned())),
        };
        let identifier = |part: &str| {
            !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
        };
        if identifier(package) && identifier(name) {
            Ok(Self { package: package.to_owned(), name: name.to_owned() })
        } else {
            Err(DefinitionError::Name(text.to_owned()))
        }
    }
}

/// The types a `.msg` text uses, primitives apart.
fn types_in(text: &str, home: &str) -> Result<BTreeSet<TypeName>, DefinitionError> {
    const PRIMITIVES: [&str; 15] = [
        "bool", "byte", "char", "float32", "float64", "int8", "uint8", "int16", "uint16", "int32", "uint32",
        "int64", "uint64", "string", "wstring",
    ];
    text.lines()
        .filter_map(|line| line.split('#').next().unwrap_or_default().split_whitespace().next())
        .map(|word| word.split(['[', '<']).next().unwrap_or_default())
        .filter(|word| !PRIMITIVES.contains(word))
        .map(|word| TypeName::parse(word, home))
        .collect()
}

/// The hash of `type_name` in the JSON file that rosidl installs beside the `.msg`.
fn hash_in(path: &Path, type_name: &str) -> Option<String> {
    let json: serde_json::Value = serde_json::from_slice(&std::fs::read(path).ok()?).ok()?;
    let hashes = json.get("type_hashes")?.as_array()?;
    let own = hashes.iter().find(|entry| entry["type_name"] == type_name)?;
    own["hash_string"].as_str().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A prefix with two packages that need each other's types, comments, constants, bounds and arrays included.
    fn prefix() -> tempfile::TempDir {
        let prefix = tempfile::tempdir().unwrap();
        let file = |path: &str, text: &str| {
            let path = prefix.path().join("share").join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        };
        file(
            "a_msgs/msg/Outer.msg",
            "# Comment Type\nuint8 ONE = 1\nb_msgs/Inner[<=3] inner  # b_msgs/Ghost\nPoint p\n",
        );
        file(
            "a_msgs/msg/Outer.json",
            r#"{"type_hashes": [{"type_name": "a_msgs/msg/Outer", "hash_string": "RIHS01_0a"}]}"#,
        );
        file("a_msgs/msg/Point.msg", "float64[3] x\nstring<=5 name\n");
        file("b_msgs/msg/Inner.msg", "a_msgs/msg/Point point\n");
        file("b_msgs/msg/Broken.msg", "c_msgs/Missing m\n");
        prefix
    }

    #[test]
    fn a_definition_has_each_needed_type_once_behind_a_line_of_80() {
        let prefix = prefix();
        let found = MessageDefinitions::new(vec![prefix.path().to_owned()]).get("a_msgs/msg/Outer").unwrap();
        let line = "=".repeat(80);
        let parts: Vec<_> = found.text.split(&line).collect();
        assert_eq!(parts.len(), 3, "{}", found.text);
        assert!(parts[1].starts_with("\nMSG: a_msgs/Point\nfloat64[3] x"), "{}", parts[1]);
        assert!(parts[2].starts_with("\nMSG: b_msgs/Inner\n"), "{}", parts[2]);
        assert_eq!((found.encoding.as_str(), found.type_hash.as_str()), ("ros2msg", "RIHS01_0a"));
    }

    #[test]
    fn a_missing_type_is_named_with_the_places_that_were_searched() {
        let prefix = prefix();
        let definitions = MessageDefinitions::new(vec![prefix.path().to_owned()]);
        let error = definitions.get("b_msgs/msg/Broken").unwrap_err().to_string();
        assert!(error.contains("share/c_msgs/msg/Missing.msg"), "{error}");
        assert!(error.contains(&prefix.path().display().to_string()), "{error}");
    }

    #[test]
    fn a_type_name_cannot_leave_the_share_directory() {
        let definitions = MessageDefinitions::new(vec![PathBuf::from("/")]);
        for name in ["../../etc/passwd", "a/msg/../b", "", "a_msgs/srv/Call", "a//b"] {
            assert!(matches!(definitions.get(name), Err(DefinitionError::Name(_))), "{name}");
        }
    }
}
