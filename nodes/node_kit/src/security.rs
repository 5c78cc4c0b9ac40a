//! Whether the transport is authenticated. rcl takes only the exact word "true" for yes, so that "True" or "1" would
//! silently run an open session: such a value is refused.

use thiserror::Error;

/// What the environment asks of DDS security (SROS 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Transport {
    /// `ROS_SECURITY_ENABLE` is not set, empty or "false".
    Open,
    /// Enabled, but a node without keys would still start: `ROS_SECURITY_STRATEGY` is not "Enforce".
    Permissive,
    /// Enabled, and nothing starts without keys.
    Enforced,
}

/// A value of `ROS_SECURITY_ENABLE` that rcl would take for "false" without a word.
#[derive(Debug, Error, PartialEq, Eq)]
#[error("ROS_SECURITY_ENABLE is \"{value}\"; accepted: true, false, or not set")]
pub struct SecurityValueError {
    value: String,
}

impl Transport {
    /// Read the values of `ROS_SECURITY_ENABLE` and `ROS_SECURITY_STRATEGY`.
    pub(crate) fn from_values(
        enable: Option<&str>,
        strategy: Option<&str>,
    ) -> Result<Transport, SecurityValueError> {
        match (enable.unwrap_or(""), strategy) {
            ("" | "false", _) => Ok(Transport::Open),
            ("true", Some("Enforce")) => Ok(Transport::Enforced),
            ("true", _) => Ok(Transport::Permissive),
            (value, _) => Err(SecurityValueError { value: value.to_owned() }),
        }
    }

    /// Read the process environment.
    pub(crate) fn from_environment() -> Result<Transport, SecurityValueError> {
        let value = |name| std::env::var_os(name).map(|v| v.to_string_lossy().into_owned());
        Transport::from_values(
            value("ROS_SECURITY_ENABLE").as_deref(),
            value("ROS_SECURITY_STRATEGY").as_deref(),
        )
    }

    /// One sentence for the log at start.
    pub(crate) fn in_words(self) -> &'static str {
        match self {
            Transport::Open => "the transport is not authenticated (ROS_SECURITY_ENABLE is not true)",
            Transport::Permissive => {
                "the transport may fall back to not authenticated (ROS_SECURITY_STRATEGY is not Enforce)"
            }
            Transport::Enforced => "the transport is authenticated",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_true_false_and_nothing_are_accepted() {
        assert_eq!(Transport::from_values(None, None), Ok(Transport::Open));
        assert_eq!(Transport::from_values(Some(""), None), Ok(Transport::Open));
        assert_eq!(Transport::from_values(Some("false"), Some("Enforce")), Ok(Transport::Open));
        assert_eq!(Transport::from_values(Some("true"), Some("Enforce")), Ok(Transport::Enforced));
        assert_eq!(Transport::from_values(Some("true"), None), Ok(Transport::Permissive));
        for value in ["True", "1", "yes", "TRUE", " true"] {
            let error = Transport::from_values(Some(value), None).unwrap_err().to_string();
            assert!(error.contains(value) && error.contains("ROS_SECURITY_ENABLE"), "{error}");
        }
    }
}
