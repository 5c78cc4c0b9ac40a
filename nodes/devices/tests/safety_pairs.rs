//! Every two rules of the safety layer at once. Each rule comes with what triggers it and with what must hold while it is
//! triggered; a scenario for each pair triggers one, both, and the other. What always holds (finite, clamps, slew) the rig
//! checks in every period.

mod safety_support;

use devices::safety::{FaultCause, LimitsHit};
use devices::source::ForceOrigin;
use devices::{DeviceState, Wrench};
use glam::DVec3;
use safety_support::checked;
use safety_support::rig::{Ask, Done, PERIOD_S, Rig, moving, still};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    NotFinite,
    Gate,
    Silence,
    Workspace,
    Passivity,
    Power,
    Force,
    Torque,
    Gripper,
    Reversal,
    Velocity,
    Disabled,
    Blind,
    Lowered,
    Late,
}

use Rule::*;
const RULES: [Rule; 15] = [
    NotFinite, Gate, Silence, Workspace, Passivity, Power, Force, Torque, Gripper, Reversal, Velocity,
    Disabled, Blind, Lowered, Late,
];

/// The rules' windows, in periods: the first alone, both, the second alone.
const FIRST: std::ops::Range<usize> = 100..400;
const SECOND: std::ops::Range<usize> = 250..550;
const END: usize = 700;
const LOWERED_N: f64 = 3.0;
/// The most that the passivity controller damps with.
const LARGEST_DAMPING_N: f64 = 4.0;

/// What a scenario is made of, besides its two rules.
struct Hand {
    at: DVec3,
    faulted: bool,
}

impl Rule {
    /// Changes what is asked for in the `tick`-th period of the rule's window.
    fn trigger(self, ask: &mut Ask, hand: &mut Hand, tick: usize) {
        let mut move_at = |velocity: DVec3| {
            hand.at += velocity * PERIOD_S;
            ask.state = moving(hand.at, velocity);
        };
        match self {
            NotFinite => ask.wrench.force_n.y = if tick.is_multiple_of(2) { f64::NAN } else { f64::INFINITY },
            // Closed by one period without permission; the force stays large, so it stays closed.
            Gate if tick == 0 => ask.permits = false,
            Silence => {
                *ask = Ask { wrench: Wrench::ZERO, origin: ForceOrigin::Nobody, settled: false, ..*ask }
            }
            // Away with the force, on and on.
            Passivity => move_at(DVec3::X * 0.15),
            // To and fro: as much put in as taken out.
            Power => move_at(DVec3::X * if (tick / 20).is_multiple_of(2) { -1.2 } else { 1.2 }),
            Velocity => move_at(DVec3::Y * if (tick / 50).is_multiple_of(2) { 2.0 } else { -2.0 }),
            Force => ask.wrench.force_n *= 1e200,
            Torque => ask.wrench.torque_n_m = DVec3::new(0.0, 3.0, 4.0),
            Gripper => ask.wrench.gripper_force_n = -1e6,
            Reversal if tick / 5 % 2 == 1 => ask.wrench.force_n = -ask.wrench.force_n,
            Disabled => ask.permits = false,
            Blind => ask.blind = true,
            // Just when the force is to change its sign.
            Late => {
                ask.after_ns *= if tick.is_multiple_of(7) { 9 } else { 1 };
                ask.wrench.force_n *= if tick / 7 % 2 == 1 { -1.0 } else { 1.0 };
            }
            Gate | Reversal | Lowered | Workspace => {}
        }
    }

    /// Whether a period shows that the rule acted.
    fn acted(self, done: &Done) -> bool {
        match self {
            NotFinite => done.hit(LimitsHit::NOT_FINITE),
            Gate => done.hit(LimitsHit::ENGAGE_GATE),
            Workspace => done.hit(LimitsHit::WORKSPACE),
            Passivity => done.hit(LimitsHit::PASSIVITY),
            Power => done.hit(LimitsHit::POWER),
            Force | Lowered => done.hit(LimitsHit::FORCE),
            Torque => done.hit(LimitsHit::TORQUE),
            Gripper => done.hit(LimitsHit::GRIPPER),
            Reversal | Late => done.hit(LimitsHit::SLEW),
            Velocity => done.applied.fault == Some(FaultCause::Velocity),
            Silence | Disabled | Blind => done.applied.wrench == Wrench::ZERO,
        }
    }

    /// Whether the rule keeps the other from being asked at all: no force is permitted, wanted, or known.
    fn takes_the_force(self) -> bool {
        matches!(self, NotFinite | Gate | Silence | Disabled | Blind | Velocity)
    }

    /// By how much `wrench`, held in this period, would break the rule: force, torque, gripper force. What a period
    /// applies may still be on its way at the slew limit.
    fn excess(self, done: &Done, wrench: &Wrench) -> [f64; 3] {
        let Wrench { force_n, torque_n_m, gripper_force_n } = *wrench;
        let DeviceState { linear_velocity_m_per_s, .. } = done.ask.state;
        let everything = [force_n.length(), torque_n_m.length(), gripper_force_n.abs()];
        let of_force = |excess_n: f64| [excess_n, 0.0, 0.0];
        match self {
            // No source, no force; but a deficit of energy is worked off all the same, against the motion.
            NotFinite | Silence if done.hit(LimitsHit::PASSIVITY) => {
                let along = linear_velocity_m_per_s.normalize_or_zero();
                let damping_n = (-force_n.dot(along)).clamp(0.0, LARGEST_DAMPING_N);
                [(force_n + along * damping_n).length(), everything[1], everything[2]]
            }
            NotFinite | Silence | Disabled | Blind | Gate => everything,
            Velocity if done.applied.fault.is_some() => everything,
            Workspace => {
                let across = done.ask.state.pose.translation.with_z(0.0);
                let share = ((0.18 - across.length()) / 0.005).clamp(0.0, 1.0);
                of_force(force_n.dot(across.normalize_or_zero()) - 15.0 * share)
            }
            Power => of_force(force_n.dot(linear_velocity_m_per_s) - 10.0),
            Lowered => of_force(force_n.length() - LOWERED_N),
            Passivity | Force | Torque | Gripper | Reversal | Late | Velocity => [0.0; 3],
        }
    }
}

fn scenario(first: Rule, second: Rule) -> Vec<Done> {
    let with = |rule| first == rule || second == rule;
    // Passivity is off where it is not asked about, because it has an opinion on every motion.
    let settings = checked(with(Passivity));
    // 1 mm from the edge: a fifth of the force passes.
    let mut hand = Hand { at: if with(Workspace) { DVec3::X * 0.179 } else { DVec3::ZERO }, faulted: false };
    let mut rig = Rig::engaged(settings, still(hand.at));
    let base = Wrench {
        torque_n_m: DVec3::Z * 0.1,
        gripper_force_n: 1.0,
        ..Wrench::of_force(DVec3::new(12.0, 1.0, 0.0))
    };
    let mut records = Vec::new();
    for tick in 0..END {
        let mut ask = Ask { wrench: base, state: still(hand.at), ..Ask::default() };
        let mut lowered = false;
        // Who is silent says nothing, whatever the other rule would have said.
        let order = if first == Silence {
            [(second, SECOND), (first, FIRST)]
        } else {
            [(first, FIRST), (second, SECOND)]
        };
        for (rule, window) in order {
            if window.contains(&tick) {
                rule.trigger(&mut ask, &mut hand, tick - window.start);
                lowered |= rule == Lowered;
            }
        }
        rig.layer.set_max_force_n(if lowered { LOWERED_N } else { f64::INFINITY });
        ask.permits &= !hand.faulted;
        let done = rig.step(ask);
        hand.faulted |= done.applied.fault.is_some();
        records.push(done);
    }
    records
}

/// Whether force, torque and gripper force each moved as fast as they may.
fn moved_at_the_limit(done: &Done) -> [bool; 3] {
    let dt_s = (done.ask.after_ns as f64 * 1e-9).min(PERIOD_S);
    let (now, before) = (done.applied.wrench, done.before);
    [
        (now.force_n - before.force_n).length() > 0.999 * 2000.0 * dt_s,
        (now.torque_n_m - before.torque_n_m).length() > 0.999 * 50.0 * dt_s,
        (now.gripper_force_n - before.gripper_force_n).abs() > 0.999 * 1000.0 * dt_s,
    ]
}

#[test]
fn every_two_rules_hold_together() {
    let mut pairs = 0;
    for first in RULES {
        for second in RULES.into_iter().filter(|&second| second != first) {
            let records = scenario(first, second);
            for (rule, other, window) in [(first, second, FIRST), (second, first, SECOND)] {
                let during = || records[window.clone()].iter();
                // The first rule has a time alone; the second acts unless the first has taken the force for good.
                if !(rule == second && other.takes_the_force()) {
                    assert!(during().any(|d| rule.acted(d)), "{rule:?} did not act beside {other:?}");
                }
                for (tick, done) in during().enumerate() {
                    let (now, before) =
                        (rule.excess(done, &done.applied.wrench), rule.excess(done, &done.before));
                    for (channel, moved) in moved_at_the_limit(done).into_iter().enumerate() {
                        // Too much is only what is on its way back, and that as fast as it may.
                        let (now, before) = (now[channel], before[channel]);
                        assert!(
                            now <= 1e-9 || (moved && now < before),
                            "{rule:?} beside {other:?}, period {tick}, channel {channel}: {now} too much after {before}: \
                             {done:?}"
                        );
                    }
                }
                // What takes the force has it after 20 periods, however late they are.
                if matches!(rule, NotFinite | Silence | Disabled | Blind) {
                    assert!(
                        records[window.start + 20..window.end]
                            .iter()
                            .all(|d| d.applied.wrench == Wrench::ZERO),
                        "{rule:?} beside {other:?}"
                    );
                }
            }
            pairs += 1;
        }
    }
    assert_eq!(pairs, 15 * 14);
}

#[test]
fn a_hand_that_goes_on_with_the_force_gets_no_energy_beside_any_other_rule() {
    for other in RULES.into_iter().filter(|&rule| rule != Passivity) {
        for (first, second) in [(Passivity, other), (other, Passivity)] {
            let largest_j =
                scenario(first, second).iter().map(|d| d.energy.largest_deficit_j).fold(0.0, f64::max);
            // A handle that is thrown to 1.2 m/s within a period gets away with what the slew limit takes to fall.
            let most_j = if other == Power { 5e-3 } else { 1e-3 };
            assert!(largest_j < most_j, "{first:?}, {second:?}: {largest_j} J");
        }
    }
}
