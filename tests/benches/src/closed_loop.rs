//! How stiff a contact may be before hand, device and contact law together swing up: evaluated in the motor loop, or
//! commanded through topics.
//!
//! A simulated hand presses the probe into a flat floor and holds still. What is between position and force is the
//! driver's own force source and safety layer, period by period; only the transport differs. No clock and no thread: the
//! same numbers on every machine.

use std::collections::VecDeque;
use std::sync::Arc;

use anyhow::{Context, Result};
use devices::safety::{CheckedSettings, SafetyLayer, SafetySettings};
use devices::simulated::{Flaws, HandSettings, Phase, Script, Segment, Settings, SimulatedDevice};
use devices::source::{Axes, ForceSource, Inputs, LawCommand, Moment, ServoCommand, Source, SourceMode};
use devices::{Device, Wrench};
use glam::DVec3;
use rhombus_chain::{ContactLaw, LocalLaw, Mode};

/// How the contact's force reaches the motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transport {
    /// The contact law arrives `delay_s` after its pose, and the motor loop evaluates it where the probe is now.
    InTheLoop {
        /// From pose to law, s.
        delay_s: f64,
    },
    /// The force for a pose arrives `delay_s` after it, and is held until the next.
    Topics {
        /// From pose to force, s.
        delay_s: f64,
    },
}

/// What presses, how fast the loop is, and what is between.
#[derive(Clone, Debug)]
pub struct ClosedLoop {
    /// The contact law; stiffer contacts are multiples of it.
    pub law: Arc<ContactLaw>,
    /// Hand and handle together.
    pub hand: HandSettings,
    /// Motor loop, Hz.
    pub rate_hz: f64,
    /// Poses to the model, Hz.
    pub pose_rate_hz: f64,
    /// From position to motors.
    pub transport: Transport,
    /// Whether the passivity controller is on. The limit of the contact itself is that with it off.
    pub passivity: bool,
}

/// Where the floor's surface is touched by a probe with this radius, m.
const PROBE_RADIUS_M: f64 = 0.005;
/// The hand means to be so deep, m: it presses with its spring times what the contact leaves of that.
const INTENT_M: f64 = 0.01;
/// The engage gate and its ramp are over after this, s; then the hand goes down, and holds.
const ENGAGE_S: f64 = 2.2;
const PRESS_S: f64 = 0.5;
const HOLD_S: f64 = 4.0;
/// A hand that is still faster than this in the last second (root mean square) does not come to rest, m/s.
const RESTLESS_M_PER_S: f64 = 1e-3;
/// Stiffnesses are tried from here to there, each so many times the one before.
const SOFTEST_N_PER_M: f64 = 50.0;
const STIFFEST_N_PER_M: f64 = 200_000.0;
const STEP: f64 = 1.04;

impl ClosedLoop {
    /// The largest stiffness, N/m, up to which the hand comes to rest at every stiffness tried; none when it does at all of
    /// them. A contact's stiffness is the slope of its law where the hand rests.
    ///
    /// # Errors
    /// A hand or a law that is none, or a loop that is not even stable on the softest contact.
    pub fn largest_stable_n_per_m(&self) -> Result<Option<f64>> {
        let mut largest = None;
        let mut wanted = SOFTEST_N_PER_M;
        while wanted < STIFFEST_N_PER_M {
            if !self.comes_to_rest(self.factor(wanted)?)? {
                return Ok(Some(largest.context("the loop is not stable on the softest contact either")?));
            }
            largest = Some(wanted);
            wanted *= STEP;
        }
        Ok(None)
    }

    /// What the law has to be multiplied by to have the stiffness where the hand rests on it.
    fn factor(&self, stiffness_n_per_m: f64) -> Result<f64> {
        let (mut low, mut high) = (1e-6, 1e9);
        for _ in 0..200 {
            let middle = f64::sqrt(low * high);
            if self.stiffness_at_rest(middle)? < stiffness_n_per_m { low = middle } else { high = middle }
        }
        Ok(high)
    }

    /// Slope of the law times `factor` where its force balances the hand's spring.
    fn stiffness_at_rest(&self, factor: f64) -> Result<f64> {
        let (mut low, mut high) = (0.0, INTENT_M);
        for _ in 0..100 {
            let depth_m = 0.5 * (low + high);
            let contact_n = factor * self.law.at_depth(depth_m)?.force_n;
            let hand_n = self.hand.stiffness_n_per_m * (INTENT_M - depth_m);
            if contact_n < hand_n { low = depth_m } else { high = depth_m }
        }
        Ok(factor * self.law.at_depth(low)?.stiffness_n_per_m)
    }

    /// Whether a hand that presses on the law times `factor` is at rest in the end.
    fn comes_to_rest(&self, factor: f64) -> Result<bool> {
        let period_s = 1.0 / self.rate_hz;
        let mut device = SimulatedDevice::open(Settings {
            hand: self.hand,
            script: script()?,
            period_s,
            flaws: Flaws::default(),
        })?;
        device.enable()?;
        let settings = settings(self.passivity, self.rate_hz)?;
        let mut layer = SafetyLayer::new(&settings, &device.description().limits, period_s);
        let mut source = Source::new(ForceSource::ContactLaw, &settings);
        let floor = LocalLaw {
            mode: Mode::Contact,
            normal: DVec3::Z,
            probe_radius_m: PROBE_RADIUS_M,
            stiffness_factor: factor,
            ..LocalLaw::default()
        };
        let mut topics = Topics::new(self);
        let ticks = ((ENGAGE_S + PRESS_S + HOLD_S) * self.rate_hz).round() as u64;
        let watched = self.rate_hz.round() as u64;
        let mut squares = 0.0;
        for tick in 0..ticks {
            let state = device.read()?;
            let now_ns = 1_000_000_000 + (tick as f64 * period_s * 1e9).round() as u64;
            let now = Moment { monotonic_ns: now_ns, stamp_ns: now_ns as i64 };
            topics.carry(tick, now_ns, state.pose.translation, &floor);
            let wanted = source.want(&Inputs {
                state: &state,
                now,
                mode: SourceMode::Follow,
                permitted: true,
                law: topics.law.as_ref(),
                servo: topics.servo.as_ref(),
            });
            let applied = layer.step(&wanted, &state, true, now_ns);
            if applied.fault.is_some() {
                return Ok(false);
            }
            device.command(&applied.wrench)?;
            if tick + watched >= ticks {
                squares += state.linear_velocity_m_per_s.length_squared();
            }
        }
        // A hand at rest in the air is not at rest on the contact.
        Ok(!layer.is_zero() && (squares / watched as f64).sqrt() < RESTLESS_M_PER_S)
    }
}

/// What is on its way from the model to the motor loop.
struct Topics {
    chains: Arc<ContactLaw>,
    in_the_loop: bool,
    every: u64,
    delay: u64,
    /// What arrives in a period, by a pose of an earlier one.
    on_the_way: VecDeque<(u64, u64, DVec3)>,
    law: Option<LawCommand>,
    servo: Option<ServoCommand>,
}

impl Topics {
    fn new(setup: &ClosedLoop) -> Topics {
        let (in_the_loop, delay_s) = match setup.transport {
            Transport::InTheLoop { delay_s } => (true, delay_s),
            Transport::Topics { delay_s } => (false, delay_s),
        };
        Topics {
            chains: setup.law.clone(),
            in_the_loop,
            every: (setup.rate_hz / setup.pose_rate_hz).round().max(1.0) as u64,
            delay: (delay_s * setup.rate_hz).round() as u64,
            on_the_way: VecDeque::new(),
            law: None,
            servo: None,
        }
    }

    /// A pose leaves where it is time for one, and what is due arrives.
    fn carry(&mut self, tick: u64, now_ns: u64, probe: DVec3, floor: &LocalLaw) {
        if tick.is_multiple_of(self.every) {
            self.on_the_way.push_back((tick + self.delay, now_ns, probe));
        }
        while let Some(&(due, stamp_ns, probe)) = self.on_the_way.front()
            && due <= tick
        {
            self.on_the_way.pop_front();
            if self.in_the_loop {
                let (local, chains) = (*floor, self.chains.clone());
                let stamp_ns = stamp_ns as i64;
                self.law = Some(LawCommand { stamp_ns, validity_ns: 100_000_000, local, chains });
            } else {
                let wrench = Wrench::of_force(floor.force_n(&self.chains, probe));
                self.servo = Some(ServoCommand {
                    since_ns: now_ns,
                    gripper_until_ns: u64::MAX,
                    wrench,
                    axes: Axes::Base,
                });
            }
        }
    }
}

fn settings(passivity: bool, rate_hz: f64) -> Result<CheckedSettings> {
    let names = if passivity { vec![] } else { vec!["safety.passivity".to_owned()] };
    Ok(SafetySettings { passivity, servo_passivity: true, ..SafetySettings::default() }
        .checked(rate_hz, &names)?)
}

/// Above the floor until the force is engaged, then down to the intent, and there it stays.
fn script() -> Result<Script> {
    let above = DVec3::Z * (PROBE_RADIUS_M + 0.005);
    let segment = |phase, duration_s, path| Segment { phase, duration_s, path, gripper_rad: 0.5 };
    Ok(Script::new(vec![
        segment(Phase::Travel, ENGAGE_S, vec![above]),
        segment(Phase::Press, PRESS_S, vec![DVec3::Z * (PROBE_RADIUS_M - INTENT_M)]),
        segment(Phase::Hold, HOLD_S, vec![]),
        // The way back to where it began, which nobody sees.
        segment(Phase::Release, 1.0, vec![above]),
    ])?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rhombus_chain::{ChainParameters, Formulation};

    fn setup(transport: Transport, damping_n_s_per_m: f64) -> ClosedLoop {
        let chain = ChainParameters {
            rod_length_m: 0.01,
            angle_rad: 0.6,
            ratio: 0.8,
            units: 12,
            normal_stiffness_n_per_m: 500.0,
            tangential_stiffness_n_per_m: 100.0,
            tangential_growth: 10.0,
            weight: 1.0,
            pitch_m: 0.0165,
        };
        ClosedLoop {
            law: Arc::new(ContactLaw::new(Formulation::Energy, &[chain]).unwrap()),
            hand: HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m },
            rate_hz: 1000.0,
            pose_rate_hz: 1000.0,
            transport,
            passivity: false,
        }
    }

    #[test]
    fn the_law_in_the_loop_is_stable_to_five_times_the_stiffness_that_topics_reach_at_3_ms() {
        for damping in [2.0, 5.0, 10.0] {
            let topics = setup(Transport::Topics { delay_s: 0.003 }, damping);
            let in_the_loop = setup(Transport::InTheLoop { delay_s: 0.003 }, damping);
            let topics = topics.largest_stable_n_per_m().unwrap().unwrap();
            let in_the_loop = in_the_loop.largest_stable_n_per_m().unwrap().unwrap();
            println!("{damping} N s/m: {in_the_loop:.0} against {topics:.0} N/m");
            assert!(in_the_loop >= 5.0 * topics, "{damping}: {in_the_loop} against {topics}");
        }
    }

    #[test]
    fn topics_without_a_delay_reach_what_the_loop_reaches() {
        let topics = setup(Transport::Topics { delay_s: 0.0 }, 5.0).largest_stable_n_per_m().unwrap();
        let in_the_loop = setup(Transport::InTheLoop { delay_s: 0.0 }, 5.0).largest_stable_n_per_m().unwrap();
        assert_eq!(topics, in_the_loop);
    }

    #[test]
    fn the_limit_through_topics_is_that_of_the_delay() {
        // Damping over delay, the delay of a held force being half a period longer (Colgate and Schenkel 1997 for a
        // delay of half a period): K (3 ms + T/2) < b + what the hand's spring adds.
        let topics =
            setup(Transport::Topics { delay_s: 0.003 }, 5.0).largest_stable_n_per_m().unwrap().unwrap();
        let estimate = 5.0 / 0.0035;
        assert!((topics / estimate - 1.0).abs() < 0.25, "{topics} against about {estimate}");
    }
}
