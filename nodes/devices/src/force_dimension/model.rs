//! The devices that the SDK drives: names, limits and buttons by the number of `dhdGetSystemType`.
//!
//! The limits are the conservative ones under which these devices are commonly run (the specifications in
//! CHAI3D's `CDeltaDevices.cpp`), not the maker's peak figures: a sigma.7 can push 20 N, but is asked for 12 N.

use glam::DVec3;

use crate::Workspace;

/// What a type number says about a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Model {
    pub(super) name: &'static str,
    pub(super) max_force_n: f64,
    /// Used where the device says that its wrist is active.
    pub(super) max_torque_n_m: f64,
    /// Used where the device says that its gripper is active.
    pub(super) max_gripper_force_n: f64,
    /// Radius of the ball around the origin that the handle always reaches.
    reach_m: f64,
    pub(super) buttons: &'static [&'static str],
}

const ONE_BUTTON: &[&str] = &["button1"];
const FALCON_BUTTONS: &[&str] = &["center", "left", "top", "right"];

const DELTA: Model = Model {
    name: "delta.3",
    max_force_n: 20.0,
    max_torque_n_m: 0.0,
    max_gripper_force_n: 0.0,
    reach_m: 0.15,
    buttons: ONE_BUTTON,
};
const OMEGA: Model = Model { max_force_n: 12.0, max_gripper_force_n: 8.0, reach_m: 0.075, ..DELTA };
const SIGMA: Model = Model { max_torque_n_m: 0.2, ..OMEGA };
const LAMBDA: Model = Model { reach_m: 0.1125, ..SIGMA };
const FALCON: Model =
    Model { name: "Falcon", max_force_n: 8.0, reach_m: 0.04, buttons: FALCON_BUTTONS, ..DELTA };

impl Model {
    /// The model with this type number, or a sentence why it cannot be driven.
    pub(super) fn of_type(number: i32) -> Result<Model, String> {
        Ok(match number {
            63 => DELTA,
            33 => Model { name: "omega.3", ..OMEGA },
            34 => Model { name: "omega.6 right", ..OMEGA },
            36 => Model { name: "omega.6 left", ..OMEGA },
            35 => Model { name: "omega.7 right", ..OMEGA },
            37 => Model { name: "omega.7 left", ..OMEGA },
            206 => Model { name: "sigma.3", ..SIGMA },
            104 => Model { name: "sigma.7 right", ..SIGMA },
            105 => Model { name: "sigma.7 left", ..SIGMA },
            203 => Model { name: "lambda.3", ..LAMBDA },
            131 => Model { name: "lambda.6 right", ..LAMBDA },
            132 => Model { name: "lambda.6 left", ..LAMBDA },
            108 => Model { name: "lambda.7 right", ..LAMBDA },
            109 => Model { name: "lambda.7 left", ..LAMBDA },
            60 => FALCON,
            31 | 32 | 61 | 62 | 64 | 106 | 107 => {
                return Err(format!(
                    "it is of type {number}, a first generation device that the SDK has dropped since version 3"
                ));
            }
            81 | 82 | 91 => {
                return Err(format!(
                    "it is of type {number}, a controller without known mechanics, whose limits and workspace are not known"
                ));
            }
            _ => return Err(format!("it is of type {number}, which is not a known device")),
        })
    }

    /// Where the handle can be: the upright cylinder around the ball that it always reaches.
    pub(super) fn workspace(&self) -> Workspace {
        Workspace { centre: DVec3::ZERO, radius_m: self.reach_m, height_m: 2.0 * self.reach_m }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_supported_type_has_its_own_name_and_limits_that_are_numbers() {
        let types = [63, 33, 34, 36, 35, 37, 206, 104, 105, 203, 131, 132, 108, 109, 60];
        let models: Vec<Model> = types.iter().map(|&number| Model::of_type(number).unwrap()).collect();
        let names: std::collections::BTreeSet<_> = models.iter().map(|model| model.name).collect();
        assert_eq!(names.len(), types.len());
        for model in models {
            assert!((5.0..=20.0).contains(&model.max_force_n), "{model:?}");
            assert!(model.workspace().contains(DVec3::Z * 0.9 * model.reach_m), "{model:?}");
        }
    }

    #[test]
    fn the_device_of_the_published_experiment_is_refused_by_its_generation() {
        assert!(Model::of_type(61).unwrap_err().contains("dropped"));
        assert!(Model::of_type(82).unwrap_err().contains("controller"));
        assert!(Model::of_type(7).unwrap_err().contains("not a known device"));
    }
}
