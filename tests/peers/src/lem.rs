//! LEM, the long elements method: the body as a fluid, crossed by elastic rods and held together by a skin.
//!
//! I. F. Costa and R. Balaniuk, "LEM - an approach for real time physically based soft tissue simulation", Proc. IEEE ICRA
//! 2001, 2337-2343; also R. Balaniuk and I. F. Costa, US patent 2003/0088389. Their long elements are straight, parallel,
//! massless springs from a point that is held to a point of the surface; a static equation for each (Hooke's law with
//! stress E x/L, the fluid's pressure change equal everywhere by Pascal's principle, surface tension between
//! neighbours) and the conservation of volume are one linear system, with rigid contacts as given elongations; see
//! [`layer`], where the equations are.
//!
//! Ours, where they leave it open:
//! - the elements run along the contact's normal, one on each point of a square lattice through the site whose pitch
//!   is the mean edge of the surface; the end towards the contact is the one that moves, the far end is held. So the system is
//!   built and solved whenever the contact moves, and a query scales its answer (the equations are linear);
//! - an element whose moving end lies in a triangle with three held corners does not move;
//! - neighbours are linked where their pieces overlap, with one tension tau for the whole body. The method ties it to no
//!   elastic constant; we choose it so that one ideal site has the stiffness 2 E a/(1 - nu^2) of a flat punch on an elastic
//!   half-space (a no smaller than the radius of one element): a flat layer of elements of this pitch and of the body's mean
//!   chord 4 V/S (Cauchy), touched by this contact, its fluid too large to change pressure. If the rods alone are
//!   stiffer than that, tau = 0;
//! - gravity is left out. A surface vertex moves with its element (linear between the four around it) when it faces the
//!   contact and with nothing otherwise. Poisson's ratio enters through tau only: the fluid is incompressible.

mod columns;
mod layer;

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

pub(crate) use columns::Lattice;
use layer::{End, Fluid, Layer};

use crate::{Job, Peer, PeerKind, SetupError, patch};

/// Half width of the ideal layer on which the tension is chosen, in pitches beyond the contact.
const IDEAL_MARGIN: u32 = 24;

/// In the list of all peers.
pub(crate) const KIND: PeerKind = PeerKind {
    name: "LEM",
    citation: "Costa and Balaniuk, LEM - an approach for real time physically based soft tissue \
    simulation, IEEE ICRA 2001",
    setup: |job| Ok(Box::new(Lem::new(job)?)),
};

/// Long elements along the contact's normal.
pub struct Lem {
    surface: SurfaceMesh,
    fixed: Vec<bool>,
    contact_radius_m: f64,
    young_pa: f64,
    pitch_m: f64,
    tension_n_per_m: f64,
    /// Displacement of each surface vertex for each metre of depth.
    per_depth: Vec<DVec3>,
    stiffness_n_per_m: f64,
    pressure_pa_per_m: f64,
    elements: usize,
}

/// Mean length of the surface's edges, m.
pub(crate) fn mean_edge_m(surface: &SurfaceMesh) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for triangle in surface.triangles() {
        let [a, b, c] = triangle.map(|vertex| surface.vertices()[vertex as usize]);
        sum += a.distance(b) + b.distance(c) + c.distance(a);
        count += 3.0;
    }
    sum / count
}

/// What one long element takes: its equation, its links and the vectors of conjugate gradients.
const ELEMENT_BYTES: u64 = 192;

impl Lem {
    /// Chooses the pitch and the tension.
    ///
    /// # Errors
    /// An unusable job, or one that does not fit.
    pub fn new(job: &Job) -> Result<Self, SetupError> {
        job.check()?;
        let pitch_m = mean_edge_m(job.surface);
        let vertices = job.surface.vertices().len() as u64;
        let [low, high] = job.surface.extents();
        let across = (high - low).length() / pitch_m + 2.0;
        // Lines through the whole shadow, most with one element.
        let lines = (across * across) as u64;
        job.reserve(lines * ELEMENT_BYTES + vertices * 128 + job.surface.memory_bytes() as u64)?;
        let area: f64 = job.surface.vertex_areas().iter().sum();
        let chord_m = 4.0 * job.surface.volume_m3() / area;
        let mut lem = Self {
            surface: job.surface.clone(),
            fixed: job.fixed.to_vec(),
            contact_radius_m: job.contact_radius_m,
            young_pa: job.material.young_pa,
            pitch_m,
            tension_n_per_m: 0.0,
            per_depth: vec![DVec3::ZERO; job.surface.vertices().len()],
            stiffness_n_per_m: 0.0,
            pressure_pa_per_m: 0.0,
            elements: 0,
        };
        let radius_m = job.contact_radius_m.max(pitch_m / std::f64::consts::PI.sqrt());
        let nu = job.material.poisson;
        lem.tension_n_per_m = lem.tension_for(2.0 * lem.young_pa * radius_m / (1.0 - nu * nu), chord_m);
        Ok(lem)
    }

    /// Surface tension of the skin, N/m.
    #[must_use]
    pub fn tension_n_per_m(&self) -> f64 {
        self.tension_n_per_m
    }

    /// How much the fluid's pressure rises for each metre of depth at the present contact, Pa/m.
    #[must_use]
    pub fn pressure_pa_per_m(&self) -> f64 {
        self.pressure_pa_per_m
    }

    /// The tension with which an ideal layer of elements of length `chord_m` has a contact stiffness.
    fn tension_for(&self, stiffness_n_per_m: f64, chord_m: f64) -> f64 {
        let mut ideal = self.ideal_layer(chord_m);
        let mut at = |tension: f64| {
            ideal.tension_n_per_m = tension;
            ideal.solve(1.0, 0.0, Fluid::Open).force_n / stiffness_n_per_m
        };
        if at(0.0) >= 1.0 {
            return 0.0;
        }
        let mut high = stiffness_n_per_m;
        while at(high) < 1.0 {
            high *= 2.0;
        }
        let mut low = 0.0;
        // Stiffness rises with tension; 40 halvings leave 1e-12.
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if at(middle) < 1.0 { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// A flat square of elements of one length, touched in its middle.
    fn ideal_layer(&self, length_m: f64) -> Layer {
        let radius = self.contact_radius_m / self.pitch_m;
        let half = radius.ceil() as u32 + IDEAL_MARGIN;
        let side = 2 * half + 1;
        let mut layer = Layer { area_m2: self.pitch_m * self.pitch_m, ..Layer::default() };
        for cell in 0..side * side {
            let [i, j] = [cell % side, cell / side];
            let inside = |on: bool, to: u32| on.then_some(to);
            let links = [
                inside(i > 0, cell.wrapping_sub(1)),
                inside(i + 1 < side, cell + 1),
                inside(j > 0, cell.wrapping_sub(side)),
                inside(j + 1 < side, cell + side),
            ];
            layer.links.push(links.into_iter().flatten().collect());
            let [x, y] = [i, j].map(|k| f64::from(k) - f64::from(half));
            let touched = x.hypot(y) <= radius * (1.0 + 1e-9);
            layer.ends.push(if touched { End::Contact } else { End::Free });
            layer.stiffness_pa_per_m.push(self.young_pa / length_m);
        }
        layer
    }

    /// The elements along `normal` through the site, and for each line the numbers and heights of its moving ends.
    fn elements(&self, site: DVec3, normal: DVec3) -> (Lattice, Layer, Vec<Vec<(u32, f64)>>) {
        let lattice = Lattice::around(&self.surface, site, normal, self.pitch_m);
        let pieces = lattice.pieces(&self.surface);
        let mut layer = Layer {
            area_m2: self.pitch_m * self.pitch_m,
            tension_n_per_m: self.tension_n_per_m,
            ..Layer::default()
        };
        let (site_cell, _) = lattice.local(site);
        let mut tops = Vec::with_capacity(pieces.len());
        let mut first = vec![0usize; pieces.len()];
        for (line, on_line) in pieces.iter().enumerate() {
            first[line] = layer.ends.len();
            let mut ends = Vec::with_capacity(on_line.len());
            let cell = glam::DVec2::new((line % lattice.size[0]) as f64, (line / lattice.size[0]) as f64);
            let aside_m = cell.distance(site_cell) * self.pitch_m;
            for piece in on_line {
                let [from, to] = piece.from_to_m;
                let reach = self.contact_radius_m.max(0.5 * self.pitch_m);
                let touched = aside_m <= self.contact_radius_m * (1.0 + 1e-9) + 1e-9 * self.pitch_m
                    && to.abs() <= reach;
                let corners = self.surface.triangles()[piece.end_face as usize];
                let held = corners.iter().all(|&vertex| self.fixed[vertex as usize]);
                ends.push((layer.ends.len() as u32, to));
                layer.ends.push(match (touched, held) {
                    (_, true) => End::Held,
                    (true, false) => End::Contact,
                    (false, false) => End::Free,
                });
                layer.stiffness_pa_per_m.push(self.young_pa / (to - from));
                layer.links.push(Vec::new());
            }
            tops.push(ends);
        }
        let [columns, rows] = lattice.size;
        for line in 0..columns * rows {
            let right = (line % columns + 1 < columns).then_some(line + 1);
            let above = (line / columns + 1 < rows).then_some(line + columns);
            for other in [right, above].into_iter().flatten() {
                for (a, one) in pieces[line].iter().enumerate() {
                    for (b, two) in pieces[other].iter().enumerate() {
                        let overlap =
                            one.from_to_m[0] < two.from_to_m[1] && two.from_to_m[0] < one.from_to_m[1];
                        if overlap {
                            let (a, b) = (first[line] + a, first[other] + b);
                            layer.links[a].push(b as u32);
                            layer.links[b].push(a as u32);
                        }
                    }
                }
            }
        }
        (lattice, layer, tops)
    }
}

impl Peer for Lem {
    fn name(&self) -> &'static str {
        KIND.name
    }

    fn bytes(&self) -> u64 {
        let own = size_of_val(self.per_depth.as_slice()) + self.fixed.len() + self.surface.memory_bytes();
        own as u64 + self.elements as u64 * ELEMENT_BYTES
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        let Some(&site) = self.surface.vertices().get(vertex as usize) else {
            return;
        };
        let (lattice, layer, tops) = self.elements(site, normal);
        let rest = layer.solve(1.0, 0.0, Fluid::Confined);
        self.elements = layer.ends.len();
        self.stiffness_n_per_m = rest.force_n;
        self.pressure_pa_per_m = rest.pressure_pa;
        for (number, to) in self.per_depth.iter_mut().enumerate() {
            let (at, own) = (self.surface.vertices()[number], self.surface.vertex_normals()[number]);
            let moves = own.dot(normal) > 0.0 && !self.fixed[number];
            *to = if moves { normal * follow(&lattice, &tops, &rest.elongation_m, at) } else { DVec3::ZERO };
        }
        for touched in patch(&self.surface, vertex, normal, self.contact_radius_m) {
            if !self.fixed[touched as usize] {
                self.per_depth[touched as usize] = -normal;
            }
        }
    }

    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        for (to, &unit) in displacements.iter_mut().zip(&self.per_depth) {
            *to = unit * depth_m;
        }
        self.stiffness_n_per_m * depth_m
    }
}

/// Elongation at a surface point: bilinear between the elements of the four lines around it that end nearest to it.
fn follow(lattice: &Lattice, tops: &[Vec<(u32, f64)>], elongation_m: &[f64], at: DVec3) -> f64 {
    let (cell, height) = lattice.local(at);
    let corner = cell.floor();
    let share = cell - corner;
    let (mut sum, mut weights) = (0.0, 0.0);
    for (i, j) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let (x, y) = (corner.x + i, corner.y + j);
        let inside = x >= 0.0 && y >= 0.0 && (x as usize) < lattice.size[0] && (y as usize) < lattice.size[1];
        if !inside {
            continue;
        }
        let line = &tops[y as usize * lattice.size[0] + x as usize];
        let nearest = line.iter().min_by(|a, b| (a.1 - height).abs().total_cmp(&(b.1 - height).abs()));
        if let Some(&(element, _)) = nearest {
            let weight = (1.0 - (share.x - i).abs()) * (1.0 - (share.y - j).abs());
            sum += weight * elongation_m[element as usize];
            weights += weight;
        }
    }
    if weights > 0.0 { sum / weights } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::Lem;
    use crate::{Job, Material, Peer, SetupError, TetMesh};
    use glam::DVec3;

    fn with_slab(limit: u64, mut run: impl FnMut(Job, u32)) {
        let cells: Vec<f64> = (0..=20).map(|k| 0.004 * f64::from(k)).collect();
        let (surface, volume) = TetMesh::block(&cells, &cells, &[0.0, 0.02, 0.04]);
        let top = DVec3::new(0.04, 0.04, 0.04);
        let site = (0u32..).zip(surface.vertices()).find(|(_, at)| at.distance(top) < 1e-12).unwrap().0;
        let job = Job {
            surface: &surface,
            volume: None,
            fixed: &volume.fixed,
            material: Material { young_pa: 10e3, poisson: 0.45 },
            contact_radius_m: 0.006,
            memory_limit_bytes: limit,
        };
        run(job, site);
    }

    #[test]
    fn the_ideal_site_has_the_stiffness_of_a_flat_punch() {
        with_slab(u64::MAX, |job, _| {
            let lem = Lem::new(&job).unwrap();
            let mut ideal = lem
                .ideal_layer(4.0 * job.surface.volume_m3() / job.surface.vertex_areas().iter().sum::<f64>());
            ideal.tension_n_per_m = lem.tension_n_per_m();
            let punch = 2.0 * 10e3 * 0.006 / (1.0 - 0.45 * 0.45);
            let found = ideal.solve(1.0, 0.0, super::Fluid::Open).force_n;
            assert!((found / punch - 1.0).abs() < 1e-9, "{found} {punch}");
        });
    }

    #[test]
    fn a_pressed_slab_bulges_elsewhere_and_its_base_stays() {
        with_slab(u64::MAX, |job, site| {
            let mut lem = Lem::new(&job).unwrap();
            lem.touch(site, DVec3::Z);
            let mut field = vec![DVec3::ZERO; job.surface.vertices().len()];
            let force = lem.query(0.002, &mut field);
            assert!(force > 0.0 && lem.pressure_pa_per_m() > 0.0);
            assert!((field[site as usize].z + 0.002).abs() < 1e-15);
            assert!(field.iter().any(|u| u.z > 0.0), "the fluid goes somewhere");
            assert!(field.iter().zip(job.fixed).all(|(u, &held)| !held || *u == DVec3::ZERO));
            let (_, layer, _) = lem.elements(job.surface.vertices()[site as usize], DVec3::Z);
            let rest = layer.solve(1.0, 0.0, super::Fluid::Confined);
            let moved: f64 = rest.elongation_m.iter().map(|x| x.abs()).sum();
            assert!(rest.elongation_m.iter().sum::<f64>().abs() < 1e-13 * moved);
        });
    }

    #[test]
    fn too_little_memory_is_refused() {
        with_slab(1000, |job, _| assert!(matches!(Lem::new(&job), Err(SetupError::DoesNotFit { .. }))));
    }
}
