//! The model's answers as recorded messages: the same values in the same fields as the deformation node publishes.

use glam::DVec3;
use recording::Qos;
use recording::cdr::{self, Message};
use recording::messages::{
    ContactLaw, ContactState, Duration, Header, Mesh, MeshTriangle, Point, SurfaceDisplacement, Time,
    Vector3, WrenchStamped,
};
use rhombus_chain::{
    Answer, ChainParameters, ContactReport, Formulation, LAW_VALIDITY_NS, Mode, Session, SurfaceMoment,
    chain_for_hand,
};
use scene::topic;

const NS_PER_S: i64 = 1_000_000_000;

/// A topic that the model speaks on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputTopic {
    /// Absolute.
    pub name: String,
    /// Such as `geometry_msgs/msg/WrenchStamped`.
    pub type_name: &'static str,
    /// What the node offers.
    pub qos: Qos,
}

/// Topics of one device, in this order.
pub(super) const FORCE: usize = 0;
pub(super) const LAW: usize = 1;
pub(super) const STATE: usize = 2;
/// How many a device has.
pub(super) const PER_DEVICE: usize = 3;

/// The topics of all devices, then the surface, then the mesh.
pub(super) fn topics(namespace: &str, devices: &[String]) -> Vec<OutputTopic> {
    let offer = |depth: u64, latched: bool| Qos {
        depth,
        durability: if latched {
            recording::Durability::TransientLocal
        } else {
            recording::Durability::Volatile
        },
        ..Qos::default()
    };
    let of_device = |device: &String| {
        let name = |topic: &str| topic::of_device(namespace, device, topic);
        [
            OutputTopic {
                name: name(topic::SERVO_CF),
                type_name: WrenchStamped::TYPE_NAME,
                qos: offer(1000, false),
            },
            OutputTopic {
                name: name(topic::CONTACT_LAW),
                type_name: ContactLaw::TYPE_NAME,
                qos: offer(10, false),
            },
            OutputTopic {
                name: name(topic::CONTACT_STATE),
                type_name: ContactState::TYPE_NAME,
                qos: offer(1000, false),
            },
        ]
    };
    let mut topics: Vec<OutputTopic> = devices.iter().flat_map(of_device).collect();
    topics.push(OutputTopic {
        name: topic::absolute(namespace, topic::SURFACE_DISPLACEMENT),
        type_name: SurfaceDisplacement::TYPE_NAME,
        qos: offer(10, false),
    });
    topics.push(OutputTopic {
        name: topic::absolute(namespace, topic::BODY_MESH),
        type_name: Mesh::TYPE_NAME,
        qos: offer(1, true),
    });
    topics
}

/// The messages of one device, made once and filled again for every pose.
pub(super) struct Answers {
    force: WrenchStamped,
    law: ContactLaw,
    state: ContactState,
}

impl Answers {
    /// With the chains of the session, for positions of the hand.
    pub(super) fn new(session: &Session, motion_scale: f64) -> Self {
        let law = session.tissue().law();
        let chains: Vec<ChainParameters> =
            law.chains().iter().map(|chain| chain_for_hand(chain.parameters(), motion_scale)).collect();
        let each = |value: fn(&ChainParameters) -> f64| chains.iter().map(value).collect();
        let law = ContactLaw {
            validity: Duration { sec: 0, nanosec: LAW_VALIDITY_NS as u32 },
            formulation: match law.formulation() {
                Formulation::Published => 0,
                Formulation::Energy => 1,
            },
            rod_length: each(|chain| chain.rod_length_m),
            angle: each(|chain| chain.angle_rad),
            ratio: each(|chain| chain.ratio),
            units: chains.iter().map(|chain| chain.units).collect(),
            normal_stiffness: each(|chain| chain.normal_stiffness_n_per_m),
            tangential_stiffness: each(|chain| chain.tangential_stiffness_n_per_m),
            tangential_growth: each(|chain| chain.tangential_growth),
            ..ContactLaw::default()
        };
        Self { force: WrenchStamped::default(), law, state: ContactState::default() }
    }

    /// Takes over the answer to the pose with this header; none for a pose that was rejected.
    pub(super) fn set(&mut self, header: &Header, answer: Option<&Answer>) {
        for target in [&mut self.force.header, &mut self.law.header, &mut self.state.header] {
            target.clone_from(header);
        }
        self.force.wrench.force = vector(answer.map_or(DVec3::ZERO, |answer| answer.force_in_frame_n));
        let law = answer.map(|answer| answer.law_for_hand).unwrap_or_default();
        self.law.mode = mode_number(law.mode);
        self.law.anchor = point(law.anchor);
        self.law.normal = vector(law.normal);
        self.law.probe_radius = law.probe_radius_m;
        self.law.depth_offset = law.depth_offset_m;
        self.law.stiffness_factor = law.stiffness_factor;
        self.law.stiffness_gradient = vector(law.stiffness_gradient_per_m);
        self.law.lateral_stiffness = law.lateral_stiffness_n_per_m;
        let contact = answer.map_or(ContactReport::default(), ContactReport::from);
        self.state.mode = mode_number(contact.mode);
        self.state.saturated = contact.saturated;
        self.state.clutched = contact.clutched;
        self.state.face = contact.face;
        self.state.barycentric = contact.barycentric.to_array();
        self.state.probe = point(contact.probe);
        self.state.proxy = point(contact.proxy);
        self.state.normal = vector(contact.normal);
        self.state.depth = contact.depth_m;
        self.state.force = contact.force_n;
        self.state.stiffness = contact.stiffness_n_per_m;
    }

    /// The bytes of the three messages, by their places among the device's topics.
    pub(super) fn encoded(&self) -> [(usize, Vec<u8>); PER_DEVICE] {
        [(FORCE, cdr::encode(&self.force)), (LAW, cdr::encode(&self.law)), (STATE, cdr::encode(&self.state))]
    }
}

/// The surface as a message.
pub(super) struct Surface {
    message: SurfaceDisplacement,
}

impl Surface {
    pub(super) fn new(body_frame: &str, topology_version: u32) -> Self {
        let header = Header { frame_id: body_frame.to_owned(), ..Header::default() };
        Self { message: SurfaceDisplacement { header, topology_version, ..SurfaceDisplacement::default() } }
    }

    pub(super) fn encoded(&mut self, moment: &SurfaceMoment<'_>) -> Vec<u8> {
        self.message.header.stamp = stamp(moment.stamp_ns);
        moment.vertices.clone_into(&mut self.message.vertex);
        self.message.displacement.clear();
        self.message.displacement.extend(moment.displacements_f32());
        cdr::encode(&self.message)
    }
}

/// The rest surface as the node's latched message.
pub(super) fn rest_mesh(session: &Session) -> Vec<u8> {
    let mesh = session.body().mesh();
    cdr::encode(&Mesh {
        triangles: mesh.triangles().iter().map(|corners| MeshTriangle { vertex_indices: *corners }).collect(),
        vertices: mesh.vertices().iter().copied().map(point).collect(),
    })
}

fn mode_number(mode: Mode) -> u8 {
    match mode {
        Mode::None => 0,
        Mode::Contact => 1,
        Mode::Grasp => 2,
    }
}

fn point(p: DVec3) -> Point {
    Point { x: p.x, y: p.y, z: p.z }
}

fn vector(v: DVec3) -> Vector3 {
    Vector3 { x: v.x, y: v.y, z: v.z }
}

/// A stamp in nanoseconds.
pub(super) fn stamp_ns(stamp: &Time) -> i64 {
    i64::from(stamp.sec) * NS_PER_S + i64::from(stamp.nanosec)
}

/// A stamp that came from a message, so that it fits into one.
fn stamp(ns: i64) -> Time {
    Time { sec: ns.div_euclid(NS_PER_S) as i32, nanosec: ns.rem_euclid(NS_PER_S) as u32 }
}
