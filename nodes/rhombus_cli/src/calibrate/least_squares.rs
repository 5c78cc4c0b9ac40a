//! Nonlinear least squares without bounds: Levenberg-Marquardt, and what the data leave open.
//!
//! Everything that must stay in a range is transformed by the caller (logarithm, [`between`]), so that no step of the
//! solver can leave it.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, storage::Owned};

/// Where the solver ended.
#[derive(Clone, Debug)]
struct Solution {
    parameters: Vec<f64>,
    /// Sum of squared residuals.
    cost: f64,
    /// One row for each residual, one column for each parameter.
    jacobian: DMatrix<f64>,
}

/// Parameters as far as the data tell them.
#[derive(Clone, Debug)]
pub(super) struct Determined {
    /// All parameters; those left open have their defaults.
    pub(super) parameters: Vec<f64>,
    /// Numbers of the parameters that the data do not tell, the least certain first.
    pub(super) left_open: Vec<usize>,
}

/// A parameter with a larger standard error is not known. Parameters are logarithms and logits: known to a factor of e.
pub(super) const KNOWN: f64 = 1.0;

/// Putting a parameter to its default may raise the sum of squares by this many times the squared scatter: two standard
/// errors.
const NOT_WORSE: f64 = 4.0;

/// The least sum of squares from several starts. A parameter that is not known at the solution is put to its default, the
/// least certain first, and the rest is fitted again, as long as that is hardly worse. `scatter` is the least that the
/// residuals are taken to scatter by; `known` the largest standard error of a parameter that counts as known. `None` where the residuals are no numbers.
pub(super) fn determine(
    starts: &[Vec<f64>],
    defaults: &[f64],
    scatter: f64,
    known: f64,
    residuals: impl Fn(&[f64]) -> Option<Vec<f64>>,
) -> Option<Determined> {
    let whole = |free: &[usize], x: &[f64]| {
        let mut all = defaults.to_vec();
        free.iter().zip(x).for_each(|(place, value)| all[*place] = *value);
        all
    };
    let solve = |free: &[usize], start: &[f64]| {
        let start: Vec<f64> = free.iter().map(|place| start[*place]).collect();
        minimize(&start, &|x| residuals(&whole(free, x)))
    };
    let mut free: Vec<usize> = (0..defaults.len()).collect();
    let solutions = starts.iter().filter_map(|start| solve(&free, start));
    let mut best = solutions.min_by(|a, b| a.cost.total_cmp(&b.cost))?;
    let (mut left_open, mut needed) = (Vec::new(), Vec::new());
    loop {
        let errors = best.standard_errors(scatter);
        let open = (0..free.len()).filter(|place| errors[*place] > known && !needed.contains(&free[*place]));
        let Some(worst) = open.max_by(|a, b| errors[*a].total_cmp(&errors[*b])) else {
            return Some(Determined { parameters: whole(&free, &best.parameters), left_open });
        };
        let mut fewer = free.clone();
        let parameter = fewer.remove(worst);
        let limit = best.cost + NOT_WORSE * best.variance(scatter);
        match solve(&fewer, &whole(&free, &best.parameters)).filter(|solution| solution.cost <= limit) {
            Some(solution) => {
                left_open.push(parameter);
                (best, free) = (solution, fewer);
            }
            None => needed.push(parameter),
        }
    }
}

struct Problem<'a, F> {
    parameters: DVector<f64>,
    residuals: &'a F,
}

impl<F: Fn(&[f64]) -> Option<Vec<f64>>> Problem<'_, F> {
    fn at(&self, parameters: &DVector<f64>) -> Option<DVector<f64>> {
        (self.residuals)(parameters.as_slice()).map(DVector::from_vec)
    }
}

impl<F: Fn(&[f64]) -> Option<Vec<f64>>> LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_, F> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, parameters: &DVector<f64>) {
        self.parameters.copy_from(parameters);
    }

    fn params(&self) -> DVector<f64> {
        self.parameters.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        self.at(&self.parameters)
    }

    /// Central differences; every parameter is of order 1 by its transformation.
    fn jacobian(&self) -> Option<DMatrix<f64>> {
        const STEP: f64 = 1e-5;
        let columns = (0..self.parameters.len()).map(|column| {
            let shifted = |by: f64| {
                let mut parameters = self.parameters.clone();
                parameters[column] += by;
                self.at(&parameters)
            };
            Some((shifted(STEP)? - shifted(-STEP)?) / (2.0 * STEP))
        });
        Some(DMatrix::from_columns(&columns.collect::<Option<Vec<_>>>()?))
    }
}

/// Minimises the sum of squares from `start`. `None` where the residuals are no numbers.
fn minimize(start: &[f64], residuals: &impl Fn(&[f64]) -> Option<Vec<f64>>) -> Option<Solution> {
    const TOLERANCE: f64 = 1e-12;
    let problem = Problem { parameters: DVector::from_column_slice(start), residuals };
    // Fixing everything is allowed; the solver refuses to solve for nothing.
    let problem = match start.is_empty() {
        true => problem,
        false => LevenbergMarquardt::new().with_tol(TOLERANCE).with_patience(100).minimize(problem).0,
    };
    let cost = problem.residuals()?.norm_squared();
    let jacobian = match start.is_empty() {
        true => DMatrix::zeros(problem.residuals()?.len(), 0),
        false => problem.jacobian()?,
    };
    cost.is_finite().then(|| Solution { parameters: problem.parameters.as_slice().to_vec(), cost, jacobian })
}

impl Solution {
    /// Squared scatter of the residuals, at least that of `floor`.
    fn variance(&self, floor: f64) -> f64 {
        let (rows, columns) = self.jacobian.shape();
        (self.cost / rows.saturating_sub(columns).max(1) as f64).max(floor * floor)
    }

    /// Standard error of each parameter in its transformed unit, for residuals with a scatter of at least `floor`:
    /// `sqrt(diag (J^T J)^-1)` times the scatter. Infinite where the Jacobian has no rank.
    fn standard_errors(&self, floor: f64) -> Vec<f64> {
        let columns = self.jacobian.ncols();
        let scatter = self.variance(floor).sqrt();
        let svd = self.jacobian.clone().svd(false, true);
        let Some(v_t) = svd.v_t else { return vec![f64::INFINITY; columns] };
        let largest = svd.singular_values.max();
        (0..columns)
            .map(|parameter| {
                let variance: f64 = (0..svd.singular_values.len())
                    .map(|i| {
                        let part = v_t[(i, parameter)];
                        let value = svd.singular_values[i];
                        let flat = value <= 1e-12 * largest;
                        if flat && part.abs() > 1e-6 {
                            f64::INFINITY
                        } else {
                            (part / value.max(1e-300)).powi(2)
                        }
                    })
                    .sum();
                scatter * variance.sqrt()
            })
            .collect()
    }
}

/// A number between `low` and `high` for any real `x`; the middle at 0.
pub(super) fn between(low: f64, high: f64, x: f64) -> f64 {
    low + (high - low) / (1.0 + libm::exp(-x))
}

/// The `x` of a number between `low` and `high`.
pub(super) fn real_of(low: f64, high: f64, value: f64) -> f64 {
    libm::log((value - low) / (high - value))
}
