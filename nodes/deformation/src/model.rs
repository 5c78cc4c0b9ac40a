//! What the parameters say of the model beyond the scene's typed groups.

use rhombus_chain::ContactLaw;
use scene::{Parameters, Scene, SceneError, Value};

/// The scene that parameters describe, if they describe a model; for values that are about to be set.
pub(crate) fn check(parameters: &Parameters) -> Result<Scene, SceneError> {
    let scene = Scene::from_parameters(parameters.clone())?;
    scene.tissue()?;
    Ok(scene)
}

/// What the parameters without a constant default are when nobody gives them.
pub(crate) fn computed(law: &ContactLaw) -> [(&'static str, Value); 2] {
    let each = |value: fn(&rhombus_chain::ChainParameters) -> f64| {
        Value::DoubleArray(law.chains().iter().map(|chain| value(chain.parameters())).collect())
    };
    [("chains.weight", each(|chain| chain.weight)), ("chains.pitch", each(|chain| chain.pitch_m))]
}
