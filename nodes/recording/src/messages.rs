//! The messages this product needs without ROS. Fields, names and units are those of the `.msg` files.

use serde::Serialize;

use crate::cdr::{Decoder, Encoder, Fault, Message, Wire};

/// Defines a struct with the fields of a message and their order on the wire.
macro_rules! message {
    ($(#[$doc:meta])* $name:ident $type_name:literal { $($(#[$field_doc:meta])* $field:ident: $type:ty),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq, Default, Serialize)]
        pub struct $name { $($(#[$field_doc])* pub $field: $type),+ }

        impl Wire for $name {
            const MIN_BYTES: usize = 0 $(+ <$type as Wire>::MIN_BYTES)+;
            fn put(&self, encoder: &mut Encoder) {
                $(self.$field.put(encoder);)+
            }
            fn take(decoder: &mut Decoder<'_>) -> Result<Self, Fault> {
                Ok(Self { $($field: Wire::take(decoder)?),+ })
            }
        }

        impl Message for $name {
            const TYPE_NAME: &'static str = $type_name;
        }
    };
}

message! {
    /// A moment.
    Time "builtin_interfaces/msg/Time" {
        /// Seconds since 1970.
        sec: i32,
        /// Nanoseconds on top.
        nanosec: u32,
    }
}
message! {
    /// When and in which frame.
    Header "std_msgs/msg/Header" {
        /// When the data was true.
        stamp: Time,
        /// The frame of positions and directions.
        frame_id: String,
    }
}
message! {
    /// A position.
    Point "geometry_msgs/msg/Point" {
        /// m.
        x: f64,
        /// m.
        y: f64,
        /// m.
        z: f64,
    }
}
message! {
    /// A direction, force, torque or velocity.
    Vector3 "geometry_msgs/msg/Vector3" {
        /// First component.
        x: f64,
        /// Second component.
        y: f64,
        /// Third component.
        z: f64,
    }
}
message! {
    /// A rotation. All zero by default, which is not a rotation.
    Quaternion "geometry_msgs/msg/Quaternion" {
        /// First imaginary component.
        x: f64,
        /// Second imaginary component.
        y: f64,
        /// Third imaginary component.
        z: f64,
        /// Real component.
        w: f64,
    }
}
message! {
    /// A position and a rotation.
    Pose "geometry_msgs/msg/Pose" {
        /// m.
        position: Point,
        /// Unit quaternion.
        orientation: Quaternion,
    }
}
message! {
    /// Where a device is: `measured_cp`.
    PoseStamped "geometry_msgs/msg/PoseStamped" {
        /// Stamp and frame.
        header: Header,
        /// Position and rotation in that frame.
        pose: Pose,
    }
}
message! {
    /// Force and torque.
    Wrench "geometry_msgs/msg/Wrench" {
        /// N.
        force: Vector3,
        /// N m.
        torque: Vector3,
    }
}
message! {
    /// The force on the hand: `servo_cf`, `measured_cf`.
    WrenchStamped "geometry_msgs/msg/WrenchStamped" {
        /// Stamp and frame.
        header: Header,
        /// Force and torque in that frame.
        wrench: Wrench,
    }
}
message! {
    /// `grasp`.
    Bool "std_msgs/msg/Bool" {
        /// Yes or no.
        data: bool,
    }
}
message! {
    /// Buttons: `clutch`.
    Joy "sensor_msgs/msg/Joy" {
        /// Stamp and frame.
        header: Header,
        /// Positions of the axes.
        axes: Vec<f32>,
        /// 0 released, 1 pressed.
        buttons: Vec<i32>,
    }
}
message! {
    /// Joints: `gripper/measured_js`.
    JointState "sensor_msgs/msg/JointState" {
        /// Stamp and frame.
        header: Header,
        /// Name of each joint.
        name: Vec<String>,
        /// rad or m.
        position: Vec<f64>,
        /// rad/s or m/s.
        velocity: Vec<f64>,
        /// N m or N.
        effort: Vec<f64>,
    }
}
message! {
    /// The contact of one device with one body: `contact_state`.
    ContactState "rhombus_haptics_msgs/msg/ContactState" {
        /// Stamp and frame of the pose.
        header: Header,
        /// 0 none, 1 contact, 2 grasp.
        mode: u8,
        /// A chain is past its guard.
        saturated: bool,
        /// The movement of the device does not move the probe.
        clutched: bool,
        /// Triangle of the body's mesh with the proxy.
        face: u32,
        /// Weights of its corners at the proxy.
        barycentric: [f64; 3],
        /// m. Centre of the probe.
        probe: Point,
        /// m. Contact point on the rest surface.
        proxy: Point,
        /// Unit vector there, out of the body.
        normal: Vector3,
        /// m. Positive into the body.
        depth: f64,
        /// N on the hand, positive pushes out.
        force: f64,
        /// N/m.
        stiffness: f64,
    }
}
message! {
    /// How far the surface of a body is from its rest shape: `surface_displacement`.
    SurfaceDisplacement "rhombus_haptics_msgs/msg/SurfaceDisplacement" {
        /// Stamp of the newest pose in it and the frame of the body.
        header: Header,
        /// CRC-32 of the body's mesh.
        topology_version: u32,
        /// Moved vertices, ascending.
        vertex: Vec<u32>,
        /// m. x, y and z for each of them.
        displacement: Vec<f32>,
    }
}
