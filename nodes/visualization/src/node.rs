//! The loop: wait for the next picture, take the newest of every topic, draw if somebody looks.

use std::time::{Duration, Instant};

use anyhow::Context;
use node_kit::{Level, NodeKit, Publisher, Status, topics};
use r2r::visualization_msgs::msg::MarkerArray;
use scene::{Scene, SceneError, VisualizationSettings};

use crate::inputs::{Inputs, NotDrawn};
use crate::messages;
use crate::picture::{Look, Picture};
use crate::transforms::Transforms;

/// Parameters and signals are looked after at least this often, however few pictures are wanted.
const LONGEST_PAUSE: Duration = Duration::from_millis(50);

/// Run the node until it is asked to end.
pub(crate) fn run(kit: &mut NodeKit) -> anyhow::Result<()> {
    let scene = Scene::from_parameters(kit.parameters().clone())?;
    kit.check_changes(Box::new(|values, _| {
        let look = Scene::from_parameters(values.clone()).and_then(|scene| look(&scene));
        look.map(|_| ()).map_err(|error| error.to_string())
    }));
    let mut rate_hz = scene.visualization.rate_hz;
    let inputs = Inputs::new(kit, &scene.session.devices)?;
    let body_frame_id = kit.frame_id(&scene.body.frame_id);
    let mut viewer = Viewer {
        picture: Picture::new(look(&scene)?, body_frame_id, scene.session.devices.len()),
        transforms: Transforms::new(kit, &scene)?,
        markers: kit.publish(&topics::MARKERS, "")?,
        inputs,
        readers: 0,
        counts: Counts::default(),
        reported: NotDrawn::default(),
    };
    kit.ready(&format!("markers at {} Hz while somebody reads them", rate_hz));

    let mut due = Instant::now();
    while kit.is_running() {
        let now = Instant::now();
        let pause = period(rate_hz).map_or(LONGEST_PAUSE, |_| due.saturating_duration_since(now));
        // Not in the spin: that would wake for every message, and only the newest at the end of the pause counts.
        std::thread::sleep(pause.min(LONGEST_PAUSE));
        let changes = kit.spin_once(Duration::ZERO);
        let now = Instant::now();
        viewer.inputs.receive(now);
        if !changes.is_empty() {
            let scene = Scene::from_parameters(kit.parameters().clone())?;
            viewer.picture.set_look(look(&scene)?);
            rate_hz = scene.visualization.rate_hz;
            due = now;
        }
        if let Some(period) = period(rate_hz)
            && now >= due
        {
            viewer.show(now)?;
            // A turn that came late does not make the next ones hurry.
            due = (due + period).max(now);
        }
        if kit.diagnostics_due() {
            kit.publish_diagnostics(vec![viewer.status()]).context("diagnostics")?;
        }
    }
    kit.closing_report(&serde_json::json!({
        "markers": viewer.counts.messages,
        "pictures": viewer.counts.pictures,
        "not_drawn": viewer.inputs.not_drawn().total(),
    }));
    Ok(())
}

/// The parameters of the picture. Without `chains.*` there are no chains to draw.
fn look(scene: &Scene) -> Result<Look, SceneError> {
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

/// What was done since the start.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    /// Pictures made, whether or not anything in them had changed.
    pictures: u64,
    /// Marker messages published.
    messages: u64,
}

/// From what is heard to what is shown.
struct Viewer {
    inputs: Inputs,
    picture: Picture,
    transforms: Transforms,
    markers: Publisher<MarkerArray>,
    /// Readers of the markers at the last turn.
    readers: usize,
    counts: Counts,
    /// What the last diagnostics said.
    reported: NotDrawn,
}

impl Viewer {
    /// One turn: transforms for those who hear them, a picture for those who look.
    fn show(&mut self, now: Instant) -> anyhow::Result<()> {
        let readers = self.markers.readers();
        let transforms_are_read = self.transforms.are_read();
        if readers > 0 || transforms_are_read {
            self.inputs.look_at_devices();
        }
        if transforms_are_read {
            self.publish_probes(now)?;
        }
        if readers > self.readers {
            self.picture.repeat_all();
        }
        self.readers = readers;
        if readers > 0 {
            self.inputs.look_at_surface();
            let update = self.picture.update(now, self.inputs.surface(), self.inputs.views());
            self.counts.pictures += 1;
            if !update.is_empty() {
                self.markers.publish(&messages::marker_array(update))?;
                self.counts.messages += 1;
            }
        }
        Ok(())
    }

    fn publish_probes(&mut self, now: Instant) -> anyhow::Result<()> {
        let probes: Vec<_> = self
            .inputs
            .views()
            .iter()
            .zip(self.inputs.stamps_ns())
            .map(|(view, stamp_ns)| Some((stamp_ns, view.probe(now)?)))
            .collect();
        Ok(self.transforms.publish_probes(&probes)?)
    }

    fn status(&mut self) -> Status {
        let not_drawn = self.inputs.not_drawn();
        let (level, summary) = if not_drawn != self.reported {
            (Level::Warn, "messages that cannot be drawn arrive")
        } else if self.readers == 0 {
            (Level::Ok, "nobody reads the markers: nothing is drawn")
        } else if self.inputs.surface().is_none() {
            (Level::Ok, "no body_mesh yet")
        } else {
            (Level::Ok, "drawing")
        };
        self.reported = not_drawn;
        Status::new(level, "markers", summary)
            .with("readers", self.readers)
            .with("pictures", self.counts.pictures)
            .with("messages", self.counts.messages)
            .with("moved_vertices", self.inputs.surface().map_or(0, |(surface, _)| surface.moved()))
            .with("not_drawable", not_drawn.not_drawable)
            .with("other_mesh", not_drawn.other_mesh)
    }
}
