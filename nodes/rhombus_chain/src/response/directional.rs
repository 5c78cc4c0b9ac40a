//! The field of one contact on a calibrated body.
//!
//! In single precision, eight vertices at a time: the compiler then works on several at once. Each vertex is worked out by
//! itself, so the bits do not depend on how many that are.

use glam::DVec3;

use crate::contact_shape::ContactShape;
use crate::interaction::Impression;
use crate::mesh::SurfaceMesh;

use super::arc_table::ArcTable;
use super::profiles::Profiles;
use super::{MOST_CHAINS, MOST_HARMONICS, Response, tangent_frame};

/// Vertices worked out together.
const LANES: usize = 8;
/// Sums over the chains: one for each coefficient of a chain.
const SUMS: usize = 2 + 6 * MOST_HARMONICS;
/// As in `surface_field`: where "away" loses its meaning.
const AWAY_FADES_BELOW: f32 = 0.2;

type Lanes = [f32; LANES];

/// One vertex of the field.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovedVertex {
    pub(crate) vertex: u32,
    /// Arc less the contact radius, m.
    pub(crate) s_m: f64,
    /// For each metre of elongation.
    pub(crate) displacement: DVec3,
    /// Share of the contact's motion that arrives here whatever the direction.
    pub(crate) share: f64,
}

/// What a calibrated field needs besides the response: made once for a body and a tissue.
#[derive(Clone, Debug)]
pub(crate) struct DirectionalField {
    arcs: ArcTable,
    profiles: Profiles,
    contact_radius_m: f32,
    /// x, y and z of the vertices, each padded to whole lanes.
    positions: [Vec<f32>; 3],
    /// At the contact.
    coefficients: Vec<f32>,
    amplitudes: Vec<f32>,
    /// x, y and z of `sum_j z_j Phi_j`, interleaved.
    modes: Vec<f32>,
}

impl DirectionalField {
    pub(crate) fn new(mesh: &SurfaceMesh, response: &Response, shape: &ContactShape) -> Self {
        let vertices = mesh.vertices().len();
        let padded = vertices.next_multiple_of(LANES);
        let axis = |axis: usize| {
            let mut all: Vec<f32> = mesh.vertices().iter().map(|vertex| vertex[axis] as f32).collect();
            all.resize(padded, 0.0);
            all
        };
        let parts = response.parts();
        let arcs = ArcTable::new(mesh);
        Self {
            profiles: Profiles::new(shape, arcs.longest_m()),
            arcs,
            contact_radius_m: shape.contact_radius_m() as f32,
            positions: [axis(0), axis(1), axis(2)],
            coefficients: vec![0.0; parts.chains * parts.coefficients_per_chain()],
            amplitudes: vec![0.0; parts.modes],
            modes: vec![0.0; if parts.modes > 0 { 3 * padded } else { 0 }],
        }
    }

    /// Takes over other chains or another contact radius.
    pub(crate) fn retune(&mut self, shape: &ContactShape) {
        self.profiles = Profiles::new(shape, self.arcs.longest_m());
        self.contact_radius_m = shape.contact_radius_m() as f32;
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        let numbers = self.positions.iter().chain([&self.coefficients, &self.amplitudes, &self.modes]);
        self.arcs.memory_bytes()
            + self.profiles.memory_bytes()
            + numbers.map(|n| size_of_val(n.as_slice())).sum::<usize>()
    }

    /// Gives every vertex that `impression` moves to `take`, in ascending order. `shape` is at its depth. Real-time safe.
    pub(crate) fn solve(
        &mut self,
        mesh: &SurfaceMesh,
        response: &Response,
        shape: &ContactShape,
        impression: &Impression,
        take: impl FnMut(MovedVertex),
    ) {
        response.at(mesh, impression.at, impression.normal, &mut self.coefficients, &mut self.amplitudes);
        self.profiles.set_depth(shape);
        self.add_modes(response);
        match response.harmonics() {
            0 => self.walk::<0>(mesh, shape, impression, take),
            1 => self.walk::<1>(mesh, shape, impression, take),
            _ => self.walk::<2>(mesh, shape, impression, take),
        }
    }

    fn add_modes(&mut self, response: &Response) {
        self.modes.fill(0.0);
        let fields = response.parts().mode_fields.chunks_exact(3 * response.vertices.max(1));
        for (z, field) in self.amplitudes.iter().zip(fields) {
            for (sum, phi) in self.modes.iter_mut().zip(field) {
                *sum += z * phi;
            }
        }
    }

    fn walk<const H: usize>(
        &mut self,
        mesh: &SurfaceMesh,
        shape: &ContactShape,
        impression: &Impression,
        mut take: impl FnMut(MovedVertex),
    ) {
        let reach_m = shape.reach_m();
        self.arcs.solve(mesh, impression.at, reach_m);
        let reach = reach_m as f32;
        let contact = Contact::new(impression);
        let has_modes = !self.amplitudes.is_empty();
        for (chunk, arcs) in self.arcs.lengths_m().chunks(LANES).enumerate() {
            if !has_modes && arcs.iter().all(|arc| *arc >= reach) {
                continue;
            }
            let begin = chunk * LANES;
            let mut arc = [f32::MAX; LANES];
            arc[..arcs.len()].copy_from_slice(arcs);
            let at = |axis: usize| -> Lanes {
                let lanes = self.positions[axis].get(begin..begin + LANES).unwrap_or_default();
                lanes.try_into().unwrap_or([0.0; LANES])
            };
            let s: Lanes = arc.map(|arc| (arc - self.contact_radius_m).max(0.0));
            let (sums, rise) = self.sums::<H>(&arc, &s);
            let [x, y, z] = contact.displacements::<H>([at(0), at(1), at(2)], &sums);
            for lane in 0..arcs.len() {
                if !has_modes && arc[lane] >= reach {
                    continue;
                }
                let vertex = begin + lane;
                let mut displacement = DVec3::new(f64::from(x[lane]), f64::from(y[lane]), f64::from(z[lane]));
                if let Some([x, y, z]) = self.modes.get(3 * vertex..).and_then(|modes| modes.first_chunk()) {
                    let mode = DVec3::new(f64::from(*x), f64::from(*y), f64::from(*z));
                    displacement += mode * f64::from(rise[lane]);
                }
                let share = f64::from(sums[0][lane]);
                take(MovedVertex { vertex: vertex as u32, s_m: f64::from(s[lane]), displacement, share });
            }
        }
    }

    /// `sum_p g_p a_p0` and `sum_p g_p w_p` times each other coefficient; and `w` of the chain with the widest ramp.
    #[inline(always)]
    fn sums<const H: usize>(&self, arc: &Lanes, s: &Lanes) -> ([Lanes; SUMS], Lanes) {
        let per_chain = 2 + 6 * H;
        let mut shapes = [[0.0; LANES]; MOST_CHAINS];
        for lane in 0..LANES {
            let mut here = [0.0; MOST_CHAINS];
            self.profiles.at(s[lane], &mut here);
            for (shape, here) in shapes.iter_mut().zip(here) {
                shape[lane] = here;
            }
        }
        let mut sums = [[0.0; LANES]; SUMS];
        let mut rise = [1.0; LANES];
        let chains = self.coefficients.chunks_exact(per_chain);
        for ((shape, ramp), coefficients) in shapes.iter().zip(&self.profiles.ramps_per_m).zip(chains) {
            let mut directed = [0.0; LANES];
            for lane in 0..LANES {
                let w = (arc[lane] * ramp).min(1.0);
                rise[lane] = w.min(rise[lane]);
                directed[lane] = shape[lane] * w;
                sums[0][lane] += shape[lane] * coefficients[0];
            }
            for (sum, coefficient) in sums.iter_mut().zip(coefficients).skip(1) {
                for lane in 0..LANES {
                    sum[lane] += directed[lane] * coefficient;
                }
            }
        }
        for lane in 0..LANES {
            // The contact moves by exactly DL, whatever the last digit of the shares' sum.
            sums[0][lane] = if s[lane] > 0.0 { sums[0][lane] } else { 1.0 };
        }
        (sums, rise)
    }
}

/// Where a contact is, in single precision.
struct Contact {
    position: [f32; 3],
    normal: [f32; 3],
    first: [f32; 3],
    second: [f32; 3],
}

impl Contact {
    fn new(impression: &Impression) -> Self {
        let [first, second] = tangent_frame(impression.normal);
        let single = |vector: DVec3| vector.as_vec3().to_array();
        Self {
            position: single(impression.position),
            normal: single(impression.normal),
            first: single(first),
            second: single(second),
        }
    }

    /// x, y and z of the displacement for each metre of elongation, without modes.
    #[inline(always)]
    fn displacements<const H: usize>(&self, at: [Lanes; 3], sums: &[Lanes; SUMS]) -> [Lanes; 3] {
        let n = &self.normal;
        let mut moved = [[0.0; LANES]; 3];
        for lane in 0..LANES {
            let offset = [0, 1, 2].map(|axis| at[axis][lane] - self.position[axis]);
            let height = dot(&offset, n);
            let in_plane = [0, 1, 2].map(|axis| offset[axis] - n[axis] * height);
            let scale = dot(&in_plane, &in_plane).sqrt().max(AWAY_FADES_BELOW * dot(&offset, &offset).sqrt());
            let inverse = if scale > 0.0 { 1.0 / scale } else { 0.0 };
            let away = in_plane.map(|part| part * inverse);
            let around = [
                n[1] * away[2] - n[2] * away[1],
                n[2] * away[0] - n[0] * away[2],
                n[0] * away[1] - n[1] * away[0],
            ];
            let (cosine, sine) = (dot(&away, &self.first), dot(&away, &self.second));
            let waves = [cosine, sine, cosine * cosine - sine * sine, 2.0 * cosine * sine];
            let series = |begin: usize| -> f32 {
                waves.iter().take(2 * H).enumerate().map(|(k, wave)| wave * sums[begin + k][lane]).sum()
            };
            let along_normal = sums[0][lane] + series(1);
            let along_away = sums[1 + 2 * H][lane] + series(2 + 2 * H);
            let along_around = series(2 + 4 * H);
            for axis in 0..3 {
                moved[axis][lane] =
                    n[axis] * along_normal + away[axis] * along_away + around[axis] * along_around;
            }
        }
        moved
    }
}

#[inline(always)]
fn dot(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
