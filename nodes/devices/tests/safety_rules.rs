//! Each rule of the safety layer alone. That the force stays finite, within the clamps and within the slew limit is
//! checked by the rig in every period of every test.

mod safety_support;

use devices::safety::{FaultCause, LimitsHit, SafetyLayer, SafetySettings};
use devices::source::ForceOrigin;
use devices::{DeviceLimits, DeviceState, RATES_HZ, Workspace, Wrench};
use glam::DVec3;
use proptest::prelude::*;
use safety_support::checked;
use safety_support::rig::{Ask, Done, LIMITS, PERIOD_NS, PERIOD_S, Rig, moving, still, without_passivity};

const PUSH: DVec3 = DVec3::new(3.0, -4.0, 0.0);

fn forces_n(done: &[Done]) -> Vec<f64> {
    done.iter().map(|d| d.force_n().length()).collect()
}

fn engaged() -> Rig {
    Rig::engaged(without_passivity(), still(DVec3::ZERO))
}

// The engage gate.

#[test]
fn a_force_that_is_there_from_the_start_never_reaches_the_motors() {
    let done = Rig::new(checked(true)).steps(Ask::force(PUSH), 5000);
    assert!(done.iter().all(|d| d.applied.wrench == Wrench::ZERO && d.hit(LimitsHit::ENGAGE_GATE)));
}

#[test]
fn after_five_small_commands_the_force_grows_linearly_over_two_seconds() {
    let mut rig = Rig::new(without_passivity());
    let small = rig.steps(Ask::force(DVec3::X * 0.19), 5);
    assert!(small.iter().all(|d| d.applied.wrench == Wrench::ZERO));
    let push = Ask {
        wrench: Wrench { torque_n_m: DVec3::X * 0.2, gripper_force_n: 2.0, ..Wrench::of_force(PUSH) },
        ..Ask::default()
    };
    let done = rig.steps(push, 2100);
    for (tick, d) in done.iter().enumerate() {
        let share = ((tick + 1) as f64 * PERIOD_S / 2.0).min(1.0);
        let Wrench { force_n, torque_n_m, gripper_force_n } = d.applied.wrench;
        assert!((force_n - PUSH * share).length() < 1e-9, "{tick}: {d:?}");
        assert!((torque_n_m.x - 0.2 * share).abs() < 1e-9 && (gripper_force_n - 2.0 * share).abs() < 1e-9);
        // The last period of the ramp is a matter of rounding.
        assert!(tick == 1999 || d.hit(LimitsHit::ENGAGE_RAMP) == (tick < 1999), "{tick}");
    }
    assert_eq!(done[2099].force_n(), PUSH);
}

#[test]
fn four_small_commands_five_not_in_a_row_large_torques_and_silence_do_not_open_the_gate() {
    let small = Ask::default();
    let torque = Ask { wrench: Wrench { torque_n_m: DVec3::X * 0.02, ..Wrench::ZERO }, ..small };
    let gripper = Ask { wrench: Wrench { gripper_force_n: 1.0, ..Wrench::ZERO }, ..small };
    let nobody = Ask { origin: ForceOrigin::Nobody, settled: false, ..small };
    let unsettled = Ask { settled: false, ..small };
    let broken = Ask::force(DVec3::splat(f64::NAN));
    for other in [Ask::force(PUSH), torque, gripper, nobody, unsettled, broken] {
        let mut rig = Rig::new(without_passivity());
        for _ in 0..100 {
            rig.steps(small, 4);
            rig.steps(other, 6);
        }
        let done = rig.step(Ask::force(PUSH));
        assert!(done.hit(LimitsHit::ENGAGE_GATE), "{other:?}");
    }
}

#[test]
fn disabling_a_fault_a_long_silence_and_a_long_gap_close_the_gate_and_short_ones_do_not() {
    let push = Ask::force(PUSH);
    let silent = Ask { origin: ForceOrigin::Nobody, settled: false, ..Ask::default() };
    let fast = |device_time_ns| Ask {
        state: DeviceState { device_time_ns, ..moving(DVec3::ZERO, DVec3::X * 2.0) },
        ..push
    };
    let closing: [(&str, Vec<Ask>); 5] = [
        ("disabled", vec![Ask { permits: false, ..push }]),
        ("fault", (1..5).map(fast).collect()),
        ("silence", vec![silent; 1010]),
        ("gap", vec![Ask { after_ns: 1_100_000_000, ..push }]),
        ("blind", vec![Ask { blind: true, ..push }; 25]),
    ];
    for (name, between) in closing {
        let mut rig = engaged();
        rig.steps(push, 10);
        for ask in between {
            rig.step(ask);
        }
        let done = rig.steps(push, 3000);
        assert_eq!(done[2999].applied.wrench, Wrench::ZERO, "{name}");
    }
    let open: [(&str, Vec<Ask>); 4] = [
        ("silence", vec![silent; 900]),
        ("gap", vec![Ask { after_ns: 900_000_000, ..push }]),
        ("blind", vec![Ask { blind: true, ..push }; 10]),
        ("not finite", vec![Ask::force(DVec3::NAN)]),
    ];
    for (name, between) in open {
        let mut rig = engaged();
        for ask in between {
            rig.step(ask);
        }
        assert_eq!(rig.steps(push, 10)[9].force_n(), PUSH, "{name}");
    }
}

// Finite, clamp, power, slew.

#[test]
fn a_wanted_force_that_is_not_finite_is_none_and_the_force_falls_at_the_slew_limit() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let wrenches = [
            Wrench::of_force(DVec3::new(1.0, bad, 0.0)),
            Wrench { torque_n_m: DVec3::Z * bad, ..Wrench::of_force(PUSH) },
            Wrench { gripper_force_n: bad, ..Wrench::of_force(PUSH) },
        ];
        for wrench in wrenches {
            let mut rig = engaged();
            rig.steps(Ask::force(PUSH), 10);
            let done = rig.steps(Ask { wrench, ..Ask::default() }, 3);
            assert!(done.iter().all(|d| d.hit(LimitsHit::NOT_FINITE)));
            // 5 N in steps of 2 N.
            let expected = [3.0, 1.0, 0.0];
            assert!(forces_n(&done).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{done:?}");
        }
    }
}

#[test]
fn a_rule_that_comes_to_a_force_that_is_not_finite_is_a_fault_and_no_force() {
    let nowhere = Workspace { centre: DVec3::new(0.0, f64::NAN, 0.0), ..LIMITS.workspace };
    let mut rig = engaged();
    rig.layer =
        SafetyLayer::new(&without_passivity(), &DeviceLimits { workspace: nowhere, ..LIMITS }, PERIOD_S);
    let done = rig.steps(Ask::default(), 2100);
    assert!(done.iter().any(|d| d.applied.fault == Some(FaultCause::ForceNotFinite)));
    for done in rig.steps(Ask::force(PUSH), 100) {
        assert_eq!((done.applied.wrench, done.energy.dissipated_j), (Wrench::ZERO, 0.0));
    }
}

#[test]
fn the_clamp_keeps_the_direction_and_takes_the_smaller_limit_of_user_and_device() {
    let huge =
        Wrench { force_n: PUSH * 1e300, torque_n_m: DVec3::new(0.0, 1e308, 1e308), gripper_force_n: -1e308 };
    let got = engaged().steps(Ask { wrench: huge, ..Ask::default() }, 50)[49];
    assert!((got.force_n() - PUSH * 3.0).length() < 1e-9); // the device's 15 N, not the user's 20 N
    assert!(
        (got.applied.wrench.torque_n_m - DVec3::new(0.0, 1.0, 1.0).normalize_or_zero() * 0.4).length() < 1e-9
    );
    assert!((got.applied.wrench.gripper_force_n + 6.0).abs() < 1e-9);
    assert!(got.hit(LimitsHit::FORCE) && got.hit(LimitsHit::TORQUE) && got.hit(LimitsHit::GRIPPER));
    let within = engaged().steps(Ask::force(PUSH), 50)[49];
    assert_eq!(within.applied.limits_hit, LimitsHit::NONE);
    assert_eq!(within.force_n(), PUSH);
}

#[test]
fn motors_that_a_device_does_not_have_get_nothing() {
    let none = DeviceLimits {
        max_force_n: None,
        max_torque_n_m: None,
        max_gripper_force_n: Some(f64::NAN),
        ..LIMITS
    };
    let mut rig = engaged();
    rig.layer = SafetyLayer::new(&without_passivity(), &none, PERIOD_S);
    rig.steps(Ask::default(), 2100);
    let wrench = Wrench { torque_n_m: DVec3::X, gripper_force_n: 1.0, ..Wrench::of_force(PUSH) };
    assert!(rig.steps(Ask { wrench, ..Ask::default() }, 50).iter().all(|d| d.applied.wrench == Wrench::ZERO));
}

#[test]
fn a_limit_that_is_lowered_live_is_reached_at_the_slew_limit_and_never_raised_beyond_the_start() {
    let mut rig = engaged();
    rig.steps(Ask::force(PUSH * 3.0), 50);
    rig.layer.set_max_force_n(4.0);
    let done = rig.steps(Ask::force(PUSH * 3.0), 7);
    let expected = [13.0, 11.0, 9.0, 7.0, 5.0, 4.0, 4.0];
    assert!(forces_n(&done).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{:?}", forces_n(&done));
    rig.layer.set_max_force_n(1e6);
    assert!((rig.steps(Ask::force(PUSH * 9.0), 50)[49].force_n().length() - 15.0).abs() < 1e-9);
    for no_limit in [f64::NAN, -1.0, 0.0] {
        rig.layer.set_max_force_n(no_limit);
        assert_eq!(rig.steps(Ask::force(PUSH), 50)[49].force_n(), DVec3::ZERO);
    }
}

#[test]
fn the_force_steps_no_further_when_a_period_is_late_and_less_when_it_is_early() {
    for (after_ns, step_n) in [(PERIOD_NS, 2.0), (5 * PERIOD_NS, 2.0), (PERIOD_NS / 10, 0.2), (0, 0.0)] {
        let done = engaged().step(Ask { after_ns, ..Ask::force(DVec3::X * 10.0) });
        assert!((done.force_n().x - step_n).abs() < 1e-9, "{done:?}");
        assert!(done.hit(LimitsHit::SLEW));
    }
}

/// Rates over the accepted range, and the layer of a loop with each, its gate open and its ramp over.
fn at_every_rate() -> impl Iterator<Item = (f64, Ask, Rig)> {
    let rates_hz = [*RATES_HZ.start(), 250.0, 333.0, 500.0, 1000.0, *RATES_HZ.end()];
    rates_hz.into_iter().map(|rate_hz| {
        let ask = Ask { after_ns: (1e9 / rate_hz) as u64, ..Ask::default() };
        let mut rig = Rig::at_period(without_passivity(), 1.0 / rate_hz);
        rig.steps(ask, (2.1 * rate_hz) as usize);
        (rate_hz, ask, rig)
    })
}

#[test]
fn no_command_steps_by_more_than_the_slew_limit_allows_in_two_milliseconds_at_any_rate() {
    for (rate_hz, ask, mut rig) in at_every_rate() {
        let most_n = 2000.0 * 2e-3f64.min(1.0 / rate_hz);
        let mut largest_n = 0.0f64;
        for sign in [1.0, -1.0, 1.0] {
            for late in [1, 1, 3, 1, 40, 1, 1, 1, 1, 1] {
                let push = Wrench {
                    torque_n_m: DVec3::X * sign,
                    gripper_force_n: 9.0 * sign,
                    ..Wrench::of_force(DVec3::X * 18.0 * sign)
                };
                let done = rig.step(Ask { wrench: push, after_ns: ask.after_ns * late, ..ask });
                let step = |now: f64, before: f64| (now - before).abs();
                largest_n = largest_n.max(step(done.force_n().x, done.before.force_n.x));
                let (now, before) = (done.applied.wrench, done.before);
                assert!(
                    step(now.torque_n_m.x, before.torque_n_m.x) <= most_n / 40.0,
                    "{rate_hz} Hz: {done:?}"
                );
                assert!(
                    step(now.gripper_force_n, before.gripper_force_n) <= most_n / 2.0,
                    "{rate_hz} Hz: {done:?}"
                );
            }
        }
        assert!(largest_n <= most_n && largest_n > 0.999 * most_n, "{rate_hz} Hz: {largest_n} N");
    }
}

#[test]
fn the_largest_force_is_gone_within_the_decay_time_at_any_rate() {
    let settings = SafetySettings::default();
    for (rate_hz, ask, mut rig) in at_every_rate() {
        // The device's 15 N stand for the default's 20 N: three quarters of the time.
        let push = Ask {
            wrench: Wrench { torque_n_m: DVec3::X, gripper_force_n: -9.0, ..Wrench::of_force(PUSH * 4.0) },
            ..ask
        };
        assert!((rig.steps(push, 100)[99].force_n().length() - 15.0).abs() < 1e-9);
        let periods = rig
            .steps(Ask { permits: false, ..push }, 200)
            .iter()
            .take_while(|d| d.applied.wrench != Wrench::ZERO)
            .count()
            + 1;
        let time_s = periods as f64 / rate_hz;
        assert!(time_s <= 0.75 * settings.decay_s + 1.0 / rate_hz, "{rate_hz} Hz: {time_s} s");
    }
}

#[test]
fn disabling_brings_the_largest_force_to_nothing_at_the_slew_limit() {
    let mut rig = engaged();
    rig.steps(Ask::force(DVec3::X * 15.0), 50);
    let done = rig.steps(Ask { permits: false, ..Ask::force(DVec3::X * 15.0) }, 8);
    assert!(done[6].force_n().x > 0.0);
    assert_eq!(done[7].applied.wrench, Wrench::ZERO);
    assert!(rig.layer.is_zero());
}

#[test]
fn a_moving_hand_gets_no_more_than_the_largest_power_and_the_direction_stays() {
    let mut rig = engaged();
    // 15 N along 1.4 m/s would be 21 W; the position stands still, so that nothing else has something to say.
    let state = moving(DVec3::ZERO, DVec3::X * 1.4);
    let done = rig.steps(Ask { state, ..Ask::force(DVec3::new(12.0, 9.0, 0.0)) }, 50)[49];
    assert!(done.hit(LimitsHit::POWER));
    assert!((done.force_n().x * 1.4 - 10.0).abs() < 1e-9);
    assert!((done.force_n().y / done.force_n().x - 0.75).abs() < 1e-12);
    // Against the motion there is no such limit.
    let brake = rig.steps(Ask { state, ..Ask::force(DVec3::X * -12.0) }, 50)[49];
    assert!(!brake.hit(LimitsHit::POWER) && brake.force_n() == DVec3::X * -12.0);
    // A torque counts too.
    let turning = DeviceState { angular_velocity_rad_per_s: DVec3::Z * 50.0, ..still(DVec3::ZERO) };
    let wrench = Wrench { torque_n_m: DVec3::Z * 0.4, ..Wrench::ZERO };
    let done = rig.steps(Ask { wrench, state: turning, ..Ask::default() }, 50)[49];
    assert!((done.applied.wrench.torque_n_m.z * 50.0 - 10.0).abs() < 1e-9);
}

// Workspace, velocity, readings.

#[test]
fn at_the_edge_only_the_outward_part_of_the_force_goes() {
    let steady = |at: DVec3, force_n: DVec3| {
        let mut rig = Rig::engaged(without_passivity(), still(at));
        rig.steps(Ask { state: still(at), ..Ask::force(force_n) }, 50)[49].force_n()
    };
    let force_n = DVec3::new(4.0, 3.0, 0.0);
    for (x, outward_n) in [(0.0, 4.0), (0.175, 4.0), (0.1775, 2.0), (0.18, 0.0), (0.25, 0.0)] {
        let got = steady(DVec3::X * x, force_n);
        assert!((got - DVec3::new(outward_n, 3.0, 0.0)).length() < 1e-9, "{x}: {got}");
        assert_eq!(steady(DVec3::X * x, -force_n), -force_n, "inward at {x}");
    }
    for (z, upward_n) in [(0.1, 4.0), (0.1475, 2.0), (0.16, 0.0)] {
        let got = steady(DVec3::Z * z, DVec3::new(1.0, 0.0, 4.0));
        assert!((got - DVec3::new(1.0, 0.0, upward_n)).length() < 1e-9, "{z}: {got}");
        let got = steady(DVec3::Z * -z, DVec3::new(1.0, 0.0, -4.0));
        assert!((got - DVec3::new(1.0, 0.0, -upward_n)).length() < 1e-9, "{z}: {got}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_edge_of_the_workspace_is_continuous(
        at in prop::array::uniform3(-0.25..0.25f64), way in prop::array::uniform3(-1e-6..1e-6f64),
        force_n in prop::array::uniform3(-8.0..8.0f64),
    ) {
        let at = DVec3::from(at);
        let steady = |at: DVec3| {
            let mut rig = Rig::engaged(without_passivity(), still(at));
            rig.steps(Ask { state: still(at), ..Ask::force(force_n.into()) }, 20)[19].force_n()
        };
        // A micrometre is a five-thousandth of the margin; near the middle, where the outward direction turns fast, all
        // of the force passes.
        let difference = (steady(at) - steady(at + DVec3::from(way))).length();
        prop_assert!(difference < 0.02, "{difference} N");
    }
}

#[test]
fn a_fast_handle_is_a_fault_and_its_force_falls_from_that_period_on() {
    let mut rig = engaged();
    rig.steps(Ask::force(PUSH), 10);
    let state = |i: u32| moving(DVec3::X * 0.002 * f64::from(i), DVec3::ZERO);
    let done: Vec<Done> = (0..8).map(|i| rig.step(Ask { state: state(i), ..Ask::force(PUSH) })).collect();
    let first = done.iter().position(|d| d.applied.fault == Some(FaultCause::Velocity)).unwrap();
    assert!(first <= 4);
    assert!(done[first].force_n().length() < done[first - 1].force_n().length());
    assert_eq!(done[first + 2].applied.wrench, Wrench::ZERO);
    // A handle that nobody drives may be thrown about.
    let mut rig = engaged();
    let free = |i: u32| Ask { permits: false, state: state(i), ..Ask::default() };
    assert!((0..8).all(|i| rig.step(free(i)).applied.fault.is_none()));
}

#[test]
fn without_a_reading_the_force_falls_at_the_slew_limit() {
    let mut rig = engaged();
    rig.steps(Ask::force(PUSH), 10);
    let done = rig.steps(Ask { blind: true, ..Ask::default() }, 3);
    assert!((done[0].force_n().length() - 3.0).abs() < 1e-9);
    assert_eq!(done[2].applied.wrench, Wrench::ZERO);
}

// Passivity.

/// A hand that is moved along the force, or against it.
fn carry(rig: &mut Rig, from: DVec3, velocity: DVec3, force_n: DVec3, ticks: u32) -> Vec<Done> {
    (1..=ticks)
        .map(|i| {
            let state = moving(from + velocity * (PERIOD_S * f64::from(i)), velocity);
            rig.step(Ask { state, ..Ask::force(force_n) })
        })
        .collect()
}

#[test]
fn a_force_may_give_back_what_was_put_in_and_no_more() {
    let mut rig = Rig::engaged(checked(true), still(DVec3::ZERO));
    let (force_n, velocity) = (DVec3::X * 4.0, DVec3::X * 0.1);
    // 50 mm against 4 N: 0.2 J less what the slew took; 100 mm back.
    carry(&mut rig, DVec3::ZERO, -velocity, force_n, 500);
    let put_in_j = -rig.layer.energy().given_j;
    assert!((put_in_j - 0.2).abs() < 0.002, "{put_in_j}");
    let back = carry(&mut rig, velocity * -0.5, velocity, force_n, 1000);
    assert_eq!(back[400].force_n(), force_n);
    assert!(back[600].hit(LimitsHit::PASSIVITY));
    assert!(back[999].force_n().x <= 0.0, "damping at most: {:?}", back[999]);
    assert!(rig.layer.energy().given_j < 1e-3);
    assert!(rig.layer.energy().largest_deficit_j < 1e-3);
    assert!(rig.layer.energy().dissipated_j > 0.1, "{:?}", rig.layer.energy());
}

#[test]
fn credit_ends_with_the_contact_and_a_deficit_does_not() {
    let velocity = DVec3::X * 0.1;
    let force_n = DVec3::X * 4.0;
    let energy_of_a_carry = |free_ticks: usize| {
        let mut rig = Rig::engaged(checked(true), still(DVec3::ZERO));
        carry(&mut rig, DVec3::ZERO, -velocity, force_n, 500);
        let at = velocity * -0.5;
        rig.steps(Ask { state: still(at), ..Ask::default() }, free_ticks);
        let before_j = rig.layer.energy().given_j;
        carry(&mut rig, at, velocity, force_n, 400);
        rig.layer.energy().given_j - before_j
    };
    assert!(energy_of_a_carry(20) > 0.1, "credit is still there after 20 ms");
    assert!(energy_of_a_carry(100) < 1e-3, "and is gone after 100 ms");

    // A deficit: the hand tears the handle away along a force faster than the slew limit takes that away.
    let mut rig = Rig::engaged(checked(true), still(DVec3::ZERO));
    carry(&mut rig, DVec3::ZERO, -velocity, DVec3::X * 15.0, 20);
    let at = velocity * -0.02;
    carry(&mut rig, at, DVec3::X * 1.4, DVec3::X * 15.0, 6);
    let deficit_j = rig.layer.energy().largest_deficit_j;
    assert!(deficit_j > 2e-3, "{deficit_j}");
    let at = at + DVec3::X * 1.4 * 0.006;
    rig.steps(Ask { state: still(at), ..Ask::default() }, 1000);
    let damped = carry(&mut rig, at, velocity, DVec3::ZERO, 5);
    assert!(damped[4].force_n().x < -0.1, "it is worked off in free space too: {:?}", damped[4]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever the velocity, tiny ones included: the controller turns no force, adds at most its 4 N, and none where
    /// nothing is owed.
    #[test]
    fn the_controller_adds_little_and_only_against_the_motion(
        exponent in -300..1i32, direction in prop::array::uniform3(-1.0..1.0f64), force in -15.0..15.0f64,
    ) {
        let velocity = DVec3::from(direction) * 10f64.powi(exponent);
        let mut rig = Rig::engaged(checked(true), still(DVec3::ZERO));
        let done = carry(&mut rig, DVec3::ZERO, velocity, DVec3::X * force, 100);
        let largest = done.iter().map(|d| d.force_n().length()).fold(0.0, f64::max);
        prop_assert!(largest <= force.abs() + 4.0 + 1e-9);
        for d in &done {
            let against = d.force_n() - DVec3::X * d.force_n().x.clamp(force.min(0.0), force.max(0.0));
            prop_assert!(against.dot(velocity) <= 1e-9, "{d:?}");
        }
    }
}

#[test]
fn the_energy_of_periods_without_a_reading_is_counted_with_the_next_one() {
    let mut rig = Rig::engaged(without_passivity(), still(DVec3::ZERO));
    rig.steps(Ask::force(DVec3::X * 5.5), 10);
    // The handle goes on by 1 mm a period while the force falls unseen from 5.5 N by 2 N a period.
    let blind = rig.steps(Ask { blind: true, ..Ask::default() }, 3);
    assert_eq!(blind[2].applied.wrench, Wrench::ZERO);
    let before_j = rig.layer.energy().given_j;
    rig.step(Ask { state: moving(DVec3::X * 0.004, DVec3::X), ..Ask::default() });
    assert!((rig.layer.energy().given_j - before_j - 0.001 * (5.5 + 3.5 + 1.5)).abs() < 1e-9);
}

#[test]
fn a_client_may_guide_a_hand_and_a_contact_law_may_not() {
    let guided = |settings: SafetySettings, origin| {
        let mut rig = Rig::engaged(settings.checked(1000.0, &[]).unwrap(), still(DVec3::ZERO));
        let pull = |i: u32| Ask {
            origin,
            state: moving(DVec3::X * (1e-5 * f64::from(i)), DVec3::X * 0.01),
            ..Ask::force(DVec3::X)
        };
        (0..2000).map(|i| rig.step(pull(i))).last().unwrap().force_n().x
    };
    let default = SafetySettings::default();
    assert_eq!(guided(default, ForceOrigin::ServoForce), 1.0);
    assert!(guided(default, ForceOrigin::ContactLaw) < 0.1);
    assert!(guided(SafetySettings { servo_passivity: true, ..default }, ForceOrigin::ServoForce) < 0.1);
}

#[test]
fn the_ramp_takes_its_time_however_much_is_wanted() {
    let mut rig = Rig::engaged_for(without_passivity(), 10);
    for tick in 1..=1000 {
        let force_n = rig.step(Ask::force(DVec3::X * 1e4)).force_n().length();
        // 15 N after 2 s.
        assert!(
            force_n <= 15.0 * f64::from(tick + 10) * PERIOD_S / 2.0 + 1e-9,
            "{force_n} N after {tick} ms"
        );
    }
}
