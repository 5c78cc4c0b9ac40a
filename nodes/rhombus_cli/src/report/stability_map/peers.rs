//! The same question to the peers that step through time: how large a step, how stiff a spring.

use std::path::Path;

use anyhow::Context as _;
use glam::DVec3;
use rhombus_chain::{Body, SurfaceMesh};
use rhombus_peers::{Job, MassSpring, Material, Peer, TetMesh};
use scene::{BodyKind, generate, sites};

use crate::report::section::Exhibit;
use crate::report::table::Table;

/// The generated liver with tetrahedra inside, for peers.
pub(crate) struct Liver {
    pub(crate) body: Body,
    volume: TetMesh,
}

impl Liver {
    /// Of one of the sizes for which there are tetrahedra below `reference`.
    pub(crate) fn read(reference: &Path, vertices: usize) -> anyhow::Result<Liver> {
        let volume = TetMesh::read(&reference.join(format!("tets/liver_{vertices}.npz")))?;
        let shape = generate::body(BodyKind::Liver, vertices);
        let mesh = SurfaceMesh::new(volume.nodes[..volume.surface_vertices].to_vec(), shape.triangles)
            .context("the tetrahedra's surface is not the generated liver's")?;
        Ok(Liver { body: Body::new(mesh), volume })
    }

    /// The body's only job: a disc of 5 mm.
    pub(crate) fn job(&self, young_pa: f64) -> Job<'_> {
        Job {
            surface: self.body.mesh(),
            volume: Some(&self.volume),
            fixed: &self.volume.fixed,
            material: Material { young_pa, poisson: 0.45 },
            contact_radius_m: 0.005,
            memory_limit_bytes: 4 << 30,
        }
    }
}

/// One period of a peer, s.
const PERIOD_S: f64 = 1e-3;
/// Depth of the disc, m.
const DEPTH_M: f64 = 1e-4;
/// Steps of a trial: an unstable body has long gone by then.
const STEPS: usize = 3000;

/// The largest stable step of mass-spring bodies, predicted and found, and the stiffest spring that a step of 1 ms allows.
pub(super) fn mass_spring(reference: &Path, sizes: &[usize]) -> anyhow::Result<Exhibit> {
    let mut table = Table::new([
        ("vertices", ""),
        ("Young's modulus", "Pa"),
        ("stiffest spring", "N/m"),
        ("largest stable step, 2 over the highest frequency", "s"),
        ("largest stable step found", "s"),
        ("stiffest spring stable with steps of 1 ms", "N/m"),
    ]);
    for &vertices in sizes {
        let liver = Liver::read(reference, vertices)?;
        for young_pa in [1e3, 1e4, 1e6, 1e9] {
            let peer = MassSpring::new(&liver.job(young_pa))?;
            let [stiffest, _] = peer.stiffness_range_n_per_m();
            let predicted_s = peer.largest_stable_step_s();
            let found_s = largest_step_s(&liver, young_pa)?;
            let at_a_period = stiffest * peer.largest_stable_stiffness_factor(PERIOD_S);
            table.push([
                vertices.into(),
                young_pa.into(),
                stiffest.into(),
                predicted_s.into(),
                found_s.into(),
                at_a_period.into(),
            ]);
        }
    }
    Ok(Exhibit {
        name: "stability_mass_spring",
        title: "A peer: mass-spring, largest stable step and stiffness".to_owned(),
        caption: "Semi-implicit Euler on the springs of the liver's tetrahedra, a disc held 0.1 mm deep. Found by halving: the \
                  longest step of which a whole number makes 1 ms and with which the body's energy stays bounded. The rhombus \
                  chains take no steps: their stiffness has no such limit."
            .to_owned(),
        figure: None,
        table,
        raw: None,
    })
}

/// The longest stable step of which a whole number makes a period, s.
fn largest_step_s(liver: &Liver, young_pa: f64) -> anyhow::Result<f64> {
    let is_stable = |steps: u32| is_stable(liver, young_pa, steps);
    let mut enough = 1;
    while !is_stable(enough)? {
        anyhow::ensure!(enough < 1 << 20, "no step is stable at {young_pa} Pa");
        enough *= 2;
    }
    let mut too_few = enough / 2;
    while enough - too_few > 1.max(enough / 256) {
        let middle = too_few + (enough - too_few) / 2;
        if is_stable(middle)? {
            enough = middle;
        } else {
            too_few = middle;
        }
    }
    Ok(PERIOD_S / f64::from(enough))
}

fn is_stable(liver: &Liver, young_pa: f64, steps: u32) -> anyhow::Result<bool> {
    let mut peer = MassSpring::new(&liver.job(young_pa))?;
    // Between two whole numbers of steps: rounding cannot change the number.
    peer.set_step_s(PERIOD_S / (f64::from(steps) - 0.5));
    let [stiffest, _] = peer.stiffness_range_n_per_m();
    let [site] = sites(&liver.body, 1)[..] else { anyhow::bail!("the liver has no place to press") };
    peer.touch(site.vertex, site.normal);
    let mut displacements = vec![DVec3::ZERO; liver.body.mesh().vertices().len()];
    // What a hundred such springs hold when they are stretched by the depth, and a thousand times as much.
    let most_j = 1e5 * stiffest * DEPTH_M * DEPTH_M;
    for _ in 0..(STEPS / steps as usize).max(2) {
        peer.query(DEPTH_M, &mut displacements);
        let energy_j = peer.energy_j();
        if !energy_j.is_finite() || energy_j > most_j {
            return Ok(false);
        }
    }
    Ok(true)
}
