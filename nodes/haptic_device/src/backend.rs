//! From the scene to the device that is opened.

use anyhow::{Context, Result, bail};
use devices::Backend;
use devices::simulated::{self, HandSettings, Motion};
use node_kit::Log;
use scene::Scene;

use crate::press_sites::{Ground, Placement, in_device_metres};

/// The backend that `device.backend` names, with all it needs. The body is loaded for the simulated one only.
pub(crate) fn backend(scene: &Scene, log: &Log) -> Result<Backend> {
    match scene.device.backend.as_str() {
        "simulated" => Ok(Backend::Simulated(simulated_hand(scene, log)?)),
        other => {
            bail!("device.backend \"{other}\" is not built into this executable; accepted: \"simulated\"")
        }
    }
}

/// A hand that presses, slides, grasps and pulls at sites of the scene's body.
fn simulated_hand(scene: &Scene, log: &Log) -> Result<simulated::Settings> {
    let loaded = scene.load_body().context("body.mesh")?;
    for warning in &loaded.warnings {
        log.warn(&warning.to_string());
    }
    let settings = &scene.simulated;
    let motion_scale = scene.device.motion_scale;
    let motion = Motion {
        probe_radius_m: scene.probe.radius_m,
        depth_m: settings.depth_m,
        pull_m: settings.pull_m,
        period_s: settings.period_s,
        ..Motion::default()
    };
    let ground = Ground {
        body: &loaded.body,
        placement: Placement {
            base_from_body: scene.device.scene_from_device.inverse() * scene.body.scene_from_body,
            motion_scale,
        },
        workspace: simulated::LIMITS.workspace,
        motion,
        slide_m: settings.slide_m,
    };
    let (sites, travel_height_m) = ground.sites()?;
    let motion = in_device_metres(&motion, motion_scale, travel_height_m);
    let script = simulated::press_slide_grasp_pull(&sites, &motion).context("the simulated hand's script")?;
    Ok(simulated::Settings {
        hand: HandSettings {
            mass_kg: settings.mass_kg,
            stiffness_n_per_m: settings.stiffness_n_per_m,
            damping_n_s_per_m: settings.damping_n_s_per_m,
        },
        script,
        period_s: 1.0 / scene.device.rate_hz,
    })
}
