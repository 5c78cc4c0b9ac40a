//! Where a law is possible, guarded, stiffening, softening and straight.

use crate::chain::Chain;
use crate::contact_law::ContactLaw;
use crate::parameters::Formulation;
use crate::unit::Rhombus;

/// How the tangent stiffness changes over a range of depths, away from rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bend {
    /// It rises with the distance from rest.
    Stiffens,
    /// It falls with the distance from rest.
    Softens,
    /// It stays: no tangential spring, or past the guard.
    Straight,
}

/// A range of depths over which the tangent stiffness is monotone. Depth is positive into the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Smallest depth, m; none: without end (a pull of any length).
    pub from_m: Option<f64>,
    /// Largest depth, m; none: without end.
    pub to_m: Option<f64>,
    /// Tangent stiffness at the smallest depth, N/m.
    pub from_n_per_m: f64,
    /// Tangent stiffness at the largest depth, N/m.
    pub to_n_per_m: f64,
    /// What it does in between.
    pub bend: Bend,
}

/// Depths and stiffness of one chain by itself. Pulls are negative depths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainAnalysis {
    /// Geometrically possible depths, (fully extended, flat), m: between them the rhombi exist.
    pub possible_m: (f64, f64),
    /// The guards, (pull, press), m: between them the closed form holds.
    pub guarded_m: (f64, f64),
    /// Tangent stiffness at rest, N/m.
    pub rest_n_per_m: f64,
    /// Pull past the guard, pull, press, press past the guard.
    pub ranges: [Range; 4],
}

/// Depths and stiffness of a whole law.
#[derive(Debug, Clone, PartialEq)]
pub struct LawAnalysis {
    /// Depths that are possible for every chain, m.
    pub possible_m: (f64, f64),
    /// Depths at which no chain is past its guard, m.
    pub guarded_m: (f64, f64),
    /// Depths outside of which every chain is past its guard and the law is one straight line, m.
    pub bent_m: (f64, f64),
    /// Tangent stiffness at rest, N/m.
    pub rest_n_per_m: f64,
    /// Pull past every guard, pull, press, press past every guard.
    pub ranges: [Range; 4],
    /// Each chain by itself.
    pub chains: Vec<ChainAnalysis>,
}

impl LawAnalysis {
    /// Closed form, each chain once.
    pub fn new(law: &ContactLaw) -> LawAnalysis {
        let chains: Vec<ChainAnalysis> = law.chains().iter().map(ChainAnalysis::new).collect();
        let over = |range: fn(&ChainAnalysis) -> (f64, f64), pick: fn(f64, f64) -> f64| {
            // `pick` chooses among sizes; a pull is a negative depth.
            chains
                .iter()
                .map(range)
                .map(|(pull, press)| (-pull, press))
                .reduce(|a, b| (pick(a.0, b.0), pick(a.1, b.1)))
        };
        let depths = |sizes: Option<(f64, f64)>| sizes.map_or((0.0, 0.0), |(pull, press)| (-pull, press));
        let possible_m = depths(over(|chain| chain.possible_m, f64::min));
        let guarded_m = depths(over(|chain| chain.guarded_m, f64::min));
        let bent_m = depths(over(|chain| chain.guarded_m, f64::max));
        let beyond = law.chains().iter().map(Chain::continued_stiffness_n_per_m);
        let ends = beyond.fold((0.0, 0.0), |sum, (press, pull)| (sum.0 + pull, sum.1 + press));
        let rest_n_per_m = law.rest_stiffness_n_per_m();
        let is_straight = law.chains().iter().all(is_straight);
        let ranges = ranges(law.formulation(), is_straight, bent_m, rest_n_per_m, ends);
        LawAnalysis { possible_m, guarded_m, bent_m, rest_n_per_m, ranges, chains }
    }
}

impl ChainAnalysis {
    fn new(chain: &Chain) -> ChainAnalysis {
        let parameters = chain.parameters();
        let rhombus = Rhombus::new(parameters.angle_rad);
        let span_m = 2.0 * parameters.rod_length_m * chain.elongation_sum();
        let (pressed_m, pulled_m) = chain.guarded_range_m();
        let guarded_m = (0.0 - pulled_m, 0.0 - pressed_m);
        let (press, pull) = chain.continued_stiffness_n_per_m();
        let rest_n_per_m = chain.rest_stiffness_n_per_m();
        ChainAnalysis {
            possible_m: (0.0 - span_m * rhombus.largest_stretch, span_m * rhombus.sine),
            guarded_m,
            rest_n_per_m,
            ranges: ranges(chain.formulation(), is_straight(chain), guarded_m, rest_n_per_m, (pull, press)),
        }
    }
}

/// Without a tangential spring both laws are `k_n dl_1` or `K/S_n^2 DL`: straight.
fn is_straight(chain: &Chain) -> bool {
    chain.parameters().tangential_stiffness_n_per_m == 0.0
}

/// The four ranges between the `bent_m` depths; `ends_n_per_m`: stiffness past the pull's and past the press's guard.
fn ranges(
    formulation: Formulation,
    is_straight: bool,
    (pull_m, press_m): (f64, f64),
    rest: f64,
    (pull, press): (f64, f64),
) -> [Range; 4] {
    let (when_pulled, when_pressed) = match formulation {
        _ if is_straight => (Bend::Straight, Bend::Straight),
        Formulation::Energy => (Bend::Stiffens, Bend::Softens),
        Formulation::Published => (Bend::Softens, Bend::Stiffens),
    };
    let range =
        |from_m, to_m, from_n_per_m, to_n_per_m, bend| Range { from_m, to_m, from_n_per_m, to_n_per_m, bend };
    [
        range(None, Some(pull_m), pull, pull, Bend::Straight),
        range(Some(pull_m), Some(0.0), pull, rest, when_pulled),
        range(Some(0.0), Some(press_m), rest, press, when_pressed),
        range(Some(press_m), None, press, press, Bend::Straight),
    ]
}
