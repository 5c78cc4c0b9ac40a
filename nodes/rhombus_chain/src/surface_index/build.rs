//! Sorting the triangles into a balanced tree.

use glam::DVec3;

use super::{Node, WIDTH};
use crate::mesh::SurfaceMesh;

/// A triangle while it is being sorted.
#[derive(Clone, Copy)]
struct Item {
    /// Sum of the corners, in single precision: it only decides who sits next to whom.
    centre: [f32; 3],
    triangle: u32,
}

/// Nodes (the root first) and the triangle numbers in the order of the leaves.
pub(super) fn build(mesh: &SurfaceMesh) -> (Vec<Node>, Vec<u32>) {
    let mut items: Vec<Item> = (0u32..)
        .zip(mesh.triangles())
        .map(|(triangle, _)| {
            let [a, b, c] = mesh.corners(triangle);
            Item { centre: (a + b + c).to_array().map(|x| x as f32), triangle }
        })
        .collect();
    let mut nodes = Vec::with_capacity(items.len() / 2);
    fill(mesh, &mut items, 0, &mut nodes);
    let order = items.iter().map(|item| item.triangle).collect();
    (nodes, order)
}

/// Makes the node over `items`, which begin at place `start` of the order; returns its number.
fn fill(mesh: &SurfaceMesh, items: &mut [Item], start: usize, nodes: &mut Vec<Node>) -> u32 {
    let number = nodes.len();
    nodes.push(Node::EMPTY);
    let mut begin = 0;
    for (child, length) in quarter(items).into_iter().enumerate() {
        let part = &mut items[begin..begin + length];
        if part.is_empty() {
            continue;
        }
        let bounds = bounds(mesh, part);
        let (target, count) = if length <= WIDTH {
            ((start + begin) as u32, length as u8)
        } else {
            (fill(mesh, part, start + begin, nodes), 0)
        };
        nodes[number].set(child, bounds, target, count);
        begin += length;
    }
    number as u32
}

/// Arranges the items into four groups that are close together, by two median cuts; returns the sizes.
fn quarter(items: &mut [Item]) -> [usize; WIDTH] {
    if items.len() <= WIDTH {
        return [items.len(), 0, 0, 0];
    }
    let half = cut(items);
    let (left, right) = items.split_at_mut(half);
    let (a, b) = (cut(left), cut(right));
    [a, left.len() - a, b, right.len() - b]
}

/// Cuts across the widest direction of the centres; returns the size of the first part.
///
/// The first part is filled up to whole leaves, so that few leaves are partly empty.
fn cut(items: &mut [Item]) -> usize {
    if items.len() <= WIDTH {
        return items.len();
    }
    let mut low = [f32::INFINITY; 3];
    let mut high = [f32::NEG_INFINITY; 3];
    for item in items.iter() {
        for k in 0..3 {
            low[k] = low[k].min(item.centre[k]);
            high[k] = high[k].max(item.centre[k]);
        }
    }
    let extent = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
    let axis = if extent[0] >= extent[1] && extent[0] >= extent[2] {
        0
    } else if extent[1] >= extent[2] {
        1
    } else {
        2
    };
    let half = (items.len() / 2).next_multiple_of(WIDTH).min(items.len() - 1);
    // Ties go by number: the order, and with it the choice among equally close points, is always the same.
    items.select_nth_unstable_by(half, |a, b| {
        a.centre[axis].total_cmp(&b.centre[axis]).then(a.triangle.cmp(&b.triangle))
    });
    half
}

fn bounds(mesh: &SurfaceMesh, items: &[Item]) -> [DVec3; 2] {
    items
        .iter()
        .flat_map(|item| mesh.corners(item.triangle))
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
}

impl Node {
    const EMPTY: Self = Self {
        low: [[f32::INFINITY; WIDTH]; 3],
        high: [[f32::NEG_INFINITY; WIDTH]; 3],
        children: [0; WIDTH],
        counts: [0; WIDTH],
    };

    fn set(&mut self, child: usize, [low, high]: [DVec3; 2], target: u32, count: u8) {
        for k in 0..3 {
            self.low[k][child] = round_down(low[k]);
            self.high[k][child] = round_up(high[k]);
        }
        self.children[child] = target;
        self.counts[child] = count;
    }
}

/// The largest single precision number not above `x`.
pub(super) fn round_down(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x { nearest.next_down() } else { nearest }
}

/// The smallest single precision number not below `x`.
pub(super) fn round_up(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) < x { nearest.next_up() } else { nearest }
}
