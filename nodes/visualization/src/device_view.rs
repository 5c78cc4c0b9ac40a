//! What is known of one device: the newest of each message, checked at the door and forgotten when it is old.

use std::time::{Duration, Instant};

use glam::DVec3;
use rhombus_chain::Pose;

use crate::drawing::is_drawable;

/// What was not heard again for this long is no longer shown.
const FORGET_AFTER: Duration = Duration::from_secs(1);

/// The contact as the model sees it. Positions and directions in `frame_id`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Contact {
    pub(crate) frame_id: String,
    pub(crate) mode: Mode,
    pub(crate) saturated: bool,
    pub(crate) clutched: bool,
    /// Centre of the probe.
    pub(crate) probe_m: DVec3,
    /// The contact point on the rest surface.
    pub(crate) proxy_m: DVec3,
    /// Out of the body; a unit vector while something is touched.
    pub(crate) normal: DVec3,
    /// Positive into the body.
    pub(crate) depth_m: f64,
    /// On the hand, along the normal.
    pub(crate) force_n: f64,
    /// Change of force for each metre of depth.
    pub(crate) stiffness_n_per_m: f64,
    /// Stamp of the pose that it was computed from, ns.
    pub(crate) stamp_ns: i64,
}

/// What the probe does with the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    None,
    Touch,
    Grasp,
}

impl Contact {
    fn is_drawable(&self) -> bool {
        let touch = || {
            is_drawable(self.proxy_m)
                && is_drawable(self.normal * self.depth_m)
                && self.normal.is_normalized()
                && self.force_n.is_finite()
                && self.stiffness_n_per_m.is_finite()
        };
        !self.frame_id.is_empty() && is_drawable(self.probe_m) && (self.mode == Mode::None || touch())
    }

    /// Where the contact point is now, with its displacement `scale` times as large. A grasped point also follows the
    /// probe along the surface.
    pub(crate) fn displaced_m(&self, scale: f64) -> DVec3 {
        let lateral_m = match self.mode {
            Mode::Grasp => (self.probe_m - self.proxy_m).reject_from_normalized(self.normal),
            Mode::None | Mode::Touch => DVec3::ZERO,
        };
        self.proxy_m + (lateral_m - self.normal * self.depth_m) * scale
    }
}

/// A value in a frame.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InFrame<T> {
    pub(crate) frame_id: String,
    pub(crate) value: T,
}

/// A message that was not drawn because something in it is NaN, infinite, absurdly far away or not of unit length, or
/// because it names no frame.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct NotDrawable;

/// The newest of every topic of one device.
#[derive(Debug, Default)]
pub(crate) struct DeviceView {
    contact: Option<(Instant, Contact)>,
    commanded_n: Option<(Instant, InFrame<DVec3>)>,
    #[cfg(feature = "viewer")]
    applied_n: Option<(Instant, InFrame<DVec3>)>,
    pose: Option<(Instant, InFrame<Pose>)>,
    revision: u64,
}

impl DeviceView {
    pub(crate) fn hear_contact(&mut self, now: Instant, contact: Contact) -> Result<(), NotDrawable> {
        if !contact.is_drawable() {
            return Err(NotDrawable);
        }
        self.contact = Some((now, contact));
        self.revision += 1;
        Ok(())
    }

    /// The force that the model commands for the hand.
    pub(crate) fn hear_command(&mut self, now: Instant, force_n: InFrame<DVec3>) -> Result<(), NotDrawable> {
        self.commanded_n = Some((now, drawable(force_n)?));
        self.revision += 1;
        Ok(())
    }

    /// The force on the hand, as the driver says that the motors apply it.
    #[cfg(feature = "viewer")]
    pub(crate) fn hear_applied(&mut self, now: Instant, force_n: InFrame<DVec3>) -> Result<(), NotDrawable> {
        self.applied_n = Some((now, drawable(force_n)?));
        Ok(())
    }

    /// The device's pose: `[x, y, z, qx, qy, qz, qw]`.
    pub(crate) fn hear_pose(
        &mut self,
        now: Instant,
        frame_id: String,
        pose: [f64; 7],
    ) -> Result<(), NotDrawable> {
        let Ok(value) = Pose::from_array(pose) else { return Err(NotDrawable) };
        if frame_id.is_empty() || !is_drawable(value.translation) {
            return Err(NotDrawable);
        }
        self.pose = Some((now, InFrame { frame_id, value }));
        self.revision += 1;
        Ok(())
    }

    /// Grows with everything heard.
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    /// The contact, unless it is old.
    pub(crate) fn contact(&self, now: Instant) -> Option<&Contact> {
        fresh(&self.contact, now)
    }

    /// The contact while something is touched.
    pub(crate) fn touch(&self, now: Instant) -> Option<&Contact> {
        self.contact(now).filter(|contact| contact.mode != Mode::None)
    }

    /// When the newest contact came, however old it is.
    #[cfg(feature = "viewer")]
    pub(crate) fn contact_heard(&self) -> Option<Instant> {
        self.contact.as_ref().map(|(when, _)| *when)
    }

    /// When the newest pose came, however old it is.
    #[cfg(feature = "viewer")]
    pub(crate) fn pose_heard(&self) -> Option<Instant> {
        self.pose.as_ref().map(|(when, _)| *when)
    }

    /// The device's own pose, unless it is old.
    #[cfg(feature = "viewer")]
    pub(crate) fn pose(&self, now: Instant) -> Option<&InFrame<Pose>> {
        fresh(&self.pose, now)
    }

    /// The force that the model commands, unless it is old.
    pub(crate) fn commanded_n(&self, now: Instant) -> Option<&InFrame<DVec3>> {
        fresh(&self.commanded_n, now)
    }

    /// The force that the motors apply, unless it is old.
    #[cfg(feature = "viewer")]
    pub(crate) fn applied_n(&self, now: Instant) -> Option<&InFrame<DVec3>> {
        fresh(&self.applied_n, now)
    }

    /// Where the probe is: as the model has it (which knows the clutch and the motion's scale), turned like the
    /// device; before the model answers, as the device has it.
    pub(crate) fn probe(&self, now: Instant) -> Option<InFrame<Pose>> {
        let pose = fresh(&self.pose, now);
        let Some(contact) = self.contact(now) else { return pose.cloned() };
        let turned = pose.filter(|pose| pose.frame_id == contact.frame_id);
        let rotation = turned.map_or(Pose::IDENTITY.rotation, |pose| pose.value.rotation);
        let value = Pose { translation: contact.probe_m, rotation };
        Some(InFrame { frame_id: contact.frame_id.clone(), value })
    }
}

fn drawable(force_n: InFrame<DVec3>) -> Result<InFrame<DVec3>, NotDrawable> {
    let is_drawable = !force_n.frame_id.is_empty() && is_drawable(force_n.value);
    if is_drawable { Ok(force_n) } else { Err(NotDrawable) }
}

fn fresh<T>(heard: &Option<(Instant, T)>, now: Instant) -> Option<&T> {
    heard.as_ref().filter(|(when, _)| now.duration_since(*when) < FORGET_AFTER).map(|(_, value)| value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(mode: Mode) -> Contact {
        Contact {
            frame_id: "base".to_owned(),
            mode,
            saturated: false,
            clutched: false,
            probe_m: DVec3::new(0.003, 0.0, 0.101),
            proxy_m: DVec3::new(0.0, 0.0, 0.1),
            normal: DVec3::Z,
            depth_m: 0.004,
            force_n: 0.4,
            stiffness_n_per_m: 100.0,
            stamp_ns: 0,
        }
    }

    #[test]
    fn the_contact_point_is_moved_by_exactly_the_depth() {
        assert_eq!(contact(Mode::Touch).displaced_m(1.0), DVec3::new(0.0, 0.0, 0.1 - 0.004));
        assert_eq!(contact(Mode::Grasp).displaced_m(1.0), DVec3::new(0.003, 0.0, 0.1 - 0.004));
    }

    #[test]
    fn what_cannot_be_drawn_is_refused_and_changes_nothing() {
        let (mut view, now) = (DeviceView::default(), Instant::now());
        view.hear_contact(now, contact(Mode::Touch)).unwrap();
        let revision = view.revision();
        let wrong = [
            Contact { probe_m: DVec3::NAN, ..contact(Mode::None) },
            Contact { proxy_m: DVec3::new(0.0, f64::INFINITY, 0.0), ..contact(Mode::Touch) },
            Contact { normal: DVec3::ZERO, ..contact(Mode::Touch) },
            Contact { depth_m: f64::NAN, ..contact(Mode::Grasp) },
            Contact { depth_m: 1e9, ..contact(Mode::Grasp) },
            Contact { force_n: f64::NAN, ..contact(Mode::Touch) },
            Contact { stiffness_n_per_m: f64::INFINITY, ..contact(Mode::Touch) },
            Contact { frame_id: String::new(), ..contact(Mode::None) },
        ];
        for wrong in wrong {
            assert_eq!(view.hear_contact(now, wrong), Err(NotDrawable));
        }
        let base = || "base".to_owned();
        assert!(view.hear_command(now, InFrame { frame_id: base(), value: DVec3::NAN }).is_err());
        assert!(view.hear_pose(now, base(), [0.0; 7]).is_err());
        assert!(view.hear_pose(now, base(), [0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0, 1.0]).is_err());
        assert_eq!((view.revision(), view.contact(now)), (revision, Some(&contact(Mode::Touch))));
        assert!(view.commanded_n(now).is_none());
    }

    #[test]
    fn a_silent_device_is_forgotten() {
        let (mut view, start) = (DeviceView::default(), Instant::now());
        view.hear_contact(start, contact(Mode::Touch)).unwrap();
        assert!(view.touch(start + Duration::from_millis(900)).is_some());
        let late = start + Duration::from_millis(1100);
        assert!(view.touch(late).is_none() && view.probe(late).is_none());
    }

    #[test]
    fn the_probe_stands_where_the_model_has_it_and_turns_as_the_device_does() {
        let (mut view, now) = (DeviceView::default(), Instant::now());
        view.hear_pose(now, "base".to_owned(), [9.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]).unwrap();
        assert_eq!(view.probe(now).unwrap().value.translation, DVec3::new(9.0, 0.0, 0.0));
        view.hear_contact(now, contact(Mode::None)).unwrap();
        let probe = view.probe(now).unwrap();
        assert_eq!((probe.value.translation, probe.value.rotation.x), (contact(Mode::None).probe_m, 1.0));
    }
}
