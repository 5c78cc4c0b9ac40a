//! What RViz gets: markers while somebody reads them, transforms while somebody hears them.

use std::time::{Duration, Instant};

use node_kit::{Level, NodeKit, Publisher, Status, topics};
use r2r::visualization_msgs::msg::MarkerArray;
use scene::{Scene, SceneError, VisualizationSettings};

use crate::inputs::{Inputs, NotDrawn};
use crate::messages;
use crate::picture::{Look, Picture};
use crate::transforms::Transforms;

/// From what is heard to what RViz shows.
pub(crate) struct Markers {
    picture: Picture,
    transforms: Transforms,
    markers: Publisher<MarkerArray>,
    rate_hz: f64,
    due: Instant,
    /// Readers of the markers at the last turn.
    readers: usize,
    counts: Counts,
    /// What the last diagnostics said.
    reported: NotDrawn,
}

/// What was done since the start.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counts {
    /// Pictures made, whether or not anything in them had changed.
    pub(crate) pictures: u64,
    /// Marker messages published.
    pub(crate) messages: u64,
}

impl Markers {
    /// Say where body and devices stand, and offer the markers.
    pub(crate) fn new(kit: &mut NodeKit, scene: &Scene) -> anyhow::Result<Markers> {
        let body_frame_id = kit.frame_id(&scene.body.frame_id);
        Ok(Markers {
            picture: Picture::new(look(scene)?, body_frame_id, scene.session.devices.len()),
            transforms: Transforms::new(kit, scene)?,
            markers: kit.publish(&topics::MARKERS, "")?,
            rate_hz: scene.visualization.rate_hz,
            due: Instant::now(),
            readers: 0,
            counts: Counts::default(),
            reported: NotDrawn::default(),
        })
    }

    /// When the next picture is due; never at rate 0.
    pub(crate) fn due(&self) -> Option<Instant> {
        period(self.rate_hz).map(|_| self.due)
    }

    /// Take over parameters that were set while the node runs.
    pub(crate) fn retune(&mut self, scene: &Scene, now: Instant) -> Result<(), SceneError> {
        self.picture.set_look(look(scene)?);
        self.rate_hz = scene.visualization.rate_hz;
        self.due = now;
        Ok(())
    }

    /// When it is time: transforms for those who hear them, a picture for those who look.
    pub(crate) fn turn(&mut self, now: Instant, inputs: &mut Inputs) -> anyhow::Result<()> {
        if let Some(period) = period(self.rate_hz)
            && now >= self.due
        {
            self.show(now, inputs)?;
            // A turn that came late does not make the next ones hurry.
            self.due = (self.due + period).max(now);
        }
        Ok(())
    }

    fn show(&mut self, now: Instant, inputs: &mut Inputs) -> anyhow::Result<()> {
        let readers = self.markers.readers();
        let transforms_are_read = self.transforms.are_read();
        if readers > 0 || transforms_are_read {
            inputs.look_at_devices();
        }
        if transforms_are_read {
            self.publish_probes(now, inputs)?;
        }
        if readers > self.readers {
            self.picture.repeat_all();
        }
        self.readers = readers;
        if readers > 0 {
            inputs.look_at_surface();
            let update = self.picture.update(now, inputs.surface(), inputs.views());
            self.counts.pictures += 1;
            if !update.is_empty() {
                self.markers.publish(&messages::marker_array(update))?;
                self.counts.messages += 1;
            }
        }
        Ok(())
    }

    fn publish_probes(&self, now: Instant, inputs: &Inputs) -> anyhow::Result<()> {
        let probes: Vec<_> = inputs
            .views()
            .iter()
            .zip(inputs.stamps_ns())
            .map(|(view, stamp_ns)| Some((stamp_ns, view.probe(now)?)))
            .collect();
        Ok(self.transforms.publish_probes(&probes)?)
    }

    /// For diagnostics.
    pub(crate) fn status(&mut self, inputs: &Inputs) -> Status {
        let not_drawn = inputs.not_drawn();
        let (level, summary) = if not_drawn != self.reported {
            (Level::Warn, "messages that cannot be drawn arrive")
        } else if self.readers == 0 {
            (Level::Ok, "nobody reads the markers: nothing is drawn")
        } else if inputs.surface().is_none() {
            (Level::Ok, "no body_mesh yet")
        } else {
            (Level::Ok, "drawing")
        };
        self.reported = not_drawn;
        Status::new(level, "markers", summary)
            .with("readers", self.readers)
            .with("pictures", self.counts.pictures)
            .with("messages", self.counts.messages)
            .with("moved_vertices", inputs.surface().map_or(0, |(surface, _)| surface.moved()))
            .with("not_drawable", not_drawn.not_drawable)
            .with("other_mesh", not_drawn.other_mesh)
    }

    pub(crate) fn counts(&self) -> Counts {
        self.counts
    }
}

/// The parameters of the picture. Without `chains.*` there are no chains to draw.
pub(crate) fn look(scene: &Scene) -> Result<Look, SceneError> {
    let VisualizationSettings { full_scale_m, displacement_scale, force_scale_m_per_n, show_chains, .. } =
        scene.visualization;
    let law = if show_chains && scene.chains.is_some() { Some(scene.law()?) } else { None };
    let probe_radius_m = scene.probe.radius_m;
    Ok(Look { full_scale_m, displacement_scale, force_scale_m_per_n, probe_radius_m, law })
}

/// Time between two pictures; none at rate 0, or one so small that it will never come.
fn period(rate_hz: f64) -> Option<Duration> {
    Duration::try_from_secs_f64(1.0 / rate_hz).ok()
}
