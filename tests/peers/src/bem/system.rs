//! From the boundary integrals to the compliance of the free vertices.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{MatMut, Par};

use super::boundary::Boundary;
use crate::compliance::{Compliance, Layout, NearMiddles};
use crate::contact::ContactPoints;
use crate::{Job, SetupError};

/// Solves H u = G t for unit forces on the free vertices, held vertices not moving.
///
/// With unknowns u on free and t on held vertices the columns of G and H change places (t has the scale of the shear
/// modulus, so that both are of order one); the columns of G of the free vertices are the right-hand sides.
pub(super) fn surface_compliance(job: &Job, layout: Layout) -> Result<Compliance, SetupError> {
    job.check()?;
    job.check_held()?;
    let points = ContactPoints::new(job.fixed, []);
    let free = points.vertices();
    let vertices = job.fixed.len();
    let size = 3 * vertices;
    // H and G, and while solving one more of the right-hand sides.
    let unknowns = 3 * free.len();
    let solving = (size_of::<f64>() * size) as u64 * (2 * size + unknowns) as u64;
    job.reserve(Compliance::bytes_for(free.len(), free.len()) + solving)?;
    let Boundary { mut h, mut g } = Boundary::new(job.surface, job.fixed, job.material.poisson);
    for (h, g) in h.chunks_exact_mut(size).zip(g.chunks_exact_mut(size)) {
        for vertex in (0..vertices).filter(|&vertex| job.fixed[vertex]) {
            for k in 3 * vertex..3 * vertex + 3 {
                h[k] = -g[k];
            }
        }
        // Right-hand sides to the front; a column is a force over the area of its vertex.
        let mu = job.material.lame_pa().1;
        for (to, &vertex) in free.iter().enumerate() {
            let per_force = 1.0 / (mu * job.surface.vertex_areas()[vertex as usize]);
            for axis in 0..3 {
                g[3 * to + axis] = g[3 * vertex as usize + axis] * per_force;
            }
        }
    }
    let par = Par::rayon(0);
    let mut matrix = MatMut::from_row_major_slice_mut(&mut h, size, size);
    let mut sides = MatMut::from_row_major_slice_mut(&mut g, size, size).subcols_mut(0, unknowns);
    let (mut forward, mut backward) = (vec![0usize; size], vec![0usize; size]);
    let scratch = factor::lu_in_place_scratch::<usize, f64>(size, size, par, faer::Spec::default());
    let mut memory = MemBuffer::new(scratch);
    let (_, permutation) = factor::lu_in_place(
        matrix.rb_mut(),
        &mut forward,
        &mut backward,
        par,
        MemStack::new(&mut memory),
        faer::Spec::default(),
    );
    let mut memory = MemBuffer::new(solve::solve_in_place_scratch::<usize, f64>(size, unknowns, par));
    let factors = matrix.rb();
    solve::solve_in_place(factors, factors, permutation, sides.rb_mut(), par, MemStack::new(&mut memory));
    let answers = sides.rb();
    let rows: Vec<usize> =
        free.iter().flat_map(|&vertex| [0, 1, 2].map(|axis| 3 * vertex as usize + axis)).collect();
    let mut numbers = Vec::with_capacity(unknowns * unknowns);
    for line in 0..unknowns {
        numbers.extend((0..unknowns).map(|across| match layout {
            Layout::Rows => answers[(rows[line], across)] as f32,
            Layout::Columns => answers[(rows[across], line)] as f32,
        }));
    }
    if numbers.iter().all(|number| number.is_finite()) {
        Ok(Compliance::new(points, layout, numbers, NearMiddles::default()))
    } else {
        Err(SetupError::Singular { size, why: "not finite".to_owned() })
    }
}
