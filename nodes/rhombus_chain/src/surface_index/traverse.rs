//! Walking the tree.

use glam::DVec3;

use super::build::{round_down, round_up};
use super::{Node, SurfaceIndex, WIDTH};
use crate::closest::closest_on_triangle;
use crate::mesh::{SurfaceMesh, SurfacePoint};

/// Depth of a balanced tree over 2^32 triangles, times the siblings that wait at each level.
const STACK: usize = 16 * (WIDTH - 1) + 1;

/// Squared distances in single precision lose less than this factor to rounding.
const ROUNDING: f32 = 1.0 - 1e-6;

/// A subtree that still waits, and the squared distance of its box.
#[derive(Clone, Copy)]
struct Waiting {
    distance_squared: f32,
    child: u32,
    count: u8,
}

const NOTHING: Waiting = Waiting { distance_squared: 0.0, child: 0, count: 0 };

pub(super) fn closest(
    index: &SurfaceIndex,
    mesh: &SurfaceMesh,
    point: DVec3,
    within_m: f64,
) -> Option<(SurfacePoint, f64)> {
    let low = point.to_array().map(round_down);
    let high = point.to_array().map(round_up);
    let mut best = None;
    let mut best_squared = within_m * within_m;
    let mut stack = [NOTHING; STACK];
    let mut waiting = 1;
    while waiting > 0 {
        waiting -= 1;
        let Waiting { distance_squared, child, count } = stack[waiting];
        if f64::from(distance_squared) > best_squared {
            continue;
        }
        if count > 0 {
            for &face in &index.order[child as usize..child as usize + usize::from(count)] {
                let (barycentric, squared) = closest_on_triangle(mesh.corners(face), point);
                if squared < best_squared || (best.is_none() && squared <= best_squared) {
                    best_squared = squared;
                    best = Some(SurfacePoint { face, barycentric });
                }
            }
            continue;
        }
        let node = &index.nodes[child as usize];
        let distances = node.squared_distances(low, high);
        let first = waiting;
        for (k, &distance_squared) in distances.iter().enumerate() {
            // Infinite: there is no such child.
            if f64::from(distance_squared) <= best_squared && distance_squared < f32::INFINITY {
                // Nearest last, so that it is looked at next.
                let mut place = waiting;
                while place > first && stack[place - 1].distance_squared < distance_squared {
                    stack[place] = stack[place - 1];
                    place -= 1;
                }
                stack[place] = Waiting { distance_squared, child: node.children[k], count: node.counts[k] };
                waiting += 1;
            }
        }
    }
    best.map(|at| (at, best_squared.sqrt()))
}

impl Node {
    /// Squared distances from a point, known to lie between `low` and `high`, to the children's boxes: never
    /// too large. Infinite for an absent child.
    #[inline]
    fn squared_distances(&self, low: [f32; 3], high: [f32; 3]) -> [f32; WIDTH] {
        let mut sums = [0.0f32; WIDTH];
        for axis in 0..3 {
            for (child, sum) in sums.iter_mut().enumerate() {
                let below = self.low[axis][child] - high[axis];
                let above = low[axis] - self.high[axis][child];
                let outside = below.max(above).max(0.0);
                *sum += outside * outside;
            }
        }
        sums.map(|sum| sum * ROUNDING)
    }
}

/// How often the surface winds around `point`: surface crossings of the ray from `point` along +x, counted
/// with their direction.
pub(super) fn winding(index: &SurfaceIndex, mesh: &SurfaceMesh, point: DVec3) -> i32 {
    let low = point.to_array().map(round_down);
    let high = point.to_array().map(round_up);
    let mut stack = [(0u32, 0u8); STACK];
    let mut waiting = 1;
    let mut winding = 0;
    while waiting > 0 {
        waiting -= 1;
        let (child, count) = stack[waiting];
        if count > 0 {
            for &face in &index.order[child as usize..child as usize + usize::from(count)] {
                winding += crossing(mesh, face, point);
            }
            continue;
        }
        let node = &index.nodes[child as usize];
        for k in 0..WIDTH {
            let is_hit = node.high[0][k] >= low[0]
                && (1..3).all(|axis| node.low[axis][k] <= high[axis] && node.high[axis][k] >= low[axis]);
            if is_hit {
                stack[waiting] = (node.children[k], node.counts[k]);
                waiting += 1;
            }
        }
    }
    winding
}

/// +1 where the ray from `point` along +x leaves through the face, -1 where it enters, else 0.
fn crossing(mesh: &SurfaceMesh, face: u32, point: DVec3) -> i32 {
    let vertices = mesh.triangles()[face as usize];
    let mut sides = [false; 3];
    for k in 0..3 {
        sides[k] = is_left_of(mesh, vertices[k], vertices[(k + 1) % 3], point);
    }
    if sides[0] != sides[1] || sides[1] != sides[2] {
        return 0;
    }
    // The ray's line passes through the face; is the face ahead of the point?
    let [a, b, c] = mesh.corners(face);
    let normal = (b - a).cross(c - a);
    let ahead = (a - point).dot(normal) * if sides[0] { 1.0 } else { -1.0 } > 0.0;
    if !ahead {
        0
    } else if sides[0] {
        1
    } else {
        -1
    }
}

/// Whether, seen along x, `point` lies to the left of the edge from vertex `from` to vertex `to`.
///
/// Computed from the smaller vertex number to the larger, so that the two faces at an edge always give
/// opposite answers and a ray through the edge is counted exactly once.
fn is_left_of(mesh: &SurfaceMesh, from: u32, to: u32, point: DVec3) -> bool {
    let (first, second) = if from < to { (from, to) } else { (to, from) };
    let (a, b) = (mesh.vertices()[first as usize] - point, mesh.vertices()[second as usize] - point);
    let is_left = a.y * b.z - a.z * b.y > 0.0;
    is_left == (from < to)
}
