//! Springs and masses from tetrahedra.
//!
//! Lloyd, Szekely and Harders (IEEE TVCG 13(5), 2007) compare the stiffness matrix of a linear tetrahedron with that of
//! springs on its six edges; for a regular one of edge l the best springs have
//!
//! ```text
//! k = (2 sqrt(2)/25) l E,   nu = 1/4
//! ```
//!
//! and an edge of a mesh gets the sum over its tetrahedra. (The same number minimises the distance, over all components,
//! between the two elasticity tensors, which the test below repeats.) For tetrahedra that are not regular l is the mean of
//! the six edges. A quarter of a tetrahedron's mass goes to each corner.

use glam::DVec3;

use crate::TetMesh;

/// One spring.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spring {
    /// The nodes at its ends.
    pub(super) ends: [u32; 2],
    /// Length at rest, m.
    pub(super) rest_m: f64,
    /// N/m.
    pub(super) stiffness_n_per_m: f64,
}

/// Masses joined by springs.
#[derive(Clone, Debug)]
pub(super) struct Network {
    /// Positions at rest, m.
    pub(super) rest: Vec<DVec3>,
    pub(super) springs: Vec<Spring>,
    /// 1/kg; zero for a held node.
    pub(super) inverse_mass_per_kg: Vec<f64>,
}

/// Stiffness of the springs of one tetrahedron, N/m.
fn stiffness_n_per_m(corners: [DVec3; 4], young_pa: f64) -> f64 {
    let [a, b, c, d] = corners;
    let edges = [(a, b), (a, c), (a, d), (b, c), (b, d), (c, d)];
    let mean_edge_m = edges.iter().map(|(from, to)| from.distance(*to)).sum::<f64>() / 6.0;
    2.0 * std::f64::consts::SQRT_2 / 25.0 * mean_edge_m * young_pa
}

impl Network {
    /// What building and stepping take at most: the springs before edges are merged, and the state.
    pub(super) fn needed_bytes(volume: &TetMesh) -> u64 {
        let springs = 6 * volume.tets.len() * size_of::<Spring>();
        (springs + volume.nodes.len() * (4 * size_of::<DVec3>() + size_of::<f64>())) as u64
    }

    /// Springs on the edges of the tetrahedra; nodes beyond `fixed` are free.
    pub(super) fn new(volume: &TetMesh, fixed: &[bool], young_pa: f64, density_kg_per_m3: f64) -> Self {
        let rest = volume.nodes.clone();
        let mut mass = vec![0.0; rest.len()];
        let mut springs = Vec::with_capacity(6 * volume.tets.len());
        for tet in &volume.tets {
            let [a, b, c, d] = tet.map(|node| rest[node as usize]);
            let volume_m3 = (b - a).cross(c - a).dot(d - a) / 6.0;
            let stiffness_n_per_m = stiffness_n_per_m([a, b, c, d], young_pa);
            for (i, &from) in tet.iter().enumerate() {
                mass[from as usize] += density_kg_per_m3 * volume_m3 / 4.0;
                for &to in &tet[i + 1..] {
                    let rest_m = rest[from as usize].distance(rest[to as usize]);
                    let ends = [from.min(to), from.max(to)];
                    springs.push(Spring { ends, rest_m, stiffness_n_per_m });
                }
            }
        }
        springs.sort_by_key(|spring| spring.ends);
        springs.dedup_by(|next, kept| {
            let same = next.ends == kept.ends;
            if same {
                kept.stiffness_n_per_m += next.stiffness_n_per_m;
            }
            same
        });
        springs.shrink_to_fit();
        let held = |node: usize| fixed.get(node).copied().unwrap_or(false);
        let inverse = |(node, &kg): (usize, &f64)| if held(node) || kg <= 0.0 { 0.0 } else { 1.0 / kg };
        let inverse_mass_per_kg = mass.iter().enumerate().map(inverse).collect();
        Self { rest, springs, inverse_mass_per_kg }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.rest.as_slice())
            + size_of_val(self.springs.as_slice())
            + size_of_val(self.inverse_mass_per_kg.as_slice())
    }

    /// The spring's present direction (zero when its ends meet) and elongation in m.
    fn strained(&self, spring: &Spring, displacement: &[DVec3]) -> (DVec3, f64) {
        let [a, b] = spring.ends.map(|node| self.rest[node as usize] + displacement[node as usize]);
        let length = (b - a).length();
        let along = if length > 0.0 { (b - a) / length } else { DVec3::ZERO };
        (along, length - spring.rest_m)
    }

    /// Forces of the springs on the nodes, N.
    pub(super) fn forces(&self, displacement: &[DVec3], forces: &mut [DVec3]) {
        forces.fill(DVec3::ZERO);
        for spring in &self.springs {
            let (along, elongation) = self.strained(spring, displacement);
            let pull = along * (spring.stiffness_n_per_m * elongation);
            forces[spring.ends[0] as usize] += pull;
            forces[spring.ends[1] as usize] -= pull;
        }
    }

    /// `K x` at rest: the forces' change for small displacements, sign reversed.
    pub(super) fn stiffness_times(&self, x: &[DVec3], product: &mut [DVec3]) {
        product.fill(DVec3::ZERO);
        for spring in &self.springs {
            let [a, b] = spring.ends.map(|node| node as usize);
            let along = (self.rest[b] - self.rest[a]) / spring.rest_m;
            let pull = along * (spring.stiffness_n_per_m * along.dot(x[b] - x[a]));
            product[a] -= pull;
            product[b] += pull;
        }
    }

    /// Energy in the springs, J.
    pub(super) fn energy_j(&self, displacement: &[DVec3]) -> f64 {
        let one = |spring: &Spring| {
            let (_, elongation) = self.strained(spring, displacement);
            0.5 * spring.stiffness_n_per_m * elongation * elongation
        };
        self.springs.iter().map(one).sum()
    }

    /// Kinetic energy, J.
    pub(super) fn kinetic_j(&self, velocity: &[DVec3]) -> f64 {
        let one = |(v, &inverse): (&DVec3, &f64)| {
            if inverse > 0.0 { 0.5 * v.length_squared() / inverse } else { 0.0 }
        };
        velocity.iter().zip(&self.inverse_mass_per_kg).map(one).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::{Network, stiffness_n_per_m};
    use crate::TetMesh;
    use glam::DVec3;

    #[test]
    fn springs_of_a_regular_tetrahedron_are_the_nearest_to_an_elastic_solid_of_ratio_a_quarter() {
        let corners =
            [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(DVec3::from);
        let volume =
            (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]).abs() / 6.0;
        let (young, lame) = (7.0, 7.0 * 0.4);
        let distance = |factor: f64| {
            let mut sum = 0.0;
            for index in 0..81 {
                let [i, j, k, l] = [index / 27, index / 9 % 3, index / 3 % 3, index % 3];
                let same = |a: usize, b: usize| f64::from(u8::from(a == b));
                let solid =
                    lame * (same(i, j) * same(k, l) + same(i, k) * same(j, l) + same(i, l) * same(j, k));
                let mut springs = 0.0;
                for a in 0..4 {
                    for b in a + 1..4 {
                        let edge = corners[b] - corners[a];
                        let e = edge.normalize_or_zero();
                        let stiffness = factor * stiffness_n_per_m(corners, young);
                        springs += stiffness * edge.length_squared() / volume * e[i] * e[j] * e[k] * e[l];
                    }
                }
                sum += (springs - solid) * (springs - solid);
            }
            sum
        };
        assert!(distance(1.0) < distance(1.0001) && distance(1.0) < distance(0.9999));
    }

    #[test]
    fn masses_add_up_to_that_of_the_body_and_edges_are_not_doubled() {
        let (surface, volume) = TetMesh::block(&[0.0, 0.1, 0.3], &[0.0, 0.2], &[0.0, 0.1]);
        let network = Network::new(&volume, &[], 1.0, 1000.0);
        let mass: f64 = network.inverse_mass_per_kg.iter().map(|inverse| 1.0 / inverse).sum();
        assert!((mass - 1000.0 * surface.volume_m3()).abs() < 1e-9);
        assert!(network.springs.is_sorted_by(|a, b| a.ends < b.ends));
        // 12 nodes, 12 tetrahedra in two cells: 20 edges of boxes, 11 face diagonals, 2 of cells.
        assert_eq!(network.springs.len(), 33);
    }
}
