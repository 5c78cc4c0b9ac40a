//! What a recorded message becomes before it is sent: checked, and a pose if it is the transform of one.

use std::borrow::Cow;

use recording::cdr::{self, CdrError, Message};
use recording::messages::{
    Bool, Clock, ContactLaw, ContactState, JointState, Joy, Mesh, Point, Pose, PoseStamped,
    SurfaceDisplacement, TFMessage, Time, TransformStamped, TwistStamped, WrenchStamped,
};

/// Whether bytes are a message of one type.
type Check = fn(&[u8]) -> Result<(), CdrError>;

/// How the messages of one topic are treated.
#[derive(Clone, Copy)]
pub(crate) enum Content {
    /// Poses; they are answered in lockstep.
    Pose,
    /// Transforms that are sent as poses: older CRTK devices publish `measured_cp` so.
    TransformAsPose,
    /// Of a type that can be checked.
    Checked(Check),
    /// Of any other type.
    Unchecked,
}

/// A message as it is sent.
pub(crate) struct Prepared<'a> {
    /// CDR with its header.
    pub(crate) data: Cow<'a, [u8]>,
    /// Of a pose.
    pub(crate) stamp: Option<Time>,
}

impl Content {
    /// For messages that were recorded as `type_name` and are played on `target`.
    pub(crate) fn of(type_name: &str, target: &str) -> Self {
        let is_pose = is_pose_topic(target);
        match type_name {
            PoseStamped::TYPE_NAME if is_pose => Self::Pose,
            TransformStamped::TYPE_NAME if is_pose => Self::TransformAsPose,
            _ => check_of(type_name).map_or(Self::Unchecked, Self::Checked),
        }
    }

    /// The type under which messages recorded as `recorded` are played.
    pub(crate) fn played_type(self, recorded: &str) -> &str {
        if matches!(self, Self::TransformAsPose) { PoseStamped::TYPE_NAME } else { recorded }
    }

    /// Whether these are poses of a device.
    pub(crate) fn is_pose(self) -> bool {
        matches!(self, Self::Pose | Self::TransformAsPose)
    }

    /// The message as it is sent.
    ///
    /// # Errors
    /// The bytes are not a message of the type.
    pub(crate) fn prepare(self, data: &[u8]) -> Result<Prepared<'_>, CdrError> {
        match self {
            Self::Pose => {
                let pose: PoseStamped = cdr::decode(data)?;
                Ok(Prepared { data: Cow::Borrowed(data), stamp: Some(pose.header.stamp) })
            }
            Self::TransformAsPose => {
                let pose = pose_of(cdr::decode(data)?);
                Ok(Prepared { data: Cow::Owned(cdr::encode(&pose)), stamp: Some(pose.header.stamp) })
            }
            Self::Checked(check) => {
                check(data)?;
                Ok(Prepared { data: Cow::Borrowed(data), stamp: None })
            }
            Self::Unchecked => Ok(Prepared { data: Cow::Borrowed(data), stamp: None }),
        }
    }
}

/// Whether a topic carries the poses of a device.
pub(crate) fn is_pose_topic(name: &str) -> bool {
    name.rsplit('/').next() == Some("measured_cp")
}

fn check_of(type_name: &str) -> Option<Check> {
    fn check<M: Message>(data: &[u8]) -> Result<(), CdrError> {
        cdr::decode::<M>(data).map(drop)
    }
    macro_rules! table {
        ($($message:ty),+ $(,)?) => {
            match type_name {
                $(<$message>::TYPE_NAME => Some(check::<$message>),)+
                _ => None,
            }
        };
    }
    table!(
        Bool,
        Clock,
        ContactLaw,
        ContactState,
        JointState,
        Joy,
        Mesh,
        PoseStamped,
        SurfaceDisplacement,
        TFMessage,
        TransformStamped,
        TwistStamped,
        WrenchStamped,
    )
}

/// The pose of the child in the outer frame, with the same stamp.
fn pose_of(transform: TransformStamped) -> PoseStamped {
    let at = transform.transform.translation;
    let position = Point { x: at.x, y: at.y, z: at.z };
    PoseStamped {
        header: transform.header,
        pose: Pose { position, orientation: transform.transform.rotation },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use recording::messages::{Header, Quaternion, Transform, Vector3};

    fn transform() -> TransformStamped {
        TransformStamped {
            header: Header { stamp: Time { sec: 3, nanosec: 4 }, frame_id: "base".to_owned() },
            child_frame_id: "tip".to_owned(),
            transform: Transform {
                translation: Vector3 { x: 1.0, y: -2.0, z: 1e-300 },
                rotation: Quaternion { x: 0.5, y: -0.5, z: 0.5, w: 0.5 },
            },
        }
    }

    #[test]
    fn a_transform_on_a_topic_of_poses_is_sent_as_the_pose_of_its_child_with_the_same_stamp_and_frame() {
        let content = Content::of(TransformStamped::TYPE_NAME, "/left/measured_cp");
        assert_eq!(content.played_type(TransformStamped::TYPE_NAME), "geometry_msgs/msg/PoseStamped");
        let bytes = cdr::encode(&transform());
        let sent = content.prepare(&bytes).unwrap();
        let pose: PoseStamped = cdr::decode(&sent.data).unwrap();
        assert_eq!(sent.stamp, Some(Time { sec: 3, nanosec: 4 }));
        assert_eq!(pose.header, transform().header);
        assert_eq!((pose.pose.position.x, pose.pose.position.y, pose.pose.position.z), (1.0, -2.0, 1e-300));
        assert_eq!(pose.pose.orientation, transform().transform.rotation);
    }

    #[test]
    fn a_transform_elsewhere_is_sent_as_it_is() {
        let content = Content::of(TransformStamped::TYPE_NAME, "/left/camera");
        let bytes = cdr::encode(&transform());
        assert_eq!(content.played_type(TransformStamped::TYPE_NAME), TransformStamped::TYPE_NAME);
        assert!(!content.is_pose());
        assert_eq!(*content.prepare(&bytes).unwrap().data, *bytes);
    }

    #[test]
    fn short_messages_are_refused_and_longer_ones_are_sent_as_they_are() {
        let bytes = cdr::encode(&PoseStamped::default());
        let content = Content::of(PoseStamped::TYPE_NAME, "/measured_cp");
        assert!(content.prepare(&bytes).is_ok());
        for end in 0..bytes.len() {
            assert!(content.prepare(&bytes[..end]).is_err(), "{end} bytes");
        }
        let longer = [&bytes[..], &[0; 4]].concat();
        assert_eq!(*content.prepare(&longer).unwrap().data, *longer);
        assert!(Content::of(Bool::TYPE_NAME, "/grasp").prepare(&[0, 1, 0, 0]).is_err());
    }
}
