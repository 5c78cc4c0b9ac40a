//! From the hand's pose in any frame to the force in that frame: frames, motion scale, clutch, grasp, rejected poses.
#![expect(clippy::unwrap_used, reason = "a test may fail here")]

mod common;

use common::{block, body, tissue};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use rhombus_chain::{
    Answer, Body, ChainParameters, ContactLaw, DeviceSession, HandPose, Interaction, Mode, Pose, Rejection,
    StiffnessMap, Tissue, chain_for_hand,
};

const MS: i64 = 1_000_000;
/// The block's top face is at this height, m.
const TOP_M: f64 = 0.05;

fn a_block() -> Body {
    body(block(DVec3::new(0.2, 0.2, 2.0 * TOP_M), 4))
}

/// The same, twice as stiff in the middle and stiffer to one side.
fn a_stiffer_block() -> Body {
    let body = a_block();
    let factors = body.mesh().vertices().iter().map(|p| 2.0 + 8.0 * p.x + 4.0 * p.y).collect();
    let map = StiffnessMap::new(factors, body.mesh()).unwrap();
    body.with_stiffness(map).unwrap()
}

fn hand_at(ms: i64, position: DVec3, body_from_frame: Pose) -> HandPose {
    let p = position;
    let frame_from_hand = [p.x, p.y, p.z, 0.0, 0.0, 0.0, 1.0];
    HandPose { stamp_ns: ms * MS, frame_from_hand, body_from_frame: Some(body_from_frame) }
}

/// A position over the middle of the top face with the probe pressed in by `depth_m`.
fn pressed(tissue: &Tissue, depth_m: f64) -> DVec3 {
    DVec3::new(0.01, 0.02, TOP_M + tissue.probe_radius_m() - depth_m)
}

fn force_at_depth(tissue: &Tissue, depth_m: f64) -> f64 {
    tissue.law().at_depth(depth_m).unwrap().force_n
}

/// The force that the motor loop gets from the law for the hand.
fn force_by_law(tissue: &Tissue, answer: &Answer, scale: f64, hand_in_frame: DVec3) -> DVec3 {
    let chains: Vec<ChainParameters> =
        tissue.law().chains().iter().map(|chain| chain_for_hand(chain.parameters(), scale)).collect();
    let law = ContactLaw::new(tissue.law().formulation(), &chains).unwrap();
    answer.law_for_hand.force_n(&law, hand_in_frame)
}

fn arbitrary_pose() -> impl Strategy<Value = Pose> {
    let coordinate = -0.5..0.5;
    ([coordinate.clone(), coordinate.clone(), coordinate], [-1.0..1.0, -1.0..1.0, -1.0..1.0], 0.0..6.0f64)
        .prop_map(|(t, axis, angle)| Pose {
            translation: DVec3::from_array(t),
            rotation: DQuat::from_axis_angle(
                DVec3::from_array(axis).try_normalize().unwrap_or(DVec3::Z),
                angle,
            ),
        })
}

proptest! {
    #[test]
    fn the_force_is_the_bodys_own_whatever_frame_the_pose_comes_in(body_from_frame in arbitrary_pose()) {
        let (body, tissue) = (a_block(), tissue());
        let probe = pressed(&tissue, 0.003);
        let mut interaction = Interaction::new();
        let expected = interaction.step(&body, &tissue, 0, probe, false).unwrap();
        let hand = body_from_frame.inverse().transform_point(probe);
        let mut device = DeviceSession::new(1.0);
        let answer = device.answer(&body, &tissue, &hand_at(0, hand, body_from_frame)).unwrap();
        let force_in_body = body_from_frame.rotate(answer.force_in_frame_n);
        prop_assert!(force_in_body.abs_diff_eq(expected.force_n, 1e-9), "{force_in_body} {}", expected.force_n);
        prop_assert!(force_by_law(&tissue, &answer, 1.0, hand).abs_diff_eq(answer.force_in_frame_n, 1e-9));
    }

    #[test]
    fn the_law_for_the_hand_gives_the_force_at_any_scale_and_clutch_offset(
        scale in 0.2..5.0f64,
        slip in [-0.1..0.1f64, -0.1..0.1, -0.1..0.1],
        body_from_frame in arbitrary_pose(),
        grasp: bool,
        mapped: bool,
    ) {
        let (body, tissue) = (if mapped { a_stiffer_block() } else { a_block() }, tissue());
        let mut device = DeviceSession::new(scale);
        let hand = body_from_frame.inverse().transform_point(pressed(&tissue, 0.004)) / scale;
        device.command_grasp(grasp);
        device.answer(&body, &tissue, &hand_at(0, hand, body_from_frame)).unwrap();
        device.set_clutched(true);
        let elsewhere = hand + DVec3::from_array(slip);
        device.answer(&body, &tissue, &hand_at(1, elsewhere, body_from_frame)).unwrap();
        device.set_clutched(false);
        let moved = elsewhere + body_from_frame.inverse().rotate(DVec3::new(0.001, 0.0, -0.0005)) / scale;
        let answer = device.answer(&body, &tissue, &hand_at(2, moved, body_from_frame)).unwrap();
        prop_assert_eq!(answer.step.mode, if grasp { Mode::Grasp } else { Mode::Contact });
        let by_law = force_by_law(&tissue, &answer, scale, moved);
        prop_assert!(by_law.abs_diff_eq(answer.force_in_frame_n, 1e-9), "{by_law} {}", answer.force_in_frame_n);
        if !grasp {
            // The side is flat and its stiffness linear, so the law is right beside its pose too.
            let aside = moved + body_from_frame.inverse().rotate(DVec3::new(-0.003, 0.002, -0.001)) / scale;
            let by_law = force_by_law(&tissue, &answer, scale, aside);
            let there = device.answer(&body, &tissue, &hand_at(3, aside, body_from_frame)).unwrap();
            prop_assert!(by_law.abs_diff_eq(there.force_in_frame_n, 1e-9), "{by_law} {}", there.force_in_frame_n);
        }
    }
}

#[test]
fn the_motion_scale_stretches_the_hands_way_and_not_the_force() {
    let (body, tissue) = (a_block(), tissue());
    let mut device = DeviceSession::new(2.0);
    let hand = pressed(&tissue, 0.003) / 2.0;
    let answer = device.answer(&body, &tissue, &hand_at(0, hand, Pose::IDENTITY)).unwrap();
    assert!((answer.step.depth_m - 0.003).abs() < 1e-12);
    assert!((answer.force_in_frame_n.z - force_at_depth(&tissue, 0.003)).abs() < 1e-9);
}

#[test]
fn the_clutch_freezes_probe_and_force_and_the_motion_goes_on_from_there() {
    let (body, tissue) = (a_block(), tissue());
    let mut device = DeviceSession::new(1.0);
    let hand = pressed(&tissue, 0.003);
    let pressed = device.answer(&body, &tissue, &hand_at(0, hand, Pose::IDENTITY)).unwrap();
    device.set_clutched(true);
    for ms in 1..20 {
        let away = hand + DVec3::new(0.002, 0.001, 0.005) * ms as f64;
        let held = device.answer(&body, &tissue, &hand_at(ms, away, Pose::IDENTITY)).unwrap();
        assert!(held.clutched);
        assert_eq!(
            (held.probe_in_body, held.force_in_frame_n),
            (pressed.probe_in_body, pressed.force_in_frame_n)
        );
    }
    device.set_clutched(false);
    let away = hand + DVec3::new(0.038, 0.019, 0.095);
    let released = device.answer(&body, &tissue, &hand_at(20, away, Pose::IDENTITY)).unwrap();
    assert!(released.probe_in_body.abs_diff_eq(pressed.probe_in_body, 1e-12), "no jump on release");
    let deeper =
        device.answer(&body, &tissue, &hand_at(21, away - DVec3::Z * 0.001, Pose::IDENTITY)).unwrap();
    assert!((deeper.step.depth_m - 0.004).abs() < 1e-9, "{}", deeper.step.depth_m);
}

#[test]
fn gripper_or_command_hold_the_surface_until_both_let_go() {
    let (body, tissue) = (a_block(), tissue());
    let mut device = DeviceSession::new(1.0);
    let hand = pressed(&tissue, 0.003);
    let mode_at = |device: &mut DeviceSession, ms| {
        device.answer(&body, &tissue, &hand_at(ms, hand, Pose::IDENTITY)).unwrap().step.mode
    };
    assert_eq!(mode_at(&mut device, 0), Mode::Contact);
    device.set_gripper_closed(true);
    assert_eq!(mode_at(&mut device, 1), Mode::Grasp);
    device.command_grasp(true);
    device.set_gripper_closed(false);
    assert_eq!(mode_at(&mut device, 2), Mode::Grasp);
    device.command_grasp(false);
    assert_eq!(mode_at(&mut device, 3), Mode::Contact);
}

#[test]
fn a_rejected_pose_names_its_cause_resets_the_contact_and_the_device_lives_on() {
    let (body, tissue) = (a_block(), tissue());
    let hand = pressed(&tissue, 0.003);
    let good = |ms| hand_at(ms, hand, Pose::IDENTITY);
    let with = |index: usize, value: f64| {
        let mut pose = good(11);
        pose.frame_from_hand[index] = value;
        pose
    };
    let cases = [
        (with(0, f64::NAN), "not_finite"),
        (with(2, f64::INFINITY), "not_finite"),
        (with(6, f64::NAN), "not_finite"),
        (with(6, 1.002), "not_unit_quaternion"),
        (with(6, 0.0), "not_unit_quaternion"),
        (HandPose { body_from_frame: None, ..good(11) }, "unknown_frame"),
        (good(9), "stamp_backwards"),
        (with(1, 1e300), "out_of_reach"),
    ];
    for (bad, cause) in cases {
        let mut device = DeviceSession::new(1.0);
        device.answer(&body, &tissue, &good(10)).unwrap();
        assert_eq!(device.impressions().count(), 1);
        let rejection = device.answer(&body, &tissue, &bad).unwrap_err();
        assert_eq!(Rejection::CAUSES[rejection.cause()], cause, "{rejection}");
        assert_eq!(device.impressions().count(), 0, "{cause}: the contact is reset");
        let answer = device.answer(&body, &tissue, &good(12)).unwrap();
        assert!(answer.force_in_frame_n.z > 0.0, "{cause}: the next pose is answered");
    }
}

#[test]
fn stamps_that_keep_going_back_are_each_rejected_and_a_new_time_line_is_taken_up() {
    let (body, tissue) = (a_block(), tissue());
    let mut device = DeviceSession::new(1.0);
    let mut accepted = |ms| device.answer(&body, &tissue, &hand_at(ms, DVec3::ZERO, Pose::IDENTITY)).is_ok();
    let line = [100, 100, 101, 50, 49, 48, 48, 60];
    assert_eq!(line.map(&mut accepted), [true, true, true, false, false, false, true, true]);
}
