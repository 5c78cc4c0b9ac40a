//! What a replay in lockstep waits for: how many messages the model has taken into account.
//!
//! A topic is in order in itself but not with others: without a word from the model nobody knows whether a grasp counts
//! for the pose that is sent after it.

use node_kit::{NodeKit, PublishError, Publisher, StartError, topics};
use r2r::std_msgs::msg::UInt64;

/// Counts and tells.
pub(crate) struct Heard {
    buttons: Total,
    transforms: Total,
}

struct Total {
    publisher: Publisher<UInt64>,
    message: UInt64,
}

impl Heard {
    /// Make the topics.
    pub(crate) fn new(kit: &mut NodeKit) -> Result<Heard, StartError> {
        Ok(Heard {
            buttons: Total {
                publisher: kit.publish(&topics::BUTTONS_HEARD, "")?,
                message: UInt64::default(),
            },
            transforms: Total {
                publisher: kit.publish(&topics::TRANSFORMS_HEARD, "")?,
                message: UInt64::default(),
            },
        })
    }

    /// So many more have been taken into account.
    pub(crate) fn add(&mut self, buttons: u64, transforms: u64) -> Result<(), PublishError> {
        self.buttons.add(buttons)?;
        self.transforms.add(transforms)
    }
}

impl Total {
    fn add(&mut self, count: u64) -> Result<(), PublishError> {
        if count == 0 {
            return Ok(());
        }
        self.message.data += count;
        self.publisher.publish(&self.message)
    }
}
