//! Writes a recording to measure with: `write_hour DIRECTORY [SECONDS] [forces]`. Poses and forces at 1 kHz and a
//! surface of 3116 vertices at 60 Hz, one hour unless told otherwise; with `forces` the surface stays out.

use recording::cdr::encode;
use recording::messages::{Header, PoseStamped, SurfaceDisplacement, Time, WrenchStamped};
use recording::{MessageDefinition, Qos, Topic, Writer};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let directory = arguments.next().ok_or("usage: write_hour DIRECTORY [SECONDS] [forces]")?;
    let seconds: u64 = arguments.next().map_or(Ok(3600), |text| text.parse())?;
    let with_surface = arguments.next().is_none_or(|what| what != "forces");
    let mut writer = Writer::create(directory, "jazzy")?;
    let topic = |name: &str, type_name: &str| Topic {
        name: name.to_owned(),
        type_name: type_name.to_owned(),
        serialization_format: "cdr".to_owned(),
        offered_qos: vec![Qos::default()],
        definition: MessageDefinition::default(),
    };
    let poses = writer.add_topic(topic("/measured_cp", "geometry_msgs/msg/PoseStamped"))?;
    let forces = writer.add_topic(topic("/servo_cf", "geometry_msgs/msg/WrenchStamped"))?;
    let surfaces =
        writer.add_topic(topic("/surface_displacement", "rhombus_haptics_msgs/msg/SurfaceDisplacement"))?;
    for millisecond in 0..seconds * 1000 {
        let stamp =
            Time { sec: (millisecond / 1000) as i32, nanosec: (millisecond % 1000) as u32 * 1_000_000 };
        let header = Header { stamp, frame_id: "device_base".to_owned() };
        let log_time_ns = 1_700_000_000_000_000_000 + millisecond * 1_000_000;
        let mut pose = PoseStamped { header: header.clone(), ..PoseStamped::default() };
        pose.pose.position.z = (millisecond % 1000) as f64 * 1e-5;
        let mut force = WrenchStamped { header: header.clone(), ..WrenchStamped::default() };
        force.wrench.force.z = pose.pose.position.z * 300.0;
        writer.write(poses, log_time_ns, &encode(&pose))?;
        writer.write(forces, log_time_ns + 100_000, &encode(&force))?;
        if with_surface && millisecond % 1000 * 60 % 1000 < 60 {
            let displacement = (0..3 * 3116).map(|at| (at % 97) as f32 * 1e-5).collect();
            let surface = SurfaceDisplacement {
                header,
                topology_version: 1,
                vertex: (0..3116).collect(),
                displacement,
            };
            writer.write(surfaces, log_time_ns + 200_000, &encode(&surface))?;
        }
    }
    writer.close()?;
    Ok(())
}
