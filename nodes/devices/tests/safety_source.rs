//! The choice among the sources of force: who is followed, for how long, and how one goes over into the other.

#![expect(clippy::unwrap_used, reason = "helpers of tests, outside the test functions")]

use std::sync::Arc;

use devices::safety::SafetySettings;
use devices::source::{
    Axes, ForceOrigin, ForceSource, Inputs, LawCommand, Moment, ServoCommand, Source, SourceMode, Wanted,
};
use devices::{DeviceState, Wrench};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use rhombus_chain::{ChainParameters, ContactLaw, Formulation, LocalLaw, Mode, Pose};

const MS: u64 = 1_000_000;
const STAMP_0: i64 = 1_700_000_000_000_000_000;

fn at_ns(ns: u64) -> Moment {
    Moment { monotonic_ns: ns, stamp_ns: STAMP_0 + ns as i64 }
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

/// A floor z < 0 touched by a probe of 5 mm.
fn law(ms: u64) -> LawCommand {
    let local = LocalLaw {
        mode: Mode::Contact,
        anchor: DVec3::ZERO,
        normal: DVec3::Z,
        probe_radius_m: 0.005,
        stiffness_factor: 1.0,
        ..LocalLaw::default()
    };
    LawCommand { stamp_ns: at_ns(ms * MS).stamp_ns, validity_ns: 100 * MS as i64, local, chains: chains() }
}

fn servo(ms: u64, force_n: DVec3) -> ServoCommand {
    ServoCommand {
        since_ns: ms * MS,
        gripper_until_ns: u64::MAX,
        wrench: Wrench::of_force(force_n),
        axes: Axes::Base,
    }
}

/// A source with the newest of every slot, as the motor loop has them.
struct Bench {
    source: Source,
    law: Option<LawCommand>,
    servo: Option<ServoCommand>,
    mode: SourceMode,
    state: DeviceState,
}

impl Bench {
    fn new(source: ForceSource) -> Bench {
        Bench {
            source: Source::new(source, &SafetySettings::default().checked(1000.0, &[]).unwrap()),
            law: None,
            servo: None,
            mode: SourceMode::Follow,
            state: DeviceState::at_rest(Pose { translation: DVec3::Z * 0.003, rotation: DQuat::IDENTITY }),
        }
    }

    fn at(&mut self, ms: u64) -> Wanted {
        self.at_ns(ms * MS)
    }

    fn at_ns(&mut self, ns: u64) -> Wanted {
        self.source.want(&Inputs {
            state: &self.state,
            now: at_ns(ns),
            mode: self.mode,
            permitted: true,
            law: self.law.as_ref(),
            servo: self.servo.as_ref(),
        })
    }

    /// Every period from one time to another, the last one included.
    fn run(&mut self, from_ms: u64, to_ms: u64) -> Vec<Wanted> {
        (from_ms..=to_ms).map(|ms| self.at(ms)).collect()
    }
}

fn law_force_n() -> DVec3 {
    DVec3::Z * chains().at_depth(0.002).unwrap().force_n
}

#[test]
fn a_gripper_force_ends_at_its_own_time_however_long_the_wrench_goes_on() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    let wrench = Wrench { gripper_force_n: 2.0, ..Wrench::of_force(DVec3::X) };
    // The source has faded in by then.
    for ms in 70..=140 {
        bench.servo = Some(ServoCommand { wrench, gripper_until_ns: 120 * MS, ..servo(ms, DVec3::X) });
        let Wrench { force_n, gripper_force_n, .. } = bench.at(ms).wrench;
        let gripper = if ms <= 120 { 2.0 } else { 0.0 };
        assert!(ms < 100 || (gripper_force_n, force_n.x) == (gripper, 1.0), "{ms} ms: {gripper_force_n}");
    }
}

// Who is followed.

#[test]
fn nobody_answering_is_no_force() {
    assert_eq!(Bench::new(ForceSource::ContactLaw).at(1), Wanted::default());
}

#[test]
fn the_law_answers_the_position_of_this_period_not_that_of_its_message() {
    let mut bench = Bench::new(ForceSource::ContactLaw);
    bench.law = Some(law(100));
    bench.run(100, 120);
    for (ms, depth_m) in [(121, 0.001), (122, 0.003)] {
        bench.state.pose.translation = DVec3::Z * (0.005 - depth_m);
        let wanted = bench.at(ms);
        let expected = chains().at_depth(depth_m).unwrap().force_n;
        assert!((wanted.wrench.force_n - DVec3::Z * expected).length() < 1e-12 && expected > 0.0);
        assert!((wanted.depth_m - depth_m).abs() < 1e-15);
        assert_eq!((wanted.origin, wanted.settled), (ForceOrigin::ContactLaw, true));
    }
}

#[test]
fn a_law_without_contact_is_an_answer_of_no_force() {
    let mut bench = Bench::new(ForceSource::ContactLaw);
    bench.servo = Some(servo(100, DVec3::X));
    bench.law = Some(LawCommand { local: LocalLaw { mode: Mode::None, ..law(100).local }, ..law(100) });
    let wanted = bench.at(101);
    assert_eq!((wanted.wrench, wanted.origin), (Wrench::ZERO, ForceOrigin::ContactLaw));
}

#[test]
fn with_the_source_servo_cf_no_law_is_evaluated() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    bench.law = Some(law(100));
    assert_eq!(bench.at(101).origin, ForceOrigin::Nobody);
    bench.servo = Some(servo(101, DVec3::X));
    assert_eq!(bench.at(101).origin, ForceOrigin::ServoForce);
}

#[test]
fn a_commanded_wrench_in_the_handles_axes_turns_with_the_handle() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    let wrench = Wrench { torque_n_m: DVec3::Y * 0.1, gripper_force_n: 2.0, ..Wrench::of_force(DVec3::X) };
    for (ms, angle) in [(0, 0.0), (20, 0.5), (40, 1.5)] {
        bench.servo =
            Some(ServoCommand { since_ns: ms * MS, gripper_until_ns: u64::MAX, wrench, axes: Axes::Tip });
        bench.state.pose.rotation = DQuat::from_rotation_z(angle);
        let got = bench.run(ms, ms + 20)[20].wrench;
        assert!((got.force_n - DQuat::from_rotation_z(angle) * DVec3::X).length() < 1e-12);
        assert!((got.torque_n_m - DQuat::from_rotation_z(angle) * DVec3::Y * 0.1).length() < 1e-12);
        assert_eq!(got.gripper_force_n.to_bits(), 2.0f64.to_bits());
    }
}

// For how long.

#[test]
fn a_law_is_used_until_its_validity_and_never_longer_than_the_setting() {
    for (validity_ms, until_ms) in [(50, 150), (100, 200), (10_000, 200)] {
        let mut bench = Bench::new(ForceSource::ContactLaw);
        bench.law = Some(LawCommand { validity_ns: validity_ms * MS as i64, ..law(100) });
        bench.run(100, 120);
        assert_eq!(bench.at(until_ms).wrench.force_n, law_force_n());
        assert!(bench.at(until_ms).settled);
        // Frozen where it was, whatever the hand does, and falling for 30 ms.
        bench.state.pose.translation = DVec3::Z * -0.01;
        for ms in 1..30 {
            let wanted = bench.at(until_ms + ms);
            let expected = law_force_n() * (1.0 - ms as f64 / 30.0);
            assert!((wanted.wrench.force_n - expected).length() < 1e-12, "{ms}: {wanted:?}");
            assert_eq!((wanted.origin, wanted.settled), (ForceOrigin::ContactLaw, false));
        }
        assert_eq!(bench.at(until_ms + 30), Wanted::default());
    }
}

#[test]
fn a_law_from_the_future_or_without_validity_is_none_and_ends_the_one_before() {
    let useless = [
        LawCommand { stamp_ns: at_ns(500 * MS).stamp_ns, ..law(0) },
        LawCommand { stamp_ns: i64::MIN, ..law(0) },
        LawCommand { stamp_ns: i64::MAX, ..law(0) },
        LawCommand { validity_ns: -1, ..law(110) },
        LawCommand { validity_ns: i64::MIN, ..law(110) },
        LawCommand { validity_ns: i64::MAX, stamp_ns: 0, ..law(0) },
    ];
    for useless in useless {
        let mut bench = Bench::new(ForceSource::ContactLaw);
        bench.law = Some(law(100));
        bench.run(100, 120);
        bench.law = Some(useless.clone());
        let falling = bench.run(121, 151);
        assert!(falling[15].wrench.force_n.length() < 0.6 * law_force_n().length(), "{useless:?}");
        assert_eq!(falling[30], Wanted::default(), "{useless:?}");
    }
}

#[test]
fn a_commanded_force_is_used_for_20_ms_and_is_nothing_50_ms_after_its_arrival() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    for ms in 100..=130 {
        bench.servo = Some(servo(ms, DVec3::X * 3.0));
        bench.at(ms);
    }
    // The last valid command arrived at 130 ms; what follows is not finite, older, or from the future.
    for (ms, bad) in
        [(131, servo(131, DVec3::NAN)), (132, servo(90, DVec3::X * 9.0)), (133, servo(5000, DVec3::X * 9.0))]
    {
        bench.servo = Some(bad);
        let wanted = bench.at(ms);
        assert!(wanted.refused, "{bad:?}");
        assert!(!bench.at_ns(ms * MS + 1).refused, "once for each command");
        assert_eq!(wanted.wrench.force_n, DVec3::X * 3.0);
    }
    assert!(bench.run(134, 150).iter().all(|w| w.wrench.force_n == DVec3::X * 3.0 && w.settled));
    for (ms, wanted) in (151..180).zip(bench.run(151, 179)) {
        let expected = 3.0 * (1.0 - (ms - 150) as f64 / 30.0);
        assert!((wanted.wrench.force_n.x - expected).abs() < 1e-12, "{ms}: {wanted:?}");
        assert!(!wanted.settled);
    }
    assert_eq!(bench.at_ns(180 * MS - 1).origin, ForceOrigin::ServoForce);
    assert_eq!(bench.at(180), Wanted::default());
}

#[test]
fn a_command_that_arrives_while_the_period_runs_is_fresh() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    bench.servo = Some(ServoCommand { since_ns: 100 * MS + 200_000, ..servo(0, DVec3::X) });
    let wanted = bench.at(100);
    assert_eq!((wanted.origin, wanted.refused), (ForceOrigin::ServoForce, false));
}

#[test]
fn a_slow_loop_ends_with_nothing_too() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    bench.servo = Some(servo(100, DVec3::X));
    bench.run(100, 120);
    assert_eq!(bench.at(400), Wanted::default());
}

// From one to the other.

/// The largest change of the force from one period to the next.
fn largest_step_n(wanted: &[Wanted]) -> f64 {
    wanted
        .windows(2)
        .map(|pair| (pair[1].wrench.force_n - pair[0].wrench.force_n).length())
        .fold(0.0, f64::max)
}

#[test]
fn no_change_of_source_steps_the_force() {
    // Servo 3 N across, the law's force upward, hold, nobody, servo again, law again: over 20 ms each.
    let mut bench = Bench::new(ForceSource::ContactLaw);
    bench.state.pose.translation = DVec3::Z * -0.003;
    let mut all = Vec::new();
    let mut origins = Vec::new();
    for ms in 100..1000 {
        let with_law = matches!(ms, 200..300 | 700..800);
        let with_servo = matches!(ms, 100..400 | 600..900);
        bench.mode = match ms {
            420..500 => SourceMode::Hold,
            850..930 => SourceMode::Free,
            _ => SourceMode::Follow,
        };
        // A law ends by one without validity, as when its sender stops.
        bench.law = Some(LawCommand { validity_ns: if with_law { 100 * MS as i64 } else { -1 }, ..law(ms) });
        if with_servo {
            bench.servo = Some(servo(ms, DVec3::X * 3.0));
        }
        let wanted = bench.at(ms);
        if origins.last() != Some(&wanted.origin) {
            origins.push(wanted.origin);
        }
        all.push(wanted);
    }
    use ForceOrigin::{ContactLaw, Hold, Nobody, ServoForce};
    assert_eq!(
        origins,
        [ServoForce, ContactLaw, ServoForce, Hold, Nobody, ServoForce, ContactLaw, ServoForce, Nobody]
    );
    let law_n = chains().at_depth(0.008).unwrap().force_n;
    let apart_n = DVec3::new(3.0, 0.0, law_n).length();
    assert!(law_n > 1.0);
    assert!(largest_step_n(&all) <= apart_n / 20.0 + 1e-9, "{} of {apart_n}", largest_step_n(&all));
    // And what was wanted arrives each time.
    assert_eq!(all[150 - 100].wrench.force_n, DVec3::X * 3.0);
    assert!((all[250 - 100].wrench.force_n - DVec3::Z * law_n).length() < 1e-12);
    assert_eq!(all[450 - 100].wrench.force_n, DVec3::ZERO);
    assert_eq!(all[580 - 100], Wanted::default());
    assert_eq!(all[880 - 100].wrench, Wrench::ZERO);
}

#[test]
fn the_way_from_one_source_to_the_other_is_not_settled() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    for ms in 100..=125 {
        bench.servo = Some(servo(ms, DVec3::X));
        assert_eq!(bench.at(ms).settled, ms >= 120, "{ms}");
    }
}

#[test]
fn a_command_after_a_pause_grows_from_what_was_left_of_the_one_before() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    bench.servo = Some(servo(100, DVec3::X * 3.0));
    let mut all = bench.run(100, 140); // a third is left at 140 ms
    bench.servo = Some(servo(141, DVec3::X * 3.0));
    all.extend(bench.run(141, 161));
    assert!(largest_step_n(&all) <= 0.16, "{}", largest_step_n(&all));
    assert_eq!(all[61].wrench.force_n, DVec3::X * 3.0);
}

#[test]
fn a_force_larger_than_any_motor_goes_over_from_what_the_motors_gave() {
    let mut bench = Bench::new(ForceSource::ServoForce);
    bench.servo = Some(servo(100, DVec3::X * 1e300));
    bench.run(100, 119);
    assert!(bench.at(120).wrench.force_n.x > 0.99e6);
    bench.mode = SourceMode::Free;
    let released = bench.run(121, 141);
    assert!(largest_step_n(&released) <= 1.0 + 1e-9);
    assert_eq!(released[20].wrench, Wrench::ZERO);
}

#[test]
fn hold_pulls_back_to_the_pose_at_which_it_began_and_begins_anew_each_time() {
    let mut bench = Bench::new(ForceSource::ContactLaw);
    for (start_ms, from) in [(100, DVec3::X * 0.01), (300, DVec3::Y * 0.02)] {
        bench.mode = SourceMode::Hold;
        bench.state.pose.translation = from;
        assert_eq!(bench.at(start_ms).wrench, Wrench::ZERO);
        bench.state.pose.translation = from + DVec3::Z * 0.01;
        bench.run(start_ms + 1, start_ms + 20);
        let wanted = bench.at(start_ms + 21);
        assert!((wanted.wrench.force_n - DVec3::Z * -3.0).length() < 1e-12);
        assert_eq!(wanted.origin, ForceOrigin::Hold);
        bench.mode = SourceMode::Follow;
        bench.run(start_ms + 22, start_ms + 50);
    }
}

#[test]
fn where_no_force_is_permitted_the_pose_to_hold_goes_along_with_the_hand() {
    let mut bench = Bench::new(ForceSource::ContactLaw);
    bench.mode = SourceMode::Hold;
    let mut want = |ms: u64, z: f64, permitted: bool| {
        bench.state.pose.translation = DVec3::Z * z;
        bench.source.want(&Inputs {
            state: &bench.state,
            now: at_ns(ms * MS),
            mode: SourceMode::Hold,
            permitted,
            law: None,
            servo: None,
        })
    };
    for ms in 0..50 {
        assert_eq!(want(ms, 0.001 * ms as f64, false).wrench, Wrench::ZERO);
    }
    want(50, 0.05, true);
    assert!((want(80, 0.06, true).wrench.force_n.z + 3.0).abs() < 1e-9);
}

proptest! {
    /// Whatever comes and goes, in periods of 1 ms: the force steps by no more than its sources differ over 20 ms, plus
    /// what falls in the decay. Every force is within 8 N, so no two are further apart than 16 N.
    #[test]
    fn no_sequence_of_sources_steps_the_force(
        script in prop::collection::vec((0u64..4, 1u64..60, -8.0..8.0f64), 1..40),
    ) {
        let mut bench = Bench::new(ForceSource::ContactLaw);
        bench.state.pose.translation = DVec3::Z * 0.002;
        let mut ms = 100;
        let mut last_n = DVec3::ZERO;
        let mut between_ms = 0;
        for (kind, duration_ms, force_n) in script {
            for _ in 0..duration_ms {
                bench.mode = if kind == 3 { SourceMode::Hold } else { SourceMode::Follow };
                let validity_ns = if kind == 1 { 100 * MS as i64 } else { -1 };
                bench.law = Some(LawCommand { validity_ns, ..law(ms) });
                if kind == 2 {
                    // Its own change is a source's business; here it has none but at the hand-over.
                    let known = bench.servo.filter(|s| s.since_ns + 21 * MS >= ms * MS);
                    let force_n = known.map_or(DVec3::X * force_n, |s| s.wrench.force_n);
                    bench.servo = Some(servo(ms, force_n));
                }
                let now_n = bench.at(ms).wrench.force_n;
                prop_assert!((now_n - last_n).length() <= 16.0 / 20.0 + 1e-9, "{now_n} after {last_n}");
                last_n = now_n;
                ms += 1;
                between_ms += 1;
            }
        }
        prop_assert!(between_ms > 0);
    }
}
