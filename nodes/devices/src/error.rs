//! What can go wrong with a device, in sentences that name the remedy.

use thiserror::Error;

/// What can go wrong with a device.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DeviceError {
    /// A setting that the backend cannot work with.
    #[error("{name} = {value}: accepted is {accepted}")]
    Setting {
        /// The setting, by its parameter name.
        name: &'static str,
        /// What it was.
        value: String,
        /// What it may be, with its unit.
        accepted: String,
    },
    /// No such device.
    #[error("no {device} device: {looked}; {remedy}")]
    NotFound {
        /// The backend.
        device: &'static str,
        /// What was looked for, and where.
        looked: String,
        /// What to do.
        remedy: String,
    },
    /// More than one, and none of them chosen.
    #[error("{} {device} devices and no choice: set device.serial to one of {}", found.len(), found.join(", "))]
    Ambiguous {
        /// The backend.
        device: &'static str,
        /// Their serial numbers.
        found: Vec<String>,
    },
    /// The operating system does not let this user at it.
    #[error("{what}: permission denied; {remedy}")]
    Permission {
        /// What was to be opened.
        what: String,
        /// What to do.
        remedy: String,
    },
    /// Another program has it.
    #[error("{what} is in use by another program; end that program, then try again")]
    Busy {
        /// What was to be opened.
        what: String,
    },
    /// A library of the maker is missing or unusable.
    #[error("{what}; {remedy}")]
    Library {
        /// What was looked for, where, and what was found.
        what: String,
        /// What to do.
        remedy: String,
    },
    /// It answers, but not what a device of its kind answers.
    #[error("the {device} device: {what}; {remedy}")]
    Protocol {
        /// The backend.
        device: &'static str,
        /// What it answered.
        what: String,
        /// What to do.
        remedy: String,
    },
    /// The device stopped answering.
    #[error("lost the {device} device: {reason}")]
    Lost {
        /// The backend.
        device: &'static str,
        /// What failed.
        reason: &'static str,
    },
    /// The device has no such thing.
    #[error("the {device} device has no {what}")]
    Unsupported {
        /// The backend.
        device: &'static str,
        /// What was asked for.
        what: &'static str,
    },
}
