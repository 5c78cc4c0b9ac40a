//! A device that is not there, led by a pointer: the hand of the simulated device, which means to be where somebody points,
//! for instance with the mouse on the viewer's page. It feels the force like any hand.

mod lead;
mod targets;

pub use targets::{NotATarget, Target, TargetSender, Targets};

use glam::DVec3;

use crate::hand::{Aim, HandSettings, HeldHandle, LIMITS};
use crate::{Description, Device, DeviceError, DeviceState, Wrench};
use lead::Lead;
use targets::Validity;

/// What a device led by a pointer is made from.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The mechanics of hand and handle.
    pub hand: HandSettings,
    /// Where the handle is first, device frame, m; outside the workspace it is the nearest place inside.
    pub start: DVec3,
    /// The hand means to move no faster, m/s, > 0 (`pointer.max_speed`).
    pub max_speed_m_per_s: f64,
    /// Time between two commands, s: the motor loop's period.
    pub period_s: f64,
    /// Where to.
    pub targets: Targets,
}

/// A handle led by a pointer. Its clock is the number of commands, as that of the simulated device: a target is valid for a
/// number of periods. Without a valid one the hand lets go of the place where it was: only its damper is left, so that
/// whatever is pressed pushes the handle out. With the next one it sets off from where the handle then is. A target lies in
/// the workspace: a place outside is none ([`NotATarget`]).
#[derive(Debug)]
pub struct PointerDevice {
    description: Description,
    handle: HeldHandle,
    lead: Lead,
    targets: Targets,
    validity: Validity,
    /// Where the hand means to be, device frame, m; none: it has let go.
    aim: Option<DVec3>,
}

impl PointerDevice {
    /// A handle at rest, and a hand that nobody leads yet.
    ///
    /// # Errors
    /// [`DeviceError::Setting`] names the parameter that is unusable.
    pub fn open(settings: Settings) -> Result<PointerDevice, DeviceError> {
        let Settings { hand, start, max_speed_m_per_s, period_s, mut targets } = settings;
        // Meant for a device that was open before.
        let _ = targets.news();
        let start = LIMITS.workspace.nearest(start);
        Ok(PointerDevice {
            description: HeldHandle::description("pointer", "hand led by a pointer"),
            handle: HeldHandle::new(hand, period_s, start)?,
            lead: Lead::new(max_speed_m_per_s, period_s)?,
            targets,
            validity: Validity::new(period_s),
            aim: None,
        })
    }

    /// Whether somebody leads the hand. RT safe.
    pub fn is_led(&self) -> bool {
        self.aim.is_some()
    }
}

impl Device for PointerDevice {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        Ok(self.handle.state())
    }

    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        let Some(target) = self.validity.period(self.targets.news()) else {
            self.aim = None;
            self.handle.coast(wrench);
            return Ok(());
        };
        let from = self.aim.unwrap_or_else(|| self.handle.position());
        let velocity_m_per_s = self.lead.velocity_m_per_s(from, target);
        self.handle
            .advance(wrench, |since_s| Aim { position: from + since_s * velocity_m_per_s, velocity_m_per_s });
        self.aim = Some(self.lead.after_a_period(from, velocity_m_per_s));
        Ok(())
    }

    fn enable(&mut self) -> Result<(), DeviceError> {
        self.handle.feel(true);
        Ok(())
    }

    fn disable(&mut self) -> Result<(), DeviceError> {
        self.handle.feel(false);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HAND: HandSettings =
        HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 20.0 };
    const START: DVec3 = DVec3::new(0.0, 0.0, 0.05);

    fn settings() -> Settings {
        let targets = Targets::new();
        Settings { hand: HAND, start: START, max_speed_m_per_s: 0.5, period_s: 1e-3, targets }
    }

    fn device() -> (PointerDevice, TargetSender) {
        let settings = settings();
        let sender = settings.targets.sender();
        let mut device = PointerDevice::open(settings).unwrap();
        device.enable().unwrap();
        (device, sender)
    }

    fn target(x: f64, y: f64, z: f64) -> Target {
        Target::new(DVec3::new(x, y, z), 0.3).unwrap()
    }

    /// The force of a wall z < 0.
    fn wall(state: &DeviceState, stiffness_n_per_m: f64) -> Wrench {
        Wrench::of_force(DVec3::Z * (-stiffness_n_per_m * state.pose.translation.z).max(0.0))
    }

    #[test]
    fn nobody_leads_so_nothing_moves_until_something_pushes() {
        let (mut device, _sender) = device();
        for _ in 0..1000 {
            device.command(&Wrench::ZERO).unwrap();
        }
        assert_eq!(device.read().unwrap().pose.translation, START);
        assert!(!device.is_led());
        for _ in 0..1000 {
            device.command(&Wrench::of_force(DVec3::X)).unwrap();
        }
        let pushed = device.read().unwrap();
        assert!((pushed.linear_velocity_m_per_s - DVec3::X / 20.0).length() < 1e-9, "1 N against its damper");
    }

    #[test]
    fn the_first_target_moves_the_hand_without_a_jump_and_no_faster_than_the_largest_speed() {
        let (mut device, mut sender) = device();
        sender.send(target(0.1, 0.0, 0.05));
        let (mut before, mut fastest) = (device.read().unwrap(), 0.0f64);
        for tick in 0..250 {
            device.command(&Wrench::ZERO).unwrap();
            let state = device.read().unwrap();
            let moved_m = state.pose.translation.distance(before.pose.translation);
            // 0.5 m/s for 1 ms, and the overshoot of the hand's spring.
            assert!(moved_m < 0.6e-3, "{moved_m} m in tick {tick}");
            fastest = fastest.max(state.linear_velocity_m_per_s.length());
            before = state;
        }
        assert!(fastest > 0.45, "it does hurry: {fastest} m/s");
    }

    #[test]
    fn a_hand_that_meets_no_force_gets_where_the_pointer_is() {
        let (mut device, mut sender) = device();
        for _ in 0..10 {
            sender.send(target(0.02, -0.03, 0.01));
            for _ in 0..100 {
                device.command(&Wrench::ZERO).unwrap();
            }
        }
        let state = device.read().unwrap();
        assert!(state.pose.translation.distance(DVec3::new(0.02, -0.03, 0.01)) < 1e-6);
        assert_eq!(state.pose.rotation, glam::DQuat::IDENTITY);
    }

    #[test]
    fn a_press_ends_where_hand_and_wall_balance_and_without_targets_the_wall_pushes_the_handle_out() {
        let (mut device, mut sender) = device();
        for _ in 0..15 {
            sender.send(target(0.0, 0.0, -0.008));
            for _ in 0..100 {
                let felt = wall(&device.read().unwrap(), 300.0);
                device.command(&felt).unwrap();
            }
        }
        // 500 N/m against 300 N/m: 5/8 of the intended depth.
        let pressed_m = -device.read().unwrap().pose.translation.z;
        assert!((pressed_m - 0.005).abs() < 1e-6, "{pressed_m}");
        for tick in 0..500 {
            // The last target was sent 100 periods ago and is valid for 300.
            assert_eq!(device.is_led(), tick <= 200, "tick {tick}");
            let felt = wall(&device.read().unwrap(), 300.0);
            device.command(&felt).unwrap();
        }
        // 300 N/m against 20 N s/m: 5 mm fall to a hundredth in 0.3 s.
        let state = device.read().unwrap();
        assert!(-state.pose.translation.z < 1e-4, "{}", state.pose.translation);
    }

    #[test]
    fn a_target_after_a_pause_leads_from_where_the_handle_is_then() {
        let (mut device, mut sender) = device();
        sender.send(target(0.0, 0.0, 0.0));
        for _ in 0..400 {
            device.command(&Wrench::ZERO).unwrap();
        }
        assert!(!device.is_led());
        for _ in 0..300 {
            device.command(&Wrench::of_force(DVec3::X)).unwrap();
        }
        let pushed = device.read().unwrap().pose.translation;
        assert!(pushed.x > 0.01);
        sender.send(target(0.0, 0.0, 0.0));
        device.command(&Wrench::ZERO).unwrap();
        assert!(device.read().unwrap().pose.translation.distance(pushed) < 0.1e-3);
    }

    #[test]
    fn a_hand_that_is_pointed_out_of_the_workspace_goes_nowhere_and_one_at_its_edge_stays_inside() {
        let (mut device, mut sender) = device();
        for far in [DVec3::new(0.3, 0.0, 0.05), DVec3::new(0.0, 0.0, -1e300)] {
            // As whoever hears targets does: what is none is not sent.
            let sent = Target::new(far, 0.3).map(|target| sender.send(target));
            assert!(sent.is_err());
            for _ in 0..500 {
                device.command(&Wrench::ZERO).unwrap();
            }
            assert_eq!(device.read().unwrap().pose.translation, START);
        }
        let edge = DVec3::new(0.18, 0.0, 0.0);
        for _ in 0..20 {
            sender.send(Target::new(edge, 0.3).unwrap());
            for _ in 0..100 {
                device.command(&Wrench::ZERO).unwrap();
                assert!(LIMITS.workspace.contains(device.read().unwrap().pose.translation * (1.0 - 1e-12)));
            }
        }
        assert!(device.read().unwrap().pose.translation.distance(edge) < 1e-6);
    }

    #[test]
    fn the_same_targets_and_forces_give_the_same_motion_bit_for_bit() {
        let run = || {
            let (mut device, mut sender) = device();
            let mut states = Vec::new();
            for tick in 0..3000u32 {
                if tick % 16 == 0 && tick < 2000 {
                    sender.send(target(0.01 * f64::from(tick % 5), 0.0, -0.005));
                }
                let state = device.read().unwrap();
                device.command(&wall(&state, 250.0)).unwrap();
                states.push(state);
            }
            states
        };
        assert_eq!(run(), run());
    }

    #[test]
    fn opening_again_hears_the_targets_that_come_from_then_on() {
        let settings = settings();
        let mut sender = settings.targets.sender();
        let backend = crate::Backend::Pointer(settings);
        for _ in 0..2 {
            let mut device = backend.open().unwrap();
            device.command(&Wrench::ZERO).unwrap();
            assert_eq!(
                device.read().unwrap().pose.translation,
                START,
                "an earlier device's target is not this one's"
            );
            sender.send(target(0.1, 0.0, 0.0));
            for _ in 0..100 {
                device.command(&Wrench::ZERO).unwrap();
            }
            assert!(device.read().unwrap().pose.translation.x > 0.01);
        }
    }

    #[test]
    fn settings_that_are_unusable_are_refused_by_their_parameter_name() {
        for (settings, name) in [
            (Settings { max_speed_m_per_s: 0.0, ..settings() }, "pointer.max_speed"),
            (Settings { max_speed_m_per_s: f64::NAN, ..settings() }, "pointer.max_speed"),
            (Settings { hand: HandSettings { mass_kg: -1.0, ..HAND }, ..settings() }, "simulated.mass"),
        ] {
            let text = PointerDevice::open(settings).unwrap_err().to_string();
            assert!(text.contains(name), "{text}");
        }
    }
}
