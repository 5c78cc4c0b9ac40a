//! What is drawn, as plain data: the shapes of RViz's markers and nothing of ROS.

mod body;
mod chains;
mod contact;

pub(crate) use body::body;
pub(crate) use chains::{chains, rows};
pub(crate) use contact::{force, probe, proxy};

use glam::DVec3;

use crate::colour::Colour;

/// A kind of thing that is drawn; its name is the namespace of the marker, under which RViz can switch it off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Thing {
    /// The deformed surface.
    Body,
    /// The sphere that touches.
    Probe,
    /// The contact point on the rest surface.
    Proxy,
    /// The force on the hand.
    Force,
    /// The rhombi of the chains at the contact.
    Chains,
}

impl Thing {
    /// The marker namespace.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Thing::Body => "body",
            Thing::Probe => "probe",
            Thing::Proxy => "proxy",
            Thing::Force => "force",
            Thing::Chains => "chains",
        }
    }
}

/// Names one marker: what it shows, and which of that kind it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Key {
    pub(crate) thing: Thing,
    pub(crate) id: i32,
}

/// The form of a drawing, with its measures in metres.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// Three points for each triangle, a colour for each point.
    Triangles,
    /// Two points for each line.
    Lines { width_m: f64 },
    /// One sphere, at the one point.
    Sphere { diameter_m: f64 },
    /// One sphere at each point.
    Spheres { diameter_m: f64 },
    /// From the first point to the second.
    Arrow { shaft_m: f64, head_m: f64, head_length_m: f64 },
}

/// One marker.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drawing {
    pub(crate) key: Key,
    /// The frame of `points_m`.
    pub(crate) frame_id: String,
    pub(crate) shape: Shape,
    pub(crate) points_m: Vec<DVec3>,
    /// Of the whole drawing, unless `colours` has one for each point.
    pub(crate) colour: Colour,
    pub(crate) colours: Vec<Colour>,
}

/// No point of a drawing is farther away than this: beyond it lies nothing but mistakes, and the single precision of
/// viewers.
const FARTHEST_M: f64 = 1e6;

/// Whether a viewer can draw at this position: neither NaN nor absurdly far away.
pub(crate) fn is_drawable(position_m: DVec3) -> bool {
    position_m.abs().cmple(DVec3::splat(FARTHEST_M)).all()
}
