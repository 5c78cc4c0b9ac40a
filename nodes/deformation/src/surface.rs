//! The surface's displacement, computed and published at a rate of stamps. At rate 0 nothing of this exists.

use node_kit::{NodeKit, PublishError, Publisher, StartError, convert, topics};
use r2r::rhombus_haptics_msgs::msg::SurfaceDisplacement;
use rhombus_chain::{Body, DeviceSession, StampRate, SurfaceField, Tissue};

/// The field, when it is due, and where it goes.
pub(crate) struct Surface {
    publisher: Publisher<SurfaceDisplacement>,
    message: SurfaceDisplacement,
    at_rate: Option<(StampRate, SurfaceField)>,
    published: u64,
}

impl Surface {
    pub(crate) fn new(
        kit: &mut NodeKit,
        body_frame: String,
        topology_version: u32,
    ) -> Result<Surface, StartError> {
        let mut message = SurfaceDisplacement { topology_version, ..SurfaceDisplacement::default() };
        message.header.frame_id = body_frame;
        let publisher = kit.publish(&topics::SURFACE_DISPLACEMENT, "")?;
        Ok(Surface { publisher, message, at_rate: None, published: 0 })
    }

    /// Compute and publish `rate_hz` times in a second of stamps from now on; 0 drops the field and its memory.
    pub(crate) fn set_rate(&mut self, rate_hz: f64, body: &Body, tissue: &Tissue) {
        let field = self.at_rate.take().map(|(_, field)| field);
        self.at_rate = StampRate::new(rate_hz)
            .map(|rate| (rate, field.unwrap_or_else(|| SurfaceField::new(body, tissue))));
    }

    /// Publish the displacement by all devices, if it is due at this stamp.
    pub(crate) fn step<'a>(
        &mut self,
        body: &Body,
        tissue: &Tissue,
        stamp_ns: i64,
        devices: impl Iterator<Item = &'a DeviceSession>,
    ) -> Result<(), PublishError> {
        let Some((rate, field)) = &mut self.at_rate else { return Ok(()) };
        if !rate.is_due(stamp_ns) {
            return Ok(());
        }
        field.update(body, tissue, devices.flat_map(DeviceSession::impressions));
        self.message.header.stamp = convert::stamp(stamp_ns);
        field.vertices().clone_into(&mut self.message.vertex);
        self.message.displacement.clear();
        // f32: a tenth of a micrometre on a metre, and half the bytes.
        self.message.displacement.extend(field.displacements().iter().flat_map(|u| u.as_vec3().to_array()));
        self.publisher.publish(&self.message)?;
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
