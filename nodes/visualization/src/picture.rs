//! From what is known to what is sent: the drawings that changed, and the markers that are no longer true.

use std::time::Instant;

use rhombus_chain::ContactLaw;

use crate::colour::ColourScale;
use crate::device_view::DeviceView;
use crate::drawing::{self, Drawing, Key, Thing};
use crate::outbox::Outbox;
use crate::rhombi::{ChainShape, Fan};
use crate::surface::BodySurface;

/// How things look: the parameters of the picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Look {
    pub(crate) full_scale_m: f64,
    pub(crate) displacement_scale: f64,
    pub(crate) force_scale_m_per_n: f64,
    pub(crate) probe_radius_m: f64,
    /// The chains to draw at each contact; none draws none.
    pub(crate) law: Option<ContactLaw>,
}

/// What to tell the readers.
#[derive(Debug, Default)]
pub(crate) struct Update {
    pub(crate) drawings: Vec<Drawing>,
    pub(crate) deleted: Vec<Key>,
}

impl Update {
    pub(crate) fn is_empty(&self) -> bool {
        self.drawings.is_empty() && self.deleted.is_empty()
    }
}

/// Draws one scene. Knows what the readers have and sends no more than needed.
#[derive(Debug)]
pub(crate) struct Picture {
    look: Look,
    body_frame_id: String,
    colours: ColourScale,
    fans: Vec<Fan>,
    outbox: Outbox,
}

impl Picture {
    pub(crate) fn new(look: Look, body_frame_id: String, devices: usize) -> Picture {
        let fans = vec![Fan::new(); devices];
        Picture { look, body_frame_id, colours: ColourScale::new(), fans, outbox: Outbox::default() }
    }

    /// Change the parameters; everything is sent again.
    pub(crate) fn set_look(&mut self, look: Look) {
        self.look = look;
        self.outbox.repeat_all();
    }

    /// Send everything again, for a new reader.
    pub(crate) fn repeat_all(&mut self) {
        self.outbox.repeat_all();
    }

    /// The next update. The surface comes with a number that grows when it changes.
    pub(crate) fn update(
        &mut self,
        now: Instant,
        surface: Option<(&BodySurface, u64)>,
        devices: &[DeviceView],
    ) -> Update {
        let mut turn = Turn { now, look: &self.look, outbox: &mut self.outbox, drawings: Vec::new() };
        if let Some((surface, revision)) = surface {
            turn.body(surface, revision, &self.body_frame_id, &self.colours);
        }
        for ((device, fan), id) in devices.iter().zip(&mut self.fans).zip(0..) {
            turn.probe_and_force(device, id);
            turn.touch(device, id, fan);
        }
        Update { drawings: turn.drawings, deleted: self.outbox.finish() }
    }
}

/// One update in the making.
struct Turn<'a> {
    now: Instant,
    look: &'a Look,
    outbox: &'a mut Outbox,
    drawings: Vec<Drawing>,
}

impl Turn<'_> {
    fn wants(&mut self, thing: Thing, id: i32, revision: u64) -> bool {
        self.outbox.wants(Key { thing, id }, revision, self.now)
    }

    fn body(&mut self, surface: &BodySurface, revision: u64, frame_id: &str, colours: &ColourScale) {
        if self.wants(Thing::Body, 0, revision) {
            let &Look { full_scale_m, displacement_scale, .. } = self.look;
            self.drawings.push(drawing::body(surface, frame_id, colours, full_scale_m, displacement_scale));
        }
    }

    fn probe_and_force(&mut self, device: &DeviceView, id: i32) {
        let Some(probe) = device.probe(self.now) else { return };
        let contact = device.contact(self.now);
        let (centre_m, radius_m) = (probe.value.translation, self.look.probe_radius_m);
        if self.wants(Thing::Probe, id, device.revision()) {
            let clutched = contact.is_some_and(|contact| contact.clutched);
            self.drawings.push(drawing::probe(id, &probe.frame_id, centre_m, radius_m, clutched));
        }
        // A force in another frame than the probe belongs to no pose that is known here.
        let force_n = device.commanded_n(self.now).filter(|force_n| force_n.frame_id == probe.frame_id);
        let Some(force_n) = force_n else { return };
        let arrow_m = force_n.value * self.look.force_scale_m_per_n;
        let saturated = contact.is_some_and(|contact| contact.saturated);
        if let Some(arrow) = drawing::force(id, &probe.frame_id, centre_m, arrow_m, radius_m, saturated)
            && self.wants(Thing::Force, id, device.revision())
        {
            self.drawings.push(arrow);
        }
    }

    fn touch(&mut self, device: &DeviceView, id: i32, fan: &mut Fan) {
        let Some(touch) = device.touch(self.now) else { return };
        if self.wants(Thing::Proxy, id, device.revision()) {
            self.drawings.push(drawing::proxy(id, &touch.frame_id, touch.proxy_m, self.look.probe_radius_m));
        }
        let Some(law) = &self.look.law else { return };
        let shapes: Vec<ChainShape> =
            law.chains().iter().map(|chain| ChainShape::at_depth(chain, touch.depth_m)).collect();
        let contact_m = touch.displaced_m(self.look.displacement_scale);
        let directions = fan.directions(touch.normal, drawing::rows(shapes.len()));
        for part in drawing::chains(id, &touch.frame_id, &shapes, contact_m, touch.normal, &directions) {
            if self.outbox.wants(part.key, device.revision(), self.now) {
                self.drawings.push(part);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device_view::{Contact, InFrame, Mode};
    use glam::DVec3;
    use std::time::Duration;

    const TURN: Duration = Duration::from_millis(33);

    fn picture() -> Picture {
        let look = Look {
            full_scale_m: 0.005,
            displacement_scale: 1.0,
            force_scale_m_per_n: 0.02,
            probe_radius_m: 0.005,
            law: None,
        };
        Picture::new(look, "body".to_owned(), 1)
    }

    fn surface() -> BodySurface {
        BodySurface::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]], 1).unwrap()
    }

    fn device(now: Instant, mode: Mode) -> DeviceView {
        let mut device = DeviceView::default();
        let contact = Contact {
            frame_id: "base".to_owned(),
            mode,
            saturated: false,
            clutched: false,
            probe_m: DVec3::Z,
            proxy_m: DVec3::ZERO,
            normal: DVec3::Z,
            depth_m: 0.003,
            force_n: 0.3,
            stiffness_n_per_m: 100.0,
            stamp_ns: 0,
        };
        device.hear_contact(now, contact).unwrap();
        let force_n = if mode == Mode::None { DVec3::ZERO } else { DVec3::Z };
        device.hear_command(now, InFrame { frame_id: "base".to_owned(), value: force_n }).unwrap();
        device
    }

    fn things(update: &Update) -> Vec<&str> {
        update.drawings.iter().map(|drawing| drawing.key.thing.name()).collect()
    }

    #[test]
    fn what_belongs_to_a_contact_is_deleted_when_the_probe_leaves() {
        let (mut picture, now) = (picture(), Instant::now());
        let update = picture.update(now, None, &[device(now, Mode::Touch)]);
        assert_eq!(things(&update), ["probe", "force", "proxy"]);
        let update = picture.update(now + TURN, None, &[device(now, Mode::None)]);
        let deleted: Vec<&str> = update.deleted.iter().map(|key| key.thing.name()).collect();
        assert_eq!(deleted, ["force", "proxy"]);
    }

    #[test]
    fn the_body_is_sent_again_only_when_it_changed_or_is_asked_for() {
        let (mut picture, surface, now) = (picture(), surface(), Instant::now());
        assert_eq!(things(&picture.update(now, Some((&surface, 1)), &[])), ["body"]);
        assert!(picture.update(now + TURN, Some((&surface, 1)), &[]).is_empty());
        assert_eq!(things(&picture.update(now + 2 * TURN, Some((&surface, 2)), &[])), ["body"]);
        picture.repeat_all();
        assert_eq!(things(&picture.update(now + 3 * TURN, Some((&surface, 2)), &[])), ["body"]);
    }

    #[test]
    fn a_force_in_another_frame_than_the_probe_is_not_drawn() {
        let (mut picture, now) = (picture(), Instant::now());
        let mut device = device(now, Mode::Touch);
        device.hear_command(now, InFrame { frame_id: "elsewhere".to_owned(), value: DVec3::Z }).unwrap();
        assert_eq!(things(&picture.update(now, None, &[device])), ["probe", "proxy"]);
    }
}
