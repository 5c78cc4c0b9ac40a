//! The dense compliance of a held body: displacement of every free vertex for forces on every point a disc can touch.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, Par};
use glam::{DVec3, Mat3, Vec3};
use rhombus_chain::SurfaceMesh;

use crate::Job;
use crate::contact::ContactPoints;

/// In which direction the numbers of the matrix lie side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    /// Rows: for products with a whole vector.
    Rows,
    /// Columns: for products with a few forces.
    Columns,
}

/// Compliance between the middles of edges that one disc can touch together: what a contact needs besides the matrix.
#[derive(Default)]
pub(crate) struct NearMiddles {
    /// For each middle, where its partners begin in `partners`; one more at the end.
    pub(crate) starts: Vec<usize>,
    /// Partners of each middle, ascending.
    pub(crate) partners: Vec<u32>,
    /// For each of them: entry (i, j) is the partner's displacement along i for a unit force on the middle along j.
    pub(crate) blocks: Vec<Mat3>,
}

/// Displacement in m per N, kept in single precision: its rounding (6e-8) is far below what the discretisation leaves.
///
/// Rows: three for each vertex that can move (a held one answers zero). Columns: three for each of the [`ContactPoints`].
pub(crate) struct Compliance {
    points: ContactPoints,
    layout: Layout,
    numbers: Vec<f32>,
    near: NearMiddles,
}

/// The answer of a disc at unit depth.
#[derive(Clone, Debug, Default)]
pub(crate) struct UnitContact {
    /// For each touched point: the force on the body, N per m of depth.
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
    /// How many bytes the matrix takes for so many free vertices and contact points.
    pub(crate) fn bytes_for(vertices: usize, points: usize) -> u64 {
        9 * vertices as u64 * points as u64 * size_of::<f32>() as u64
    }

    /// `numbers` in the layout given. With middles among the points the matrix has to be symmetric.
    pub(crate) fn new(points: ContactPoints, layout: Layout, numbers: Vec<f32>, near: NearMiddles) -> Self {
        Self { points, layout, numbers, near }
    }

    /// What it takes.
    pub(crate) fn bytes(&self) -> u64 {
        let near = size_of_val(&self.near.starts[..])
            + size_of_val(&self.near.partners[..])
            + size_of_val(&self.near.blocks[..]);
        self.points.bytes() + (size_of_val(&self.numbers[..]) + near) as u64
    }

    /// Numbers of displacements it answers with.
    pub(crate) fn rows(&self) -> usize {
        3 * self.points.vertices().len()
    }

    /// Numbers of forces it takes.
    pub(crate) fn columns(&self) -> usize {
        3 * self.points.len()
    }

    /// A row or a column, as laid out.
    fn line(&self, number: usize) -> &[f32] {
        let length = if self.layout == Layout::Rows { self.columns() } else { self.rows() };
        &self.numbers[number * length..(number + 1) * length]
    }

    /// Displacement of one touched point for a force on another.
    fn answer(&self, of: u32, by: u32, force: DVec3) -> DVec3 {
        let vertices = self.points.vertices().len() as u32;
        let (of_first, by_first) = (3 * of as usize, 3 * by as usize);
        let force = force.as_vec3();
        let displacement = if of < vertices && self.layout == Layout::Rows {
            [0, 1, 2].map(|i| Vec3::from_slice(&self.line(of_first + i)[by_first..]).dot(force)).into()
        } else if of < vertices {
            let column = |j| Vec3::from_slice(&self.line(by_first + j)[of_first..]);
            column(0) * force.x + column(1) * force.y + column(2) * force.z
        } else if by < vertices {
            // Symmetric: the transposed block.
            let entry = |i, j| match self.layout {
                Layout::Rows => self.line(by_first + j)[of_first + i],
                Layout::Columns => self.line(of_first + i)[by_first + j],
            };
            [0, 1, 2].map(|i| (0..3).map(|j| entry(i, j) * force[j]).sum::<f32>()).into()
        } else {
            let starts = &self.near.starts[(by - vertices) as usize..];
            let partners = &self.near.partners[starts[0]..starts[1]];
            let block = partners.binary_search(&(of - vertices)).map(|at| self.near.blocks[starts[0] + at]);
            block.unwrap_or(Mat3::ZERO) * force
        };
        displacement.as_dvec3()
    }

    /// The disc at a vertex: unit depth along the normal, free along the disc.
    pub(crate) fn touch(
        &self,
        surface: &SurfaceMesh,
        vertex: u32,
        normal: DVec3,
        radius_m: f64,
    ) -> UnitContact {
        let touched = self.points.touched(surface, vertex, normal, radius_m);
        let pressed = press(touched.len(), |i, j| self.answer(touched[i], touched[j], normal).dot(normal));
        UnitContact {
            stiffness_n_per_m: pressed.iter().sum(),
            forces: touched.into_iter().zip(pressed).map(|(point, force)| (point, normal * -force)).collect(),
        }
    }

    /// `displacements = C forces` as the full dense product; laid out in rows. `scratch`: one number for each row.
    pub(crate) fn multiply(&self, forces: &[f32], scratch: &mut [f32], displacements: &mut [DVec3]) {
        faer::linalg::matmul::matmul(
            faer::ColMut::from_slice_mut(scratch),
            faer::Accum::Replace,
            faer::MatRef::from_row_major_slice(&self.numbers, self.rows(), self.columns()),
            faer::ColRef::from_slice(forces),
            1.0,
            Par::Seq,
        );
        self.scatter(scratch, displacements);
    }

    /// `displacements = C forces` with few forces, each on a point; laid out in columns.
    pub(crate) fn combine(&self, forces: &[(u32, DVec3)], scratch: &mut [f32], displacements: &mut [DVec3]) {
        scratch.fill(0.0);
        for &(point, force) in forces {
            for (axis, force) in force.as_vec3().to_array().into_iter().enumerate() {
                for (sum, &number) in scratch.iter_mut().zip(self.line(3 * point as usize + axis)) {
                    *sum += number * force;
                }
            }
        }
        self.scatter(scratch, displacements);
    }

    fn scatter(&self, numbers: &[f32], displacements: &mut [DVec3]) {
        displacements.fill(DVec3::ZERO);
        for (&vertex, u) in self.points.vertices().iter().zip(numbers.chunks_exact(3)) {
            displacements[vertex as usize] = DVec3::new(f64::from(u[0]), f64::from(u[1]), f64::from(u[2]));
        }
    }
}

impl NearMiddles {
    /// Which middles one disc of the job can touch together: no farther apart than the diagonal of a box of its diameter.
    /// Their blocks are still to be filled.
    pub(crate) fn pairs(job: &Job, points: &ContactPoints) -> Self {
        let vertices = job.surface.vertices();
        let at: Vec<DVec3> =
            points.edges().map(|[a, b]| (vertices[a as usize] + vertices[b as usize]) * 0.5).collect();
        let reach = 2.0 * f64::sqrt(2.0) * job.contact_radius_m * (1.0 + 1e-6);
        let (mut starts, mut partners) = (vec![0], Vec::new());
        for own in &at {
            let near = (0u32..).zip(&at).filter(|(_, other)| own.distance_squared(**other) <= reach * reach);
            partners.extend(near.map(|(other, _)| other));
            starts.push(partners.len());
        }
        Self { starts, partners, blocks: Vec::new() }
    }
}
