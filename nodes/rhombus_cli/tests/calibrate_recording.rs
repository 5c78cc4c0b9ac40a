//! `rhombus calibrate --recording`: the stiffness comes back from poses and measured forces.
#![expect(clippy::expect_used, reason = "a test may fail here")]

mod common;

use common::Folder;
use recording::cdr;
use recording::messages::{
    Header, Point, Pose, PoseStamped, Quaternion, Time, Vector3, Wrench, WrenchStamped,
};
use recording::{MessageDefinition, Topic, TopicId, Writer};

/// The body hangs 0.3 m above the scene's origin, turned by a quarter around x: forces come back in the device's frame.
const SCENE: &str = "/**:
  ros__parameters:
    body: {mesh: sphere.obj, pose: [0.0, 0.0, 0.3, 0.7071067811865476, 0.0, 0.0, 0.7071067811865476]}
    device: {scene_from_device: [0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]}
    probe: {radius: 0.005}
    chains:
      formulation: energy
      rod_length: [0.01]
      angle: [0.5235987755982988]
      ratio: [0.8]
      units: [12]
      normal_stiffness: [500.0]
      tangential_stiffness: [100.0]
      tangential_growth: [10.0]
";

/// Radius of the sphere, m.
const RADIUS_M: f64 = 0.05;

struct Bag {
    writer: Writer,
    poses: TopicId,
    forces: TopicId,
}

impl Bag {
    fn new(folder: &Folder) -> Bag {
        let mut writer = Writer::create(folder.path("bag"), "").expect("a recording");
        let mut topic = |name: &str, type_name: &str| {
            let topic = Topic {
                name: name.to_owned(),
                type_name: type_name.to_owned(),
                serialization_format: "cdr".to_owned(),
                offered_qos: Vec::new(),
                definition: MessageDefinition {
                    encoding: String::new(),
                    text: String::new(),
                    type_hash: String::new(),
                },
            };
            writer.add_topic(topic).expect("a topic")
        };
        let poses = topic("/measured_cp", "geometry_msgs/msg/PoseStamped");
        let forces = topic("/measured_cf", "geometry_msgs/msg/WrenchStamped");
        Bag { writer, poses, forces }
    }

    /// A probe below the sphere, `gap_m` under its lowest point in the scene, that measures `force_n` pushing it down.
    fn write(&mut self, ms: u32, frame: &str, gap_m: f64, force_n: Option<f64>) {
        let header = Header { stamp: Time { sec: 1, nanosec: ms * 1_000_000 }, frame_id: frame.to_owned() };
        let time = 1_000_000_000 + u64::from(ms) * 1_000_000;
        let position = Point { x: -0.1, y: 0.0, z: 0.3 - RADIUS_M - 0.005 - gap_m };
        let orientation = Quaternion { w: 1.0, ..Quaternion::default() };
        let pose = PoseStamped { header: header.clone(), pose: Pose { position, orientation } };
        self.writer.write(self.poses, time, &cdr::encode(&pose)).expect("a message");
        if let Some(force_n) = force_n {
            let force = Vector3 { x: 0.3, y: -0.2, z: -force_n };
            let wrench = WrenchStamped { header, wrench: Wrench { force, torque: Vector3::default() } };
            self.writer.write(self.forces, time, &cdr::encode(&wrench)).expect("a message");
        }
    }
}

fn folder() -> Folder {
    let folder = Folder::new().with("scene.yaml", SCENE);
    folder.success(&["mesh", "make", "sphere", "--vertices", "2000", "-o", "sphere.obj"]);
    folder
}

const COMMAND: [&str; 7] = ["calibrate", "--recording", "bag", "--scene", "scene.yaml", "-o", "out.yaml"];

#[test]
fn the_stiffness_comes_back_from_poses_and_forces() {
    let folder = folder();
    let mut bag = Bag::new(&folder);
    for ms in 0..200 {
        // Down and up again: 3 mm above the surface to 5 mm into it.
        let depth_m = 0.008 * (1.0 - (f64::from(ms) / 100.0 - 1.0).abs()) - 0.003;
        bag.write(ms, "device_base", -depth_m, Some(170.0 * depth_m.max(0.0)));
    }
    bag.writer.close().expect("a recording");
    let said = folder.success(&COMMAND);
    assert!(said.contains("no point is pulled"), "{said}");
    let text = std::fs::read_to_string(folder.path("out.yaml")).expect("a file");
    assert!(text.contains("measured forces of bag, recorded on the body of scene.yaml"), "{text}");
    let answer = folder.json(&["evaluate", "out.yaml", "--depth", "0.004", "--json"]);
    let force_n = answer["force_n"].as_f64().expect("a number");
    // The sphere's mesh lies up to 0.05 mm inside the sphere.
    assert!((force_n / (170.0 * 0.004) - 1.0).abs() < 0.03, "{force_n} N");
    folder.success(&["explain", "out.yaml"]);
}

#[test]
fn recordings_that_tell_nothing_are_refused() {
    let folder = folder();
    let said = folder.refusal(&COMMAND);
    assert!(said.contains("bag"), "{said}");
    let mut bag = Bag::new(&folder);
    (0..20).for_each(|ms| bag.write(ms, "device_base", 0.01, Some(0.0)));
    bag.writer.close().expect("a recording");
    let said = folder.refusal(&COMMAND);
    assert!(said.contains("bag: 0 poses touch the body of the scene"), "{said}");

    std::fs::remove_dir_all(folder.path("bag")).expect("a folder");
    let mut bag = Bag::new(&folder);
    (0..20).for_each(|ms| bag.write(ms, "ceiling", -0.002, Some(1.0)));
    bag.writer.close().expect("a recording");
    let said = folder.refusal(&COMMAND);
    assert!(
        said.contains("a pose in frame \"ceiling\"; accepted: the scene's device_base, scene, body"),
        "{said}"
    );

    std::fs::remove_dir_all(folder.path("bag")).expect("a folder");
    let mut bag = Bag::new(&folder);
    (0..20).for_each(|ms| bag.write(ms, "device_base", -0.002, Some(-1.0)));
    bag.writer.close().expect("a recording");
    let said = folder.refusal(&COMMAND);
    assert!(said.contains("the forces do not oppose the depths"), "{said}");
    assert!(!folder.path("out.yaml").exists());

    let said = folder.refusal(&["calibrate", "--recording", "bag", "-o", "out.yaml"]);
    assert!(said.contains("--scene"), "{said}");
}
