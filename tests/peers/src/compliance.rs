//! The dense surface compliance of a held body: displacement of every free vertex for a force on every free vertex.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, Par};
use glam::DVec3;

/// In which direction the numbers of the matrix lie side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    /// Rows: for products with a whole vector.
    Rows,
    /// Columns: for products with a few forces.
    Columns,
}

/// Displacement in m per N, kept in single precision: its rounding (6e-8) is far below what the discretisation leaves.
///
/// Only the vertices that can move take part: a held one answers zero.
pub(crate) struct Compliance {
    free: Vec<u32>,
    place: Vec<Option<u32>>,
    layout: Layout,
    numbers: Vec<f32>,
}

/// The forces of a disc on its vertices at unit depth.
#[derive(Clone, Debug, Default)]
pub(crate) struct UnitContact {
    /// For each touched vertex that can move, its number among those: the force on the body, N per m of depth.
    pub(crate) forces: Vec<(u32, DVec3)>,
    /// Force on the hand, N per m of depth.
    pub(crate) stiffness_n_per_m: f64,
}

/// Forces normal to a disc, N per m of depth and positive into the body, that give every touched point unit depth:
/// `normal_compliance(i, j)` is the displacement of point i for a unit force on point j, both along the normal.
pub(crate) fn press(points: usize, normal_compliance: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let matrix = Mat::from_fn(points, points, normal_compliance);
    let depth = Mat::from_fn(points, 1, |_, _| 1.0);
    let forces = PartialPivLu::new(matrix.as_ref()).solve(&depth);
    (0..points).map(|point| forces[(point, 0)]).collect()
}

impl Compliance {
    /// How many bytes it takes for a body with so many vertices that can move.
    pub(crate) fn bytes_for(free: usize) -> u64 {
        9 * (free as u64).pow(2) * size_of::<f32>() as u64
    }

    /// Vertices that can move, ascending.
    pub(crate) fn free_vertices(fixed: &[bool]) -> Vec<u32> {
        (0u32..).zip(fixed).filter(|&(_, &held)| !held).map(|(vertex, _)| vertex).collect()
    }

    /// `numbers` in the layout given: unknown `3 k + axis` belongs to the k-th free vertex.
    pub(crate) fn new(fixed: &[bool], layout: Layout, numbers: Vec<f32>) -> Self {
        let free = Self::free_vertices(fixed);
        let mut place = vec![None; fixed.len()];
        for (number, &vertex) in (0u32..).zip(&free) {
            place[vertex as usize] = Some(number);
        }
        Self { free, place, layout, numbers }
    }

    /// What it takes.
    pub(crate) fn bytes(&self) -> u64 {
        (size_of_val(&self.numbers[..]) + size_of_val(&self.free[..]) + size_of_val(&self.place[..])) as u64
    }

    /// Number of unknowns.
    pub(crate) fn size(&self) -> usize {
        3 * self.free.len()
    }

    /// A row or a column, as laid out.
    fn line(&self, number: usize) -> &[f32] {
        let size = self.size();
        &self.numbers[number * size..(number + 1) * size]
    }

    /// Displacement along `normal` of one free vertex for a unit force along `normal` on another.
    fn normal_compliance(&self, of: u32, by: u32, normal: DVec3) -> f64 {
        let (line, across) = if self.layout == Layout::Rows { (of, by) } else { (by, of) };
        let n = normal.to_array();
        let mut sum = 0.0;
        for i in 0..3 {
            let numbers = &self.line(3 * line as usize + i)[3 * across as usize..][..3];
            sum += n[i] * numbers.iter().zip(n).map(|(&number, n)| f64::from(number) * n).sum::<f64>();
        }
        sum
    }

    /// The disc on the touched vertices: unit depth along the normal, free along the disc.
    pub(crate) fn touch(&self, patch: &[u32], normal: DVec3) -> UnitContact {
        let touched: Vec<u32> = patch.iter().filter_map(|&vertex| self.place[vertex as usize]).collect();
        let pressed = press(touched.len(), |i, j| self.normal_compliance(touched[i], touched[j], normal));
        UnitContact {
            stiffness_n_per_m: pressed.iter().sum(),
            forces: touched
                .into_iter()
                .zip(pressed)
                .map(|(vertex, force)| (vertex, normal * -force))
                .collect(),
        }
    }

    /// `displacements = C forces` as the full dense product; laid out in rows. `scratch` is one number for each unknown.
    pub(crate) fn multiply(&self, forces: &[f32], scratch: &mut [f32], displacements: &mut [DVec3]) {
        let size = self.size();
        faer::linalg::matmul::matmul(
            faer::ColMut::from_slice_mut(scratch),
            faer::Accum::Replace,
            faer::MatRef::from_row_major_slice(&self.numbers, size, size),
            faer::ColRef::from_slice(forces),
            1.0,
            Par::Seq,
        );
        self.scatter(scratch, displacements);
    }

    /// `displacements = C forces`, forces on few vertices given as (number among the free, force); laid out in columns.
    pub(crate) fn combine(&self, forces: &[(u32, DVec3)], scratch: &mut [f32], displacements: &mut [DVec3]) {
        scratch.fill(0.0);
        for &(vertex, force) in forces {
            for (axis, force) in force.as_vec3().to_array().into_iter().enumerate() {
                for (sum, &number) in scratch.iter_mut().zip(self.line(3 * vertex as usize + axis)) {
                    *sum += number * force;
                }
            }
        }
        self.scatter(scratch, displacements);
    }

    fn scatter(&self, unknowns: &[f32], displacements: &mut [DVec3]) {
        displacements.fill(DVec3::ZERO);
        for (&vertex, u) in self.free.iter().zip(unknowns.chunks_exact(3)) {
            displacements[vertex as usize] = DVec3::new(f64::from(u[0]), f64::from(u[1]), f64::from(u[2]));
        }
    }
}
