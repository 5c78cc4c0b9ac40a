//! Transforms from `/tf` and `/tf_static`, and transforms out.

use r2r::geometry_msgs::msg::TransformStamped;
use r2r::std_msgs::msg::Header;
use r2r::tf2_msgs::msg::TFMessage;
use rhombus_chain::Pose;

use crate::{Inbox, NodeKit, StartError, convert, topics};

/// Hears the transforms of the whole graph.
pub struct TransformListener {
    moving: Inbox<TFMessage>,
    fixed: Inbox<TFMessage>,
}

impl TransformListener {
    /// Subscribe.
    pub fn new(kit: &mut NodeKit) -> Result<TransformListener, StartError> {
        Ok(TransformListener {
            moving: kit.subscribe(&topics::TF, "")?,
            fixed: kit.subscribe(&topics::TF_STATIC, "")?,
        })
    }

    /// Hand over what arrived since the last turn, as `(parent, child, parent_from_child)` with the transform as
    /// `[x, y, z, qx, qy, qz, qw]`, unchecked. The number of messages.
    pub fn update(&mut self, mut hear: impl FnMut(&str, &str, [f64; 7])) -> u64 {
        let mut messages = 0;
        for inbox in [&mut self.fixed, &mut self.moving] {
            while let Some(message) = inbox.take() {
                messages += 1;
                for transform in &message.transforms {
                    let parent_from_child = convert::transform_array(&transform.transform);
                    hear(&transform.header.frame_id, &transform.child_frame_id, parent_from_child);
                }
            }
        }
        messages
    }
}

/// The message for one transform: where `child` stands in `parent`.
pub fn transform_stamped(
    stamp_ns: i64,
    parent: &str,
    child: &str,
    parent_from_child: &Pose,
) -> TransformStamped {
    TransformStamped {
        header: Header { stamp: convert::stamp(stamp_ns), frame_id: parent.to_owned() },
        child_frame_id: child.to_owned(),
        transform: convert::transform(parent_from_child),
    }
}
