//! The surface's displacement, computed and published at a rate of stamps. At rate 0 nothing of this exists.

use node_kit::{NodeKit, PublishError, Publisher, StartError, convert, topics};
use r2r::rhombus_haptics_msgs::msg::SurfaceDisplacement;
use rhombus_chain::{Body, DeviceSession, StampRate, SurfaceField, Tissue};
use scene::Scene;

/// The surface's output: the topic, and what fills it.
pub(crate) struct Surface {
    message: SurfaceDisplacement,
    /// Made when the rate is above zero for the first time.
    publisher: Option<Publisher<SurfaceDisplacement>>,
    at_rate: Option<(StampRate, SurfaceField)>,
    published: u64,
}

impl Surface {
    /// One that publishes nothing yet.
    pub(crate) fn new(body_frame: String, topology_version: u32) -> Surface {
        let mut message = SurfaceDisplacement { topology_version, ..SurfaceDisplacement::default() };
        message.header.frame_id = body_frame;
        Surface { message, publisher: None, at_rate: None, published: 0 }
    }

    /// Compute and publish at `surface.rate` from now on; 0 drops the field and its memory.
    pub(crate) fn set_rate(
        &mut self,
        kit: &mut NodeKit,
        scene: &Scene,
        body: &Body,
        tissue: &Tissue,
    ) -> Result<(), StartError> {
        self.at_rate = scene.surface_field(body, tissue);
        if self.at_rate.is_some() && self.publisher.is_none() {
            self.publisher = Some(kit.publish(&topics::SURFACE_DISPLACEMENT, "")?);
        }
        Ok(())
    }

    /// Publish the displacement by all devices, if it is due at this stamp.
    pub(crate) fn step<'a>(
        &mut self,
        body: &Body,
        tissue: &Tissue,
        stamp_ns: i64,
        devices: impl Iterator<Item = &'a DeviceSession>,
    ) -> Result<(), PublishError> {
        let (Some((rate, field)), Some(publisher)) = (&mut self.at_rate, &self.publisher) else {
            return Ok(());
        };
        if !rate.is_due(stamp_ns) {
            return Ok(());
        }
        field.update(body, tissue, devices.flat_map(DeviceSession::impressions));
        self.message.header.stamp = convert::stamp(stamp_ns);
        field.vertices().clone_into(&mut self.message.vertex);
        self.message.displacement.clear();
        // f32: a tenth of a micrometre on a metre, and half the bytes.
        self.message.displacement.extend(field.displacements().iter().flat_map(|u| u.as_vec3().to_array()));
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
