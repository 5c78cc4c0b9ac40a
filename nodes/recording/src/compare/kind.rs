//! The messages that are compared: their fields by name, with units.

use crate::cdr::Message;
use crate::messages::{
    ContactLaw, ContactState, JointState, PoseStamped, SurfaceDisplacement, Time, TwistStamped, WrenchStamped,
};

/// A type of message that can be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Wrench,
    Contact,
    Law,
    Surface,
    Pose,
    Twist,
    Joints,
}

/// A field of a message: its path in the `.msg` files. Elements of an array are one field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Field {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
}

/// The content of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Column<'a> {
    Stamp(&'a Time),
    Text(&'a str),
    Flag(bool),
    Whole(i64),
    Number(f64),
    Numbers(&'a [f64]),
    Wholes(&'a [u32]),
    Texts(&'a [String]),
    /// Displacements of the vertices of the message, compared as a field on the surface.
    Vertices(&'a SurfaceDisplacement),
}

/// A message as a list of its fields.
pub(super) trait Compared: Message + Default {
    /// The fields in the order of the message.
    const FIELDS: &'static [Field];
    /// Their contents, in the same order.
    fn columns(&self) -> impl Iterator<Item = Column<'_>>;
}

impl Kind {
    pub(super) const ALL: [Self; 7] =
        [Self::Wrench, Self::Contact, Self::Law, Self::Surface, Self::Pose, Self::Twist, Self::Joints];

    pub(super) fn of(type_name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.type_name() == type_name)
    }

    pub(super) fn type_name(self) -> &'static str {
        match self {
            Self::Wrench => WrenchStamped::TYPE_NAME,
            Self::Contact => ContactState::TYPE_NAME,
            Self::Law => ContactLaw::TYPE_NAME,
            Self::Surface => SurfaceDisplacement::TYPE_NAME,
            Self::Pose => PoseStamped::TYPE_NAME,
            Self::Twist => TwistStamped::TYPE_NAME,
            Self::Joints => JointState::TYPE_NAME,
        }
    }

    pub(super) fn fields(self) -> &'static [Field] {
        match self {
            Self::Wrench => WrenchStamped::FIELDS,
            Self::Contact => ContactState::FIELDS,
            Self::Law => ContactLaw::FIELDS,
            Self::Surface => SurfaceDisplacement::FIELDS,
            Self::Pose => PoseStamped::FIELDS,
            Self::Twist => TwistStamped::FIELDS,
            Self::Joints => JointState::FIELDS,
        }
    }

    /// For each field, whether a tolerance can be given for it: everything but numbers has to be equal.
    pub(super) fn tolerable(self) -> Vec<bool> {
        fn of<M: Compared>() -> Vec<bool> {
            let is_number =
                |column| matches!(column, Column::Number(_) | Column::Numbers(_) | Column::Vertices(_));
            M::default().columns().map(is_number).collect()
        }
        match self {
            Self::Wrench => of::<WrenchStamped>(),
            Self::Contact => of::<ContactState>(),
            Self::Law => of::<ContactLaw>(),
            Self::Surface => of::<SurfaceDisplacement>(),
            Self::Pose => of::<PoseStamped>(),
            Self::Twist => of::<TwistStamped>(),
            Self::Joints => of::<JointState>(),
        }
    }

    /// What is drawn of such a message, and its unit.
    pub(super) fn drawn(self) -> Option<(&'static str, &'static str)> {
        match self {
            Self::Wrench => Some(("|force|", "N")),
            Self::Contact => Some(("depth", "m")),
            Self::Surface => Some(("largest displacement", "m")),
            Self::Law | Self::Pose | Self::Twist | Self::Joints => None,
        }
    }
}

/// What a field of a message struct can be.
trait Content {
    fn column(&self) -> Column<'_>;
}

macro_rules! content {
    ($($type:ty: $this:ident => $column:expr;)+) => {$(
        impl Content for $type {
            fn column(&self) -> Column<'_> {
                let $this = self;
                $column
            }
        }
    )+};
}
content! {
    Time: this => Column::Stamp(this);
    String: this => Column::Text(this);
    bool: this => Column::Flag(*this);
    u8: this => Column::Whole((*this).into());
    i32: this => Column::Whole((*this).into());
    u32: this => Column::Whole((*this).into());
    f64: this => Column::Number(*this);
    [f64; 3]: this => Column::Numbers(this);
    Vec<f64>: this => Column::Numbers(this);
    Vec<u32>: this => Column::Wholes(this);
    Vec<String>: this => Column::Texts(this);
}

/// Lists the fields of a message behind its header, with their units.
macro_rules! compared {
    ($type:ident { $($first:ident $(. $rest:ident)* $unit:literal)+ }) => {
        impl Compared for $type {
            const FIELDS: &'static [Field] = &[
                Field { name: "header.stamp", unit: "s" },
                Field { name: "header.frame_id", unit: "" },
                $(Field { name: concat!(stringify!($first) $(, ".", stringify!($rest))*), unit: $unit },)+
            ];
            fn columns(&self) -> impl Iterator<Item = Column<'_>> {
                [
                    self.header.stamp.column(),
                    self.header.frame_id.column(),
                    $(self.$first $(. $rest)* .column(),)+
                ]
                .into_iter()
            }
        }
    };
}

compared!(WrenchStamped {
    wrench.force.x "N" wrench.force.y "N" wrench.force.z "N"
    wrench.torque.x "N m" wrench.torque.y "N m" wrench.torque.z "N m"
});
compared!(ContactState {
    mode "" saturated "" clutched "" face "" barycentric ""
    probe.x "m" probe.y "m" probe.z "m"
    proxy.x "m" proxy.y "m" proxy.z "m"
    normal.x "" normal.y "" normal.z ""
    depth "m" force "N" stiffness "N/m"
});
compared!(ContactLaw {
    validity.sec "s" validity.nanosec "ns" mode ""
    anchor.x "m" anchor.y "m" anchor.z "m"
    normal.x "" normal.y "" normal.z ""
    probe_radius "m" depth_offset "m" stiffness_factor ""
    stiffness_gradient.x "1/m" stiffness_gradient.y "1/m" stiffness_gradient.z "1/m"
    lateral_stiffness "N/m" formulation ""
    rod_length "m" angle "rad" ratio "" units ""
    normal_stiffness "N/m" tangential_stiffness "N/m" tangential_growth ""
});
compared!(PoseStamped {
    pose.position.x "m" pose.position.y "m" pose.position.z "m"
    pose.orientation.x "" pose.orientation.y "" pose.orientation.z "" pose.orientation.w ""
});
compared!(TwistStamped {
    twist.linear.x "m/s" twist.linear.y "m/s" twist.linear.z "m/s"
    twist.angular.x "rad/s" twist.angular.y "rad/s" twist.angular.z "rad/s"
});
compared!(JointState {
    name "" position "rad or m" velocity "rad/s or m/s" effort "N m or N"
});

impl Compared for SurfaceDisplacement {
    const FIELDS: &'static [Field] = &[
        Field { name: "header.stamp", unit: "s" },
        Field { name: "header.frame_id", unit: "" },
        Field { name: "topology_version", unit: "" },
        Field { name: "displacement", unit: "m" },
    ];
    fn columns(&self) -> impl Iterator<Item = Column<'_>> {
        let Self { header, topology_version, .. } = self;
        [header.stamp.column(), header.frame_id.column(), topology_version.column(), Column::Vertices(self)]
            .into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::{Compared, Kind, WrenchStamped};

    #[test]
    fn every_field_has_a_name_a_unit_and_a_content() {
        for kind in Kind::ALL {
            assert_eq!(kind.tolerable().len(), kind.fields().len(), "{kind:?}");
            assert_eq!(Kind::of(kind.type_name()), Some(kind));
        }
        assert_eq!(Kind::of("std_msgs/msg/Bool"), None);
        let names: Vec<&str> = WrenchStamped::FIELDS.iter().map(|field| field.name).collect();
        assert_eq!(names[..3], ["header.stamp", "header.frame_id", "wrench.force.x"]);
    }
}
