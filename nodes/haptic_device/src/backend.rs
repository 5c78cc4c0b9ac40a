//! From the scene to the device that is opened.

use anyhow::Result;
use devices::Backend;
use node_kit::Log;
use scene::Scene;

/// The backend that `device.backend` names, with all it needs; the others' settings are not looked at.
///
/// # Errors
/// The name is of a backend that was left out of this executable, or the simulated hand has nothing to press.
pub(crate) fn backend(scene: &Scene, log: &Log) -> Result<Backend> {
    let serial = || scene.device.serial.clone();
    let p = scene.parameters();
    Ok(match scene.device.backend.as_str() {
        #[cfg(feature = "simulated")]
        "simulated" => Backend::Simulated(simulated_hand(scene, log)?),
        #[cfg(feature = "force_dimension")]
        "force_dimension" => Backend::ForceDimension(devices::force_dimension::Settings {
            serial: serial(),
            sdk: p.text("force_dimension.sdk")?.into(),
            period_s: 1.0 / scene.device.rate_hz,
        }),
        #[cfg(feature = "haply")]
        "haply" => Backend::Haply(devices::haply::Settings {
            url: p.text("haply.url")?.to_owned(),
            serial: serial(),
            grip: p.text("haply.grip")?.to_owned(),
            max_force_n: p.double("haply.max_force")?,
        }),
        #[cfg(feature = "serial")]
        "serial" => Backend::Serial(devices::serial::Settings {
            port: p.text("serial.port")?.to_owned(),
            // The schema keeps it within what fits.
            baud: u32::try_from(p.integer("serial.baud")?).unwrap_or(u32::MAX),
            serial: serial(),
        }),
        #[cfg(feature = "spacemouse")]
        "spacemouse" => Backend::SpaceMouse(devices::spacemouse::Settings {
            serial: serial(),
            linear_speed_m_per_s: p.double("spacemouse.linear_speed")?,
            angular_speed_rad_per_s: p.double("spacemouse.angular_speed")?,
            full_scale: p.double("spacemouse.full_scale")?,
            deadband: p.double("spacemouse.deadband")?,
        }),
        other => anyhow::bail!(
            "device.backend \"{other}\" is not built into this executable; build it with the Cargo feature of that name"
        ),
    })
}

/// A hand that presses, slides, grasps and pulls at sites of the scene's body, which is loaded for it.
#[cfg(feature = "simulated")]
fn simulated_hand(scene: &Scene, log: &Log) -> Result<devices::simulated::Settings> {
    use anyhow::Context;
    use devices::simulated::{self, HandSettings, Motion};

    use crate::press_sites::{Ground, Placement, in_device_metres};

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
        flaws: simulated::Flaws {
            noise_m: settings.noise_m,
            quantisation_m: settings.quantisation_m,
            dropout: settings.dropout,
            latency_s: settings.latency_s,
        },
    })
}
