//! Pose to force through DDS: the deformation node beside a bare echo, in alternating rounds of the same run.
//!
//! A sender publishes poses at 1 kHz on `measured_cp`; the other process answers on `servo_cf` with the same stamp. The
//! time from just before the publish call to the arrival of the answer is one sample. The probe presses and slides on
//! the scene's body, so that the deformation node does its whole work for nearly every pose.

use std::fs::File;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Child, Command};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};
use clap::Parser;
use futures::{FutureExt, StreamExt};
use glam::DVec3;
use r2r::geometry_msgs::msg::{PoseStamped, WrenchStamped};
use r2r::{Publisher, QosProfile};
use rhombus_benches::{PRESS_M, Spread, machine_name, pressed, walk_on_surface};
use scene::{Reader, Scene};

const PERIOD: Duration = Duration::from_millis(1);

#[derive(Parser)]
#[command(about = "Pose to force through DDS, the deformation node beside a bare echo")]
struct Options {
    /// Poses of each round (1 kHz).
    #[arg(long, default_value_t = 20_000)]
    poses: usize,
    /// Rounds of each kind, alternating.
    #[arg(long, default_value_t = 3)]
    rounds: usize,
    /// Scene of the deformation node.
    #[arg(long, default_value = "config/liver.yaml")]
    scene: PathBuf,
    /// File for the raw results.
    #[arg(long)]
    csv: PathBuf,
}

/// Ends the process under test, however the benchmark ends.
struct Peer(Child);

impl Drop for Peer {
    fn drop(&mut self) {
        // Nothing can be done about a peer that has already gone.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// One round's samples in microseconds and the number of poses that were never answered.
struct Round {
    latencies_us: Vec<f64>,
    unanswered: usize,
}

fn main() -> Result<()> {
    let options = Options::parse();
    let context = r2r::Context::create()?;
    let mut node = r2r::Node::create(context, "round_trip", "")?;
    let qos = || QosProfile::default().reliable().keep_last(1000);
    let mut forces = Box::pin(node.subscribe::<WrenchStamped>("servo_cf", qos())?);
    let poses = node.create_publisher::<PoseStamped>("measured_cp", qos())?;
    let path = press_and_slide(&options.scene, options.poses)?;

    let mut csv =
        File::create(&options.csv).with_context(|| format!("creating {}", options.csv.display()))?;
    writeln!(csv, "# {}", machine_name())?;
    writeln!(csv, "# {} poses at 1 kHz in each round, latency in microseconds", options.poses)?;
    writeln!(csv, "round,kind,unanswered,{}", Spread::CSV_HEADER)?;
    let mut all: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    let mut unanswered = [0; 2];
    for round in 0..options.rounds {
        for (kind, name) in ["bare_echo", "deformation"].into_iter().enumerate() {
            let peer = start(name, &options)?;
            wait_for_peer(&mut node, &poses, true)?;
            let mut result = run_round(&mut node, &poses, &mut forces, &path)?;
            drop(peer);
            wait_for_peer(&mut node, &poses, false)?;
            let spread = Spread::of(&mut result.latencies_us).context("no pose was answered")?;
            writeln!(csv, "{round},{name},{},{}", result.unanswered, spread.csv())?;
            eprintln!(
                "round {round} {name:12} median {:7.1} us  p99 {:8.1} us  max {:9.1} us  unanswered {}",
                spread.median, spread.p99, spread.max, result.unanswered
            );
            all[kind].append(&mut result.latencies_us);
            unanswered[kind] += result.unanswered;
        }
    }
    let [Some(echo), Some(model)] = all.map(|mut values| Spread::of(&mut values)) else {
        bail!("no round was run");
    };
    writeln!(csv, "all,bare_echo,{},{}", unanswered[0], echo.csv())?;
    writeln!(csv, "all,deformation,{},{}", unanswered[1], model.csv())?;
    eprintln!(
        "all: bare echo {:.1} us, deformation {:.1} us: adds {:.1} us, ratio {:.3}; unanswered {} and {}",
        echo.median,
        model.median,
        model.median - echo.median,
        model.median / echo.median,
        unanswered[0],
        unanswered[1]
    );
    Ok(())
}

/// Probe positions in the device frame: sliding at 20 mm/s, pressed 1 mm to 5 mm deep, twice a second.
fn press_and_slide(scene: &std::path::Path, count: usize) -> Result<Vec<DVec3>> {
    let scene = Scene::from_file(scene, Reader::Everything)?;
    let tissue = scene.tissue()?;
    let body = scene.load_body()?.body;
    let device_from_body = scene.device.scene_from_device.inverse() * scene.body.scene_from_body;
    let walk = walk_on_surface(body.mesh(), count, 20e-6);
    let depth_m = |i: usize| PRESS_M * (0.6 - 0.4 * libm::cos(i as f64 * 1e-3 * std::f64::consts::TAU * 2.0));
    let probes = pressed(&walk, tissue.probe_radius_m(), depth_m);
    Ok(probes
        .into_iter()
        .map(|probe| device_from_body.transform_point(probe) / scene.device.motion_scale)
        .collect())
}

fn start(name: &str, options: &Options) -> Result<Peer> {
    let directory =
        std::env::current_exe()?.parent().map(PathBuf::from).context("directory of the benchmark")?;
    let mut command = match name {
        "bare_echo" => Command::new(directory.join("bench_bare_echo")),
        _ => {
            let mut command = Command::new(directory.join("deformation"));
            command.args(["--ros-args", "--log-level", "warn", "--params-file"]).arg(&options.scene);
            command
        }
    };
    let child = command.spawn().with_context(|| format!("starting {name}; build it with --release first"))?;
    Ok(Peer(child))
}

/// Wait until the poses have (or no longer have) a reader, and then for the peer's own discovery to settle.
fn wait_for_peer(node: &mut r2r::Node, poses: &Publisher<PoseStamped>, present: bool) -> Result<()> {
    let deadline = Instant::now() + Duration::from_secs(30);
    while (poses.get_inter_process_subscription_count()? > 0) != present {
        ensure!(Instant::now() < deadline, "the peer did not {}", if present { "appear" } else { "leave" });
        node.spin_once(Duration::from_millis(20));
    }
    let settled = Instant::now() + Duration::from_secs(1);
    while Instant::now() < settled {
        node.spin_once(Duration::from_millis(20));
    }
    Ok(())
}

fn run_round(
    node: &mut r2r::Node,
    poses: &Publisher<PoseStamped>,
    forces: &mut (impl futures::Stream<Item = WrenchStamped> + Unpin),
    path: &[DVec3],
) -> Result<Round> {
    let count = path.len();
    let sent_ns: Arc<Vec<AtomicU64>> = Arc::new((0..count).map(|_| AtomicU64::new(0)).collect());
    let finished = Arc::new(AtomicBool::new(false));
    let start = Instant::now();
    let first_stamp_s = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH)?.as_secs() as i32;
    let sender = {
        let (sent_ns, finished, poses, path) =
            (Arc::clone(&sent_ns), Arc::clone(&finished), poses.clone(), path.to_vec());
        std::thread::Builder::new().name("sender".into()).spawn(move || -> Result<()> {
            for (index, position) in path.iter().enumerate() {
                let due = start + PERIOD * index as u32;
                if let Some(wait) = due.checked_duration_since(Instant::now()) {
                    std::thread::sleep(wait);
                }
                let pose = pose_message(*position, first_stamp_s, index);
                sent_ns[index].store(start.elapsed().as_nanos() as u64, Ordering::Release);
                poses.publish(&pose)?;
            }
            finished.store(true, Ordering::Release);
            Ok(())
        })?
    };
    let mut latencies_us = Vec::with_capacity(count);
    let mut last_heard = Instant::now();
    while latencies_us.len() < count
        && (!finished.load(Ordering::Acquire) || last_heard.elapsed() < Duration::from_secs(2))
    {
        node.spin_once(Duration::from_millis(10));
        while let Some(Some(force)) = forces.next().now_or_never() {
            let now_ns = start.elapsed().as_nanos() as u64;
            last_heard = Instant::now();
            let stamp = &force.header.stamp;
            let index = (stamp.sec - first_stamp_s) as usize * 1000 + stamp.nanosec as usize / 1_000_000;
            if let Some(sent) = sent_ns.get(index) {
                latencies_us.push((now_ns - sent.load(Ordering::Acquire)) as f64 * 1e-3);
            }
        }
    }
    sender.join().map_err(|_| anyhow::anyhow!("the sender panicked"))??;
    let unanswered = count - latencies_us.len();
    Ok(Round { latencies_us, unanswered })
}

fn pose_message(position: DVec3, first_stamp_s: i32, index: usize) -> PoseStamped {
    let mut message = PoseStamped::default();
    message.header.frame_id = "device_base".into();
    message.header.stamp.sec = first_stamp_s + (index / 1000) as i32;
    message.header.stamp.nanosec = (index % 1000) as u32 * 1_000_000;
    message.pose.position.x = position.x;
    message.pose.position.y = position.y;
    message.pose.position.z = position.z;
    message.pose.orientation.w = 1.0;
    message
}
