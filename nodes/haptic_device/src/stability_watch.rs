//! Warns when a law asks for more damping than the device is known to have: the first law, and what is stiffer later.

use std::sync::Arc;

use devices::LawCommand;
use rhombus_chain::stability::{Demand, HapticLoop, Reach, Verdict};
use rhombus_chain::{ContactLaw, Mode};
use scene::Scene;

/// A body that has turned out this much stiffer is worth another word.
const WORTH_SAYING: f64 = 1.1;

/// Judges contact laws by the device's rate, delay and damping.
pub(crate) struct StabilityWatch {
    haptic_loop: HapticLoop,
    max_force_n: f64,
    /// The chains that arrived last, and what they ask for.
    chains: Option<(Arc<ContactLaw>, Demand)>,
    /// The largest stiffness that has been judged with these chains, N/m.
    judged_n_per_m: f64,
}

impl StabilityWatch {
    pub(crate) fn new(scene: &Scene) -> StabilityWatch {
        StabilityWatch {
            haptic_loop: scene.haptic_loop(),
            max_force_n: scene.device.max_force_n,
            chains: None,
            judged_n_per_m: 0.0,
        }
    }

    /// The verdict on a law that fails or cannot be judged, if it is new: other chains, or a place stiffer than all before.
    pub(crate) fn warning(&mut self, command: &LawCommand) -> Option<Verdict> {
        let of_chains = self.of_chains(&command.chains);
        let local = &command.local;
        let here = match local.mode {
            Mode::None => of_chains,
            Mode::Contact | Mode::Grasp => {
                of_chains.times(local.stiffness_factor).or_lateral(local.lateral_stiffness_n_per_m)
            }
        };
        if here.stiffness_n_per_m <= WORTH_SAYING * self.judged_n_per_m {
            return None;
        }
        self.judged_n_per_m = here.stiffness_n_per_m;
        Some(self.haptic_loop.judge(here)).filter(Verdict::is_warning)
    }

    fn of_chains(&mut self, chains: &Arc<ContactLaw>) -> Demand {
        match &self.chains {
            Some((last, demand)) if Arc::ptr_eq(last, chains) => *demand,
            _ => {
                let demand = Demand::of_law(chains, Reach::of_force(chains, self.max_force_n));
                self.chains = Some((chains.clone(), demand));
                self.judged_n_per_m = 0.0;
                demand
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rhombus_chain::{ChainParameters, Formulation, LocalLaw};
    use scene::{Origin, Value};

    fn watch(damping: f64) -> StabilityWatch {
        let values = [("simulated.damping".to_owned(), Value::Double(damping))];
        StabilityWatch::new(&Scene::from_values(values, Origin::named("test")).unwrap())
    }

    /// A straight law of 1000 N/m: needs 0.5 N s/m at 1 kHz.
    fn chains() -> Arc<ContactLaw> {
        let chain = ChainParameters {
            rod_length_m: 0.01,
            angle_rad: 0.6,
            ratio: 0.5,
            units: 1,
            normal_stiffness_n_per_m: 1000.0,
            tangential_stiffness_n_per_m: 0.0,
            tangential_growth: 1.0,
            weight: 1.0,
            pitch_m: 0.016,
        };
        Arc::new(ContactLaw::new(Formulation::Energy, &[chain]).unwrap())
    }

    fn command(chains: &Arc<ContactLaw>, mode: Mode, stiffness_factor: f64) -> LawCommand {
        let local = LocalLaw { mode, stiffness_factor, ..LocalLaw::default() };
        LawCommand { stamp_ns: 0, validity_ns: 0, local, chains: chains.clone() }
    }

    #[test]
    fn the_first_law_is_judged_before_anything_is_touched_and_then_not_again() {
        let (mut enough, mut too_little) = (watch(0.51), watch(0.49));
        let untouched = command(&chains(), Mode::None, 0.0);
        assert_eq!(enough.warning(&untouched), None);
        assert_eq!(too_little.warning(&untouched).unwrap().is_passive(), Some(false));
        assert_eq!(too_little.warning(&untouched), None);
    }

    #[test]
    fn a_stiffer_place_is_judged_anew_and_a_softer_one_is_not() {
        let (mut watch, chains) = (watch(0.9), chains());
        assert_eq!(watch.warning(&command(&chains, Mode::None, 0.0)), None);
        assert_eq!(watch.warning(&command(&chains, Mode::Contact, 0.3)), None);
        let nodule = watch.warning(&command(&chains, Mode::Contact, 2.0)).unwrap();
        assert!((nodule.needed_n_s_per_m - 1.0).abs() < 1e-12);
        assert_eq!(watch.warning(&command(&chains, Mode::Contact, 2.0)), None);
    }

    #[test]
    fn other_chains_are_judged_anew() {
        let mut watch = watch(0.1);
        assert!(watch.warning(&command(&chains(), Mode::None, 0.0)).is_some());
        assert!(watch.warning(&command(&chains(), Mode::None, 0.0)).is_some(), "others, though equal");
    }
}
