//! `rhombus stability`: what a scene asks of a haptic device, and whether a device can give it.

mod devices;
mod text;

use std::path::PathBuf;

use clap::{Args, ValueHint};
use rhombus_chain::stability::{Bend, Cause, Demand, HapticLoop, LawAnalysis, Range, Reach};
use rhombus_chain::{ContactLaw, StiffnessMap};
use scene::Scene;
use serde::Serialize;

use crate::assignments::Assignments;
use crate::output;
use devices::SIMULATED;

/// Depths and stiffness of a scene's contact law, and the damping that a haptic device needs to render it
///
/// Depth is positive into the body; a pull in a grasp is negative. The largest tangent stiffness K over the depths that a
/// session can reach (as far as device.max_force goes), the rate 1/T and the delay tau ask for a device damping
/// b > K (T/2 + tau): then no hand can make the contact unstable.
#[derive(Args)]
pub(crate) struct Stability {
    /// ROS 2 parameter file
    #[arg(value_name = "PARAMS.yaml", value_hint = ValueHint::FilePath)]
    parameters: PathBuf,
    #[command(flatten)]
    assignments: Assignments,
    /// A device by name; without one the damping that a device needs is stated
    #[arg(long, value_name = "NAME")]
    device: Option<String>,
    /// Rate of the force, Hz; by default that of --device, otherwise device.rate
    #[arg(long, value_name = "HZ", allow_hyphen_values = true, value_parser = rate)]
    rate: Option<f64>,
    /// Time from position to force besides the period, s; by default 0 with device.force_source: contact_law, one period
    /// with servo_cf
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = delay)]
    delay: Option<f64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

fn rate(text: &str) -> Result<f64, String> {
    let accepted = |rate_hz: &f64| (1.0..=1e6).contains(rate_hz);
    text.parse().ok().filter(accepted).ok_or_else(|| "accepted: 1 to 1e6 Hz".to_owned())
}

fn delay(text: &str) -> Result<f64, String> {
    let accepted = |delay_s: &f64| (0.0..=10.0).contains(delay_s);
    text.parse().ok().filter(accepted).ok_or_else(|| "accepted: 0 to 10 s".to_owned())
}

/// Field names and their order are the JSON.
#[derive(Serialize)]
struct Report {
    scene: PathBuf,
    formulation: String,
    whole: Law,
    chains: Vec<Law>,
    /// N, `device.max_force`: how far a session goes.
    largest_force_n: f64,
    reach: Depths,
    /// Factors that the law's stiffness is multiplied by.
    motion_scale: f64,
    largest_stiffness_factor: f64,
    pressed_only: Asked,
    with_grasp: Asked,
    device: Option<Device>,
    rate_hz: f64,
    delay_s: f64,
    needed_damping_n_s_per_m: f64,
    largest_passive_stiffness_n_per_m: Option<f64>,
    passive: Option<bool>,
    verdict: String,
}

/// m, positive into the body; null: without end.
#[derive(Serialize)]
struct Depths {
    pull_m: Option<f64>,
    press_m: Option<f64>,
}

#[derive(Serialize)]
struct Law {
    possible: Depths,
    guarded: Depths,
    rest_stiffness_n_per_m: f64,
    ranges: Vec<RangeReport>,
}

#[derive(Serialize)]
struct RangeReport {
    from_m: Option<f64>,
    to_m: Option<f64>,
    from_n_per_m: f64,
    to_n_per_m: f64,
    /// Away from rest: `stiffens`, `softens` or `straight`.
    bend: &'static str,
}

/// The largest stiffness at the hand.
#[derive(Serialize)]
struct Asked {
    stiffness_n_per_m: f64,
    depth_m: f64,
    /// `rest`, `press`, `pull` or `lateral`.
    at: &'static str,
}

#[derive(Serialize)]
struct Device {
    name: String,
    damping_n_s_per_m: f64,
    source: String,
}

impl Stability {
    pub(crate) fn run(self) -> anyhow::Result<()> {
        let scene = self.assignments.scene(&self.parameters)?;
        let law = scene.law()?;
        let (haptic_loop, device) = self.haptic_loop(&scene)?;
        let report = Report::new(self.parameters, &scene, &law, haptic_loop, device)?;
        match self.json {
            true => output::json(&report),
            false => output::text(&report.to_string()),
        }
    }

    /// The loop to be judged: the scene's, changed by the command line. Without `--device` no damping is known.
    fn haptic_loop(&self, scene: &Scene) -> anyhow::Result<(HapticLoop, Option<Device>)> {
        let mut haptic_loop = HapticLoop { damping_n_s_per_m: None, ..scene.haptic_loop() };
        let mut device = None;
        if let Some(name) = &self.device {
            let published = devices::published(name)
                .map_err(|accepted| anyhow::anyhow!("--device {name} is not known; {accepted}"))?;
            let (damping_n_s_per_m, source) = match published {
                Some(published) => {
                    haptic_loop.rate_hz = published.rate_hz;
                    (published.damping_n_s_per_m(), published.source.to_owned())
                }
                None => (scene.simulated.damping_n_s_per_m, "simulated.damping".to_owned()),
            };
            haptic_loop.damping_n_s_per_m = Some(damping_n_s_per_m);
            device = Some(Device { name: name.clone(), damping_n_s_per_m, source });
        }
        haptic_loop.rate_hz = self.rate.unwrap_or(haptic_loop.rate_hz);
        if scene.haptic_loop().delay_s > 0.0 {
            haptic_loop.delay_s = 1.0 / haptic_loop.rate_hz;
        }
        haptic_loop.delay_s = self.delay.unwrap_or(haptic_loop.delay_s);
        Ok((haptic_loop, device))
    }
}

impl Report {
    fn new(
        file: PathBuf,
        scene: &Scene,
        law: &ContactLaw,
        haptic_loop: HapticLoop,
        device: Option<Device>,
    ) -> anyhow::Result<Report> {
        let analysis = LawAnalysis::new(law);
        let largest_force_n = scene.device.max_force_n;
        let motion_scale = scene.device.motion_scale;
        let map = match scene.body.stiffness_file() {
            Some(_) => scene.load_body()?.body.stiffness().map(StiffnessMap::range),
            None => None,
        };
        let (least_factor, largest_factor) = map.unwrap_or((1.0, 1.0));
        // Where the body is softest the same force goes deepest.
        let reach = Reach::of_force(law, largest_force_n / least_factor);
        let at_the_hand = |demand: Demand| demand.times(largest_factor * motion_scale);
        let pressed_only = at_the_hand(Demand::of_law(law, reach.without_grasp()));
        let lateral_n_per_m = scene.grasp.lateral * law.rest_stiffness_n_per_m();
        let with_grasp = at_the_hand(Demand::of_law(law, reach).or_lateral(lateral_n_per_m));
        let verdict = haptic_loop.judge(with_grasp);
        Ok(Report {
            scene: file,
            formulation: law.formulation().to_string(),
            whole: Law::new(analysis.possible_m, analysis.guarded_m, analysis.rest_n_per_m, &analysis.ranges),
            chains: analysis
                .chains
                .iter()
                .map(|chain| Law::new(chain.possible_m, chain.guarded_m, chain.rest_n_per_m, &chain.ranges))
                .collect(),
            largest_force_n,
            reach: Depths::new((0.0 - reach.pull_m, reach.press_m)),
            motion_scale,
            largest_stiffness_factor: largest_factor,
            pressed_only: Asked::new(pressed_only),
            with_grasp: Asked::new(with_grasp),
            device,
            rate_hz: haptic_loop.rate_hz,
            delay_s: haptic_loop.delay_s,
            needed_damping_n_s_per_m: verdict.needed_n_s_per_m,
            largest_passive_stiffness_n_per_m: haptic_loop
                .damping_n_s_per_m
                .map(|damping| haptic_loop.largest_passive_stiffness_n_per_m(damping)),
            passive: verdict.is_passive(),
            verdict: verdict.to_string(),
        })
    }
}

impl Depths {
    fn new((pull_m, press_m): (f64, f64)) -> Depths {
        let finite = |depth_m: f64| depth_m.is_finite().then_some(depth_m);
        Depths { pull_m: finite(pull_m), press_m: finite(press_m) }
    }
}

impl Law {
    fn new(
        possible_m: (f64, f64),
        guarded_m: (f64, f64),
        rest_stiffness_n_per_m: f64,
        ranges: &[Range],
    ) -> Law {
        let ranges = ranges.iter().map(|range| RangeReport {
            from_m: range.from_m,
            to_m: range.to_m,
            from_n_per_m: range.from_n_per_m,
            to_n_per_m: range.to_n_per_m,
            bend: match range.bend {
                Bend::Stiffens => "stiffens",
                Bend::Softens => "softens",
                Bend::Straight => "straight",
            },
        });
        Law {
            possible: Depths::new(possible_m),
            guarded: Depths::new(guarded_m),
            rest_stiffness_n_per_m,
            ranges: ranges.collect(),
        }
    }
}

impl Asked {
    fn new(demand: Demand) -> Asked {
        let at = match demand.cause {
            Cause::Rest => "rest",
            Cause::Press => "press",
            Cause::Pull => "pull",
            Cause::Lateral => "lateral",
        };
        Asked { stiffness_n_per_m: demand.stiffness_n_per_m, depth_m: demand.depth_m, at }
    }
}
