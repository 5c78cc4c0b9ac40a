//! `chains.*`: one array entry for each parallel chain, put together into chains.

use rhombus_chain::{ChainParameters, ContactLaw, Formulation, ParameterError};

use crate::scene::parsed;
use crate::{Parameters, Problem, SceneError};

/// The parallel chains as the parameters give them.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainSettings {
    /// Force law of all chains.
    pub formulation: Formulation,
    /// One entry for each chain, one or more.
    pub chains: Vec<ChainParameters>,
}

const REQUIRED: [&str; 7] = [
    "chains.rod_length",
    "chains.angle",
    "chains.ratio",
    "chains.units",
    "chains.normal_stiffness",
    "chains.tangential_stiffness",
    "chains.tangential_growth",
];

const OPTIONAL: [&str; 2] = ["chains.weight", "chains.pitch"];

impl ChainSettings {
    pub(crate) fn read(p: &Parameters) -> Result<Option<ChainSettings>, SceneError> {
        let names = || REQUIRED.into_iter().chain(OPTIONAL);
        let Some(first) = REQUIRED.into_iter().chain(OPTIONAL).find(|name| p.is_given(name)) else {
            return Ok(None);
        };
        let count = entries(p, first);
        for name in names() {
            let found = entries(p, name);
            if p.is_given(name) && found != count {
                let problem = Problem::UnequalLengths { found, reference: first, expected: count };
                return Err(p.error(name, problem));
            }
        }
        let number = |name: &'static str| p.doubles(name).map(<[f64]>::to_vec);
        let rod_length = number("chains.rod_length")?;
        let angle = number("chains.angle")?;
        let ratio = number("chains.ratio")?;
        let units = p.integers("chains.units")?;
        let normal = number("chains.normal_stiffness")?;
        let tangential = number("chains.tangential_stiffness")?;
        let growth = number("chains.tangential_growth")?;
        let weight = match p.is_given("chains.weight") {
            true => number("chains.weight")?,
            false => vec![1.0 / count as f64; count],
        };
        let pitch = match p.is_given("chains.pitch") {
            true => number("chains.pitch")?,
            false => rod_length.iter().zip(&angle).map(|(a, theta)| 2.0 * a * libm::cos(*theta)).collect(),
        };
        let chains = (0..count)
            .map(|i| ChainParameters {
                rod_length_m: rod_length[i],
                angle_rad: angle[i],
                ratio: ratio[i],
                units: u32::try_from(units[i]).unwrap_or(u32::MAX),
                normal_stiffness_n_per_m: normal[i],
                tangential_stiffness_n_per_m: tangential[i],
                tangential_growth: growth[i],
                weight: weight[i],
                pitch_m: pitch[i],
            })
            .collect();
        Ok(Some(ChainSettings { formulation: parsed(p, "chains.formulation")?, chains }))
    }

    /// The contact law, validated by the model.
    pub(crate) fn law(&self, p: &Parameters) -> Result<ContactLaw, SceneError> {
        ContactLaw::new(self.formulation, &self.chains)
            .map_err(|error| p.error(blamed(&error), Problem::Model(error.to_string())))
    }

    pub(crate) fn missing(p: &Parameters) -> SceneError {
        let accepted = format!("the arrays {}, or one of the tissues in config/", REQUIRED.join(", "));
        p.error("chains", Problem::Missing { accepted })
    }
}

/// The parameter whose line a message points at.
fn blamed(error: &ParameterError) -> &'static str {
    match error {
        ParameterError::ChainOutOfRange { name, .. } => {
            let named =
                REQUIRED.into_iter().chain(OPTIONAL).find(|full| full.strip_prefix("chains.") == Some(name));
            named.unwrap_or("chains")
        }
        ParameterError::WeightSum { .. } => "chains.weight",
        ParameterError::TangentialOverflow { .. } => "chains.tangential_growth",
        ParameterError::SnapsThrough { .. } | ParameterError::NotRising { .. } => {
            "chains.tangential_stiffness"
        }
        ParameterError::UnknownWord { name, .. } | ParameterError::SurfaceOutOfRange { name, .. } => name,
        ParameterError::UnitsOutOfRange { .. } => "chains.units",
        _ => "chains",
    }
}

fn entries(p: &Parameters, name: &str) -> usize {
    p.get(name).and_then(crate::Value::array_length).unwrap_or(0)
}
