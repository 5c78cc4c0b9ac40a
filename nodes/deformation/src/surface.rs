//! The surface's displacement as a message. Without a rate nothing of this exists.

use node_kit::topics::Topic;
use node_kit::{NodeKit, PublishError, Publisher, StartError, convert, topics};
use r2r::rhombus_haptics_msgs::msg::SurfaceDisplacement;
use rhombus_chain::SurfaceMoment;

/// The surface's output: the topic, and what fills it.
pub(crate) struct Surface {
    message: SurfaceDisplacement,
    topic: Topic<SurfaceDisplacement>,
    /// Made when the surface is published for the first time.
    publisher: Option<Publisher<SurfaceDisplacement>>,
    published: u64,
}

impl Surface {
    /// One that publishes nothing yet.
    pub(crate) fn new(body_frame: &str, topology_version: u32, lockstep: bool) -> Surface {
        let mut message = SurfaceDisplacement { topology_version, ..SurfaceDisplacement::default() };
        message.header.frame_id = body_frame.to_owned();
        let topic = topics::SURFACE_DISPLACEMENT.kept_in_lockstep(lockstep);
        Surface { message, topic, publisher: None, published: 0 }
    }

    /// Make the topic, if it is not there.
    pub(crate) fn announce(&mut self, kit: &mut NodeKit) -> Result<(), StartError> {
        if self.publisher.is_none() {
            self.publisher = Some(kit.publish(&self.topic, "")?);
        }
        Ok(())
    }

    /// Publish the surface at a moment.
    pub(crate) fn publish(&mut self, moment: &SurfaceMoment<'_>) -> Result<(), PublishError> {
        let Some(publisher) = &self.publisher else { return Ok(()) };
        self.message.header.stamp = convert::stamp(moment.stamp_ns);
        moment.vertices.clone_into(&mut self.message.vertex);
        self.message.displacement.clear();
        self.message.displacement.extend(moment.displacements_f32());
        publisher.publish(&self.message)?;
        self.published += 1;
        Ok(())
    }

    /// Number of vertices that moved in the last message.
    pub(crate) fn touched(&self) -> usize {
        self.message.vertex.len()
    }

    /// Number of messages.
    pub(crate) fn published(&self) -> u64 {
        self.published
    }
}
