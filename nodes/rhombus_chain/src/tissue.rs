//! How a body answers: its contact law, the shape of its surface, and the probe that touches it.

use thiserror::Error;

use crate::contact_law::ContactLaw;
use crate::contact_shape::ContactShape;
use crate::parameter_error::ParameterError;
use crate::parameters::SurfaceParameters;

/// Validated settings of the model. Immutable; a change of parameters makes a new one.
#[derive(Clone, Debug, PartialEq)]
pub struct Tissue {
    law: ContactLaw,
    surface: SurfaceParameters,
    /// At depth 0, to be copied by whoever computes fields.
    shape: ContactShape,
    probe_radius_m: f64,
    grasp_lateral: f64,
}

/// Why settings are refused. Names are those of the scene file.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TissueError {
    /// A parameter of the surface.
    #[error(transparent)]
    Surface(#[from] ParameterError),
    /// The probe's radius.
    #[error("probe.radius = {0} m: accepted is 0 to 1 m")]
    ProbeRadius(f64),
    /// The lateral stiffness of a grasp.
    #[error("grasp.lateral = {0}: accepted is 0 to 100 times the rest stiffness")]
    GraspLateral(f64),
}

impl Tissue {
    /// Checks the settings. `probe_radius_m` is the radius of the spherical probe; `grasp_lateral` is the
    /// stiffness of a grasp across the surface normal as a multiple of the law's rest stiffness.
    ///
    /// # Errors
    /// The first setting outside its range.
    pub fn new(
        law: ContactLaw,
        surface: SurfaceParameters,
        probe_radius_m: f64,
        grasp_lateral: f64,
    ) -> Result<Self, TissueError> {
        let shape = ContactShape::new(&law, &surface)?;
        if !(0.0..=1.0).contains(&probe_radius_m) {
            return Err(TissueError::ProbeRadius(probe_radius_m));
        }
        if !(0.0..=100.0).contains(&grasp_lateral) {
            return Err(TissueError::GraspLateral(grasp_lateral));
        }
        Ok(Self { law, surface, shape, probe_radius_m, grasp_lateral })
    }

    /// The force law.
    #[must_use]
    pub fn law(&self) -> &ContactLaw {
        &self.law
    }

    /// The shape of the surface around a contact.
    #[must_use]
    pub fn surface(&self) -> &SurfaceParameters {
        &self.surface
    }

    /// The field of one contact, at depth 0.
    pub(crate) fn shape(&self) -> ContactShape {
        self.shape.clone()
    }

    /// Radius of the spherical probe in metres.
    #[must_use]
    pub fn probe_radius_m(&self) -> f64 {
        self.probe_radius_m
    }

    /// Stiffness of a grasp across the normal, as a multiple of the rest stiffness.
    #[must_use]
    pub fn grasp_lateral(&self) -> f64 {
        self.grasp_lateral
    }

    /// `k_lat`: stiffness of a grasp across the normal, in N/m.
    #[must_use]
    pub fn lateral_stiffness_n_per_m(&self) -> f64 {
        self.grasp_lateral * self.law.rest_stiffness_n_per_m()
    }
}
