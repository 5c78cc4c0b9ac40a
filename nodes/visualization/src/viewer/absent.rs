//! In place of the viewer where it was not built: says so and only waits.

use std::time::Instant;

use node_kit::{NodeKit, Status};
use scene::Scene;

use crate::inputs::Inputs;

/// No viewer.
pub(crate) struct Viewer;

impl Viewer {
    /// Say that there is none, when the scene wants one.
    pub(crate) fn start(kit: &mut NodeKit, scene: &Scene) -> anyhow::Result<Viewer> {
        if scene.viewer.enabled {
            kit.log().info("built without the viewer: no page is served");
        }
        Ok(Viewer)
    }

    /// Sleep.
    pub(crate) fn wait(&mut self, _: &mut NodeKit, until: Instant) -> anyhow::Result<()> {
        std::thread::sleep(until.saturating_duration_since(Instant::now()));
        Ok(())
    }

    pub(crate) fn due(&self) -> Option<Instant> {
        None
    }

    pub(crate) fn hear(&mut self, _: Instant) -> bool {
        false
    }

    pub(crate) fn turn(&mut self, _: &mut NodeKit, _: Instant, _: &mut Inputs) -> anyhow::Result<()> {
        Ok(())
    }

    pub(crate) fn retune(&mut self, _: &Scene) {}

    pub(crate) fn end(&mut self, _: &mut NodeKit) -> anyhow::Result<()> {
        Ok(())
    }

    pub(crate) fn address(&self) -> Option<String> {
        None
    }

    pub(crate) fn status(&self) -> Option<Status> {
        None
    }

    pub(crate) fn report(&self) -> serde_json::Value {
        serde_json::Value::Null
    }
}
