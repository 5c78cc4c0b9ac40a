//! Bodies made on the fly: closed, outward oriented surfaces with any number of vertices.

/// A body that can be generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyKind {
    /// A smooth, liver-like organ about 0.20 m long.
    Liver,
    /// A box of 0.10 x 0.08 x 0.05 m.
    Block,
    /// A sphere of 0.10 m diameter.
    Sphere,
}

impl BodyKind {
    /// Every kind.
    pub const ALL: [BodyKind; 3] = [BodyKind::Liver, BodyKind::Block, BodyKind::Sphere];

    /// The name in parameter files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            BodyKind::Liver => "liver",
            BodyKind::Block => "block",
            BodyKind::Sphere => "sphere",
        }
    }

    /// All names, for messages: `"liver" or "block" or "sphere"`.
    pub fn names() -> String {
        BodyKind::ALL.map(|kind| format!("{:?}", kind.name())).join(" or ")
    }

    /// Vertices when nobody says how many; the liver's is the number of the paper's experiment.
    pub fn default_vertices(self) -> usize {
        match self {
            BodyKind::Liver => 3116,
            BodyKind::Block | BodyKind::Sphere => 1002,
        }
    }
}

/// A name that is no body's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no generated body; accepted: {names}", names = BodyKind::names())]
pub struct UnknownBody(String);

impl std::str::FromStr for BodyKind {
    type Err = UnknownBody;

    fn from_str(text: &str) -> Result<BodyKind, UnknownBody> {
        BodyKind::ALL.into_iter().find(|kind| kind.name() == text).ok_or_else(|| UnknownBody(text.to_owned()))
    }
}
