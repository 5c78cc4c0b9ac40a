//! Exact arc lengths: windows sent across the edges.
//!
//! Straight ways from the source that cross an edge side by side, through the same triangles, make a
//! *window*: a stretch of the edge, and the source's place in the plane of the triangle behind. A window goes
//! on through the next triangle to the one or two edges it meets there, and where it meets a vertex it gives
//! it a label. Shortest ways bend only at vertices with more than a full turn of angles around them; windows
//! are sent from those, too, into the shadow behind them (Mitchell, Mount, Papadimitriou 1987; Chen, Han
//! 1990).

mod unfolding;

use glam::DVec2;

use super::roughness::total_angle;
use super::shelves::{NONE, Shelves};
use crate::mesh::{SurfaceMesh, SurfacePoint, destination, length, next, previous};
use unfolding::{Crossing, Unfolded, segments_cross};

/// A label or a window only counts as shorter when it is shorter by this factor, so that ways of equal length
/// do not push each other out by rounding.
const SHORTER: f64 = 1.0 - 1e-12;
const LONGER: f64 = 1.0 + 1e-10;

/// Windows narrower than this part of their edge are rounding.
const NARROWEST: f64 = 1e-12;

/// Angles beyond a full turn below this, in radians, cast no shadow.
const LEAST_SHADOW: f64 = 1e-9;

/// Depth of a shelf of the queue in mean edge lengths.
const SHELF_DEPTH: f64 = 0.25;

#[derive(Clone, Debug)]
pub(super) struct Windows {
    unfolded: Unfolded,
    /// Sum of the angles around each vertex.
    total_angles: Vec<f64>,

    limit_m: f64,
    labels: Vec<Label>,
    /// Vertices with a label.
    known: Vec<u32>,
    queue: Shelves,
    events: Vec<Event>,
    /// First of the events that are not in use.
    free: u32,
}

/// What is known of a vertex.
#[derive(Clone, Copy, Debug)]
struct Label {
    arc_m: f64,
    /// Half-edge opposite to the vertex, and the source, or something in its direction, in that half-edge's
    /// plane.
    half_edge: u32,
    source: DVec2,
}

const UNKNOWN: Label = Label { arc_m: f64::INFINITY, half_edge: 0, source: DVec2::ZERO };

/// Straight ways through a half-edge into its triangle. In the plane of [`Unfolded`].
#[derive(Clone, Copy, Debug)]
struct Window {
    half_edge: u32,
    source: DVec2,
    /// The stretch of the half-edge.
    ends: [f64; 2],
    /// Length of the way to `source` from the true source.
    offset_m: f64,
}

#[derive(Clone, Copy, Debug)]
struct Event {
    what: What,
    /// The event behind this one in the queue, or in the list of those not in use.
    behind: u32,
}

#[derive(Clone, Copy, Debug)]
enum What {
    Window(Window),
    /// A vertex with a new label.
    Vertex {
        vertex: u32,
        arc_m: f64,
    },
}

impl Windows {
    pub(super) fn new(mesh: &SurfaceMesh) -> Self {
        let vertices = mesh.vertices().len();
        let unfolded = Unfolded::new(mesh);
        let [mean_edge_m, longest_edge_m] = unfolded.mean_and_longest_edge_m();
        Self {
            total_angles: (0..vertices as u32).map(|vertex| total_angle(mesh, vertex)).collect(),
            limit_m: 0.0,
            labels: vec![UNKNOWN; vertices],
            known: Vec::with_capacity(vertices),
            // The nearest point of the next edge is at most two edges farther.
            queue: Shelves::new(SHELF_DEPTH * mean_edge_m, 2.0 * longest_edge_m),
            events: Vec::with_capacity(vertices),
            free: NONE,
            unfolded,
        }
    }

    pub(super) fn solve(&mut self, mesh: &SurfaceMesh, source: SurfacePoint, limit_m: f64) {
        for &vertex in &self.known {
            self.labels[vertex as usize] = UNKNOWN;
        }
        self.known.clear();
        self.queue.restart();
        if limit_m.is_nan() || limit_m <= 0.0 {
            return;
        }
        self.limit_m = limit_m;
        self.start(mesh, source);
        while let Some(event) = self.queue.pop(|event| self.events[event as usize].behind) {
            let what = self.events[event as usize].what;
            self.events[event as usize].behind = self.free;
            self.free = event;
            match what {
                What::Window(window) => self.go_on(mesh, &window),
                What::Vertex { vertex, arc_m } if arc_m == self.labels[vertex as usize].arc_m => {
                    self.spread(mesh, vertex);
                }
                What::Vertex { .. } => {} // labelled anew since
            }
        }
    }

    pub(super) fn known(&self) -> &[u32] {
        &self.known
    }

    pub(super) fn arc_m(&self, vertex: u32) -> f64 {
        self.labels[vertex as usize].arc_m
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.unfolded.memory_bytes()
            + self.total_angles.capacity() * size_of::<f64>()
            + self.labels.capacity() * size_of::<Label>()
            + self.known.capacity() * size_of::<u32>()
            + self.events.capacity() * size_of::<Event>()
    }

    /// Labels the corners of the source's face and sends windows out of it.
    fn start(&mut self, mesh: &SurfaceMesh, source: SurfacePoint) {
        let position = mesh.position(source);
        for half_edge in 3 * source.face..3 * source.face + 3 {
            let place = self.unfolded.place(mesh, half_edge, position);
            let apex = mesh.origin(previous(half_edge));
            let arc_m = length(mesh.vertices()[apex as usize] - position);
            self.label(apex, Label { arc_m, half_edge, source: place });
            self.send(
                mesh,
                Window {
                    half_edge: mesh.twin(half_edge),
                    source: self.unfolded.seen_by_twin(half_edge, place),
                    ends: [0.0, self.unfolded.length(half_edge)],
                    offset_m: 0.0,
                },
            );
        }
    }

    /// Carries a window through its triangle.
    fn go_on(&mut self, mesh: &SurfaceMesh, window: &Window) {
        let Window { half_edge, source, ends, offset_m } = *window;
        let crossing = Crossing::new(&self.unfolded, half_edge, source, ends);
        if crossing.meets_apex() {
            let apex = mesh.origin(previous(half_edge));
            let arc_m = offset_m + crossing.apex_distance_m();
            self.label(apex, Label { arc_m, half_edge, source });
        }
        for (edge, stretch) in [(previous(half_edge), crossing.left()), (next(half_edge), crossing.right())] {
            if let Some((source, ends)) = stretch {
                self.send(mesh, Window { half_edge: mesh.twin(edge), source, ends, offset_m });
            }
        }
    }

    /// Carries the label of a vertex along its edges, and into its shadow.
    fn spread(&mut self, mesh: &SurfaceMesh, vertex: u32) {
        let arc_m = self.labels[vertex as usize].arc_m;
        for half_edge in mesh.fan(vertex) {
            let to = destination(mesh.triangles(), half_edge);
            let opposite = next(next(half_edge));
            let source = DVec2::new(self.unfolded.length(opposite), 0.0);
            let arc_m = arc_m + self.unfolded.length(half_edge);
            self.label(to, Label { arc_m, half_edge: opposite, source });
        }
        let total = self.total_angles[vertex as usize];
        let (pi, is_source) = (std::f64::consts::PI, arc_m == 0.0);
        if is_source {
            self.send_from(mesh, vertex, [0.0, total]);
        } else if total > 2.0 * pi + LEAST_SHADOW {
            self.send_from(mesh, vertex, [pi, total - pi]);
        }
    }

    /// Sends windows from a vertex to the opposite edges of its faces. `range`: between which angles, counted
    /// clockwise from the direction the shortest way comes from.
    fn send_from(&mut self, mesh: &SurfaceMesh, vertex: u32, range: [f64; 2]) {
        let Label { arc_m, half_edge, source } = self.labels[vertex as usize];
        let mut edge = previous(half_edge);
        let mut angle = if arc_m == 0.0 { 0.0 } else { self.unfolded.angle_at_apex(half_edge, source) };
        for _ in mesh.fan(vertex) {
            edge = next(mesh.twin(edge));
            let corner = self.unfolded.corner_angle(edge);
            let part = [(range[0] - angle).max(0.0), (range[1] - angle).min(corner)];
            if part[0] < part[1] {
                let opposite = next(edge);
                let (source, ends) = self.unfolded.fan_out(opposite, part);
                self.send(mesh, Window { half_edge: mesh.twin(opposite), source, ends, offset_m: arc_m });
            }
            angle += corner;
        }
    }

    /// Gives a vertex a label if it is shorter than what it has, and queues it.
    fn label(&mut self, vertex: u32, label: Label) {
        let known = &mut self.labels[vertex as usize];
        if label.arc_m >= self.limit_m || label.arc_m >= known.arc_m * SHORTER {
            return;
        }
        if known.arc_m == f64::INFINITY {
            self.known.push(vertex);
        }
        *known = label;
        self.enqueue(What::Vertex { vertex, arc_m: label.arc_m }, label.arc_m);
    }

    /// Queues a window if it can be of use.
    fn send(&mut self, mesh: &SurfaceMesh, window: Window) {
        let Window { half_edge, source, ends: [from, to], offset_m } = window;
        let edge_m = self.unfolded.length(half_edge);
        if to - from <= NARROWEST * edge_m {
            return;
        }
        let distance = |x: f64| offset_m + (DVec2::new(x, 0.0) - source).length();
        let nearest_m = distance(source.x.clamp(from, to));
        if nearest_m < self.limit_m && !self.is_beaten(mesh, &window, [distance(from), distance(to)]) {
            self.enqueue(What::Window(window), nearest_m);
        }
    }

    /// Whether, for every way through the window, there is a shorter one by a corner of the triangle before
    /// the edge (Xin, Wang 2009).
    ///
    /// One by a corner v is shorter to a point A of the window. Where the line from v to A crosses the ways
    /// to all other points of the window, those are shorter by v as well, from the crossing on.
    fn is_beaten(&self, mesh: &SurfaceMesh, window: &Window, at_ends_m: [f64; 2]) -> bool {
        let Window { half_edge, source, ends, .. } = *window;
        let edge_m = self.unfolded.length(half_edge);
        let twin = mesh.twin(half_edge);
        let arc_m = |vertex: u32| self.labels[vertex as usize].arc_m;
        let start_m = arc_m(mesh.origin(half_edge));
        let end_m = arc_m(destination(mesh.triangles(), half_edge));
        let apex_m = arc_m(mesh.origin(previous(twin)));
        let apex = self.unfolded.seen_by_twin(twin, self.unfolded.apex(twin));
        let [from, to] = ends.map(|x| DVec2::new(x, 0.0));
        let is_by_apex = |a: DVec2, b: DVec2, at_a_m: f64| {
            at_a_m > (apex_m + (a - apex).length()) * LONGER && segments_cross([apex, a], [source, b])
        };
        at_ends_m[1] > (start_m + ends[1]) * LONGER
            || at_ends_m[0] > (end_m + edge_m - ends[0]) * LONGER
            || is_by_apex(from, to, at_ends_m[0])
            || is_by_apex(to, from, at_ends_m[1])
    }

    fn enqueue(&mut self, what: What, key_m: f64) {
        let place = if self.free == NONE { self.events.len() as u32 } else { self.free };
        let event = Event { what, behind: self.queue.push(place, key_m) };
        match self.events.get_mut(place as usize) {
            Some(unused) => {
                self.free = unused.behind;
                *unused = event;
            }
            None => self.events.push(event),
        }
    }
}
