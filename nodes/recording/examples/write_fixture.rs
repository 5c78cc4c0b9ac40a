//! Writes a recording with every message type of this crate: `write_fixture DIRECTORY COUNT`.
//!
//! Message `i` has values that follow from `i`, so that a reader in another language can say what it must find.
//! Definitions come from `AMENT_PREFIX_PATH`.

use recording::cdr::{Message, encode};
use recording::messages::*;
use recording::{Durability, MessageDefinitions, Qos, Topic, TopicId, Writer};

/// Log time of message 0, ns since 1970; the next ones follow each millisecond.
const START_NS: u64 = 1_700_000_000_000_000_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [directory, count] = arguments.as_slice() else {
        return Err("usage: write_fixture DIRECTORY COUNT".into());
    };
    let count: u32 = count.parse()?;
    let definitions = MessageDefinitions::from_environment();
    let mut writer = Writer::create(directory, "jazzy")?;
    let latched = Qos { durability: Durability::TransientLocal, ..Qos::default() };
    let pose = add::<PoseStamped>(&mut writer, &definitions, "/measured_cp", Qos::default())?;
    let force = add::<WrenchStamped>(&mut writer, &definitions, "/servo_cf", Qos::default())?;
    let clutch = add::<Joy>(&mut writer, &definitions, "/clutch", latched)?;
    let gripper = add::<JointState>(&mut writer, &definitions, "/gripper/measured_js", Qos::default())?;
    let grasp = add::<Bool>(&mut writer, &definitions, "/grasp", Qos::default())?;
    let state = add::<ContactState>(&mut writer, &definitions, "/contact_state", Qos::default())?;
    let surface =
        add::<SurfaceDisplacement>(&mut writer, &definitions, "/surface_displacement", Qos::default())?;
    for i in 0..count {
        let time = START_NS + u64::from(i) * 1_000_000;
        writer.write(pose, time, &encode(&pose_of(i)))?;
        writer.write(force, time, &encode(&force_of(i)))?;
        writer.write(state, time, &encode(&state_of(i)))?;
        if i % 10 == 0 {
            let numbers = vec![f64::from(i) * 0.1];
            let js = JointState {
                header: header(i),
                name: vec!["gripper".to_owned()],
                position: numbers.clone(),
                velocity: Vec::new(),
                effort: numbers,
            };
            writer.write(gripper, time, &encode(&js))?;
            writer.write(grasp, time, &encode(&Bool { data: i % 20 == 0 }))?;
            writer.write(surface, time, &encode(&surface_of(i)))?;
        }
        if i % 100 == 0 {
            let joy = Joy { header: header(i), axes: vec![0.5], buttons: vec![i32::from(i % 200 == 0)] };
            writer.write(clutch, time, &encode(&joy))?;
        }
    }
    writer.close()?;
    Ok(())
}

fn add<M: Message>(
    writer: &mut Writer,
    definitions: &MessageDefinitions,
    name: &str,
    qos: Qos,
) -> Result<TopicId, Box<dyn std::error::Error>> {
    let definition = definitions.get(M::TYPE_NAME)?;
    Ok(writer.add_topic(Topic {
        name: name.to_owned(),
        type_name: M::TYPE_NAME.to_owned(),
        serialization_format: "cdr".to_owned(),
        offered_qos: vec![qos],
        definition,
    })?)
}

fn header(i: u32) -> Header {
    Header { stamp: Time { sec: 1_700_000_000, nanosec: i * 1_000_000 }, frame_id: "device_base".to_owned() }
}

fn pose_of(i: u32) -> PoseStamped {
    let position = Point { x: f64::from(i) * 1e-3, y: -1.0 / 3.0, z: 1e-300 };
    PoseStamped {
        header: header(i),
        pose: Pose { position, orientation: Quaternion { w: 1.0, ..Quaternion::default() } },
    }
}

fn force_of(i: u32) -> WrenchStamped {
    let force = Vector3 { x: 0.0, y: 0.0, z: f64::from(i) * 0.01 };
    WrenchStamped { header: header(i), wrench: Wrench { force, torque: Vector3::default() } }
}

fn state_of(i: u32) -> ContactState {
    ContactState {
        header: header(i),
        mode: (i % 3) as u8,
        saturated: i.is_multiple_of(2),
        clutched: i.is_multiple_of(5),
        face: i,
        barycentric: [0.25, 0.25, 0.5],
        probe: Point { x: 1.0, y: 2.0, z: 3.0 },
        proxy: Point { x: 4.0, y: 5.0, z: 6.0 },
        normal: Vector3 { x: 0.0, y: 0.0, z: 1.0 },
        depth: f64::from(i) * 1e-5,
        force: f64::from(i) * 0.01,
        stiffness: 250.0,
    }
}

fn surface_of(i: u32) -> SurfaceDisplacement {
    let vertex: Vec<u32> = (0..i % 50).collect();
    let displacement = vertex.iter().flat_map(|number| [*number as f32 * 0.5, -1.0, 0.25]).collect();
    SurfaceDisplacement { header: header(i), topology_version: 0xdead_beef, vertex, displacement }
}
