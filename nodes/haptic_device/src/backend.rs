//! From the scene to the device that is opened.

use anyhow::Result;
use devices::Backend;
use node_kit::Log;
use scene::Scene;

/// The backend that `device.backend` names, with all it needs; the others' settings are not looked at.
///
/// # Errors
/// The name is of a backend that was left out of this executable, or a setting does not fit the scene.
#[cfg_attr(
    not(any(feature = "simulated", feature = "pointer")),
    expect(unused_variables, reason = "only a hand that is not real loads the body, and warns of it")
)]
pub(crate) fn backend(scene: &Scene, log: &Log) -> Result<Backend> {
    let (name, serial) = (scene.device.backend.as_str(), &scene.device.serial);
    if matches!(name, "simulated" | "pointer") && !serial.is_empty() {
        anyhow::bail!("device.serial = {serial:?}: the {name} device has no serial number; accepted is \"\"");
    }
    Ok(match name {
        #[cfg(feature = "simulated")]
        "simulated" => Backend::Simulated(simulated_hand(scene, log)?),
        #[cfg(feature = "force_dimension")]
        "force_dimension" => Backend::ForceDimension(devices::force_dimension::Settings {
            serial: scene.device.serial.clone(),
            sdk: scene.parameters().text("force_dimension.sdk")?.into(),
            period_s: 1.0 / scene.device.rate_hz,
        }),
        #[cfg(feature = "haply")]
        "haply" => Backend::Haply(devices::haply::Settings {
            url: scene.parameters().text("haply.url")?.to_owned(),
            serial: scene.device.serial.clone(),
            grip: scene.parameters().text("haply.grip")?.to_owned(),
            max_force_n: scene.parameters().double("haply.max_force")?,
        }),
        #[cfg(feature = "serial")]
        "serial" => Backend::Serial(devices::serial::Settings {
            port: scene.parameters().text("serial.port")?.to_owned(),
            // The schema keeps it within what fits.
            baud: u32::try_from(scene.parameters().integer("serial.baud")?).unwrap_or(u32::MAX),
            serial: scene.device.serial.clone(),
        }),
        #[cfg(feature = "spacemouse")]
        "spacemouse" => Backend::SpaceMouse(devices::spacemouse::Settings {
            serial: scene.device.serial.clone(),
            linear_speed_m_per_s: scene.parameters().double("spacemouse.linear_speed")?,
            angular_speed_rad_per_s: scene.parameters().double("spacemouse.angular_speed")?,
            full_scale: scene.parameters().double("spacemouse.full_scale")?,
            deadband: scene.parameters().double("spacemouse.deadband")?,
        }),
        #[cfg(feature = "pointer")]
        "pointer" => Backend::Pointer(pointer_hand(scene, log)?),
        other => anyhow::bail!(
            "device.backend \"{other}\" is not built into this executable; build it with the Cargo feature of that name"
        ),
    })
}

/// A hand that presses, slides, grasps and pulls at sites of the scene's body, which is loaded for it.
#[cfg(feature = "simulated")]
fn simulated_hand(scene: &Scene, log: &Log) -> Result<devices::simulated::Settings> {
    use anyhow::Context;
    use devices::simulated::{self, Motion};

    use crate::press_sites::{Ground, in_device_metres};

    let body = body(scene, log)?;
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
        body: &body,
        placement: crate::placement::Placement::new(scene),
        workspace: simulated::LIMITS.workspace,
        motion,
        slide_m: settings.slide_m,
    };
    let (sites, travel_height_m) = ground.sites()?;
    let motion = in_device_metres(&motion, motion_scale, travel_height_m);
    let script = simulated::press_slide_grasp_pull(&sites, &motion).context("the simulated hand's script")?;
    Ok(simulated::Settings {
        hand: hand(scene),
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

/// A hand that waits over the body for a pointer to lead it.
#[cfg(feature = "pointer")]
fn pointer_hand(scene: &Scene, log: &Log) -> Result<devices::pointer::Settings> {
    use devices::hand::LIMITS;

    /// Between body and probe, m.
    const CLEARANCE_M: f64 = 0.02;

    let p = scene.parameters();
    let (max_speed_m_per_s, fault_m_per_s) = (p.double("pointer.max_speed")?, p.double("safety.max_speed")?);
    if max_speed_m_per_s >= fault_m_per_s {
        anyhow::bail!(
            "pointer.max_speed = {max_speed_m_per_s}: accepted is less than safety.max_speed, {fault_m_per_s} m/s"
        );
    }
    let clearance_m = scene.probe.radius_m + CLEARANCE_M;
    let placement = crate::placement::Placement::new(scene);
    Ok(devices::pointer::Settings {
        hand: hand(scene),
        start: placement.above(&body(scene, log)?, &LIMITS.workspace, clearance_m),
        max_speed_m_per_s,
        period_s: 1.0 / scene.device.rate_hz,
        targets: devices::pointer::Targets::new(),
    })
}

/// The mechanics of a hand that is not real.
#[cfg(any(feature = "simulated", feature = "pointer"))]
fn hand(scene: &Scene) -> devices::hand::HandSettings {
    devices::hand::HandSettings {
        mass_kg: scene.simulated.mass_kg,
        stiffness_n_per_m: scene.simulated.stiffness_n_per_m,
        damping_n_s_per_m: scene.simulated.damping_n_s_per_m,
    }
}

/// The body under such a hand.
#[cfg(any(feature = "simulated", feature = "pointer"))]
fn body(scene: &Scene, log: &Log) -> Result<rhombus_chain::Body> {
    use anyhow::Context;

    let loaded = scene.load_body().context("body.mesh")?;
    for warning in &loaded.warnings {
        log.warn(&warning.to_string());
    }
    Ok(loaded.body)
}
