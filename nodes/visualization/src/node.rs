//! The loop: wait for the next picture, take the newest of every topic, show it to those who look.

use std::time::{Duration, Instant};

use anyhow::Context;
use node_kit::{Change, NodeKit};
use scene::Scene;

use crate::inputs::Inputs;
use crate::markers::{self, Markers};
use crate::viewer::Viewer;

/// Parameters and signals are looked after at least this often, however few pictures are wanted.
const LONGEST_PAUSE: Duration = Duration::from_millis(50);
/// A spin takes one message of each subscription: after so many, what still waits is left for the next turn.
const MOST_SPINS: usize = 8;

/// Run the node until it is asked to end.
pub(crate) fn run(kit: &mut NodeKit) -> anyhow::Result<()> {
    let scene = Scene::from_parameters(kit.parameters().clone())?;
    kit.check_changes(Box::new(|values, _| {
        let look = Scene::from_parameters(values.clone()).and_then(|scene| markers::look(&scene));
        look.map(|_| ()).map_err(|error| error.to_string())
    }));
    let mut inputs = Inputs::new(kit, &scene.session.devices)?;
    let mut markers = Markers::new(kit, &scene)?;
    let mut viewer = Viewer::start(kit, &scene)?;
    kit.ready(&summary(&scene, &viewer));

    while kit.is_running() {
        let dues = [markers.due(), viewer.due(), Some(Instant::now() + LONGEST_PAUSE)];
        // Not in the spin: that would wake for every message, and only the newest at the end of the pause counts.
        viewer.wait(kit, dues.into_iter().flatten().min().unwrap_or_else(Instant::now))?;
        let changes = receive(kit, &mut inputs, &mut viewer);
        let now = Instant::now();
        if !changes.is_empty() {
            let scene = Scene::from_parameters(kit.parameters().clone())?;
            markers.retune(&scene, now)?;
            viewer.retune(&scene);
        }
        markers.turn(now, &mut inputs)?;
        viewer.turn(kit, now, &mut inputs)?;
        if kit.diagnostics_due() {
            let statuses = std::iter::once(markers.status(&inputs)).chain(viewer.status());
            kit.publish_diagnostics(statuses.collect()).context("diagnostics")?;
        }
    }
    viewer.end(kit)?;
    kit.closing_report(&serde_json::json!({
        "markers": markers.counts().messages,
        "pictures": markers.counts().pictures,
        "not_drawn": inputs.not_drawn().total(),
        "viewer": viewer.report(),
    }));
    Ok(())
}

/// Take what has arrived. What was set since the last turn.
fn receive(kit: &mut NodeKit, inputs: &mut Inputs, viewer: &mut Viewer) -> Vec<Change> {
    let mut changes = Vec::new();
    for _ in 0..MOST_SPINS {
        changes.extend(kit.spin_once(Duration::ZERO));
        let now = Instant::now();
        inputs.receive(now);
        if !viewer.hear(now) {
            break;
        }
    }
    changes
}

fn summary(scene: &Scene, viewer: &Viewer) -> String {
    let markers = format!("markers at {} Hz while somebody reads them", scene.visualization.rate_hz);
    match viewer.address() {
        Some(address) => format!("{markers}, viewer at {address}"),
        None => markers,
    }
}
