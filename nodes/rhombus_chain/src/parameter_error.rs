//! Why parameters are refused.

/// Why parameters are refused. Every message names the parameter as scenes do, the value, and what is accepted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ParameterError {
    /// An empty list of chains.
    #[error("chains: no chain given; at least one is needed")]
    NoChain,
    /// A word that names no choice.
    #[error("{name} = \"{value}\": accepted is {accepted}")]
    UnknownWord {
        /// Scene name of the parameter.
        name: &'static str,
        /// The word received.
        value: String,
        /// What is accepted.
        accepted: &'static str,
    },
    /// One parameter of one chain outside its range.
    #[error("chains.{name}[{chain}] = {value:?}: accepted is {accepted}")]
    ChainOutOfRange {
        /// Index of the chain, from 0.
        chain: usize,
        /// Scene name of the parameter, below `chains`.
        name: &'static str,
        /// The value received.
        value: f64,
        /// What is accepted.
        accepted: &'static str,
    },
    /// A number of units outside 1..=1 000 000.
    #[error("chains.units[{chain}] = {value}: accepted is 1 to 1000000")]
    UnitsOutOfRange {
        /// Index of the chain, from 0.
        chain: usize,
        /// The value received.
        value: u32,
    },
    /// A parameter of the surface or the probe outside its range.
    #[error("{name} = {value:?}: accepted is {accepted}")]
    SurfaceOutOfRange {
        /// Scene name of the parameter.
        name: &'static str,
        /// The value received.
        value: f64,
        /// What is accepted.
        accepted: &'static str,
    },
    /// Weights that do not add up to 1.
    #[error("chains.weight: the {chains} weights add up to {sum:?}; accepted is 1 within 1e-9")]
    WeightSum {
        /// Number of chains.
        chains: usize,
        /// Sum of their weights.
        sum: f64,
    },
    /// `sum (q^2 e^(1/beta))^(i-1)` is not a number this machine can hold.
    #[error(
        "chain {chain}: the stiffness of its tangential springs overflows with chains.tangential_growth[{chain}] = {growth:?}, \
         chains.ratio[{chain}] = {ratio:?}, chains.units[{chain}] = {units}; accepted is \
         units * (2 ln ratio + 1/tangential_growth) below about 690 and 1/tangential_growth up to 600: raise tangential_growth, \
         lower ratio or units, or set tangential_stiffness to 0"
    )]
    TangentialOverflow {
        /// Index of the chain, from 0.
        chain: usize,
        /// `beta`.
        growth: f64,
        /// `q`.
        ratio: f64,
        /// `n`.
        units: u32,
    },
    /// Energy law, not `K > T (1 - cos theta)`: pressed far enough, the chain would snap through.
    #[error(
        "chain {chain}: the energy law snaps through when pressed, because chains.tangential_stiffness[{chain}] = {tangential:?} \
         with tangential_growth, ratio and angle outweighs chains.normal_stiffness[{chain}] = {normal:?}; accepted is \
         normal_stiffness > {least_normal:?} with the others kept, or tangential_stiffness < {most_tangential:?} with the others kept, \
         or a smaller angle, a larger tangential_growth, a smaller ratio or fewer units"
    )]
    SnapsThrough {
        /// Index of the chain, from 0.
        chain: usize,
        /// `k_n`, N/m.
        normal: f64,
        /// `k_t`, N/m.
        tangential: f64,
        /// The normal stiffness that has to be exceeded, N/m.
        least_normal: f64,
        /// The tangential stiffness that must not be reached, N/m.
        most_tangential: f64,
    },
    /// Published law, not `k_n > k_t tan^2 theta`: pressing would be answered by suction.
    #[error(
        "chain {chain}: the published law does not push back when pressed, because chains.tangential_stiffness[{chain}] = {tangential:?} \
         times tan^2 of the angle outweighs chains.normal_stiffness[{chain}] = {normal:?}; accepted is normal_stiffness > {least_normal:?} \
         with the others kept, or tangential_stiffness < {most_tangential:?} with the others kept, or a smaller angle, \
         or formulation: energy"
    )]
    NotRising {
        /// Index of the chain, from 0.
        chain: usize,
        /// `k_n`, N/m.
        normal: f64,
        /// `k_t`, N/m.
        tangential: f64,
        /// The normal stiffness that has to be exceeded, N/m.
        least_normal: f64,
        /// The tangential stiffness that must not be reached, N/m.
        most_tangential: f64,
    },
}
