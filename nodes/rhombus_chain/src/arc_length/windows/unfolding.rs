//! Triangles laid flat.

use glam::DVec2;

use crate::mesh::{SurfaceMesh, destination, length};
use glam::DVec3;

/// Directions closer than this to each other, in radians, may be the same.
const SAME_DIRECTION: f64 = 1e-9;

/// Each triangle in the plane of each of its half-edges: the half-edge runs from the origin along x, the
/// triangle is above it.
#[derive(Clone, Debug)]
pub(super) struct Unfolded {
    lengths_m: Vec<f64>,
    apices: Vec<DVec2>,
}

impl Unfolded {
    pub(super) fn new(mesh: &SurfaceMesh) -> Self {
        let half_edges = 3 * mesh.triangles().len() as u32;
        let mut unfolded = Self {
            lengths_m: Vec::with_capacity(half_edges as usize),
            apices: Vec::with_capacity(half_edges as usize),
        };
        for half_edge in 0..half_edges {
            let apex = mesh.vertices()[mesh.origin(crate::mesh::previous(half_edge)) as usize];
            let [start, end] = ends(mesh, half_edge);
            unfolded.lengths_m.push(length(end - start));
            unfolded.apices.push(place(start, end, apex));
        }
        unfolded
    }

    #[inline]
    pub(super) fn length(&self, half_edge: u32) -> f64 {
        self.lengths_m[half_edge as usize]
    }

    /// The third corner of the half-edge's triangle.
    #[inline]
    pub(super) fn apex(&self, half_edge: u32) -> DVec2 {
        self.apices[half_edge as usize]
    }

    /// A point of the half-edge's triangle.
    pub(super) fn place(&self, mesh: &SurfaceMesh, half_edge: u32, point: DVec3) -> DVec2 {
        let [start, end] = ends(mesh, half_edge);
        place(start, end, point)
    }

    /// From the plane of a half-edge to that of its twin.
    #[inline]
    pub(super) fn seen_by_twin(&self, half_edge: u32, point: DVec2) -> DVec2 {
        DVec2::new(self.length(half_edge) - point.x, -point.y)
    }

    /// Angle of the triangle where the half-edge starts, in radians.
    pub(super) fn corner_angle(&self, half_edge: u32) -> f64 {
        let apex = self.apex(half_edge);
        libm::atan2(apex.y, apex.x)
    }

    /// Angle at the apex between the direction to `source` and that to the half-edge's start, in radians.
    pub(super) fn angle_at_apex(&self, half_edge: u32, source: DVec2) -> f64 {
        let apex = self.apex(half_edge);
        let (to_source, to_start) = (source - apex, -apex);
        libm::atan2(to_source.perp_dot(to_start).abs(), to_source.dot(to_start))
    }

    /// What the apex of a half-edge sees of the half-edge between two angles, counted from its end towards
    /// its start. The apex and the stretch, in the plane of the twin.
    pub(super) fn fan_out(&self, half_edge: u32, [from, to]: [f64; 2]) -> (DVec2, [f64; 2]) {
        let edge_m = self.length(half_edge);
        let apex = self.seen_by_twin(half_edge, self.apex(half_edge));
        let at = |angle: f64| {
            // The direction to the twin's start, turned clockwise.
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            let direction = DVec2::new(-apex.x * cos - apex.y * sin, apex.x * sin - apex.y * cos);
            if direction.y > 0.0 {
                (apex.x - direction.x / direction.y * apex.y).clamp(0.0, edge_m)
            } else {
                edge_m
            }
        };
        (apex, [at(from), at(to)])
    }

    pub(super) fn mean_and_longest_edge_m(&self) -> [f64; 2] {
        let sum: f64 = self.lengths_m.iter().sum();
        [sum / self.lengths_m.len() as f64, self.lengths_m.iter().copied().fold(0.0, f64::max)]
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.lengths_m.capacity() * size_of::<f64>() + self.apices.capacity() * size_of::<DVec2>()
    }
}

fn ends(mesh: &SurfaceMesh, half_edge: u32) -> [DVec3; 2] {
    let vertices = mesh.vertices();
    [vertices[mesh.origin(half_edge) as usize], vertices[destination(mesh.triangles(), half_edge) as usize]]
}

/// `point` in the plane of the half-edge from `start` to `end`, above it.
fn place(start: DVec3, end: DVec3, point: DVec3) -> DVec2 {
    let along = (end - start) / length(end - start);
    let offset = point - start;
    DVec2::new(offset.dot(along), length(offset.cross(along)))
}

/// Whether two segments cross, not merely touch.
pub(super) fn segments_cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let are_apart =
        |p: DVec2, q: DVec2, u: DVec2, v: DVec2| (q - p).perp_dot(u - p) * (q - p).perp_dot(v - p) < 0.0;
    are_apart(a, b, c, d) && are_apart(c, d, a, b)
}

/// Straight ways from a source below a half-edge, through a stretch of it, in the triangle above.
pub(super) struct Crossing {
    edge_m: f64,
    apex: DVec2,
    source: DVec2,
    /// From the source to the ends of the stretch.
    rays: [DVec2; 2],
    /// Where the apex is from the rays: positive to the left.
    sides: [f64; 2],
    /// Less than this may be rounding.
    tolerance: [f64; 2],
}

impl Crossing {
    pub(super) fn new(unfolded: &Unfolded, half_edge: u32, source: DVec2, ends: [f64; 2]) -> Self {
        let apex = unfolded.apex(half_edge);
        let rays = ends.map(|x| DVec2::new(x, 0.0) - source);
        let to_apex = apex - source;
        Self {
            edge_m: unfolded.length(half_edge),
            apex,
            source,
            rays,
            sides: rays.map(|ray| ray.perp_dot(to_apex)),
            tolerance: rays.map(|ray| SAME_DIRECTION * ray.length() * to_apex.length()),
        }
    }

    /// Whether one of the ways leads to the apex.
    pub(super) fn meets_apex(&self) -> bool {
        self.sides[0] <= self.tolerance[0] && self.sides[1] >= -self.tolerance[1]
    }

    pub(super) fn apex_distance_m(&self) -> f64 {
        (self.apex - self.source).length()
    }

    /// The part that leaves to the left of the apex: source and stretch in the plane of the left edge's twin,
    /// which runs from the half-edge's start to the apex.
    pub(super) fn left(&self) -> Option<(DVec2, [f64; 2])> {
        let (start, end) = (DVec2::ZERO, self.apex);
        (self.sides[0] < 0.0).then(|| {
            let to = if self.sides[1] < 0.0 { self.meet(1, start, end) } else { 1.0 };
            self.seen_from(start, end, [self.meet(0, start, end), to])
        })
    }

    /// The part that leaves to the right of the apex, in the plane of the right edge's twin, which runs from
    /// the apex to the half-edge's end.
    pub(super) fn right(&self) -> Option<(DVec2, [f64; 2])> {
        let (start, end) = (self.apex, DVec2::new(self.edge_m, 0.0));
        (self.sides[1] > 0.0).then(|| {
            let from = if self.sides[0] > 0.0 { self.meet(0, start, end) } else { 0.0 };
            self.seen_from(start, end, [from, self.meet(1, start, end)])
        })
    }

    /// Where a ray meets the line from `start` to `end`: 0 at the start, 1 at the end.
    fn meet(&self, ray: usize, start: DVec2, end: DVec2) -> f64 {
        let ray = self.rays[ray];
        let part = (start - self.source).perp_dot(ray) / ray.perp_dot(end - start);
        // A ray of no length comes from a source on the edge's end; the whole edge is ahead of it.
        if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 }
    }

    fn seen_from(&self, start: DVec2, end: DVec2, part: [f64; 2]) -> (DVec2, [f64; 2]) {
        let edge_m = (end - start).length();
        let along = (end - start) / edge_m;
        let offset = self.source - start;
        (DVec2::new(offset.dot(along), along.perp_dot(offset)), part.map(|part| part * edge_m))
    }
}
