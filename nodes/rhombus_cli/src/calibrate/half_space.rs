//! An elastic half-space pressed by a rigid probe: closed forms, and the chains that come nearest to them.
//!
//! With `E* = E / (1 - nu^2)`, depth `d`, probe radius `R` and distance `r` from the axis (Johnson, Contact Mechanics, 1985,
//! sections 3.5 and 4.2; Popov, Contact Mechanics and Friction, 2017, chapter 5):
//!
//! ```text
//! flat punch   F = 2 E* R d               u(r) = d for r <= R, (2/pi) d asin(R/r) beyond
//! sphere       F = 4/3 E* sqrt(R) d^1.5   (Hertz)
//! ```
//!
//! The surface is always fitted to the flat punch, whose shape does not depend on the depth, as a chain's without
//! boundary does not. The force is fitted to the flat punch by default: it is linear in the depth, as a chain law is at
//! rest, and exact then. For `--contact sphere` it is fitted to Hertz over the depth range: only the published law rises
//! when pressed, the energy law comes out as the best straight line.

use rhombus_chain::Formulation;

use super::fitted::{self, FitError, Fitted, Member, Reached, Spring};
use super::force::{self, ForcePoint};
use super::shape::{ShapePoint, ShapeTask};

/// What presses the half-space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Contact {
    /// A flat-ended cylinder of the probe's radius.
    Flat,
    /// A sphere of the probe's radius; Hertz.
    Sphere,
}

/// An elastic half-space and a rigid probe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Young's modulus `E`, Pa.
    pub young_pa: f64,
    /// Poisson's ratio `nu`.
    pub poisson: f64,
    /// Probe radius `R`, m; the contact radius of the surface.
    pub radius_m: f64,
    /// Which closed form the force is.
    pub contact: Contact,
    /// Largest depth, m: over it Hertz is fitted, and twice as far the chains can be pressed.
    pub depth_m: f64,
}

/// Points of the profile: equidistant over this many radii, equal weights.
const PROFILE_POINTS: usize = 400;
const PROFILE_RADII: f64 = 20.0;

/// Points of the force.
const FORCE_POINTS: usize = 100;

impl HalfSpace {
    /// Pressed by a flat punch, as deep as it is wide.
    #[must_use]
    pub fn flat(young_pa: f64, poisson: f64, radius_m: f64) -> Self {
        Self { young_pa, poisson, radius_m, contact: Contact::Flat, depth_m: radius_m }
    }

    /// `E*`, Pa.
    #[must_use]
    pub fn plane_modulus_pa(&self) -> f64 {
        self.young_pa / (1.0 - self.poisson * self.poisson)
    }

    /// Force on the hand at a depth, N; positive pushes out.
    #[must_use]
    pub fn force_n(&self, depth_m: f64) -> f64 {
        match self.contact {
            Contact::Flat => 2.0 * self.plane_modulus_pa() * self.radius_m * depth_m,
            Contact::Sphere => {
                let pressed_m = depth_m.max(0.0);
                4.0 / 3.0 * self.plane_modulus_pa() * (self.radius_m * pressed_m).sqrt() * pressed_m
            }
        }
    }

    /// The flat punch's profile at `r_m` from the axis, for a depth of 1.
    #[must_use]
    pub fn profile(&self, r_m: f64) -> f64 {
        if r_m <= self.radius_m { 1.0 } else { std::f64::consts::FRAC_2_PI * libm::asin(self.radius_m / r_m) }
    }

    /// Distances from the axis at which profiles are compared, m.
    #[must_use]
    pub fn profile_distances_m(&self) -> Vec<f64> {
        let step_m = PROFILE_RADII * self.radius_m / (PROFILE_POINTS - 1) as f64;
        (0..PROFILE_POINTS).map(|i| i as f64 * step_m).collect()
    }

    fn check(&self) -> Result<(), FitError> {
        let checks = [
            ("young", self.young_pa, self.young_pa > 0.0 && self.young_pa <= 1e15, "greater than 0, Pa"),
            (
                "poisson",
                self.poisson,
                self.poisson > -1.0 && self.poisson <= 0.5,
                "greater than -1, up to 0.5",
            ),
            ("probe-radius", self.radius_m, (1e-6..=1.0).contains(&self.radius_m), "1e-6 to 1, in m"),
            ("depth", self.depth_m, self.depth_m >= 1e-9 && self.depth_m <= 10.0, "1e-9 to 10, in m"),
        ];
        match checks.into_iter().find(|(_, _, accepted, _)| !accepted) {
            Some((name, value, _, accepted)) => Err(FitError::Input { name, value, accepted }),
            None => Ok(()),
        }
    }
}

/// Fits `chains` parallel chains to a half-space.
///
/// # Errors
/// A number outside its range.
pub fn fit(half_space: &HalfSpace, formulation: Formulation, chains: usize) -> Result<Fitted, FitError> {
    half_space.check()?;
    let members = members(half_space.radius_m, chains)?;
    let mut notes = vec![
        "chains.tangential_growth: neither force nor surface of a half-space depends on it; the default"
            .to_owned(),
        "chains.angle: not told by a surface's normal displacement; small, so that little moves sideways"
            .to_owned(),
    ];
    let range_m = 2.0 * half_space.depth_m;
    let spring = match half_space.contact {
        Contact::Flat => {
            notes.push(
                "chains.tangential_stiffness: 0, because the force of a flat punch is linear in the depth"
                    .to_owned(),
            );
            let rest_n_per_m = half_space.force_n(1.0);
            Spring { formulation, rest_n_per_m, tangential: 0.0, range_m }
        }
        Contact::Sphere => {
            let points: Vec<ForcePoint> = (1..=FORCE_POINTS)
                .map(|i| {
                    let depth_m = half_space.depth_m * i as f64 / FORCE_POINTS as f64;
                    ForcePoint { depth_m, force_n: half_space.force_n(depth_m) }
                })
                .collect();
            let found = force::fit(formulation, &members, &points)?;
            notes.extend(found.notes);
            return finished(half_space, &found.spring, &found.members, notes);
        }
    };
    finished(half_space, &spring, &members, notes)
}

fn finished(
    half_space: &HalfSpace,
    spring: &Spring,
    members: &[Member],
    notes: Vec<String>,
) -> Result<Fitted, FitError> {
    let mut fitted = Fitted {
        formulation: spring.formulation,
        chains: fitted::chains(spring, members),
        surface: task(half_space.radius_m, members.len()).surface(),
        probe_radius_m: half_space.radius_m,
        reached: Vec::new(),
        notes,
    };
    let force = match half_space.contact {
        Contact::Flat => "force of the flat punch F = 2 E* R d",
        Contact::Sphere => "force of the sphere F = 4/3 E* sqrt(R) d^1.5 (Hertz)",
    };
    fitted.reached = vec![
        Reached {
            what: format!(
                "surface beside the flat punch's u = (2/pi) asin(R/r), {PROFILE_POINTS} points over {PROFILE_RADII} R"
            ),
            relative: profile_error(half_space, &fitted)?,
        },
        Reached {
            what: format!("{force}, up to {:?} m", half_space.depth_m),
            relative: force_error(half_space, &fitted)?,
        },
    ];
    Ok(fitted)
}

/// The chains whose shape is nearest to the flat punch's.
pub(super) fn members(radius_m: f64, chains: usize) -> Result<Vec<Member>, FitError> {
    let half_space = HalfSpace::flat(1.0, 0.0, radius_m);
    let point = |r_m: f64| ShapePoint {
        arc_m: r_m,
        normal: half_space.profile(r_m),
        tangential: None,
        weight: 1.0,
        tangential_weight: 0.0,
    };
    let points: Vec<ShapePoint> = half_space.profile_distances_m().into_iter().map(point).collect();
    Ok(task(radius_m, chains).fit(&points)?.members)
}

fn task(radius_m: f64, chains: usize) -> ShapeTask {
    ShapeTask {
        chains,
        contact_radius_m: radius_m,
        depth_m: radius_m,
        range_m: 2.0 * radius_m,
        ends: false,
        reach_m: f64::INFINITY,
        exact: true,
    }
}

/// Relative L2 error of the fitted surface against the flat punch's at [`HalfSpace::profile_distances_m`].
///
/// # Errors
/// The model does not accept the chains.
pub fn profile_error(half_space: &HalfSpace, fitted: &Fitted) -> Result<f64, FitError> {
    let law = fitted.law()?;
    let mut shape = rhombus_chain::ContactShape::new(&law, &fitted.surface)?;
    shape.set_depth(&law, half_space.depth_m).map_err(|error| FitError::Data(error.to_string()))?;
    let (mut error, mut all) = (0.0, 0.0);
    for r_m in half_space.profile_distances_m() {
        let exact = half_space.profile(r_m);
        error += (shape.share(shape.s_m(r_m)) - exact).powi(2);
        all += exact * exact;
    }
    Ok((error / all).sqrt())
}

fn force_error(half_space: &HalfSpace, fitted: &Fitted) -> Result<f64, FitError> {
    let points: Vec<ForcePoint> = (1..=FORCE_POINTS)
        .map(|i| {
            let depth_m = half_space.depth_m * i as f64 / FORCE_POINTS as f64;
            ForcePoint { depth_m, force_n: half_space.force_n(depth_m) }
        })
        .collect();
    force::relative_error(&fitted.law()?, &points)
}
