//! A sparse symmetric positive definite matrix, factored once, solved for many right-hand sides at once.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::prelude::Reborrow;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut, Par, Side};

use crate::SetupError;

/// One entry of a matrix.
pub(crate) type Entry = Triplet<u32, u32, f64>;

/// L of the matrix L Lᵀ (supernodal, approximate minimum degree order).
pub(crate) struct SparseFactor {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

impl SparseFactor {
    /// Factors a matrix of which the lower triangle is given. `reserve` is asked before anything large is allocated: it is
    /// told how many bytes the factor takes.
    ///
    /// # Errors
    /// What `reserve` says, or that the matrix is not positive definite.
    pub(crate) fn new(
        size: usize,
        lower: &[Entry],
        reserve: impl FnOnce(u64) -> Result<(), SetupError>,
    ) -> Result<Self, SetupError> {
        let singular = |why: String| SetupError::Singular { size, why };
        let matrix = SparseColMat::<u32, f64>::try_new_from_triplets(size, size, lower)
            .map_err(|error| singular(format!("{error:?}")))?;
        let symbolic = factorize_symbolic_cholesky(
            matrix.symbolic(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|error| singular(format!("{error:?}")))?;
        let par = Par::rayon(0);
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(par, faer::Spec::default());
        reserve((8 * symbolic.len_val() + scratch.unaligned_bytes_required()) as u64)?;
        let mut values = vec![0.0; symbolic.len_val()];
        let mut memory = MemBuffer::new(scratch);
        symbolic
            .factorize_numeric_llt(
                &mut values,
                matrix.rb(),
                Side::Lower,
                LltRegularization::default(),
                par,
                MemStack::new(&mut memory),
                faer::Spec::default(),
            )
            .map_err(|error| singular(format!("{error:?}")))?;
        Ok(Self { symbolic, values })
    }

    /// Replaces each column of `sides` by the solution for it.
    pub(crate) fn solve(&self, sides: MatMut<'_, f64>, par: Par) {
        let mut memory = MemBuffer::new(self.symbolic.solve_in_place_scratch::<f64>(sides.ncols(), par));
        let factor = LltRef::new(&self.symbolic, &self.values);
        factor.solve_in_place_with_conj(Conj::No, sides, par, MemStack::new(&mut memory));
    }

    /// What it takes, without its integers.
    pub(crate) fn bytes(&self) -> u64 {
        8 * self.values.len() as u64
    }
}
