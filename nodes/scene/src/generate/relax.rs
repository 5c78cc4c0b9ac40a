//! Even, well-shaped triangles: flip edges until they are Delaunay, pull vertices to the middle of their neighbours.

use glam::DVec3;

use super::Shape;

/// A closed triangle surface with half-edges: number `3 t + k` runs from corner `k` of triangle `t` to the next.
pub(super) struct Surface {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    twins: Vec<u32>,
}

/// Rounds of flips; each round leaves far fewer to do.
const ROUNDS: usize = 20;

/// How far a vertex goes towards the middle of its neighbours in one step.
const PULL: f64 = 0.7;

impl Surface {
    /// `triangles` must be closed and consistently oriented.
    pub(super) fn new(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Surface {
        let edges = triangles.iter().enumerate().flat_map(|(t, corners)| {
            (0..3).map(move |k| (corners[k], corners[(k + 1) % 3], (3 * t + k) as u32))
        });
        let mut sorted: Vec<([u32; 2], u32)> = edges.map(|(a, b, h)| ([a.min(b), a.max(b)], h)).collect();
        sorted.sort_unstable();
        let mut twins = vec![0; sorted.len()];
        for pair in sorted.chunks_exact(2) {
            twins[pair[0].1 as usize] = pair[1].1;
            twins[pair[1].1 as usize] = pair[0].1;
        }
        Surface { vertices, triangles, twins }
    }

    pub(super) fn into_shape(self) -> Shape {
        Shape { vertices: self.vertices, triangles: self.triangles }
    }

    /// One step for every vertex; `onto_surface` brings a point near the surface back onto it.
    pub(super) fn smooth(&mut self, onto_surface: impl Fn(DVec3) -> DVec3) {
        // Area weights make areas, not only edges, even.
        let mut sums = vec![(DVec3::ZERO, 0.0); self.vertices.len()];
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|v| self.vertices[v as usize]);
            let area = (b - a).cross(c - a).length();
            for v in corners {
                let (sum, weight) = &mut sums[*v as usize];
                *sum += (a + b + c) / 3.0 * area;
                *weight += area;
            }
        }
        for (vertex, (sum, weight)) in self.vertices.iter_mut().zip(sums) {
            if weight > 0.0 {
                *vertex = onto_surface(*vertex + (sum / weight - *vertex) * PULL);
            }
        }
    }

    /// Flips edges whose opposite angles are together more than half a turn.
    pub(super) fn flip_to_delaunay(&mut self) {
        for _ in 0..ROUNDS {
            let mut flips = 0;
            for h in 0..self.twins.len() as u32 {
                if h < self.twins[h as usize] && self.should_flip(h) {
                    self.flip(h);
                    flips += 1;
                }
            }
            if flips == 0 {
                return;
            }
        }
    }

    fn corner(&self, h: u32) -> u32 {
        self.triangles[h as usize / 3][h as usize % 3]
    }

    fn at(&self, vertex: u32) -> DVec3 {
        self.vertices[vertex as usize]
    }

    fn should_flip(&self, h: u32) -> bool {
        let g = self.twins[h as usize];
        let (a, b) = (self.corner(h), self.corner(g));
        let (c, d) = (self.corner(previous(h)), self.corner(previous(g)));
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| self.at(v));
        if cotangent(pc, pa, pb) + cotangent(pd, pa, pb) >= -1e-9 {
            return false;
        }
        // Both new triangles have to look the way the old ones did, or the flip would fold the surface.
        let old = (pb - pa).cross(pc - pa) + (pa - pb).cross(pd - pb);
        let upright = |normal: DVec3| normal.dot(old) > 0.5 * normal.length() * old.length();
        upright((pa - pc).cross(pd - pc)) && upright((pb - pd).cross(pc - pd)) && !self.are_neighbours(h, d)
    }

    /// Whether the corner opposite `h` has an edge to `vertex`.
    fn are_neighbours(&self, h: u32, vertex: u32) -> bool {
        let start = previous(h);
        let mut leaving = start;
        loop {
            if self.corner(next(leaving)) == vertex {
                return true;
            }
            leaving = self.twins[previous(leaving) as usize];
            if leaving == start {
                return false;
            }
        }
    }

    /// `a b c` and `b a d` become `c a d` and `d b c`.
    fn flip(&mut self, h: u32) {
        let g = self.twins[h as usize];
        let (a, b) = (self.corner(h), self.corner(g));
        let (c, d) = (self.corner(previous(h)), self.corner(previous(g)));
        let [b_c, c_a, a_d, d_b] =
            [next(h), previous(h), next(g), previous(g)].map(|e| self.twins[e as usize]);
        let (t, u) = (h / 3, g / 3);
        self.triangles[t as usize] = [c, a, d];
        self.triangles[u as usize] = [d, b, c];
        self.join(3 * t, c_a);
        self.join(3 * t + 1, a_d);
        self.join(3 * t + 2, 3 * u + 2);
        self.join(3 * u, d_b);
        self.join(3 * u + 1, b_c);
    }

    fn join(&mut self, h: u32, g: u32) {
        self.twins[h as usize] = g;
        self.twins[g as usize] = h;
    }
}

fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

/// Cotangent of the angle at `tip` between `a` and `b`.
fn cotangent(tip: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (u, v) = (a - tip, b - tip);
    u.dot(v) / u.cross(v).length().max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_that_is_there_already_is_recognised() {
        let tetrahedron = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let surface = Surface::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], tetrahedron);
        for h in 0..12 {
            let opposite = surface.corner(previous(surface.twins[h as usize]));
            assert!(surface.are_neighbours(h, opposite), "every two corners of a tetrahedron have an edge");
        }
        let octahedron =
            vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
        let surface = Surface::new(vec![DVec3::ZERO; 6], octahedron);
        for h in 0..24 {
            let opposite = surface.corner(previous(surface.twins[h as usize]));
            assert!(!surface.are_neighbours(h, opposite), "the far corners of an octahedron have none");
        }
    }

    #[test]
    fn a_flip_keeps_the_surface_closed_and_makes_the_long_diagonal_short() {
        // A flat double-sided kite, cut along its long diagonal 0-1.
        let kite =
            vec![DVec3::new(-2.0, 0.0, 0.0), DVec3::new(2.0, 0.0, 0.0), DVec3::Y, -DVec3::Y, DVec3::Z * -3.0];
        let triangles = vec![[0, 1, 2], [1, 0, 3], [1, 4, 2], [2, 4, 0], [0, 4, 3], [3, 4, 1]];
        let mut surface = Surface::new(kite, triangles);
        surface.flip_to_delaunay();
        let diagonal = surface.triangles.iter().filter(|t| t.contains(&2) && t.contains(&3)).count();
        assert_eq!(diagonal, 2, "{:?}", surface.triangles);
        for (h, twin) in surface.twins.iter().enumerate() {
            assert_eq!(surface.twins[*twin as usize], h as u32);
            assert_eq!(surface.corner(*twin), surface.corner(next(h as u32)));
        }
    }
}
