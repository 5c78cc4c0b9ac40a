//! The messages this product needs without ROS. Fields, names and units are those of the `.msg` files.

mod definition;
mod hashes;
mod text;

use serde::Serialize;

use crate::cdr::{Decoder, Encoder, Fault, Message, Shape, Wire};

pub(crate) use definition::fields_of;
pub use definition::{is_same, same_definition};
pub use text::own_definition;

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
            fn shape() -> Shape {
                let fields = vec![$((stringify!($field), <$type as Wire>::shape())),+];
                Shape::Message { type_name: $type_name, fields }
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
    /// A span of time.
    Duration "builtin_interfaces/msg/Duration" {
        /// Seconds.
        sec: i32,
        /// Nanoseconds on top.
        nanosec: u32,
    }
}
message! {
    /// What time it is: `/clock`.
    Clock "rosgraph_msgs/msg/Clock" {
        /// Now.
        clock: Time,
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
    /// Where a frame is in another.
    Transform "geometry_msgs/msg/Transform" {
        /// m.
        translation: Vector3,
        /// Unit quaternion.
        rotation: Quaternion,
    }
}
message! {
    /// Where a frame is in another, and when; older CRTK devices say so where they are.
    TransformStamped "geometry_msgs/msg/TransformStamped" {
        /// Stamp and outer frame.
        header: Header,
        /// The frame that is placed.
        child_frame_id: String,
        /// The pose of the child in the outer frame.
        transform: Transform,
    }
}
message! {
    /// Frames: `/tf` and `/tf_static`.
    TFMessage "tf2_msgs/msg/TFMessage" {
        /// Any number of them.
        transforms: Vec<TransformStamped>,
    }
}
message! {
    /// Velocities.
    Twist "geometry_msgs/msg/Twist" {
        /// m/s.
        linear: Vector3,
        /// rad/s.
        angular: Vector3,
    }
}
message! {
    /// How fast a device moves: `measured_cv`.
    TwistStamped "geometry_msgs/msg/TwistStamped" {
        /// Stamp and frame.
        header: Header,
        /// Velocities in that frame.
        twist: Twist,
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
    /// A count.
    UInt64 "std_msgs/msg/UInt64" {
        /// Its value.
        data: u64,
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
message! {
    /// A triangle of a mesh.
    MeshTriangle "shape_msgs/msg/MeshTriangle" {
        /// Its corners, numbers of vertices.
        vertex_indices: [u32; 3],
    }
}
message! {
    /// The rest surface of a body: `mesh`.
    Mesh "shape_msgs/msg/Mesh" {
        /// Counter-clockwise seen from outside.
        triangles: Vec<MeshTriangle>,
        /// m.
        vertices: Vec<Point>,
    }
}
message! {
    /// What a motor loop needs to answer a position with a force by itself: `contact_law`.
    ContactLaw "rhombus_haptics_msgs/msg/ContactLaw" {
        /// Stamp and frame of the pose the law was computed from.
        header: Header,
        /// How long after the stamp the law may be used.
        validity: Duration,
        /// 0 none, 1 contact, 2 grasp.
        mode: u8,
        /// m. The point of the rest surface under the probe; in a grasp the probe's position when it began.
        anchor: Point,
        /// Unit vector there, out of the body.
        normal: Vector3,
        /// m. Radius of the probe.
        probe_radius: f64,
        /// m. Added to the depth along the normal.
        depth_offset: f64,
        /// Multiplies the force of the chains at the anchor.
        stiffness_factor: f64,
        /// 1/m. Change of that factor for each metre of the hand.
        stiffness_gradient: Vector3,
        /// N/m. In a grasp: pull towards the anchor for each metre across the normal.
        lateral_stiffness: f64,
        /// 0 published, 1 energy.
        formulation: u8,
        /// m. For each chain, the length of the rods of its first unit.
        rod_length: Vec<f64>,
        /// rad. For each chain, the rest angle.
        angle: Vec<f64>,
        /// For each chain, size of a unit divided by that of the one before.
        ratio: Vec<f64>,
        /// For each chain, how many units it has.
        units: Vec<u32>,
        /// N/m. For each chain, the normal spring of every unit.
        normal_stiffness: Vec<f64>,
        /// N/m. For each chain, the tangential spring of the first unit.
        tangential_stiffness: Vec<f64>,
        /// For each chain, the units over which the tangential stiffness grows by a factor e.
        tangential_growth: Vec<f64>,
    }
}

/// The fields of a type that is defined here.
fn shape_of(type_name: &str) -> Option<Shape> {
    const KNOWN: &[fn() -> Shape] = &[
        Time::shape,
        Duration::shape,
        Clock::shape,
        Header::shape,
        Point::shape,
        Vector3::shape,
        Quaternion::shape,
        Pose::shape,
        PoseStamped::shape,
        Transform::shape,
        TransformStamped::shape,
        TFMessage::shape,
        Twist::shape,
        TwistStamped::shape,
        Wrench::shape,
        WrenchStamped::shape,
        Bool::shape,
        UInt64::shape,
        Joy::shape,
        JointState::shape,
        ContactState::shape,
        SurfaceDisplacement::shape,
        MeshTriangle::shape,
        Mesh::shape,
        ContactLaw::shape,
    ];
    KNOWN
        .iter()
        .map(|shape| shape())
        .find(|shape| matches!(shape, Shape::Message { type_name: known, .. } if *known == type_name))
}
