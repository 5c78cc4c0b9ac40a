//! Chain elements on a cubic lattice, each linked to its six nearest neighbours.

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

use crate::lem::Lattice;

/// Not reached from the contact.
pub(super) const UNREACHED: u16 = u16::MAX;

/// What a cell of the lattice is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cell {
    Outside,
    Free,
    Held,
}

/// The cells of a box, some of which are chain elements.
#[derive(Clone, Debug)]
pub(super) struct Elements {
    /// Cells along x, y and z.
    size: [usize; 3],
    cells: Vec<Cell>,
    /// Where cell (0, 0, 0) lies, and the distance of neighbours, m.
    low: DVec3,
    pitch_m: f64,
}

/// How far each element is from the contact, in links.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    /// For each cell; [`UNREACHED`] also where there is no element.
    pub(super) of_cell: Vec<u16>,
    /// How many elements are 0, 1, 2, ... links away.
    pub(super) counts: Vec<u32>,
    queue: Vec<u32>,
}

impl Elements {
    /// What the cells of a body take, with their links.
    pub(super) fn needed_bytes(surface: &SurfaceMesh, pitch_m: f64) -> u64 {
        let [low, high] = surface.extents();
        let across = ((high - low) / pitch_m).ceil() + 3.0;
        let cells = (across.x * across.y * across.z) as u64;
        // A cell, its links and its place in the queue; while building also the pieces of the lattice's lines.
        cells * 8
    }

    /// Elements at all lattice points inside the surface, and one nearest to each of its vertices; those nearest to a
    /// held vertex, and to no other, are held.
    pub(super) fn inside(surface: &SurfaceMesh, fixed: &[bool], pitch_m: f64) -> Self {
        let [low, high] = surface.extents();
        let low = low - DVec3::splat(pitch_m);
        let size = ((high - low) / pitch_m).to_array().map(|across| across.ceil() as usize + 2);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let lattice = Lattice { origin: low, axes, pitch_m, size: [size[0], size[1]] };
        let mut cells = vec![Cell::Outside; size[0] * size[1] * size[2]];
        for (line, pieces) in lattice.pieces(surface).iter().enumerate() {
            for piece in pieces {
                let [from, to] = piece.from_to_m.map(|height| height / pitch_m);
                for level in from.ceil() as usize..=to.floor() as usize {
                    cells[line + level * size[0] * size[1]] = Cell::Free;
                }
            }
        }
        let mut elements = Self { size, cells, low, pitch_m };
        for (kind, of_held) in [(Cell::Held, true), (Cell::Free, false)] {
            for (&at, _) in surface.vertices().iter().zip(fixed).filter(|&(_, &held)| held == of_held) {
                let cell = elements.nearest(at);
                elements.cells[cell] = kind;
            }
        }
        elements
    }

    /// A piece of a half-space: its surface is the highest layer of cells.
    pub(super) fn half_space(half_width: usize, pitch_m: f64) -> Self {
        let across = 2 * half_width + 1;
        let size = [across, across, half_width + 1];
        Self { size, cells: vec![Cell::Free; size.iter().product()], low: DVec3::ZERO, pitch_m }
    }

    pub(super) fn len(&self) -> usize {
        self.cells.len()
    }

    /// The cell a point lies in; points beyond the box count to its rim.
    pub(super) fn nearest(&self, at: DVec3) -> usize {
        let place = ((at - self.low) / self.pitch_m).round().max(DVec3::ZERO);
        let [x, y, z] = place.to_array().map(|k| k as usize);
        self.number([x.min(self.size[0] - 1), y.min(self.size[1] - 1), z.min(self.size[2] - 1)])
    }

    /// The number of a cell.
    pub(super) fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.size[0] * (y + self.size[1] * z)
    }

    /// The elements at the corners of the lattice cube around a point, and weights for them that add up to 1: trilinear,
    /// without the corners where there is no element.
    pub(super) fn around(&self, at: DVec3) -> [(u32, f32); 8] {
        let place = (at - self.low) / self.pitch_m;
        let corner = place.floor().max(DVec3::ZERO);
        let share = place - corner;
        let corner = corner.to_array().map(|k| k as usize);
        let mut found = [(0u32, 0.0f32); 8];
        let mut sum = 0.0;
        for (which, entry) in found.iter_mut().enumerate() {
            let step = [which & 1, which >> 1 & 1, which >> 2];
            let mut weight = 1.0;
            let mut cell = [0; 3];
            for axis in 0..3 {
                cell[axis] = (corner[axis] + step[axis]).min(self.size[axis] - 1);
                weight *= if step[axis] == 1 { share[axis] } else { 1.0 - share[axis] };
            }
            let number = self.number(cell);
            if self.cells[number] != Cell::Outside && weight > 0.0 {
                *entry = (number as u32, weight as f32);
                sum += entry.1;
            }
        }
        for entry in &mut found {
            entry.1 /= sum;
        }
        found
    }

    /// Walks outward from the contact over free elements, link by link (breadth first): all six links count alike.
    pub(super) fn walk(&self, contact: impl Iterator<Item = usize>, links: &mut Links) {
        links.of_cell.clear();
        links.of_cell.resize(self.cells.len(), UNREACHED);
        links.counts.clear();
        links.queue.clear();
        let [x, y, z] = self.size;
        let mut reach = |cell: usize, away: u16, queue: &mut Vec<u32>| {
            if self.cells[cell] == Cell::Free && links.of_cell[cell] == UNREACHED {
                links.of_cell[cell] = away;
                if links.counts.len() <= away as usize {
                    links.counts.push(0);
                }
                links.counts[away as usize] += 1;
                queue.push(cell as u32);
            }
        };
        let mut levels: Vec<u32> = std::mem::take(&mut links.queue);
        for cell in contact {
            reach(cell, 0, &mut levels);
        }
        let (mut next, mut away, mut end) = (0, 0u16, levels.len());
        while next < end && away < UNREACHED - 1 {
            away += 1;
            while next < end {
                let cell = levels[next] as usize;
                next += 1;
                let place = [cell % x, cell / x % y, cell / (x * y)];
                for (axis, stride, size) in [(0, 1, x), (1, x, y), (2, x * y, z)] {
                    if place[axis] > 0 {
                        reach(cell - stride, away, &mut levels);
                    }
                    if place[axis] + 1 < size {
                        reach(cell + stride, away, &mut levels);
                    }
                }
            }
            end = levels.len();
        }
        links.queue = levels;
    }
}

#[cfg(test)]
mod tests {
    use super::{Elements, Links, UNREACHED};
    use crate::TetMesh;
    use glam::DVec3;

    #[test]
    fn elements_fill_the_body_and_are_counted_by_links() {
        let (surface, volume) = TetMesh::block(&[0.0, 0.02, 0.04], &[0.0, 0.02, 0.04], &[0.0, 0.02]);
        let elements = Elements::inside(&surface, &volume.fixed, 0.0021);
        let mut links = Links::default();
        let top = elements.nearest(DVec3::new(0.02, 0.02, 0.02));
        elements.walk(std::iter::once(top), &mut links);
        let free = links.of_cell.iter().filter(|&&away| away != UNREACHED).count();
        let expected = 0.04 * 0.04 * 0.02 / 0.0021f64.powi(3);
        assert!((free as f64 / expected - 1.0).abs() < 0.2, "{free} {expected}");
        assert_eq!(links.of_cell[top], 0);
        let aside = elements.nearest(DVec3::new(0.02 + 3.0 * 0.0021, 0.02 - 2.0 * 0.0021, 0.02 - 0.0021));
        assert_eq!(links.of_cell[aside], 6, "links go along the axes");
        assert_eq!(links.counts.iter().sum::<u32>() as usize, free);
        // Weights of a point on the surface: all of it.
        let weights: f32 =
            elements.around(DVec3::new(0.04, 0.013, 0.02)).iter().map(|(_, weight)| weight).sum();
        assert!((weights - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_half_space_has_the_counts_of_half_an_octahedron() {
        let elements = Elements::half_space(6, 1.0);
        let mut links = Links::default();
        elements.walk(std::iter::once(elements.number([6, 6, 6])), &mut links);
        // m links away, at depth j: 4 (m - j) elements, 1 in the column below.
        for m in 1..6u32 {
            let expected: u32 = (0..m).map(|j| 4 * (m - j)).sum::<u32>() + 1;
            assert_eq!(links.counts[m as usize], expected);
        }
    }
}
