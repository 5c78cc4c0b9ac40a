//! Mass-spring: the body as point masses joined by springs, stepped through time.
//!
//! Masses sit at the nodes of the tetrahedra and springs on their edges, see [`network`]. A spring of rest length l0 pulls
//! its ends together with `k (l - l0)` along its present direction, so large motions are followed. One step is semi-implicit
//! (symplectic) Euler, the integrator of interactive mass-spring models (Baraff and Witkin, "Large steps in cloth
//! simulation", SIGGRAPH 1998, name its limits; Nealen et al., "Physically based deformable models in computer graphics",
//! Computer Graphics Forum 25(4), 2006, survey it):
//!
//! ```text
//! v <- (v + dt f(x)/m) / (1 + c dt),   x <- x + dt v
//! ```
//!
//! Without damping it is stable for `dt < 2/omega`, omega the highest frequency of the springs, see [`stability`];
//! damping c never lowers that. One query is one haptic period of 1 ms, in as many substeps as stability needs.
//!
//! Ours, where no publication decides: density 1000 kg/m^3 (nothing at rest depends on it); damping by mass, critical for a
//! column of the body's height, `c = 2 omega_1`, `omega_1 = pi/2 sqrt(E/density)/height`; the contact's vertices are led along
//! the normal from where they are to the depth asked for, evenly over the substeps. Springs cannot have a Poisson ratio
//! other than 1/4 (Cauchy's relations): the job's ratio is not used.

mod network;
mod stability;

use glam::DVec3;

use crate::{Job, Peer, PeerKind, SetupError, patch};
use network::Network;

/// Duration of one query, s.
const PERIOD_S: f64 = 1e-3;
/// Density of soft tissue, kg/m^3.
const DENSITY_KG_PER_M3: f64 = 1000.0;
/// Share of the largest stable step that is used: strained springs are somewhat stiffer across than at rest.
const STEP_MARGIN: f64 = 0.8;
/// At rest: no node moves by more than this share of the largest displacement in one period.
const REST: f64 = 1e-6;
/// A body that does not come to rest in as many periods (10 s) is left as it is.
const LONGEST_SETTLING: u32 = 10_000;

/// In the list of all peers.
pub(crate) const KIND: PeerKind = PeerKind {
    name: "mass-spring",
    citation: "Lloyd, Szekely and Harders, Identification of spring parameters for deformable object \
    simulation, IEEE TVCG 13(5), 2007; semi-implicit Euler",
    setup: |job| Ok(Box::new(MassSpring::new(job)?)),
};

/// Point masses and springs on the edges of the tetrahedra.
pub struct MassSpring {
    network: Network,
    /// To find what a disc touches.
    surface: rhombus_chain::SurfaceMesh,
    contact_radius_m: f64,
    displacement: Vec<DVec3>,
    velocity: Vec<DVec3>,
    force: Vec<DVec3>,
    touched: Vec<u32>,
    normal: DVec3,
    damping_per_s: f64,
    step_s: f64,
}

impl MassSpring {
    /// Springs and masses of the job's tetrahedra, at rest.
    ///
    /// # Errors
    /// An unusable job, one without tetrahedra, or one that does not fit.
    pub fn new(job: &Job) -> Result<Self, SetupError> {
        job.check()?;
        let volume = job.tetrahedra()?;
        job.reserve(Network::needed_bytes(volume) + job.surface.memory_bytes() as u64)?;
        let network = Network::new(volume, job.fixed, job.material.young_pa, DENSITY_KG_PER_M3);
        let [low, high] = job.surface.extents();
        let wave_speed = (job.material.young_pa / DENSITY_KG_PER_M3).sqrt();
        let damping_per_s = std::f64::consts::PI * wave_speed / (high - low).max_element();
        Ok(Self::at_rest(network, job.surface.clone(), job.contact_radius_m, damping_per_s))
    }

    fn at_rest(
        network: Network,
        surface: rhombus_chain::SurfaceMesh,
        contact_radius_m: f64,
        damping_per_s: f64,
    ) -> Self {
        let nodes = network.rest.len();
        let step_s = STEP_MARGIN * stability::largest_stable_step_s(&network);
        Self {
            network,
            surface,
            contact_radius_m,
            displacement: vec![DVec3::ZERO; nodes],
            velocity: vec![DVec3::ZERO; nodes],
            force: vec![DVec3::ZERO; nodes],
            touched: Vec::new(),
            normal: DVec3::Z,
            damping_per_s,
            step_s,
        }
    }

    /// The largest step at which undamped semi-implicit Euler is stable: 2 over the highest angular frequency of the
    /// springs at rest, s.
    #[must_use]
    pub fn largest_stable_step_s(&self) -> f64 {
        stability::largest_stable_step_s(&self.network)
    }

    /// The factor by which all springs (and so Young's modulus) may be multiplied before steps of `step_s` become unstable.
    #[must_use]
    pub fn largest_stable_stiffness_factor(&self, step_s: f64) -> f64 {
        let ratio = self.largest_stable_step_s() / step_s;
        ratio * ratio
    }

    /// Multiplies all springs; the step stays as it is, so that a body can be made too stiff for it.
    pub fn stiffen(&mut self, factor: f64) {
        for spring in &mut self.network.springs {
            spring.stiffness_n_per_m *= factor;
        }
    }

    /// The stiffest and the softest spring, N/m; zero without springs.
    #[must_use]
    pub fn stiffness_range_n_per_m(&self) -> [f64; 2] {
        let all = || self.network.springs.iter().map(|spring| spring.stiffness_n_per_m);
        [all().fold(0.0, f64::max), all().reduce(f64::min).unwrap_or(0.0)]
    }

    /// The longest step taken within a period, s.
    #[must_use]
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Sets the longest step within a period, also to one that is not stable. Anything but a positive number is ignored.
    pub fn set_step_s(&mut self, step_s: f64) {
        if step_s > 0.0 {
            self.step_s = step_s;
        }
    }

    /// Kinetic energy and energy in the springs, J.
    #[must_use]
    pub fn energy_j(&self) -> f64 {
        self.network.energy_j(&self.displacement) + self.network.kinetic_j(&self.velocity)
    }

    fn substeps(&self) -> u32 {
        // Saturates: a step far too small only takes long.
        let steps = (PERIOD_S / self.step_s).ceil() as u32;
        steps.max(1)
    }

    /// One step of `dt_s`; `left` steps remain, this one included, until the touched nodes are at `-depth_m`. The normal
    /// force of the springs on the touched nodes, N, at the step's start.
    fn step(&mut self, dt_s: f64, depth_m: f64, left: u32) -> f64 {
        self.network.forces(&self.displacement, &mut self.force);
        let slowed = 1.0 / (1.0 + self.damping_per_s * dt_s);
        for ((velocity, force), inverse) in
            self.velocity.iter_mut().zip(&self.force).zip(&self.network.inverse_mass_per_kg)
        {
            *velocity = (*velocity + *force * (dt_s * inverse)) * slowed;
        }
        let mut pushed_n = 0.0;
        for &node in &self.touched {
            let node = node as usize;
            let now = self.displacement[node].dot(self.normal);
            let wanted = (-depth_m - now) / (f64::from(left) * dt_s);
            let velocity = &mut self.velocity[node];
            *velocity += self.normal * (wanted - velocity.dot(self.normal));
            pushed_n += self.force[node].dot(self.normal);
        }
        for (at, velocity) in self.displacement.iter_mut().zip(&self.velocity) {
            *at += *velocity * dt_s;
        }
        pushed_n
    }

    fn period(&mut self, depth_m: f64) -> f64 {
        let steps = self.substeps();
        let dt_s = PERIOD_S / f64::from(steps);
        let mut pushed_n = 0.0;
        for done in 0..steps {
            pushed_n = self.step(dt_s, depth_m, steps - done);
        }
        pushed_n
    }

    fn write(&self, displacements: &mut [DVec3]) {
        for (to, &from) in displacements.iter_mut().zip(&self.displacement) {
            *to = from;
        }
    }
}

impl Peer for MassSpring {
    fn name(&self) -> &'static str {
        KIND.name
    }

    fn bytes(&self) -> u64 {
        let state = 3 * size_of_val(self.displacement.as_slice());
        (self.network.bytes() + state + self.surface.memory_bytes()) as u64
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        self.normal = normal;
        self.touched = patch(&self.surface, vertex, normal, self.contact_radius_m);
        self.touched.retain(|&node| self.network.inverse_mass_per_kg[node as usize] > 0.0);
    }

    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        let force_n = self.period(depth_m);
        self.write(displacements);
        force_n
    }

    fn settle(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        let mut force_n = self.period(depth_m);
        for _ in 0..LONGEST_SETTLING {
            force_n = self.period(depth_m);
            let farthest = self.displacement.iter().map(|u| u.length_squared()).fold(0.0, f64::max).sqrt();
            let fastest = self.velocity.iter().map(|v| v.length_squared()).fold(0.0, f64::max).sqrt();
            if fastest * PERIOD_S <= REST * farthest {
                break;
            }
        }
        self.write(displacements);
        force_n
    }
}

#[cfg(test)]
mod tests {
    use super::network::{Network, Spring};
    use super::{MassSpring, PERIOD_S};
    use crate::{Job, Material, Peer, SetupError, TetMesh};
    use glam::DVec3;

    fn cells(count: u32, pitch: f64) -> Vec<f64> {
        (0..=count).map(|k| pitch * f64::from(k)).collect()
    }

    fn block() -> (rhombus_chain::SurfaceMesh, TetMesh) {
        TetMesh::block(&cells(4, 0.01), &cells(4, 0.01), &cells(3, 0.01))
    }

    fn with_block(limit: u64, mut run: impl FnMut(Job)) {
        let (surface, volume) = block();
        run(Job {
            surface: &surface,
            volume: Some(&volume),
            fixed: &volume.fixed,
            material: Material { young_pa: 10e3, poisson: 0.45 },
            contact_radius_m: 0.011,
            memory_limit_bytes: limit,
        });
    }

    /// Springs in series along z between a held node and the site of a disc; sideways nothing holds them, nothing pushes.
    #[test]
    fn springs_in_series_give_the_force_of_their_sum() {
        let (surface, _) = block();
        let stiffness = [30.0, 50.0, 20.0, 80.0];
        // Node 0 is the vertex that is touched; the others continue below it.
        let rest: Vec<DVec3> =
            (0..5).map(|k| surface.vertices()[0] - DVec3::Z * 0.01 * f64::from(k)).collect();
        let springs = (0u32..)
            .zip(stiffness)
            .map(|(k, stiffness_n_per_m)| Spring { ends: [k, k + 1], rest_m: 0.01, stiffness_n_per_m })
            .collect();
        let network = Network { rest, springs, inverse_mass_per_kg: vec![1e3, 1e3, 1e3, 1e3, 0.0] };
        let mut chain = MassSpring::at_rest(network, surface, 0.0, 300.0);
        chain.touched = vec![0];
        let expected = 0.002 / stiffness.iter().map(|k| 1.0 / k).sum::<f64>();
        let mut field = vec![DVec3::ZERO; 5];
        for depth in [0.002, -0.002] {
            let force = chain.settle(depth, &mut field);
            assert!((force - expected * depth.signum()).abs() < 1e-4 * expected, "{force} {expected}");
            assert!((field[0].z + depth).abs() < 1e-12);
            let first = force / stiffness[0];
            assert!((field[1].z + depth - first).abs() < 1e-6, "{field:?}");
            assert_eq!(field[4], DVec3::ZERO);
        }
    }

    #[test]
    fn energy_stays_bounded_below_the_largest_stable_step_and_explodes_above() {
        let free_vibration = |share: f64, steps: u32| {
            let mut growth = 0.0;
            with_block(u64::MAX, |job| {
                let mut body = MassSpring::new(&job).unwrap();
                body.damping_per_s = 0.0;
                let dt = share * body.largest_stable_step_s();
                // All frequencies at once, far too small for the springs to turn.
                for (node, velocity) in body.velocity.iter_mut().enumerate() {
                    let held = body.network.inverse_mass_per_kg[node] == 0.0;
                    let sign = if node % 2 == 0 { 1.0 } else { -1.0 };
                    *velocity = DVec3::new(sign, 0.3, -sign) * if held { 0.0 } else { 1e-9 };
                }
                let start = body.energy_j();
                for _ in 0..steps {
                    body.step(dt, 0.0, 1);
                    growth = f64::max(growth, body.energy_j() / start);
                }
            });
            growth
        };
        let below = free_vibration(0.97, 4000);
        assert!(below < 100.0, "{below}");
        let above = free_vibration(1.02, 400);
        assert!(above > 1e6, "{above}");
    }

    #[test]
    fn a_pressed_block_resists_and_is_softer_when_made_softer() {
        let (surface, volume) = block();
        let top = DVec3::new(0.02, 0.02, 0.03);
        let site = (0u32..).zip(surface.vertices()).find(|(_, at)| at.distance(top) < 1e-12).unwrap().0;
        let mut field = vec![DVec3::ZERO; volume.surface_vertices];
        with_block(u64::MAX, |job| {
            let mut body = MassSpring::new(&job).unwrap();
            body.touch(site, DVec3::Z);
            let force = body.settle(0.0005, &mut field);
            assert!((field[site as usize].z + 0.0005).abs() < 1e-9);
            assert!(field.iter().zip(&volume.fixed).all(|(u, &held)| !held || *u == DVec3::ZERO));
            let mut soft = MassSpring::new(&job).unwrap();
            soft.stiffen(0.5);
            soft.touch(site, DVec3::Z);
            let half = soft.settle(0.0005, &mut field);
            assert!((half / force - 0.5).abs() < 1e-3, "{half} {force}");
            let factor = body.largest_stable_stiffness_factor(PERIOD_S / 2.0);
            body.stiffen(factor);
            assert!((body.largest_stable_step_s() / (PERIOD_S / 2.0) - 1.0).abs() < 1e-6);
        });
    }

    #[test]
    fn too_little_memory_is_refused() {
        with_block(1000, |job| {
            assert!(matches!(MassSpring::new(&job), Err(SetupError::DoesNotFit { limit_bytes: 1000, .. })));
            let no_volume = Job { volume: None, ..job };
            assert!(matches!(MassSpring::new(&no_volume), Err(SetupError::NoVolume)));
        });
    }
}
