//! Chains from measurements: depths and forces, points of the surface, or both.

use rhombus_chain::{ContactShape, Formulation};

use super::fitted::{self, FitError, Fitted, Reached, Spring};
use super::force::{self, ForcePoint};
use super::half_space;
use super::shape::{ShapePoint, ShapeTask};
use super::table::ProfilePoint;

/// What was measured, and with what.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Depths and forces; none when only the surface was measured.
    pub force: Vec<ForcePoint>,
    /// Points of the surface, by distance; none when only forces were measured.
    pub profile: Vec<ProfilePoint>,
    /// Depth at which the surface was measured, m. `None`: the displacement of the first point, which lies in the contact.
    pub profile_depth_m: Option<f64>,
    /// Radius of the spherical probe, m.
    pub probe_radius_m: f64,
    /// Radius of the contact, m: what moves by the whole depth.
    pub contact_radius_m: f64,
}

/// Stiffness at rest where no force was measured, N/m: 1 N at 5 mm.
const STIFFNESS_N_PER_M: f64 = 200.0;

impl Measured {
    /// Fits `chains` parallel chains.
    ///
    /// # Errors
    /// Too few points, a surface measured at no known depth, forces that do not oppose the depth.
    pub fn fit(&self, formulation: Formulation, chains: usize) -> Result<Fitted, FitError> {
        if self.force.is_empty() && self.profile.is_empty() {
            return Err(FitError::Data(
                "nothing was measured; accepted: depths and forces, a surface, or both".to_owned(),
            ));
        }
        for (name, value) in
            [("probe-radius", self.probe_radius_m), ("contact-radius", self.contact_radius_m)]
        {
            if !(1e-6..=1.0).contains(&value) {
                return Err(FitError::Input { name, value, accepted: "1e-6 to 1, in m" });
            }
        }
        let mut notes = Vec::new();
        let deepest_m = self.force.iter().map(|point| point.depth_m.abs()).fold(0.0, f64::max);
        let mut task = ShapeTask {
            chains,
            contact_radius_m: self.contact_radius_m,
            depth_m: self.contact_radius_m,
            range_m: 2.0 * deepest_m.max(self.contact_radius_m),
            ends: false,
            reach_m: f64::INFINITY,
            exact: false,
        };
        let profile = self.shape_points()?;
        let members = match &profile {
            Some((depth_m, points)) => {
                task.depth_m = *depth_m;
                task.range_m = task.range_m.max(2.0 * depth_m);
                let found = task.fit(points)?;
                notes.extend(found.notes);
                found.members
            }
            None => {
                notes.push(
                    "chains.ratio, chains.pitch, chains.weight: forces do not tell the surface's shape; that of an elastic \
                     half-space around probe.contact_radius"
                        .to_owned(),
                );
                half_space::members(self.contact_radius_m, chains)?
            }
        };
        let (spring, members) = if self.force.is_empty() {
            notes.push(format!(
                "chains.normal_stiffness, chains.tangential_stiffness: a surface does not tell forces; {STIFFNESS_N_PER_M} \
                 N/m at rest"
            ));
            let range_m = task.range_m;
            (Spring { formulation, rest_n_per_m: STIFFNESS_N_PER_M, tangential: 0.0, range_m }, members)
        } else {
            let found = force::fit(formulation, &members, &self.force)?;
            notes.extend(found.notes);
            (found.spring, found.members)
        };
        let mut fitted = Fitted {
            formulation,
            chains: fitted::chains(&spring, &members),
            surface: task.surface(),
            probe_radius_m: self.probe_radius_m,
            reached: Vec::new(),
            notes,
        };
        let law = fitted.law()?;
        if !self.force.is_empty() {
            fitted.reached.push(Reached {
                what: format!("force at {} measured depths (relative L2)", self.force.len()),
                relative: force::relative_error(&law, &self.force)?,
            });
        }
        if let Some((depth_m, points)) = &profile {
            let mut shape = ContactShape::new(&law, &fitted.surface)?;
            shape.set_depth(&law, *depth_m).map_err(|error| FitError::Data(error.to_string()))?;
            let error = |point: &ShapePoint| (shape.share(shape.s_m(point.arc_m)) - point.normal).powi(2);
            let (error, all) =
                points.iter().fold((0.0, 0.0), |(e, all), p| (e + error(p), all + p.normal * p.normal));
            fitted.reached.push(Reached {
                what: format!("surface at {} measured points (relative L2)", points.len()),
                relative: (error / all).sqrt(),
            });
        }
        Ok(fitted)
    }

    /// The measured surface for a depth of 1, and that depth.
    fn shape_points(&self) -> Result<Option<(f64, Vec<ShapePoint>)>, FitError> {
        let Some(first) = self.profile.first() else { return Ok(None) };
        let depth_m = match self.profile_depth_m {
            Some(depth_m) => depth_m,
            None if first.distance_m <= self.contact_radius_m => first.displacement_m,
            None => {
                return Err(FitError::Data(format!(
                    "the depth of the surface is not known: its first point is {:?} m from the contact's middle, outside its \
                     radius of {:?} m; accepted: a point within the contact, or --profile-depth",
                    first.distance_m, self.contact_radius_m
                )));
            }
        };
        if depth_m <= 0.0 {
            let accepted = "greater than 0: displacement is positive into the body";
            return Err(FitError::Input { name: "depth of the surface", value: depth_m, accepted });
        }
        let point = |point: &ProfilePoint| ShapePoint {
            arc_m: point.distance_m,
            normal: point.displacement_m / depth_m,
            tangential: None,
            weight: 1.0,
            tangential_weight: 0.0,
        };
        Ok(Some((depth_m, self.profile.iter().map(point).collect())))
    }
}
