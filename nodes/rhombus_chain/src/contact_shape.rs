//! The shape of the surface around one contact (MODEL section 4): how far the boundary reaches, and how much of the
//! contact's displacement arrives at an arc length.
//!
//! With `g(s) = (q^(s/h) - q^m) / (1 - q^m)` up to the boundary `s = m h` and 0 beyond, for each chain:
//!
//! ```text
//! normal:      u(s) = DL sum_p w_p g_p(s)
//! tangential:  t(s) = sum_p w_p dw_1p/2 g_p(s) min(1, arc / max(h_p, r_c))       away from the contact when pressed
//! ```

use crate::chain::Chain;
use crate::contact_law::{ContactLaw, NonFinite, elongation_m};
use crate::parameter_error::ParameterError;
use crate::parameters::SurfaceParameters;

/// The field of one contact at its present depth. Made once; afterwards nothing allocates.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactShape {
    contact_radius_m: f64,
    expands: bool,
    chains: Vec<ChainShape>,
    elongation_m: f64,
    /// The largest `m h`, m.
    boundary_m: f64,
    /// The largest `m`.
    boundary_rings: f64,
}

/// How a point of the surface moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Displacement {
    /// Along the outward contact normal, m; negative when pressed.
    pub normal_m: f64,
    /// Away from the contact, m.
    pub tangential_m: f64,
}

/// One chain's part of the field: constants first, then what the present depth decides.
#[derive(Debug, Clone, PartialEq)]
struct ChainShape {
    weight: f64,
    ln_ratio: f64,
    units: f64,
    pitch_m: f64,
    units_per_m: f64,
    /// One over the arc in which the tangential motion rises from its zero at the contact.
    ramp_per_m: f64,
    /// `dl_c` when pressed, negative, m.
    compression_edge_m: f64,
    /// `dl_c` when pulled; `None`: no unit reaches the boundary's turn, only the first one moves.
    extension_edge_m: Option<f64>,

    /// `m`, real-valued.
    boundary_units: f64,
    falloff: Falloff,
    half_dw_m: f64,
}

/// `g`, prepared for one exponential per evaluation without cancellation; `scale` is `1 / (1 - q^m)`.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Falloff {
    /// `edge = q^m`, well below 1.
    Steep { edge: f64, scale: f64 },
    /// `drop = 1 - q^m`, for `q^m` near 1.
    Flat { drop: f64, scale: f64 },
}

impl ContactShape {
    /// The shape of `law`'s chains, at depth 0.
    ///
    /// # Errors
    /// A surface parameter outside its range.
    pub fn new(law: &ContactLaw, surface: &SurfaceParameters) -> Result<Self, ParameterError> {
        surface.check()?;
        let weights: f64 = law.chains().iter().map(|chain| chain.parameters().weight).sum();
        let mut shape = Self {
            contact_radius_m: surface.contact_radius_m,
            expands: surface.expansion > 0.0,
            chains: law.chains().iter().map(|chain| ChainShape::new(chain, surface, weights)).collect(),
            elongation_m: 0.0,
            boundary_m: 0.0,
            boundary_rings: 0.0,
        };
        shape.update(law, 0.0);
        Ok(shape)
    }

    /// Moves the contact to a depth, positive into the body. `law` is the one this shape was made for. RT safe.
    ///
    /// # Errors
    /// A NaN or infinite depth; the shape stays as it was.
    pub fn set_depth(&mut self, law: &ContactLaw, depth_m: f64) -> Result<(), NonFinite> {
        if !depth_m.is_finite() {
            return Err(NonFinite { quantity: "depth_m", value: depth_m });
        }
        self.update(law, elongation_m(depth_m));
        Ok(())
    }

    fn update(&mut self, law: &ContactLaw, elongation_m: f64) {
        self.elongation_m = elongation_m;
        self.boundary_m = 0.0;
        self.boundary_rings = 0.0;
        for (shape, chain) in self.chains.iter_mut().zip(law.chains()) {
            shape.set_elongation(chain, elongation_m);
            self.boundary_m = self.boundary_m.max(shape.boundary_units * shape.pitch_m);
            self.boundary_rings = self.boundary_rings.max(shape.boundary_units);
        }
    }

    /// Share of the contact's displacement that arrives at `s_m`, the arc less the contact radius: 1 at the contact,
    /// falling to 0 at the boundary. RT safe.
    #[inline]
    pub fn share(&self, s_m: f64) -> f64 {
        self.sum(|chain| chain.weight * chain.falloff(s_m * chain.units_per_m), s_m)
    }

    /// `u(s)`, displacement along the outward contact normal, m; exactly `DL` at the contact. RT safe.
    #[inline]
    pub fn normal_m(&self, s_m: f64) -> f64 {
        self.elongation_m * self.share(s_m)
    }

    /// `t(s)`, displacement along the surface, away from the contact when pressed, m. `arc_m` is the whole arc length. RT safe.
    #[inline]
    pub fn tangential_m(&self, s_m: f64, arc_m: f64) -> f64 {
        self.displacement(s_m, arc_m).tangential_m
    }

    /// `u(s)` and `t(s)` at the cost of one. RT safe.
    #[inline]
    pub fn displacement(&self, s_m: f64, arc_m: f64) -> Displacement {
        let (mut share, mut tangential_m) = (0.0, 0.0);
        for chain in &self.chains {
            let weighted = chain.weight * chain.falloff(s_m * chain.units_per_m);
            share += weighted;
            tangential_m += chain.half_dw_m * weighted * (arc_m * chain.ramp_per_m).min(1.0);
        }
        self.displaced(if s_m > 0.0 { share } else { 1.0 }, tangential_m)
    }

    /// `share` for `spread: rings`, where the ring index stands for `s/h` of every chain. RT safe.
    #[inline]
    pub fn share_at_ring(&self, ring: f64) -> f64 {
        self.sum(|chain| chain.weight * chain.falloff(ring), ring)
    }

    /// `displacement` for `spread: rings`. The contact radius plays no part; the tangential motion is zero at the contact
    /// and complete from the first ring on. RT safe.
    #[inline]
    pub fn displacement_at_ring(&self, ring: f64) -> Displacement {
        let (mut share, mut tangential_m) = (0.0, 0.0);
        for chain in &self.chains {
            let weighted = chain.weight * chain.falloff(ring);
            share += weighted;
            tangential_m += chain.half_dw_m * weighted * ring.clamp(0.0, 1.0);
        }
        self.displaced(if ring > 0.0 { share } else { 1.0 }, tangential_m)
    }

    #[inline]
    fn sum(&self, weighted: impl Fn(&ChainShape) -> f64, s: f64) -> f64 {
        // The contact moves by exactly DL, whatever the last digit of the weights' sum.
        if s <= 0.0 { 1.0 } else { self.chains.iter().map(weighted).sum() }
    }

    #[inline]
    fn displaced(&self, share: f64, tangential_m: f64) -> Displacement {
        Displacement { normal_m: self.elongation_m * share, tangential_m }
    }

    /// The expansion's bump `b((s - M)/M)`: 1 in the middle of `M .. 2 M`, 0 outside (MODEL section 4). RT safe.
    #[inline]
    pub fn bump(&self, s_m: f64) -> f64 {
        bump(s_m, self.boundary_m)
    }

    /// `bump` for `spread: rings`. RT safe.
    #[inline]
    pub fn bump_at_ring(&self, ring: f64) -> f64 {
        bump(ring, self.boundary_rings)
    }

    /// `m` of one chain: units up to the boundary, real-valued. 0 when there is no such chain.
    pub fn boundary_units(&self, chain: usize) -> f64 {
        self.chains.get(chain).map_or(0.0, |chain| chain.boundary_units)
    }

    /// `M`, the largest `m h` of the chains: `s` beyond which nothing is displaced by the chains, m.
    pub fn boundary_m(&self) -> f64 {
        self.boundary_m
    }

    /// Arc length from the contact beyond which nothing moves, m: `r_c + M`, or `r_c + 2 M` with expansion.
    pub fn reach_m(&self) -> f64 {
        self.contact_radius_m + if self.expands { 2.0 * self.boundary_m } else { self.boundary_m }
    }

    /// Ring beyond which nothing moves, for `spread: rings`.
    pub fn reach_rings(&self) -> f64 {
        if self.expands { 2.0 * self.boundary_rings } else { self.boundary_rings }
    }

    /// P.
    pub(crate) fn chains(&self) -> usize {
        self.chains.len()
    }

    /// `1 - q^(s/h)` of a chain.
    pub(crate) fn drop(&self, chain: usize, s_m: f64) -> f64 {
        self.chains.get(chain).map_or(0.0, |chain| -libm::expm1(s_m * chain.units_per_m * chain.ln_ratio))
    }

    /// `1 / (1 - q^m)` of a chain at the present depth.
    pub(crate) fn drop_scale(&self, chain: usize) -> f64 {
        self.chains.get(chain).map_or(1.0, |chain| match chain.falloff {
            Falloff::Steep { scale, .. } | Falloff::Flat { scale, .. } => scale,
        })
    }

    /// `1 / max(h, r_c)` of a chain.
    pub(crate) fn ramp_per_m(&self, chain: usize) -> f64 {
        self.chains.get(chain).map_or(1.0, |chain| chain.ramp_per_m)
    }

    /// The largest `n h`, m: no boundary is farther.
    pub(crate) fn longest_chain_m(&self) -> f64 {
        self.chains.iter().map(|chain| chain.units * chain.pitch_m).fold(0.0, f64::max)
    }

    /// The smallest length in which a chain's shape falls to 1/e, or the shortest unit, m: nothing changes faster.
    pub(crate) fn finest_m(&self) -> f64 {
        let lengths = self.chains.iter().map(|chain| chain.pitch_m.min(-chain.pitch_m / chain.ln_ratio));
        lengths.fold(f64::INFINITY, f64::min)
    }

    /// One over the largest `max(h, r_c)` of the chains.
    pub(crate) fn widest_ramp_per_m(&self) -> f64 {
        self.chains.iter().map(|chain| chain.ramp_per_m).fold(f64::INFINITY, f64::min)
    }

    /// `r_c`, m.
    pub(crate) fn contact_radius_m(&self) -> f64 {
        self.contact_radius_m
    }

    /// `s = max(arc - r_c, 0)`, m.
    #[inline]
    pub fn s_m(&self, arc_m: f64) -> f64 {
        (arc_m - self.contact_radius_m).max(0.0)
    }
}

impl ChainShape {
    fn new(chain: &Chain, surface: &SurfaceParameters, weights: f64) -> Self {
        let parameters = chain.parameters();
        let ln_ratio = libm::log(parameters.ratio);
        let (angle, cutoff) = (parameters.angle_rad, surface.cutoff);
        // sin(theta + d) - sin(theta) = 2 cos(theta + d/2) sin(d/2)
        let edge_m = |turn_rad: f64| {
            4.0 * parameters.rod_length_m * libm::cos(angle + 0.5 * turn_rad) * libm::sin(0.5 * turn_rad)
        };
        let reachable = angle * (1.0 + cutoff) < std::f64::consts::FRAC_PI_2;
        Self {
            weight: parameters.weight / weights,
            ln_ratio,
            units: f64::from(parameters.units),
            pitch_m: parameters.pitch_m,
            units_per_m: 1.0 / parameters.pitch_m,
            ramp_per_m: 1.0 / parameters.pitch_m.max(surface.contact_radius_m),
            compression_edge_m: edge_m(-angle * cutoff),
            extension_edge_m: reachable.then(|| edge_m(angle * cutoff)),
            boundary_units: 1.0,
            falloff: Falloff::new(ln_ratio),
            half_dw_m: 0.0,
        }
    }

    fn set_elongation(&mut self, chain: &Chain, elongation_m: f64) {
        let kinematics = chain.kinematics(elongation_m);
        self.half_dw_m = 0.5 * kinematics.dw_1_m;
        self.boundary_units = self.boundary(kinematics.dl_1_m);
        self.falloff = Falloff::new(self.boundary_units * self.ln_ratio);
    }

    /// `m = clamp(1 + ln(dl_c/dl_1)/ln q, 1, n)`, with `dl_1 = DL/S_n` past a guard too. Where `dl_c` lies beyond a guard, the
    /// clamp leaves `m` at 1 up to it.
    fn boundary(&self, dl_1_m: f64) -> f64 {
        let edge_m = if dl_1_m > 0.0 { self.extension_edge_m } else { Some(self.compression_edge_m) };
        match edge_m {
            Some(0.0) => self.units, // cutoff = 0: every unit that turns at all is moved
            None => 1.0,
            Some(_) if dl_1_m == 0.0 => 1.0,
            Some(edge_m) => (1.0 + libm::log(edge_m / dl_1_m) / self.ln_ratio).clamp(1.0, self.units),
        }
    }

    /// `g` at `s/h` units from the contact.
    #[inline]
    fn falloff(&self, units: f64) -> f64 {
        if units <= 0.0 {
            return 1.0;
        }
        if units >= self.boundary_units {
            return 0.0;
        }
        let exponent = units * self.ln_ratio;
        let share = match self.falloff {
            Falloff::Steep { edge, scale } => (libm::exp(exponent) - edge) * scale,
            Falloff::Flat { drop, scale } => (libm::expm1(exponent) + drop) * scale,
        };
        share.max(0.0)
    }
}

impl Falloff {
    /// `exponent = m ln q`.
    fn new(exponent: f64) -> Self {
        const FLAT_ABOVE: f64 = -0.5;
        let drop = -libm::expm1(exponent);
        let scale = 1.0 / drop;
        if exponent > FLAT_ABOVE {
            Self::Flat { drop, scale }
        } else {
            Self::Steep { edge: libm::exp(exponent), scale }
        }
    }
}

/// `b((s - M)/M)`, `b(y) = 16 y^2 (1 - y)^2` on `0 < y < 1`.
#[inline]
fn bump(s: f64, boundary: f64) -> f64 {
    let y = (s - boundary) / boundary;
    if y > 0.0 && y < 1.0 {
        let product = y * (1.0 - y);
        16.0 * product * product
    } else {
        0.0
    }
}
