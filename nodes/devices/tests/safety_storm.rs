//! A storm of commands through source and safety layer: not finite, huge, stale, from the future, out of order, in the
//! handle's axes, with contact laws as broken as they, while modes change, readings are missing and periods are late.
//! What the motors get stays finite, within the clamps and within the slew limit, every time.

#![expect(clippy::unwrap_used, reason = "helpers of tests, outside the test functions")]

use std::sync::Arc;

use devices::safety::{SafetyLayer, SafetySettings};
use devices::source::{
    Axes, ForceOrigin, ForceSource, Inputs, LawCommand, Moment, ServoCommand, Source, SourceMode,
};
use devices::{DeviceLimits, DeviceState, RATES_HZ, Workspace, Wrench};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use rhombus_chain::{ChainParameters, ContactLaw, Formulation, LocalLaw, Mode, Pose};

const LIMITS: DeviceLimits = DeviceLimits {
    max_force_n: Some(12.0),
    max_torque_n_m: Some(0.3),
    max_gripper_force_n: Some(5.0),
    workspace: Workspace { centre: DVec3::ZERO, radius_m: 0.1, height_m: 0.2 },
};
const STAMP_0: i64 = 1_700_000_000_000_000_000;

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }
    fn one_in(&mut self, n: u64) -> bool {
        self.below(n) == 0
    }
    /// -1 to 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * size
    }
    /// Any bit pattern, the usual troublemakers first.
    fn trouble(&mut self) -> f64 {
        const USUAL: [f64; 10] = [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN,
            f64::MIN_POSITIVE,
            5e-324,
            -0.0,
            1e300,
            -1e160,
        ];
        if self.one_in(2) { USUAL[self.below(10) as usize] } else { f64::from_bits(self.next()) }
    }
    fn troubled_vector(&mut self) -> DVec3 {
        let mut one = || if self.one_in(2) { self.trouble() } else { self.unit() * 20.0 };
        DVec3::new(one(), one(), one())
    }
    fn wrench(&mut self) -> Wrench {
        match self.below(4) {
            0 => Wrench {
                force_n: self.troubled_vector(),
                torque_n_m: self.troubled_vector(),
                gripper_force_n: self.trouble(),
            },
            1 => Wrench::of_force(self.troubled_vector()),
            2 => Wrench { force_n: self.vector(1e12), torque_n_m: self.vector(1e9), gripper_force_n: 1e15 },
            _ => Wrench {
                force_n: self.vector(15.0),
                torque_n_m: self.vector(0.5),
                gripper_force_n: self.unit(),
            },
        }
    }
    fn servo(&mut self, now_ns: u64) -> ServoCommand {
        let since_ns = match self.below(8) {
            0 => self.next(),                                   // no time of this clock
            1 => now_ns.saturating_sub(self.below(1 << 40)),    // stale
            2 => now_ns.saturating_add(self.below(1 << 40)),    // from the future
            3 => now_ns.saturating_sub(self.below(60_000_000)), // out of order
            _ => now_ns,
        };
        let axes = if self.one_in(2) { Axes::Tip } else { Axes::Base };
        ServoCommand { since_ns, gripper_until_ns: u64::MAX, wrench: self.wrench(), axes }
    }
    fn law(&mut self, stamp_ns: i64, chains: &Arc<ContactLaw>) -> LawCommand {
        let broken = self.one_in(3);
        let normal = self.vector(1.0).try_normalize().unwrap_or(DVec3::Z);
        let mut number = |sound: f64| if broken && self.one_in(3) { self.trouble() } else { sound };
        let local = LocalLaw {
            mode: Mode::Contact,
            anchor: DVec3::new(number(0.0), number(0.0), number(0.02)),
            normal: DVec3::new(number(normal.x), number(normal.y), number(normal.z)),
            probe_radius_m: number(0.005),
            depth_offset_m: number(0.0),
            stiffness_factor: number(1.0),
            stiffness_gradient_per_m: DVec3::new(number(0.0), 0.0, 0.0),
            lateral_stiffness_n_per_m: number(100.0),
        };
        let mode = [Mode::None, Mode::Contact, Mode::Contact, Mode::Grasp][self.below(4) as usize];
        let stamp_ns = match self.below(6) {
            0 => self.next() as i64,
            1 => stamp_ns.saturating_sub(self.below(1 << 34) as i64),
            2 => stamp_ns.saturating_add(self.below(1 << 34) as i64),
            _ => stamp_ns,
        };
        let validity_ns = if self.one_in(4) { self.next() as i64 } else { 100_000_000 };
        LawCommand { stamp_ns, validity_ns, local: LocalLaw { mode, ..local }, chains: chains.clone() }
    }
}

fn chains() -> Arc<ContactLaw> {
    let one = ChainParameters {
        rod_length_m: 0.01,
        angle_rad: 0.6,
        ratio: 0.8,
        units: 10,
        normal_stiffness_n_per_m: 8000.0,
        tangential_stiffness_n_per_m: 1600.0,
        tangential_growth: 10.0,
        weight: 1.0,
        pitch_m: 0.016,
    };
    Arc::new(ContactLaw::new(Formulation::Energy, &[one]).unwrap())
}

#[derive(Debug, Default)]
struct Tally {
    commands: usize,
    pushed: usize,
    clamped: usize,
    origins: [usize; 4],
    largest_n: f64,
}

/// `ticks` periods of calm and storm in turn. Panics where something does not hold.
fn storm(seed: u64, ticks: usize, passivity: bool) -> Tally {
    let mut dice = Dice(seed);
    let names = if passivity { vec![] } else { vec!["safety.passivity".to_owned()] };
    let settings = SafetySettings { passivity, servo_passivity: true, ..SafetySettings::default() }
        .checked(*RATES_HZ.start(), &names)
        .unwrap();
    let rate_hz = [1000.0, 4000.0, 500.0, *RATES_HZ.start()][dice.below(4) as usize];
    let (period_s, period_ns) = (1.0 / rate_hz, (1e9 / rate_hz) as u64);
    let mut layer = SafetyLayer::new(&settings, &LIMITS, period_s);
    let mut source = Source::new(ForceSource::ContactLaw, &settings);
    let chains = chains();
    let (mut law, mut servo): (Option<LawCommand>, Option<ServoCommand>) = (None, None);
    let (mut now_ns, mut at, mut velocity) = (5_000_000_000u64, DVec3::ZERO, DVec3::ZERO);
    let (mut mode, mut permitted, mut lowered_n) = (SourceMode::Follow, true, f64::INFINITY);
    let mut before = Wrench::ZERO;
    let mut tally = Tally::default();
    for tick in 0..ticks {
        // Long enough a calm that the engage gate opens and its ramp is over, then a storm.
        let calm_ticks = (2.2 * rate_hz) as usize;
        let calm = tick % (3 * calm_ticks) < calm_ticks;
        let after_ns = if dice.one_in(20) { dice.below(6 * period_ns) } else { period_ns };
        now_ns += after_ns;
        let now = Moment { monotonic_ns: now_ns, stamp_ns: STAMP_0 + now_ns as i64 };
        velocity = 0.98 * velocity + dice.vector(0.02);
        at = (at + velocity * period_s).clamp(DVec3::splat(-0.11), DVec3::splat(0.11));
        let rotation = DQuat::from_rotation_x(dice.unit() * 3.0) * DQuat::from_rotation_z(dice.unit() * 3.0);
        let state = DeviceState {
            linear_velocity_m_per_s: velocity,
            angular_velocity_rad_per_s: dice.vector(5.0),
            device_time_ns: now_ns,
            ..DeviceState::at_rest(Pose { translation: at, rotation })
        };
        if calm {
            (law, mode, permitted, lowered_n) = (None, SourceMode::Follow, true, f64::INFINITY);
            servo = Some(ServoCommand {
                since_ns: now_ns,
                gripper_until_ns: u64::MAX,
                wrench: Wrench::ZERO,
                axes: Axes::Base,
            });
        } else {
            if dice.one_in(2) {
                servo = Some(dice.servo(now_ns));
                tally.commands += 1;
            }
            if dice.one_in(3) {
                law = if dice.one_in(9) { None } else { Some(dice.law(now.stamp_ns, &chains)) };
                tally.commands += 1;
            }
            if dice.one_in(300) {
                mode = [SourceMode::Follow, SourceMode::Follow, SourceMode::Free, SourceMode::Hold]
                    [dice.below(4) as usize];
            }
            permitted &= !dice.one_in(8000);
            if dice.one_in(200) {
                lowered_n = dice.trouble();
            }
        }
        layer.set_max_force_n(lowered_n);
        let applied = if dice.one_in(50) {
            layer.step_blind(now_ns)
        } else {
            let inputs =
                Inputs { state: &state, now, mode, permitted, law: law.as_ref(), servo: servo.as_ref() };
            let wanted = source.want(&inputs);
            tally.origins[match wanted.origin {
                ForceOrigin::Nobody => 0,
                ForceOrigin::ContactLaw => 1,
                ForceOrigin::ServoForce => 2,
                ForceOrigin::Hold => 3,
            }] += 1;
            layer.step(&wanted, &state, permitted, now_ns)
        };
        let now_is = applied.wrench;
        let dt_s = (after_ns as f64 * 1e-9).min(period_s).min(2e-3);
        let context = || format!("seed {seed}, period {tick}: {before:?} -> {applied:?}");
        assert!(now_is.is_finite(), "{}", context());
        assert!(now_is.force_n.length() <= 12.0, "{}", context());
        assert!(now_is.torque_n_m.length() <= 0.3, "{}", context());
        assert!(now_is.gripper_force_n.abs() <= 5.0, "{}", context());
        assert!((now_is.force_n - before.force_n).length() <= 2000.0 * dt_s, "{}", context());
        assert!((now_is.torque_n_m - before.torque_n_m).length() <= 50.0 * dt_s, "{}", context());
        assert!((now_is.gripper_force_n - before.gripper_force_n).abs() <= 1000.0 * dt_s, "{}", context());
        let size_n = now_is.force_n.length();
        tally.pushed += usize::from(size_n > 0.1);
        tally.clamped += usize::from(applied.limits_hit.contains(devices::safety::LimitsHit::FORCE));
        tally.largest_n = tally.largest_n.max(size_n);
        before = now_is;
    }
    tally
}

#[test]
fn a_storm_of_two_hundred_thousand_commands_never_exceeds_clamp_or_slew() {
    for passivity in [true, false] {
        let mut commands = 0;
        let mut seed = 1;
        let mut sum = Tally::default();
        while commands < 200_000 {
            let tally = storm(seed, 60_000, passivity);
            commands += tally.commands;
            seed += 1;
            sum.pushed += tally.pushed;
            sum.clamped += tally.clamped;
            sum.largest_n = sum.largest_n.max(tally.largest_n);
            (0..4).for_each(|origin| sum.origins[origin] += tally.origins[origin]);
        }
        println!("passivity {passivity}: {commands} commands, {sum:?}");
        // The storm did reach the motors.
        assert!(sum.pushed > 20_000 && sum.clamped > 20_000, "{sum:?}");
        assert!(sum.largest_n > 11.0 || passivity, "{sum:?}");
        assert!(sum.origins.iter().all(|&count| count > 1000), "{sum:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_storm_exceeds_clamp_or_slew(seed in any::<u64>(), passivity in any::<bool>()) {
        storm(seed, 12_000, passivity);
    }
}
