//! Bodies made on the fly: closed, outward oriented surfaces, the same bits for the same number of vertices.

mod block;
mod liver;
mod relax;
mod rings;
mod round;

use glam::DVec3;

/// A generated surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Vertices in metres.
    pub vertices: Vec<DVec3>,
    /// Triangles, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Most vertices that are generated: keeps a slip of the keyboard from filling the memory.
pub const MOST_VERTICES: usize = 4_000_000;

/// Generates a body with `vertices` vertices; liver and sphere have exactly that many, the block the nearest number
/// that a box of nearly square cells can have. The number is raised to [`BodyKind::fewest_vertices`] and lowered to
/// [`MOST_VERTICES`]. A closed surface of genus 0 with V vertices has 2 V - 4 triangles.
pub fn body(kind: BodyKind, vertices: usize) -> Shape {
    let vertices = vertices.clamp(kind.fewest_vertices(), MOST_VERTICES);
    match kind {
        BodyKind::Liver => round::generate(&liver::Liver, vertices),
        BodyKind::Block => block::generate(vertices),
        BodyKind::Sphere => round::generate(&round::Ball { radius_m: 0.05 }, vertices),
    }
}

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
            BodyKind::Block => 1018,
            BodyKind::Sphere => 1002,
        }
    }
}

impl BodyKind {
    /// Fewer vertices do not show the shape.
    pub fn fewest_vertices(self) -> usize {
        match self {
            BodyKind::Liver => 100,
            BodyKind::Block => 8,
            BodyKind::Sphere => 20,
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
