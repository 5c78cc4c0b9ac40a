//! Which force the motors get: the newest contact law evaluated here, the newest commanded force, or none.

use std::str::FromStr;
use std::sync::Arc;

use glam::DVec3;
use rhombus_chain::{ContactLaw, LocalLaw, Mode};

use crate::latest::Receiver;

/// A commanded force older than this is not used. The limit that drivers of surgical robots keep.
const SERVO_VALIDITY_NS: u64 = 20_000_000;

/// No contact law is used longer than this after its pose, whatever validity it claims.
const LONGEST_LAW_VALIDITY_NS: i64 = 200_000_000;

/// Who decides on the force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ForceSource {
    /// The motor loop, by the newest contact law; without a valid one the newest commanded force.
    #[default]
    ContactLaw,
    /// The newest commanded force only.
    ServoForce,
}

impl FromStr for ForceSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "contact_law" => Ok(ForceSource::ContactLaw),
            "servo_cf" => Ok(ForceSource::ServoForce),
            _ => Err(format!("force source \"{text}\": accepted are \"contact_law\" and \"servo_cf\"")),
        }
    }
}

/// A contact law for the motor loop, in the device frame.
#[derive(Clone, Debug)]
pub struct LawCommand {
    /// Stamp of the sample that the law was computed from, as this loop gave it.
    pub stamp_ns: i64,
    /// How long after that stamp the law may be used.
    pub validity_ns: i64,
    /// Where and how the body is touched.
    pub local: LocalLaw,
    /// The chains. Shared, because they change far less often than the place.
    pub chains: Arc<ContactLaw>,
}

/// A force for the motors, in the device frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoCommand {
    /// When it arrived, by [`monotonic_ns`](crate::monotonic_ns).
    pub received_ns: u64,
    /// The force on the hand.
    pub force_n: DVec3,
}

/// Where the force of a sample came from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ForceOrigin {
    /// Nobody: no valid command, hence no force.
    #[default]
    Nobody,
    /// The contact law, evaluated in the motor loop.
    ContactLaw,
    /// A commanded force.
    ServoForce,
}

/// The force of one period, not yet checked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Choice {
    /// It may be not finite and of any size.
    pub(crate) force_n: DVec3,
    /// Where it comes from.
    pub(crate) origin: ForceOrigin,
    /// How deep the probe is by the contact law, m; 0 without one or without contact.
    pub(crate) depth_m: f64,
}

/// A moment on both clocks of the motor loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Moment {
    /// By [`monotonic_ns`](crate::monotonic_ns).
    pub(crate) monotonic_ns: u64,
    /// By the stamp clock.
    pub(crate) stamp_ns: i64,
}

/// The reading ends of both command slots.
pub(crate) struct Commands {
    /// Who decides.
    pub(crate) source: ForceSource,
    /// Contact laws, newest wins.
    pub(crate) laws: Receiver<LawCommand>,
    /// Commanded forces, newest wins.
    pub(crate) servo: Receiver<ServoCommand>,
}

impl Commands {
    /// The force for a probe at `probe` now. The caller checks it. RT safe.
    pub(crate) fn choose(&mut self, probe: DVec3, now: Moment) -> Choice {
        if self.source == ForceSource::ContactLaw
            && let Some(command) = self.laws.newest()
            && is_valid(command, now.stamp_ns)
        {
            let LawCommand { local, chains, .. } = command;
            let depth_m = local.depth_m(probe);
            return Choice {
                force_n: local.force_n(chains, probe),
                origin: ForceOrigin::ContactLaw,
                // Negative depth is a pull in a grasp, and no contact otherwise.
                depth_m: if local.mode == Mode::Contact { depth_m.max(0.0) } else { depth_m },
            };
        }
        match self.servo.newest() {
            Some(command) if now.monotonic_ns.saturating_sub(command.received_ns) <= SERVO_VALIDITY_NS => {
                Choice { force_n: command.force_n, origin: ForceOrigin::ServoForce, depth_m: 0.0 }
            }
            _ => Choice::default(),
        }
    }
}

/// A law with a stamp from the future is not one of this loop's and is not valid either.
fn is_valid(command: &LawCommand, now_ns: i64) -> bool {
    let age_ns = now_ns.saturating_sub(command.stamp_ns);
    (0..=command.validity_ns.min(LONGEST_LAW_VALIDITY_NS)).contains(&age_ns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latest::{Sender, latest};
    use rhombus_chain::{ChainParameters, Formulation};

    const MS: u64 = 1_000_000;
    const STAMP_0: i64 = 1_700_000_000_000_000_000;

    fn at_ms(ms: u64) -> Moment {
        Moment { monotonic_ns: ms * MS, stamp_ns: STAMP_0 + (ms * MS) as i64 }
    }

    fn commands(source: ForceSource) -> (Commands, Sender<LawCommand>, Sender<ServoCommand>) {
        let ((law_sender, laws), (servo_sender, servo)) = (latest(), latest());
        (Commands { source, laws, servo }, law_sender, servo_sender)
    }

    fn chains() -> Arc<ContactLaw> {
        let one = ChainParameters {
            rod_length_m: 0.01,
            angle_rad: 0.6,
            ratio: 0.8,
            units: 10,
            normal_stiffness_n_per_m: 500.0,
            tangential_stiffness_n_per_m: 100.0,
            tangential_growth: 10.0,
            weight: 1.0,
            pitch_m: 0.016,
        };
        Arc::new(ContactLaw::new(Formulation::Energy, &[one]).unwrap())
    }

    /// Force and its origin.
    fn choice(commands: &mut Commands, probe: DVec3, now: Moment) -> (DVec3, ForceOrigin) {
        let choice = commands.choose(probe, now);
        (choice.force_n, choice.origin)
    }

    /// A floor z < 0 touched by a probe of 5 mm, from the sample at 100 ms, valid for 100 ms.
    fn law() -> LawCommand {
        LawCommand {
            stamp_ns: at_ms(100).stamp_ns,
            validity_ns: 100 * MS as i64,
            local: LocalLaw {
                mode: Mode::Contact,
                anchor: DVec3::ZERO,
                normal: DVec3::Z,
                probe_radius_m: 0.005,
                depth_offset_m: 0.0,
                stiffness_factor: 1.0,
                ..LocalLaw::default()
            },
            chains: chains(),
        }
    }

    #[test]
    fn nobody_answering_is_no_force() {
        let (mut commands, _laws, _servo) = commands(ForceSource::ContactLaw);
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(1)), (DVec3::ZERO, ForceOrigin::Nobody));
    }

    #[test]
    fn the_law_answers_the_position_of_this_period_not_that_of_its_message() {
        let (mut commands, mut laws, _servo) = commands(ForceSource::ContactLaw);
        laws.send(law());
        for depth_m in [0.001, 0.003] {
            let choice = commands.choose(DVec3::Z * (0.005 - depth_m), at_ms(101));
            let expected = chains().at_depth(depth_m).unwrap().force_n;
            assert!((choice.force_n - DVec3::Z * expected).length() < 1e-12 && expected > 0.0);
            assert!((choice.depth_m - depth_m).abs() < 1e-15);
            assert_eq!(choice.origin, ForceOrigin::ContactLaw);
        }
    }

    #[test]
    fn a_law_past_its_validity_is_not_used_nor_one_from_the_future() {
        let (mut commands, mut laws, _servo) = commands(ForceSource::ContactLaw);
        laws.send(law());
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(200)).1, ForceOrigin::ContactLaw);
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(201)), (DVec3::ZERO, ForceOrigin::Nobody));
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(99)), (DVec3::ZERO, ForceOrigin::Nobody));
    }

    #[test]
    fn no_law_lives_for_ever_however_long_it_claims_to_be_valid() {
        let (mut commands, mut laws, _servo) = commands(ForceSource::ContactLaw);
        laws.send(LawCommand { validity_ns: i64::MAX, ..law() });
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(300)).1, ForceOrigin::ContactLaw);
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(301)), (DVec3::ZERO, ForceOrigin::Nobody));
    }

    #[test]
    fn a_commanded_force_steps_in_without_a_valid_law_and_for_twenty_milliseconds() {
        let (mut commands, mut laws, mut servo) = commands(ForceSource::ContactLaw);
        laws.send(law());
        servo.send(ServoCommand { received_ns: at_ms(195).monotonic_ns, force_n: DVec3::X });
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(200)).1, ForceOrigin::ContactLaw);
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(201)), (DVec3::X, ForceOrigin::ServoForce));
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(215)), (DVec3::X, ForceOrigin::ServoForce));
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(216)), (DVec3::ZERO, ForceOrigin::Nobody));
    }

    #[test]
    fn with_the_source_servo_cf_no_law_is_evaluated() {
        let (mut commands, mut laws, mut servo) = commands(ForceSource::ServoForce);
        laws.send(law());
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(101)), (DVec3::ZERO, ForceOrigin::Nobody));
        servo.send(ServoCommand { received_ns: at_ms(101).monotonic_ns, force_n: DVec3::X });
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(101)).1, ForceOrigin::ServoForce);
    }

    #[test]
    fn a_law_without_contact_is_an_answer_of_no_force() {
        let (mut commands, mut laws, mut servo) = commands(ForceSource::ContactLaw);
        servo.send(ServoCommand { received_ns: at_ms(100).monotonic_ns, force_n: DVec3::X });
        let local = LocalLaw { mode: Mode::None, ..law().local };
        laws.send(LawCommand { local, ..law() });
        assert_eq!(choice(&mut commands, DVec3::ZERO, at_ms(101)), (DVec3::ZERO, ForceOrigin::ContactLaw));
    }

    #[test]
    fn a_source_is_named_as_its_topic() {
        assert_eq!("contact_law".parse(), Ok(ForceSource::ContactLaw));
        assert_eq!("servo_cf".parse(), Ok(ForceSource::ServoForce));
        assert!("servo".parse::<ForceSource>().unwrap_err().contains("servo_cf"));
    }
}
