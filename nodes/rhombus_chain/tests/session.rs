//! A session: several devices on one body, frames that are heard, surfaces at a rate of stamps.

mod common;

use common::{block, body, tissue};
use glam::DVec3;
use proptest::prelude::*;
use rhombus_chain::{
    Answer, FrameTree, MeasuredPose, Mode, Rejection, Session, SessionParts, StampRate, SurfaceField,
};

const MS: i64 = 1_000_000;
/// The block's top face is at this height, m.
const TOP_M: f64 = 0.05;

fn session(devices: usize, surface_hz: f64) -> Session {
    let (body, tissue) = (body(block(DVec3::new(0.2, 0.2, 2.0 * TOP_M), 4)), tissue());
    let surface = StampRate::new(surface_hz).map(|rate| (rate, SurfaceField::new(&body, &tissue)));
    Session::new(SessionParts {
        body,
        tissue,
        body_frame: "body".to_owned(),
        frames: FrameTree::new(),
        devices,
        motion_scale: 1.0,
        close_below_rad: 0.2,
        surface,
    })
}

fn answer(
    session: &mut Session,
    device: usize,
    ms: i64,
    frame_id: &str,
    position: DVec3,
) -> Result<Answer, Rejection> {
    let p = position;
    let frame_from_hand = [p.x, p.y, p.z, 0.0, 0.0, 0.0, 1.0];
    session.answer(device, &MeasuredPose { stamp_ns: ms * MS, frame_id, frame_from_hand })
}

/// Over the top face with the probe pressed in by `depth_m`.
fn pressed(x_m: f64, depth_m: f64) -> DVec3 {
    DVec3::new(x_m, 0.02, TOP_M + tissue().probe_radius_m() - depth_m)
}

#[test]
fn a_pose_is_placed_by_the_frames_that_were_heard_last() {
    let mut session = session(1, 0.0);
    let hand = pressed(0.01, 0.003);
    assert_eq!(answer(&mut session, 0, 0, "arm", hand).unwrap_err(), Rejection::UnknownFrame);
    session.hear_transform("body", "arm", [0.0, 0.0, 0.001, 0.0, 0.0, 0.0, 1.0]);
    assert!((answer(&mut session, 0, 1, "arm", hand).unwrap().step.depth_m - 0.002).abs() < 1e-12);
    assert!((answer(&mut session, 0, 2, "/arm", hand).unwrap().step.depth_m - 0.002).abs() < 1e-12);
    session.hear_transform("body", "arm", [0.0, 0.0, 0.002, 0.0, 0.0, 0.0, 1.0]);
    assert!((answer(&mut session, 0, 3, "/arm", hand).unwrap().step.depth_m - 0.001).abs() < 1e-12);
    assert!((answer(&mut session, 0, 4, "body", hand).unwrap().step.depth_m - 0.003).abs() < 1e-12);
}

#[test]
fn a_gripper_below_its_angle_and_a_commanded_grasp_both_hold_the_surface() {
    let mut session = session(1, 0.0);
    let mode =
        |session: &mut Session, ms| answer(session, 0, ms, "body", pressed(0.01, 0.002)).unwrap().step.mode;
    assert_eq!(mode(&mut session, 0), Mode::Contact);
    assert!(session.hear_gripper(0, Some(0.1)));
    assert_eq!(mode(&mut session, 1), Mode::Grasp);
    assert!(session.hear_gripper(0, Some(0.3)));
    assert_eq!(mode(&mut session, 2), Mode::Contact);
    session.command_grasp(0, true);
    assert_eq!(mode(&mut session, 3), Mode::Grasp);
}

#[test]
fn what_says_nothing_changes_nothing() {
    let mut session = session(1, 0.0);
    assert!(!session.hear_gripper(0, None) && !session.hear_gripper(0, Some(f64::NAN)));
    assert!(!session.hear_clutch(0, None));
    assert!(!session.hear_gripper(1, Some(0.0)), "there is no such device");
    assert_eq!(answer(&mut session, 1, 0, "body", DVec3::ZERO).unwrap_err(), Rejection::UnknownFrame);
    assert_eq!(answer(&mut session, 0, 0, "body", pressed(0.01, 0.002)).unwrap().step.mode, Mode::Contact);
}

#[test]
fn the_surface_is_due_at_its_rate_of_stamps_and_never_without_one() {
    for (rate_hz, expected) in [(0.0, 0), (50.0, 50), (1000.0, 1000)] {
        let mut session = session(1, rate_hz);
        let mut surfaces = 0;
        for ms in 0..1000 {
            answer(&mut session, 0, ms, "body", pressed(0.01, 0.002)).unwrap();
            surfaces += usize::from(session.surface_if_due().is_some());
            assert!(session.surface_if_due().is_none(), "once for each stamp");
        }
        assert_eq!(surfaces, expected);
    }
}

proptest! {
    /// Each hand feels the body as if it were alone.
    #[test]
    fn the_force_on_one_hand_does_not_depend_on_the_other(
        depths in prop::collection::vec((-0.002..0.006f64, -0.002..0.006f64), 1..40),
    ) {
        let (mut both, mut left, mut right) = (session(2, 60.0), session(1, 0.0), session(1, 0.0));
        for (ms, (left_m, right_m)) in depths.into_iter().enumerate() {
            let ms = ms as i64;
            for (device, alone, at) in [(0, &mut left, pressed(-0.03, left_m)), (1, &mut right, pressed(0.03, right_m))] {
                let together = answer(&mut both, device, ms, "body", at).unwrap();
                prop_assert_eq!(together, answer(alone, 0, ms, "body", at).unwrap());
                both.surface_if_due();
            }
        }
    }
}
