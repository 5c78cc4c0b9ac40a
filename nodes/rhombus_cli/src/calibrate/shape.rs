//! The shape of the surface: decay lengths and shares of parallel chains from points of a profile.
//!
//! A chain of many units is `g(s) = (e^(-s/L) - e^(-X/L)) / (1 - e^(-X/L))` with decay length `L = h / -ln q` and extent
//! `X = n h`. Profiles are compared with what the model itself computes ([`ContactShape`]).

use rhombus_chain::{ContactLaw, ContactShape, Formulation, SurfaceParameters};

use super::fitted::{self, ANGLE_RAD, BEST_DATA, FitError, LONG, MOST_CHAINS, Member, Spring};
use super::least_squares::{KNOWN, between, determine, real_of};

/// How far a point of the surface moves, each metre of depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShapePoint {
    /// Arc length from the contact, m.
    pub(super) arc_m: f64,
    /// Into the body, along the contact normal.
    pub(super) normal: f64,
    /// Away from the contact; `None` where only the normal part is known.
    pub(super) tangential: Option<f64>,
    /// Weight of the squared error of the normal part ...
    pub(super) weight: f64,
    /// ... and of the tangential one.
    pub(super) tangential_weight: f64,
}

/// What was found.
pub(super) struct ShapeFit {
    pub(super) members: Vec<Member>,
    /// What the points do not tell.
    pub(super) notes: Vec<String>,
}

/// Something to be found.
struct Unknown {
    default: f64,
    what: &'static str,
}

const DECAY: &str = "chains.ratio (decay length)";
const WEIGHT: &str = "chains.weight";
const EXTENT: &str = "chains.pitch (where a shape ends)";
const ANGLE: &str = "chains.angle (motion away from the contact)";

/// What may be chosen about the shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShapeTask {
    /// Parallel chains.
    pub(super) chains: usize,
    /// `r_c`, m.
    pub(super) contact_radius_m: f64,
    /// Depth at which the points are compared, m: the tangential motion is not quite linear in it.
    pub(super) depth_m: f64,
    /// Depth at which every unit would be flat, m.
    pub(super) range_m: f64,
    /// Whether the shape may end before it has decayed, as on a body that is held somewhere.
    pub(super) ends: bool,
    /// Distance behind the contact radius at which every shape has ended, m; infinite where nothing asks for an end.
    pub(super) reach_m: f64,
    /// Whether the points are those of a formula or of a solution, and not measured.
    pub(super) exact: bool,
}

/// Angles of a fitted tangential motion, rad.
const ANGLES: (f64, f64) = (0.1, 1.3);

/// Logarithms of the decay lengths that are looked for, as a share of the farthest point's `s`: 1/10000 to 10.
const SHORT: f64 = -9.2;
const WIDE: f64 = 2.3;

/// Makes an unknown a logarithm in the middle of its range: the slope of [`between`] is a quarter of the range there.
const STEEPNESS: f64 = (WIDE - SHORT) / 4.0;

/// Extents of a shape that ends, in decay lengths: from almost a cone to one that has decayed.
const EXTENTS: (f64, f64) = (0.05, LONG);

impl ShapeTask {
    /// `cutoff = 0`: every unit that turns moves its part of the surface, so that the shape does not depend on the depth.
    pub(super) fn surface(&self) -> SurfaceParameters {
        SurfaceParameters {
            cutoff: 0.0,
            contact_radius_m: self.contact_radius_m,
            ..SurfaceParameters::default()
        }
    }

    /// Fewest points that say anything about so many chains: one for each unknown and one to check.
    pub(super) fn fewest_points(&self) -> usize {
        2 * self.chains + 1
    }

    /// The members with the least sum of weighted squared errors; steepest first. Unknowns that the points do not tell to a
    /// factor of e are put to their defaults, the least certain one first.
    pub(super) fn fit(&self, points: &[ShapePoint]) -> Result<ShapeFit, FitError> {
        if !(1..=MOST_CHAINS).contains(&self.chains) {
            return Err(FitError::Input { name: "chains", value: self.chains as f64, accepted: "1 to 8" });
        }
        let outside = points.iter().filter(|point| point.arc_m > self.contact_radius_m).count();
        if outside < self.fewest_points() {
            return Err(FitError::TooFew {
                what: "points of the surface outside the contact",
                found: outside,
                needed: self.fewest_points(),
                chains: self.chains,
            });
        }
        let far_m = self.far_m(points);
        let unknowns = self.unknowns(points);
        let defaults: Vec<f64> = unknowns.iter().map(|unknown| unknown.default).collect();
        let weight = points.iter().map(|point| point.weight + point.tangential_weight).sum::<f64>();
        let scatter = BEST_DATA * (weight / points.len() as f64).sqrt();
        // What is left of exact points is the model's error, not scatter: all of it counts.
        let known = if self.exact { f64::INFINITY } else { KNOWN };
        let residuals = |x: &[f64]| self.residuals(points, &self.members(x, far_m));
        let found = determine(&self.starts(points), &defaults, scatter, known, residuals);
        let found = found.ok_or(FitError::NoSolution("surface's shape"))?;
        let mut members = self.members(&found.parameters, far_m);
        members.sort_by(|a, b| a.decay_m.total_cmp(&b.decay_m));
        let mut notes: Vec<String> = Vec::new();
        for what in [DECAY, WEIGHT, EXTENT, ANGLE] {
            let count = found.left_open.iter().filter(|place| unknowns[**place].what == what).count();
            if count > 0 {
                notes.push(format!("{what}: the data do not tell {count} of {}; defaults", self.chains));
            }
        }
        Ok(ShapeFit { members, notes })
    }

    fn residuals(&self, points: &[ShapePoint], members: &[Member]) -> Option<Vec<f64>> {
        let spring = Spring {
            formulation: Formulation::Energy,
            rest_n_per_m: 1.0,
            tangential: 0.0,
            range_m: self.range_m,
        };
        let law = ContactLaw::new(spring.formulation, &fitted::chains(&spring, members)).ok()?;
        let mut shape = ContactShape::new(&law, &self.surface()).ok()?;
        shape.set_depth(&law, self.depth_m).ok()?;
        let mut residuals = Vec::with_capacity(2 * points.len());
        for point in points {
            let moved = shape.displacement(shape.s_m(point.arc_m), point.arc_m);
            residuals.push((-moved.normal_m / self.depth_m - point.normal) * point.weight.sqrt());
            if let Some(tangential) = point.tangential {
                let error = moved.tangential_m / self.depth_m - tangential;
                residuals.push(error * point.tangential_weight.sqrt());
            }
        }
        Some(residuals)
    }

    /// ln decay (P), weights against the last (P - 1), and where they are wanted extents (P) and angles (P).
    fn unknowns(&self, points: &[ShapePoint]) -> Vec<Unknown> {
        let p = self.chains;
        let mut unknowns = Vec::new();
        let mut block = |count: usize, what: &'static str, default: &dyn Fn(usize) -> f64| {
            unknowns.extend((0..count).map(|i| Unknown { default: default(i), what }));
        };
        block(p, DECAY, &|i| decays(0.02, 0.5, p)[i]);
        block(p - 1, WEIGHT, &|_| 0.0);
        if self.ends {
            block(p, EXTENT, &|_| real_of(EXTENTS.0, EXTENTS.1, 0.99 * LONG));
        }
        if self.moves_sideways(points) {
            block(p, ANGLE, &|_| real_of(ANGLES.0, ANGLES.1, ANGLE_RAD));
        }
        unknowns
    }

    fn moves_sideways(&self, points: &[ShapePoint]) -> bool {
        points.iter().any(|point| point.tangential.is_some())
    }

    fn far_m(&self, points: &[ShapePoint]) -> f64 {
        points.iter().map(|point| point.arc_m - self.contact_radius_m).fold(0.0, f64::max)
    }

    /// The members of [`unknowns`](Self::unknowns) with values.
    fn members(&self, x: &[f64], far_m: f64) -> Vec<Member> {
        let p = self.chains;
        let largest = (0..p - 1).map(|i| x[p + i]).fold(0.0, f64::max);
        let extents = self.ends.then_some(2 * p - 1);
        let angles = 2 * p - 1 + if self.ends { p } else { 0 };
        let angles = (x.len() > angles).then_some(angles);
        (0..p)
            .map(|i| {
                let decay_m = far_m * libm::exp(between(SHORT, WIDE, x[i] / STEEPNESS));
                let exponent = if i + 1 < p { x[p + i] } else { 0.0 };
                Member {
                    // A chain of no weight at all would be refused.
                    weight: libm::exp((exponent - largest).max(-20.0)),
                    decay_m,
                    extent_m: self
                        .reach_m
                        .min(decay_m * extents.map_or(LONG, |at| between(EXTENTS.0, EXTENTS.1, x[at + i]))),
                    angle_rad: angles.map_or(ANGLE_RAD, |at| between(ANGLES.0, ANGLES.1, x[at + i])),
                }
            })
            .collect()
    }

    /// Decay lengths spread evenly on a logarithmic scale over several ranges.
    fn starts(&self, points: &[ShapePoint]) -> Vec<Vec<f64>> {
        const RANGES: [(f64, f64); 5] = [(0.02, 0.5), (0.05, 0.2), (0.01, 1.5), (0.003, 0.3), (0.000_2, 1.0)];
        let p = self.chains;
        let start = |(low, high): (f64, f64)| {
            let mut start = decays(low, high, p);
            start.extend(std::iter::repeat_n(0.0, p - 1));
            if self.ends {
                start.extend(std::iter::repeat_n(real_of(EXTENTS.0, EXTENTS.1, 4.0), p));
            }
            if self.moves_sideways(points) {
                start.extend(std::iter::repeat_n(real_of(ANGLES.0, ANGLES.1, 0.3), p));
            }
            start
        };
        RANGES.map(start).to_vec()
    }
}

/// Decay lengths between two shares of the farthest point, evenly on a logarithmic scale.
fn decays(low: f64, high: f64, chains: usize) -> Vec<f64> {
    let along = |i: usize| (i as f64 + 0.5) / chains as f64;
    let logarithm = |i: usize| libm::log(low) + along(i) * libm::log(high / low);
    (0..chains).map(|i| STEEPNESS * real_of(SHORT, WIDE, logarithm(i))).collect()
}
