//! What a message says about itself, for the types this crate knows.

use crate::cdr::{CdrError, Message, decode_with_rest};
use crate::messages::*;

/// A quaternion this far from unit length is taken as a rotation by the model too.
const NORM_TOLERANCE: f64 = 1e-3;

/// What one message says.
pub(super) struct Facts {
    /// The stamp of its header; `None` for types without one.
    pub(super) stamp: Option<Time>,
    /// Its numbers can be what they are called: none is NaN or infinite, rotations are unit quaternions.
    pub(super) sound: bool,
    /// There are bytes behind its last field.
    pub(super) has_rest: bool,
}

/// Decodes a message and looks at it.
pub(super) type Look = fn(&[u8]) -> Result<Facts, CdrError>;

/// How messages of a type are looked at; `None` for types this crate does not know.
pub(super) fn look_at(type_name: &str) -> Option<Look> {
    match type_name {
        PoseStamped::TYPE_NAME => Some(look::<PoseStamped>),
        WrenchStamped::TYPE_NAME => Some(look::<WrenchStamped>),
        Joy::TYPE_NAME => Some(look::<Joy>),
        JointState::TYPE_NAME => Some(look::<JointState>),
        ContactState::TYPE_NAME => Some(look::<ContactState>),
        SurfaceDisplacement::TYPE_NAME => Some(look::<SurfaceDisplacement>),
        TransformStamped::TYPE_NAME => Some(look::<TransformStamped>),
        TFMessage::TYPE_NAME => Some(look::<TFMessage>),
        TwistStamped::TYPE_NAME => Some(look::<TwistStamped>),
        ContactLaw::TYPE_NAME => Some(look::<ContactLaw>),
        Mesh::TYPE_NAME => Some(look::<Mesh>),
        Clock::TYPE_NAME => Some(look::<Clock>),
        Bool::TYPE_NAME => Some(look::<Bool>),
        UInt64::TYPE_NAME => Some(look::<UInt64>),
        _ => None,
    }
}

/// Whether messages of a type say where a device is.
pub(super) fn is_pose(type_name: &str) -> bool {
    [PoseStamped::TYPE_NAME, TransformStamped::TYPE_NAME].contains(&type_name)
}

fn look<M: Message + Say>(data: &[u8]) -> Result<Facts, CdrError> {
    let (message, rest) = decode_with_rest::<M>(data)?;
    Ok(Facts { stamp: message.stamp(), sound: message.is_sound(), has_rest: rest > 0 })
}

/// What is asked of each type.
trait Say {
    fn stamp(&self) -> Option<Time>;
    fn is_sound(&self) -> bool;
}

/// Types with a header, and when their numbers are sound.
macro_rules! stamped {
    ($($message:ident: |$value:ident| $sound:expr;)+) => {$(
        impl Say for $message {
            fn stamp(&self) -> Option<Time> {
                Some(self.header.stamp.clone())
            }
            fn is_sound(&self) -> bool {
                let $value = self;
                $sound
            }
        }
    )+};
}

stamped! {
    PoseStamped: |m| is_point(&m.pose.position) && is_rotation(&m.pose.orientation);
    TransformStamped: |m| is_transform(&m.transform);
    TwistStamped: |m| is_vector(&m.twist.linear) && is_vector(&m.twist.angular);
    WrenchStamped: |m| is_vector(&m.wrench.force) && is_vector(&m.wrench.torque);
    ContactState: |m| m.depth.is_finite() && m.force.is_finite();
    SurfaceDisplacement: |m| m.displacement.iter().all(|x| x.is_finite());
    ContactLaw: |m| is_point(&m.anchor) && is_vector(&m.normal);
    Joy: |_m| true;
    // NaN is how a joint without a sensor says so.
    JointState: |_m| true;
}

/// Types without a header of their own.
macro_rules! plain {
    ($($message:ident: |$value:ident| $sound:expr;)+) => {$(
        impl Say for $message {
            fn stamp(&self) -> Option<Time> {
                None
            }
            fn is_sound(&self) -> bool {
                let $value = self;
                $sound
            }
        }
    )+};
}

plain! {
    TFMessage: |m| m.transforms.iter().all(|stamped| is_transform(&stamped.transform));
    Mesh: |m| m.vertices.iter().all(is_point);
    Clock: |_m| true;
    Bool: |_m| true;
    UInt64: |_m| true;
}

fn is_transform(transform: &Transform) -> bool {
    is_vector(&transform.translation) && is_rotation(&transform.rotation)
}

fn is_point(point: &Point) -> bool {
    [point.x, point.y, point.z].iter().all(|x| x.is_finite())
}

fn is_vector(vector: &Vector3) -> bool {
    [vector.x, vector.y, vector.z].iter().all(|x| x.is_finite())
}

/// False for NaN too.
fn is_rotation(quaternion: &Quaternion) -> bool {
    let Quaternion { x, y, z, w } = quaternion;
    ((x * x + y * y + z * z + w * w).sqrt() - 1.0).abs() <= NORM_TOLERANCE
}
