//! The field of one contact on a calibrated body.

use glam::{DVec3, Mat4, Vec4};

use crate::contact_law::elongation_m;
use crate::contact_shape::ContactShape;
use crate::interaction::Impression;
use crate::mesh::SurfaceMesh;

use super::Response;
use super::arc_table::ArcTable;
use super::contact_frame::ContactFrame;
use super::lanes::{ALL, Axes, BLOCK, HALVES, LANES, in_blocks};
use super::modes::Modes;
use super::moved::Moved;
use super::profiles::Profiles;

/// Contact radius below which there is none, m.
const NO_RADIUS_M: f64 = 1e-9;

/// Blocks whose places are worked out before their displacements: a processor looks ahead only so far, and roots take long.
const STRIP: usize = 4;

/// What a calibrated field needs besides the response: made once for a body and a tissue.
#[derive(Clone, Debug)]
pub(crate) struct DirectionalField {
    arcs: ArcTable,
    profiles: Profiles,
    modes: Modes,
    positions: Vec<[Axes; HALVES]>,
    contact_radius_m: f32,
    /// One over the contact radius.
    rise_per_m: f32,
    /// One over the widest ramp `max(h_p, r_c)`.
    mode_rise_per_m: f32,
    /// At the contact.
    coefficients: Vec<f32>,
    amplitudes: Vec<f32>,
}

/// One press, as the vertices need it.
struct Press {
    frame: ContactFrame,
    elongation_m: f64,
    lateral_m: DVec3,
    /// Arc from which on nothing moves; `M`; one over the last stretch before it.
    reach_m: f32,
    boundary_m: f32,
    closing_per_m: f32,
}

/// Where four vertices lie, seen from the contact.
#[derive(Clone, Copy, Default)]
struct Place {
    arc_m: Vec4,
    s_m: Vec4,
    /// `min(1, arc / r_c)`.
    rise: Vec4,
    cosine: Vec4,
    sine: Vec4,
    /// cos, sin, cos 2 phi and sin 2 phi, times the rise.
    waves: [[f32; LANES]; 4],
    /// In the table of the chains.
    nodes: [u32; LANES],
    parts: [f32; LANES],
}

impl DirectionalField {
    pub(crate) fn new(mesh: &SurfaceMesh, response: &Response, shape: &ContactShape) -> Self {
        let parts = response.parts();
        let arcs = ArcTable::new(mesh);
        let positions = mesh.vertices().iter().map(|vertex| vertex.as_vec3().to_array());
        Self {
            profiles: Profiles::new(shape, arcs.longest_m()),
            arcs,
            modes: Modes::new(response),
            positions: in_blocks(positions),
            contact_radius_m: shape.contact_radius_m() as f32,
            rise_per_m: rise_per_m(shape),
            mode_rise_per_m: shape.widest_ramp_per_m() as f32,
            coefficients: vec![0.0; parts.chains * parts.coefficients_per_chain()],
            amplitudes: vec![0.0; parts.modes],
        }
    }

    /// Takes over other chains or another contact radius.
    pub(crate) fn retune(&mut self, shape: &ContactShape) {
        self.profiles = Profiles::new(shape, self.arcs.longest_m());
        self.contact_radius_m = shape.contact_radius_m() as f32;
        self.rise_per_m = rise_per_m(shape);
        self.mode_rise_per_m = shape.widest_ramp_per_m() as f32;
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        let numbers = [&self.coefficients, &self.amplitudes].map(|n| size_of_val(n.as_slice()));
        self.arcs.memory_bytes()
            + self.profiles.memory_bytes()
            + self.modes.memory_bytes()
            + size_of_val(self.positions.as_slice())
            + numbers.iter().sum::<usize>()
    }

    /// Writes every vertex that `impression` moves, ascending, and its displacement, m, in the place of what was there. `shape` is
    /// at its depth. Real-time safe with room for all vertices.
    pub(crate) fn solve(
        &mut self,
        mesh: &SurfaceMesh,
        response: &Response,
        shape: &ContactShape,
        impression: &Impression,
        vertices: &mut Vec<u32>,
        displacements: &mut Vec<DVec3>,
    ) {
        response.at(mesh, impression.at, impression.normal, &mut self.coefficients, &mut self.amplitudes);
        self.arcs.solve(mesh, impression.at, shape.reach_m());
        let boundary_m = shape.boundary_m() as f32;
        let press = Press {
            frame: ContactFrame::new(impression),
            elongation_m: elongation_m(impression.depth_m),
            lateral_m: impression.lateral_m,
            reach_m: shape.reach_m() as f32,
            boundary_m,
            closing_per_m: 1.0 / self.profiles.grid.step_m(boundary_m),
        };
        match response.harmonics() {
            0 => self.walk::<1>(shape, &press, vertices, displacements),
            1 => self.walk::<3>(shape, &press, vertices, displacements),
            _ => self.walk::<5>(shape, &press, vertices, displacements),
        }
    }

    /// `s` of a vertex at the last contact, m.
    pub(crate) fn s_m(&self, vertex: u32) -> f64 {
        f64::from((self.arcs.arc_m(vertex) - self.contact_radius_m).max(0.0))
    }

    fn walk<const WAVES: usize>(
        &mut self,
        shape: &ContactShape,
        press: &Press,
        vertices: &mut Vec<u32>,
        displacements: &mut Vec<DVec3>,
    ) {
        self.profiles.fill::<WAVES>(shape, &self.coefficients);
        let all = self.arcs.vertices();
        // What is there already is overwritten.
        vertices.resize(all, 0);
        displacements.resize(all, DVec3::ZERO);
        let mut moved = Moved { vertices, displacements, count: 0 };
        for (strip, at) in self.positions.chunks(STRIP).enumerate() {
            let mut places = [[Place::default(); HALVES]; STRIP];
            for (block, (places, at)) in places.iter_mut().zip(at).enumerate() {
                let arcs_m = self.arcs.block(strip * STRIP + block);
                for half in 0..HALVES {
                    places[half] = self.place(press, arcs_m[half], &at[half]);
                }
            }
            for (block, places) in places.iter().enumerate().take(at.len()) {
                let block = strip * STRIP + block;
                let modes = self.modes.at(block, &self.amplitudes);
                for half in 0..HALVES {
                    let begin = block * BLOCK + half * LANES;
                    self.move_four::<WAVES>(press, begin, &places[half], &modes[half], &mut moved);
                }
            }
        }
        let count = moved.count;
        vertices.truncate(count);
        displacements.truncate(count);
    }

    /// Moves those of the four vertices from `begin` on that move.
    #[inline(always)]
    fn move_four<const WAVES: usize>(
        &self,
        press: &Press,
        begin: usize,
        place: &Place,
        modes: &Axes,
        moved: &mut Moved<'_>,
    ) {
        let has_modes = !self.amplitudes.is_empty();
        let within = place.arc_m.cmplt(Vec4::splat(press.reach_m)).bitmask();
        let moving = if has_modes { ALL } else { within };
        if moving == 0 {
            return;
        }
        let [mut x, mut y, mut z] = self.chains::<WAVES>(press, place);
        if has_modes {
            let rise = (place.arc_m * self.mode_rise_per_m).min(Vec4::ONE);
            x += modes[0] * rise;
            y += modes[1] * rise;
            z += modes[2] * rise;
        }
        let first = moved.count;
        moved.push_four(begin, moving, [x.to_array(), y.to_array(), z.to_array()], press.elongation_m);
        if press.lateral_m != DVec3::ZERO {
            for k in first..moved.count {
                let share = self.share(press, place.arc_m[moved.vertices[k] as usize % LANES]);
                moved.displacements[k] += press.lateral_m * share;
            }
        }
    }

    /// Where four vertices lie.
    #[inline(always)]
    fn place(&self, press: &Press, arc_m: Vec4, at: &Axes) -> Place {
        let s_m = (arc_m - Vec4::splat(self.contact_radius_m)).max(Vec4::ZERO);
        // What has a direction rises from its zero at the contact in proportion to the arc, up to what the table has for s = 0.
        let rise = (arc_m * self.rise_per_m).min(Vec4::ONE);
        let [cosine, sine] = press.frame.direction(at);
        let (risen_cosine, risen_sine) = (cosine * rise, sine * rise);
        let waves = [
            risen_cosine.to_array(),
            risen_sine.to_array(),
            (risen_cosine * cosine - risen_sine * sine).to_array(),
            (2.0 * risen_cosine * sine).to_array(),
        ];
        let (nodes, parts) = self.profiles.grid.places(s_m);
        Place { arc_m, s_m, rise, cosine, sine, waves, nodes, parts: parts.to_array() }
    }

    /// What the chains do at four vertices for each metre of elongation.
    #[inline(always)]
    fn chains<const WAVES: usize>(&self, press: &Press, place: &Place) -> Axes {
        let Place { s_m, rise, cosine, sine, waves, nodes, parts, .. } = *place;
        let mut sums = [Vec4::ZERO; LANES];
        for lane in 0..LANES {
            let waves = [waves[0][lane], waves[1][lane], waves[2][lane], waves[3][lane]];
            sums[lane] = self.profiles.at::<WAVES>(nodes[lane], parts[lane], waves);
        }
        let sums = Mat4::from_cols(sums[0], sums[1], sums[2], sums[3]).transpose();
        let closing = self.closing(press, s_m);
        let normal = sums.x_axis * closing;
        let away = (sums.y_axis + sums.w_axis * rise) * closing;
        let around = sums.z_axis * closing;
        press.frame.in_body(normal, away * cosine - around * sine, away * sine + around * cosine)
    }

    /// 1, falling to 0 in the last step of the table before the boundary, which is no node.
    #[inline(always)]
    fn closing(&self, press: &Press, s_m: Vec4) -> Vec4 {
        ((Vec4::splat(press.boundary_m) - s_m) * press.closing_per_m).clamp(Vec4::ZERO, Vec4::ONE)
    }

    /// Share of the contact's motion that arrives at an arc whatever the direction.
    fn share(&self, press: &Press, arc_m: f32) -> f64 {
        let s_m = (arc_m - self.contact_radius_m).max(0.0);
        let (nodes, parts) = self.profiles.grid.places(Vec4::splat(s_m));
        let share = self.profiles.at::<1>(nodes[0], parts.x, [0.0; 4]).x;
        f64::from(share * self.closing(press, Vec4::splat(s_m)).x)
    }
}

fn rise_per_m(shape: &ContactShape) -> f32 {
    (1.0 / shape.contact_radius_m().max(NO_RADIUS_M)) as f32
}
