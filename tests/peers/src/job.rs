//! What every peer is given, and why it may refuse.

use rhombus_chain::SurfaceMesh;
use thiserror::Error;

use crate::TetMesh;

/// Linear, isotropic elasticity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus in Pa.
    pub young_pa: f64,
    /// Poisson's ratio, above -1 and below 0.5.
    pub poisson: f64,
}

impl Material {
    /// Lamé's constants lambda and mu in Pa.
    #[must_use]
    pub fn lame_pa(self) -> (f64, f64) {
        let mu = self.young_pa / (2.0 * (1.0 + self.poisson));
        (2.0 * mu * self.poisson / (1.0 - 2.0 * self.poisson), mu)
    }
}

/// One body, one material, one size of contact: the same for every peer.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// The body's surface.
    pub surface: &'a SurfaceMesh,
    /// Tetrahedra inside; their first nodes are the vertices of the surface.
    pub volume: Option<&'a TetMesh>,
    /// For each vertex of the surface: whether it is held.
    pub fixed: &'a [bool],
    /// What the body is made of.
    pub material: Material,
    /// Radius of the rigid disc that touches, in m.
    pub contact_radius_m: f64,
    /// A peer that would take more refuses, before it allocates.
    pub memory_limit_bytes: u64,
}

impl<'a> Job<'a> {
    /// Checks what all peers need.
    ///
    /// # Errors
    /// A material outside linear elasticity, a negative radius, or lists of different length.
    pub fn check(&self) -> Result<(), SetupError> {
        let Material { young_pa, poisson } = self.material;
        if !(young_pa.is_finite() && young_pa > 0.0 && poisson > -1.0 && poisson < 0.5) {
            return Err(SetupError::Material { young_pa, poisson });
        }
        if !(self.contact_radius_m.is_finite() && self.contact_radius_m >= 0.0) {
            return Err(SetupError::ContactRadius { found_m: self.contact_radius_m });
        }
        let expected = self.surface.vertices().len();
        if self.fixed.len() != expected {
            return Err(SetupError::Count { what: "fixed", found: self.fixed.len(), expected });
        }
        Ok(())
    }

    /// Refuses a body that is free to move as a whole.
    ///
    /// # Errors
    /// [`SetupError::Singular`] when fewer than three vertices are held.
    pub fn check_held(&self) -> Result<(), SetupError> {
        let held = self.fixed.iter().filter(|&&fixed| fixed).count();
        if held < 3 {
            let why = format!("{held} vertices are held");
            return Err(SetupError::Singular { size: 3 * self.fixed.len(), why });
        }
        Ok(())
    }

    /// The tetrahedra, for peers that need them.
    ///
    /// # Errors
    /// None were given, or they belong to another surface.
    pub fn tetrahedra(&self) -> Result<&'a TetMesh, SetupError> {
        let volume = self.volume.ok_or(SetupError::NoVolume)?;
        let expected = self.surface.vertices().len();
        let found = volume.surface_vertices;
        if found != expected {
            return Err(SetupError::Count { what: "surface nodes of the tetrahedra", found, expected });
        }
        Ok(volume)
    }

    /// Refuses what would not fit; to be called before allocating.
    ///
    /// # Errors
    /// [`SetupError::DoesNotFit`].
    pub fn reserve(&self, needed_bytes: u64) -> Result<(), SetupError> {
        let limit_bytes = self.memory_limit_bytes;
        if needed_bytes > limit_bytes {
            return Err(SetupError::DoesNotFit { needed_bytes, limit_bytes });
        }
        Ok(())
    }
}

/// Why a peer cannot be set up for a job.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SetupError {
    /// More memory than allowed; nothing was allocated.
    #[error("needs {needed_bytes} bytes; allowed: {limit_bytes}")]
    DoesNotFit {
        /// What setting up takes at its peak.
        needed_bytes: u64,
        /// [`Job::memory_limit_bytes`].
        limit_bytes: u64,
    },
    /// The peer needs tetrahedra, and there are none for this body.
    #[error("needs a tetrahedral mesh of the body")]
    NoVolume,
    /// A list of the wrong length.
    #[error("{what}: {found} entries; expected {expected}, one for each vertex of the surface")]
    Count {
        /// Which list.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The number of surface vertices.
        expected: usize,
    },
    /// Not a material of linear elasticity.
    #[error(
        "Young's modulus {young_pa} Pa, Poisson's ratio {poisson}; accepted: positive, and above -1 and below 0.5"
    )]
    Material {
        /// Young's modulus, Pa.
        young_pa: f64,
        /// Poisson's ratio.
        poisson: f64,
    },
    /// Not a radius.
    #[error("contact radius {found_m} m; accepted: 0 or more")]
    ContactRadius {
        /// The radius, m.
        found_m: f64,
    },
    /// The equations have no unique solution: too little is fixed, or an element has no volume.
    #[error(
        "the equations of {size} unknowns cannot be solved ({why}); the body must be held at three vertices or more"
    )]
    Singular {
        /// Number of unknowns.
        size: usize,
        /// What the solver says.
        why: String,
    },
}
