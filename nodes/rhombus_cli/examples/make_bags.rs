//! Makes the recordings of tests/bags: `make_bags DIRECTORY`. The same bytes on every machine. With a number of seconds,
//! `make_bags DIRECTORY 3600`, only DIRECTORY/session: a hand that slides to and fro in contact, to measure with.
//!
//! Poses at 1 kHz as a driver would send them, on the liver of config/liver.yaml (two_devices: config/two_hands.yaml): press,
//! slide, grasp_and_pull with gripper, commanded grasp and clutch, two_devices, sensor_noise, dropouts.
#![expect(clippy::unwrap_used, reason = "a script that stops at the first failure")]

use std::f64::consts::{PI, TAU};
use std::path::Path;

use glam::DVec3;
use libm::{cos, log, sin, sqrt};
use recording::cdr::{Message, encode};
use recording::messages::{
    Bool, Header, JointState, Joy, Point, Pose, PoseStamped, Quaternion, TFMessage, Time, Transform,
    TransformStamped, Vector3, own_definition,
};
use recording::{Durability, Qos, Topic, TopicId, Writer};
use scene::{Reader, Scene, Site, sites};

/// First stamp, ns since 1970.
const START_NS: u64 = 1_700_000_000_000_000_000;
const MS: u64 = 1_000_000;
/// A recorder hears a pose this long after its stamp.
const DELAY_NS: u64 = 180_000;
const COUNT: u64 = 1500;
const PROBE_RADIUS_M: f64 = 0.005;

fn main() {
    let directory = std::env::args().nth(1).unwrap();
    let directory = Path::new(&directory);
    match std::env::args().nth(2) {
        Some(seconds) => {
            let (here, there) = places(Path::new("."));
            session(&directory.join("session"), seconds.parse().unwrap(), &here, &there);
        }
        None => make(Path::new("."), directory),
    }
}

/// Two sites of the liver of the repository at `root`.
fn places(root: &Path) -> (Site, Site) {
    let scene = Scene::from_file(&root.join("config/liver.yaml"), Reader::Everything).unwrap();
    let sites = sites(&scene.load_body().unwrap().body, 4);
    (sites[0], sites[1])
}

/// All recordings of tests/bags, into a directory; `root` is that of the repository.
pub fn make(root: &Path, directory: &Path) {
    let (here, there) = places(root);

    let mut bag = Bag::create(&directory.join("press"));
    let hand = bag.device("", "device_base");
    for ms in 0..COUNT {
        // Twice in to 8 mm and out again.
        let depth_m = 0.008 * 0.5 * (1.0 - cos(TAU * ms as f64 / 750.0)) - 0.001;
        bag.pose(&hand, ms, over(&here, depth_m));
    }
    bag.close();

    let mut bag = Bag::create(&directory.join("slide"));
    let hand = bag.device("", "device_base");
    for ms in 0..COUNT {
        let way = 0.25 * (1.0 - cos(PI * ms as f64 / COUNT as f64));
        let depth_m = 0.004 * (4.0 * ms as f64 / COUNT as f64).min(1.0);
        bag.pose(&hand, ms, over(&here, depth_m).lerp(over(&there, depth_m), way));
    }
    bag.close();

    let mut bag = Bag::create(&directory.join("grasp_and_pull"));
    let hand = bag.device("", "device_base");
    for ms in 0..COUNT {
        let t = ms as f64 / COUNT as f64;
        if ms % 10 == 0 {
            // Closed from 300 to 700 ms.
            bag.gripper(&hand, ms, if (300..700).contains(&ms) { 0.1 } else { 0.6 });
        }
        match ms {
            0 => bag.clutch(&hand, ms, false),
            900 => bag.grasp(&hand, ms, true),
            1100 => bag.clutch(&hand, ms, true),
            1200 => bag.clutch(&hand, ms, false),
            1350 => bag.grasp(&hand, ms, false),
            _ => {}
        }
        let side = DVec3::new(0.003 * sin(3.0 * TAU * t), 0.002 * sin(2.0 * TAU * t), 0.0);
        bag.pose(&hand, ms, over(&here, 0.003 + 0.006 * sin(2.0 * TAU * t)) + side);
    }
    bag.close();

    let mut bag = Bag::create(&directory.join("two_devices"));
    // As in config/two_hands.yaml: the right device looks at the left one.
    let left = bag.device("left/", "left/device_base");
    let right = bag.device("right/", "right/device_base");
    bag.stands("scene", "left/device_base", DVec3::new(-0.2, 0.0, 0.0), [0.0, 0.0, 0.0, 1.0]);
    bag.stands("scene", "right/device_base", DVec3::new(0.2, 0.0, 0.0), [0.0, 0.0, 1.0, 0.0]);
    for ms in 0..COUNT {
        let t = ms as f64 / COUNT as f64;
        let one = over(&here, 0.005 * sin(2.0 * TAU * t));
        let other = over(&there, 0.004 * sin(3.0 * TAU * t));
        bag.pose(&left, ms, one - DVec3::new(-0.2, 0.0, 0.0));
        bag.pose(&right, ms, DVec3::new(0.2 - other.x, -other.y, other.z));
    }
    bag.close();

    let mut bag = Bag::create(&directory.join("sensor_noise"));
    let hand = bag.device("", "device_base");
    let mut random = fastrand::Rng::with_seed(5);
    for ms in 0..COUNT {
        let at = over(&here, 0.004 * sin(2.0 * TAU * ms as f64 / COUNT as f64));
        // 30 um of noise, then steps of 10 um.
        let noisy = at + DVec3::new(normal(&mut random), normal(&mut random), normal(&mut random)) * 30e-6;
        bag.pose(&hand, ms, (noisy / 10e-6).round() * 10e-6);
    }
    bag.close();

    let mut bag = Bag::create(&directory.join("dropouts"));
    let hand = bag.device("", "device_base");
    let mut random = fastrand::Rng::with_seed(7);
    let mut silent_until = 0;
    for ms in 0..COUNT {
        if random.f64() < 0.01 {
            silent_until = ms + random.u64(2..40);
        }
        if ms < silent_until {
            continue;
        }
        let at = over(&here, 0.005 * sin(2.0 * TAU * ms as f64 / COUNT as f64));
        bag.pose(&hand, ms, at);
        if random.f64() < 0.02 {
            // The same reading again, with the same stamp.
            bag.pose(&hand, ms, at);
        }
    }
    bag.close();
}

/// A hand in contact, from site to site and back in 8 s, 1 to 5 mm deep.
fn session(path: &Path, seconds: u64, here: &Site, there: &Site) {
    let mut bag = Bag::create(path);
    let hand = bag.device("", "device_base");
    for ms in 0..1000 * seconds {
        let t_s = ms as f64 * 1e-3;
        let way = 0.25 * (1.0 - cos(TAU * t_s / 8.0));
        let depth_m = 0.003 + 0.002 * sin(TAU * t_s / 1.5);
        bag.pose(&hand, ms, over(here, depth_m).lerp(over(there, depth_m), way));
    }
    bag.close();
}

/// Where the hand is with the probe pressed in by `depth_m` at a site, in the body's frame, which is the scene's.
fn over(site: &Site, depth_m: f64) -> DVec3 {
    site.point + site.normal * (PROBE_RADIUS_M - depth_m)
}

/// Standard normal, after Box and Muller.
fn normal(random: &mut fastrand::Rng) -> f64 {
    sqrt(-2.0 * log(1.0 - random.f64())) * cos(TAU * random.f64())
}

/// A recording of devices that is being written.
struct Bag {
    writer: Writer,
    fixed: Option<TopicId>,
}

struct Device {
    frame_id: &'static str,
    pose: TopicId,
    gripper: TopicId,
    grasp: TopicId,
    clutch: TopicId,
}

impl Bag {
    fn create(directory: &Path) -> Self {
        Self { writer: Writer::create(directory, "jazzy").unwrap(), fixed: None }
    }

    fn topic<M: Message>(&mut self, name: &str, latched: bool) -> TopicId {
        let durability = if latched { Durability::TransientLocal } else { Durability::Volatile };
        let topic = Topic {
            name: format!("/{name}"),
            type_name: M::TYPE_NAME.to_owned(),
            serialization_format: "cdr".to_owned(),
            offered_qos: vec![Qos { durability, depth: if latched { 10 } else { 1000 }, ..Qos::default() }],
            definition: own_definition(M::TYPE_NAME).unwrap(),
        };
        self.writer.add_topic(topic).unwrap()
    }

    fn device(&mut self, prefix: &str, frame_id: &'static str) -> Device {
        Device {
            frame_id,
            pose: self.topic::<PoseStamped>(&format!("{prefix}measured_cp"), false),
            gripper: self.topic::<JointState>(&format!("{prefix}gripper/measured_js"), false),
            grasp: self.topic::<Bool>(&format!("{prefix}grasp"), false),
            clutch: self.topic::<Joy>(&format!("{prefix}clutch"), true),
        }
    }

    fn write(&mut self, topic: TopicId, ms: u64, message: &impl Message) {
        self.writer.write(topic, START_NS + ms * MS + DELAY_NS, &encode(message)).unwrap();
    }

    fn pose(&mut self, device: &Device, ms: u64, hand: DVec3) {
        let pose = Pose { position: point(hand), orientation: rotation([0.0, 0.0, 0.0, 1.0]) };
        let message = PoseStamped { header: header(device.frame_id, ms), pose };
        self.write(device.pose, ms, &message);
    }

    fn gripper(&mut self, device: &Device, ms: u64, angle_rad: f64) {
        let message = JointState {
            header: header(device.frame_id, ms),
            name: vec!["gripper".to_owned()],
            position: vec![angle_rad],
            ..JointState::default()
        };
        self.write(device.gripper, ms, &message);
    }

    fn grasp(&mut self, device: &Device, ms: u64, hold: bool) {
        self.write(device.grasp, ms, &Bool { data: hold });
    }

    fn clutch(&mut self, device: &Device, ms: u64, pressed: bool) {
        let message =
            Joy { header: header(device.frame_id, ms), axes: Vec::new(), buttons: vec![i32::from(pressed)] };
        self.write(device.clutch, ms, &message);
    }

    /// A transform that stays.
    fn stands(&mut self, parent: &str, child: &str, at: DVec3, quaternion: [f64; 4]) {
        let fixed = match self.fixed {
            Some(fixed) => fixed,
            None => self.topic::<TFMessage>("tf_static", true),
        };
        self.fixed = Some(fixed);
        let transform =
            Transform { translation: Vector3 { x: at.x, y: at.y, z: at.z }, rotation: rotation(quaternion) };
        let stamped =
            TransformStamped { header: header(parent, 0), child_frame_id: child.to_owned(), transform };
        self.write(fixed, 0, &TFMessage { transforms: vec![stamped] });
    }

    fn close(self) {
        self.writer.close().unwrap();
    }
}

fn header(frame_id: &str, ms: u64) -> Header {
    let ns = START_NS + ms * MS;
    let stamp = Time { sec: (ns / 1_000_000_000) as i32, nanosec: (ns % 1_000_000_000) as u32 };
    Header { stamp, frame_id: frame_id.to_owned() }
}

fn point(p: DVec3) -> Point {
    Point { x: p.x, y: p.y, z: p.z }
}

fn rotation([x, y, z, w]: [f64; 4]) -> Quaternion {
    Quaternion { x, y, z, w }
}
