//! A hand on a simulated device that presses into a virtual wall, with the safety layer between wall and motors.

#![allow(dead_code, reason = "each test uses its part")]
#![expect(clippy::unwrap_used, reason = "helpers of tests, outside the test functions")]

pub(crate) mod rig;

use std::collections::VecDeque;

use devices::safety::{CheckedSettings, SafetyLayer, SafetySettings};
use devices::simulated::{self, HandSettings, Phase, Script, Segment, SimulatedDevice};
use devices::source::{ForceOrigin, Wanted};
use devices::{Device, DeviceState, Wrench};
use glam::DVec3;

/// What is between the hand's position and the wall's force.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    pub(crate) stiffness_n_per_m: f64,
    pub(crate) delay_s: f64,
    pub(crate) period_s: f64,
    /// Standard deviation of the positions' noise, m.
    pub(crate) noise_m: f64,
    /// Step of the positions, m; 0: none.
    pub(crate) quantum_m: f64,
    pub(crate) hand: HandSettings,
    /// How fast the hand presses and lets go: once in so many s.
    pub(crate) cycle_s: f64,
    pub(crate) passivity: bool,
}

impl Default for Wall {
    fn default() -> Wall {
        Wall {
            stiffness_n_per_m: 5000.0,
            delay_s: 0.02,
            period_s: 1e-3,
            noise_m: 0.0,
            quantum_m: 0.0,
            hand: HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 5.0 },
            cycle_s: 2.0,
            passivity: true,
        }
    }
}

/// Time constant of the filter that a device makes velocities with, s.
const VELOCITY_FILTER_S: f64 = 2e-3;

/// What happened in one period.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Record {
    pub(crate) position: DVec3,
    pub(crate) velocity: DVec3,
    pub(crate) wanted_n: DVec3,
    pub(crate) applied_n: DVec3,
    /// True energy that the motors have given the hand until now, J.
    pub(crate) given_j: f64,
    /// What the layer believes.
    pub(crate) believed_j: f64,
    pub(crate) faulted: bool,
}

pub(crate) fn checked(passivity: bool) -> CheckedSettings {
    let names = if passivity { vec![] } else { vec!["safety.passivity".to_owned()] };
    SafetySettings { passivity, servo_passivity: true, ..SafetySettings::default() }
        .checked(1000.0, &names)
        .unwrap()
}

fn press(cycle_s: f64) -> Script {
    let segment =
        |phase, share: f64, path| Segment { phase, duration_s: share * cycle_s, path, gripper_rad: 0.5 };
    let up = DVec3::Z * 0.01;
    Script::new(vec![
        segment(Phase::Travel, 0.2, vec![up]),
        segment(Phase::Press, 0.2, vec![DVec3::Z * -0.02]),
        segment(Phase::Hold, 0.4, vec![]),
        segment(Phase::Release, 0.2, vec![up]),
    ])
    .unwrap()
}

impl Wall {
    /// `seconds` of pressing.
    pub(crate) fn run(&self, seconds: f64) -> Vec<Record> {
        let settings = simulated::Settings {
            hand: self.hand,
            script: press(self.cycle_s),
            period_s: self.period_s,
            flaws: simulated::Flaws::default(),
        };
        let mut device = SimulatedDevice::open(settings).unwrap();
        device.enable().unwrap();
        let limits = device.description().limits;
        let mut layer = SafetyLayer::new(&checked(self.passivity), &limits, self.period_s);
        let mut noise = Noise(0x9e37_79b9_7f4a_7c15);
        let mut late: VecDeque<DVec3> = VecDeque::new();
        let delay = (self.delay_s / self.period_s).round() as usize;
        let mut given_j = 0.0;
        let mut before: Option<(DVec3, DVec3)> = None;
        let mut records = Vec::new();
        let mut faulted = false;
        let mut filter = None;
        for tick in 0..(seconds / self.period_s).round() as u64 {
            let truth = device.read().unwrap();
            let position = truth.pose.translation;
            if let Some((force_n, from)) = before {
                given_j += force_n.dot(position - from);
            }
            let state = self.measured(&truth, &mut noise, &mut filter);
            late.push_back(self.force_n(state.pose.translation));
            let wanted_n = if late.len() > delay { late.pop_front().unwrap() } else { DVec3::ZERO };
            let wanted = Wanted {
                wrench: Wrench::of_force(wanted_n),
                origin: ForceOrigin::ServoForce,
                settled: true,
                ..Wanted::default()
            };
            let now_ns = (tick as f64 * self.period_s * 1e9).round() as u64;
            let applied = layer.step(&wanted, &state, !faulted, now_ns);
            faulted |= applied.fault.is_some();
            device.command(&applied.wrench).unwrap();
            before = Some((applied.wrench.force_n, position));
            records.push(Record {
                position,
                velocity: truth.linear_velocity_m_per_s,
                wanted_n,
                applied_n: applied.wrench.force_n,
                given_j,
                believed_j: layer.energy().given_j,
                faulted,
            });
        }
        records
    }

    /// A wall z < 0.
    fn force_n(&self, at: DVec3) -> DVec3 {
        DVec3::Z * (-self.stiffness_n_per_m * at.z).max(0.0)
    }

    /// What the device says: noise and steps in the position, and in the velocity that it makes of two positions.
    fn measured(
        &self,
        truth: &DeviceState,
        noise: &mut Noise,
        filter: &mut Option<(DVec3, DVec3)>,
    ) -> DeviceState {
        let step =
            |x: f64| if self.quantum_m > 0.0 { (x / self.quantum_m).round() * self.quantum_m } else { x };
        let mut state = *truth;
        let shifted =
            truth.pose.translation + DVec3::new(noise.next(), noise.next(), noise.next()) * self.noise_m;
        let position = DVec3::new(step(shifted.x), step(shifted.y), step(shifted.z));
        let (before, velocity) = filter.unwrap_or((position, DVec3::ZERO));
        let share = self.period_s / (self.period_s + VELOCITY_FILTER_S);
        let velocity = velocity + share * ((position - before) / self.period_s - velocity);
        *filter = Some((position, velocity));
        state.pose.translation = position;
        state.linear_velocity_m_per_s = velocity;
        state
    }
}

/// Normal deviates of variance 1 by the sum of twelve uniform ones; the same every time.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }

    fn uniform(&mut self) -> f64 {
        // Xorshift (Marsaglia 2003).
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}
