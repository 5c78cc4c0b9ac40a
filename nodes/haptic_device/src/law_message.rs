//! From a contact-law message to what the motor loop evaluates: checked here, so that the loop need not.

use std::sync::Arc;

use devices::LawCommand;
use node_kit::convert;
use r2r::rhombus_haptics_msgs::msg::ContactLaw as LawMessage;
use rhombus_chain::{
    ChainParameters, ContactLaw, Formulation, LocalLaw, Mode, ParameterError, frame_of_message,
};
use thiserror::Error;

/// The normal's length may differ from 1 by this.
const NORMAL_TOLERANCE: f64 = 1e-3;

// r2r gives the constants of a message the type of C.
const NONE: u8 = LawMessage::NONE as u8;
const CONTACT: u8 = LawMessage::CONTACT as u8;
const GRASP: u8 = LawMessage::GRASP as u8;
const PUBLISHED: u8 = LawMessage::PUBLISHED as u8;
const ENERGY: u8 = LawMessage::ENERGY as u8;

/// More chains than any tissue was calibrated with; 64 take the motor loop some 10 us.
const MOST_CHAINS: usize = 64;

/// Why a message is no contact law for this device.
#[derive(Debug, Error)]
pub(crate) enum LawRefusal {
    #[error("frame_id is \"{found}\"; this device's laws are in \"{expected}\"")]
    Frame { found: String, expected: String },
    #[error("mode {0}; accepted are NONE = 0, CONTACT = 1, GRASP = 2")]
    Mode(u8),
    #[error("formulation {0}; accepted are PUBLISHED = 0 and ENERGY = 1")]
    Formulation(u8),
    #[error("{0} is not finite")]
    NotFinite(&'static str),
    #[error("the normal has length {0}; accepted is 1 within {NORMAL_TOLERANCE}")]
    Normal(f64),
    #[error("{name} is {value}; accepted is a number >= 0")]
    Negative { name: &'static str, value: f64 },
    #[error("the chain arrays differ in length: {0:?}; accepted is one entry for each chain in each")]
    Lengths([usize; 7]),
    #[error(
        "{0} chains; accepted are at most {MOST_CHAINS}, because the motor loop adds them up in every period"
    )]
    TooMany(usize),
    #[error(transparent)]
    Chains(#[from] ParameterError),
}

/// Reads laws in one frame. Keeps the chains of the last message: they arrive with every law and rarely change.
pub(crate) struct LawReader {
    frame_id: String,
    last: Option<(Formulation, Vec<ChainParameters>, Arc<ContactLaw>)>,
}

impl LawReader {
    pub(crate) fn new(frame_id: String) -> LawReader {
        LawReader { frame_id, last: None }
    }

    /// The message as a command for the motor loop.
    pub(crate) fn read(&mut self, message: &LawMessage) -> Result<LawCommand, LawRefusal> {
        let found = frame_of_message(&message.header.frame_id);
        if found != self.frame_id {
            return Err(LawRefusal::Frame { found: found.to_owned(), expected: self.frame_id.clone() });
        }
        let validity = &message.validity;
        Ok(LawCommand {
            stamp_ns: convert::stamp_ns(&message.header.stamp),
            validity_ns: i64::from(validity.sec) * 1_000_000_000 + i64::from(validity.nanosec),
            local: local_law(message)?,
            chains: self.chains(message)?,
        })
    }

    fn chains(&mut self, message: &LawMessage) -> Result<Arc<ContactLaw>, LawRefusal> {
        let formulation = match message.formulation {
            PUBLISHED => Formulation::Published,
            ENERGY => Formulation::Energy,
            other => return Err(LawRefusal::Formulation(other)),
        };
        if message.rod_length.len() > MOST_CHAINS {
            return Err(LawRefusal::TooMany(message.rod_length.len()));
        }
        let chains = chain_parameters(message)?;
        if let Some((last_formulation, last_chains, law)) = &self.last
            && *last_formulation == formulation
            && *last_chains == chains
        {
            return Ok(law.clone());
        }
        let law = Arc::new(ContactLaw::new(formulation, &chains)?);
        self.last = Some((formulation, chains, law.clone()));
        Ok(law)
    }
}

fn local_law(message: &LawMessage) -> Result<LocalLaw, LawRefusal> {
    let mode = match message.mode {
        NONE => return Ok(LocalLaw::default()),
        CONTACT => Mode::Contact,
        GRASP => Mode::Grasp,
        other => return Err(LawRefusal::Mode(other)),
    };
    let anchor = convert::dvec3(&message.anchor);
    let normal = convert::dvec3_of_vector(&message.normal);
    let stiffness_gradient_per_m = convert::dvec3_of_vector(&message.stiffness_gradient);
    for (name, finite) in [
        ("anchor", anchor.is_finite()),
        ("normal", normal.is_finite()),
        ("depth_offset", message.depth_offset.is_finite()),
        ("stiffness_gradient", stiffness_gradient_per_m.is_finite()),
    ] {
        if !finite {
            return Err(LawRefusal::NotFinite(name));
        }
    }
    let length = normal.length();
    let unit = normal.try_normalize().filter(|_| (length - 1.0).abs() <= NORMAL_TOLERANCE);
    let normal = unit.ok_or(LawRefusal::Normal(length))?;
    for (name, value) in [
        ("probe_radius", message.probe_radius),
        ("stiffness_factor", message.stiffness_factor),
        ("lateral_stiffness", message.lateral_stiffness),
    ] {
        if !(value.is_finite() && value >= 0.0) {
            return Err(LawRefusal::Negative { name, value });
        }
    }
    Ok(LocalLaw {
        mode,
        anchor,
        normal,
        probe_radius_m: message.probe_radius,
        depth_offset_m: message.depth_offset,
        stiffness_factor: message.stiffness_factor,
        stiffness_gradient_per_m,
        lateral_stiffness_n_per_m: message.lateral_stiffness,
    })
}

fn chain_parameters(message: &LawMessage) -> Result<Vec<ChainParameters>, LawRefusal> {
    let lengths = [
        message.rod_length.len(),
        message.angle.len(),
        message.ratio.len(),
        message.units.len(),
        message.normal_stiffness.len(),
        message.tangential_stiffness.len(),
        message.tangential_growth.len(),
    ];
    let count = lengths[0];
    if lengths.iter().any(|&length| length != count) {
        return Err(LawRefusal::Lengths(lengths));
    }
    Ok((0..count)
        .map(|p| ChainParameters {
            rod_length_m: message.rod_length[p],
            angle_rad: message.angle[p],
            ratio: message.ratio[p],
            units: message.units[p],
            normal_stiffness_n_per_m: message.normal_stiffness[p],
            tangential_stiffness_n_per_m: message.tangential_stiffness[p],
            tangential_growth: message.tangential_growth[p],
            // These two shape the surface and not the force.
            weight: 1.0 / count as f64,
            pitch_m: message.rod_length[p],
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use r2r::builtin_interfaces::msg::{Duration, Time};
    use r2r::geometry_msgs::msg::{Point, Vector3};
    use r2r::std_msgs::msg::Header;

    fn message() -> LawMessage {
        LawMessage {
            header: Header { stamp: Time { sec: 5, nanosec: 7 }, frame_id: "device_base".to_owned() },
            validity: Duration { sec: 0, nanosec: 100_000_000 },
            mode: CONTACT,
            anchor: Point { x: 0.0, y: 0.0, z: 0.01 },
            normal: Vector3 { x: 0.0, y: 0.0, z: 1.0 },
            probe_radius: 0.005,
            depth_offset: 0.0,
            stiffness_factor: 2.0,
            stiffness_gradient: Vector3 { x: 50.0, y: 0.0, z: 0.0 },
            lateral_stiffness: 0.0,
            formulation: ENERGY,
            rod_length: vec![0.01, 0.02],
            angle: vec![0.6, 0.7],
            ratio: vec![0.8, 0.9],
            units: vec![10, 20],
            normal_stiffness: vec![500.0, 300.0],
            tangential_stiffness: vec![100.0, 50.0],
            tangential_growth: vec![10.0, 8.0],
        }
    }

    fn reader() -> LawReader {
        LawReader::new("device_base".to_owned())
    }

    #[test]
    fn a_message_becomes_the_force_of_its_chains_at_its_plane() {
        let command = reader().read(&message()).unwrap();
        assert_eq!((command.stamp_ns, command.validity_ns), (5_000_000_007, 100_000_000));
        let force_n = command.local.force_n(&command.chains, DVec3::Z * 0.013);
        let pressed = command.chains.at_depth(0.002).unwrap();
        let expected = DVec3::new(-50.0 * pressed.energy_j, 0.0, 2.0 * pressed.force_n);
        assert!((force_n - expected).length() < 1e-12 && pressed.force_n > 0.0);
        // 10 mm towards the stiff side the factor is 2.5.
        let aside_n = command.local.force_n(&command.chains, DVec3::new(0.01, 0.0, 0.013)).z;
        assert!((aside_n - 2.5 * pressed.force_n).abs() < 1e-12);
    }

    #[test]
    fn the_same_chains_are_built_once_and_other_chains_anew() {
        let mut reader = reader();
        let first = reader.read(&message()).unwrap();
        let moved = LawMessage { anchor: Point { x: 1.0, y: 0.0, z: 0.0 }, ..message() };
        assert!(Arc::ptr_eq(&first.chains, &reader.read(&moved).unwrap().chains));
        let stiffer = LawMessage { normal_stiffness: vec![600.0, 300.0], ..message() };
        assert!(!Arc::ptr_eq(&first.chains, &reader.read(&stiffer).unwrap().chains));
    }

    #[test]
    fn without_contact_the_place_means_nothing_and_is_not_checked() {
        let nowhere = LawMessage { mode: NONE, normal: Vector3::default(), ..message() };
        assert_eq!(reader().read(&nowhere).unwrap().local.mode, Mode::None);
    }

    #[test]
    fn what_is_no_law_is_refused_with_the_field_and_its_value() {
        let nan = f64::NAN;
        let mut other_frame = message();
        other_frame.header.frame_id = "elsewhere".to_owned();
        for (wrong, text) in [
            (other_frame, "\"elsewhere\""),
            (LawMessage { mode: 9, ..message() }, "mode 9"),
            (LawMessage { formulation: 3, ..message() }, "formulation 3"),
            (LawMessage { anchor: Point { x: nan, y: 0.0, z: 0.0 }, ..message() }, "anchor"),
            (LawMessage { normal: Vector3 { x: 0.0, y: 0.0, z: 1.1 }, ..message() }, "length 1.1"),
            (LawMessage { normal: Vector3::default(), ..message() }, "length 0"),
            (LawMessage { depth_offset: f64::INFINITY, ..message() }, "depth_offset"),
            (
                LawMessage { stiffness_gradient: Vector3 { x: 0.0, y: nan, z: 0.0 }, ..message() },
                "stiffness_gradient",
            ),
            (LawMessage { stiffness_factor: -1.0, ..message() }, "stiffness_factor is -1"),
            (LawMessage { lateral_stiffness: nan, ..message() }, "lateral_stiffness is NaN"),
            (LawMessage { units: vec![10], ..message() }, "length"),
            (LawMessage { ratio: vec![0.8, 1.5], ..message() }, "ratio"),
        ] {
            let refusal = reader().read(&wrong).unwrap_err().to_string();
            assert!(refusal.contains(text), "{refusal}");
        }
    }
}
