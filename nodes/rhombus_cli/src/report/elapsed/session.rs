//! A long session on the liver: a probe that wanders from place to place, slides, presses, grasps and pulls, and comes back.

use std::collections::BTreeMap;

use glam::DVec3;
use rhombus_chain::{
    Body, ChainParameters, ContactLaw, Formulation, Interaction, Mode, Step, SurfaceField, SurfaceParameters,
    SurfacePoint, Tissue,
};
use scene::{BodyKind, MeshFile, sites};

use crate::report::stability_map::Random;

/// Places that the probe comes back to.
const PLACES: usize = 12;
const PROBE_RADIUS_M: f64 = 0.005;
const DEPTH_M: f64 = 0.004;
const PULL_M: f64 = 0.006;
/// Steps of 1 ms in each part of a visit; a grasp forgets its beginning, and a release its force, within 50 ms.
const STEP_NS: i64 = 1_000_000;
const APPROACH: usize = 40;
const PULL: usize = 70;
const LEAVE: usize = 70;

/// What the model says at one moment.
#[derive(Clone, Debug)]
struct Answer {
    force_n: DVec3,
    energy_j: f64,
    vertices: Vec<u32>,
    displacements_m: Vec<DVec3>,
}

/// The contact memory at a place, to the last bit.
type Memory = (u32, [u64; 3]);

/// How far answers at one place, in one position, differ from the first that was given there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Drift {
    /// Answers compared.
    pub(crate) compared: u64,
    pub(crate) force_n: f64,
    pub(crate) field_m: f64,
    pub(crate) energy_j: f64,
}

/// What a session has shown up to some step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Checkpoint {
    pub(crate) steps: u64,
    /// Against the first answer with the same contact memory.
    pub(crate) same_memory: Drift,
    /// Against the first answer of the place with another contact memory: the probe came from another side.
    pub(crate) other_memory: Drift,
    /// Largest force so far, N.
    pub(crate) peak_force_n: f64,
}

/// The session.
pub(crate) struct Session {
    body: Body,
    tissue: Tissue,
    places: Vec<(DVec3, DVec3)>,
    interaction: Interaction,
    field: SurfaceField,
    random: Random,
    stamp_ns: i64,
    probe: DVec3,
    now: Checkpoint,
    first: BTreeMap<(usize, bool), BTreeMap<Memory, Answer>>,
}

impl Session {
    /// The default scene's tissue on the generated liver.
    pub(crate) fn new() -> anyhow::Result<Session> {
        let body = Body::new(MeshFile::generated(BodyKind::Liver).surface(1.0)?);
        let tissue = tissue()?;
        let places: Vec<_> = sites(&body, PLACES).into_iter().map(|site| (site.point, site.normal)).collect();
        anyhow::ensure!(places.len() > 1, "the liver has no {PLACES} places to press");
        let field = SurfaceField::new(&body, &tissue);
        let probe = places[0].0 + places[0].1 * 0.05;
        let drift = Drift::default();
        let now = Checkpoint { steps: 0, same_memory: drift, other_memory: drift, peak_force_n: 0.0 };
        let (interaction, first) = (Interaction::new(), BTreeMap::new());
        Ok(Session {
            body,
            tissue,
            places,
            interaction,
            field,
            random: Random::new(1),
            stamp_ns: 0,
            probe,
            now,
            first,
        })
    }

    /// Goes on until at least so many steps have been made.
    pub(crate) fn run(&mut self, steps: u64) -> anyhow::Result<Checkpoint> {
        while self.now.steps < steps {
            self.visit()?;
        }
        Ok(self.now)
    }

    /// To a place from above, or sliding from aside; pressed there; sometimes grasped and pulled; away again.
    fn visit(&mut self) -> anyhow::Result<()> {
        let place = self.random.below(self.places.len());
        let (point, normal) = self.places[place];
        let pressed = point + normal * (PROBE_RADIUS_M - DEPTH_M);
        let above = point + normal * (PROBE_RADIUS_M + 0.002);
        if self.random.share() < 0.5 {
            self.go(above, APPROACH, false)?;
        } else {
            let aside = normal.any_orthonormal_vector() * self.random.between(-0.008, 0.008);
            let aside = aside + normal.cross(aside).normalize_or_zero() * self.random.between(-0.008, 0.008);
            self.go(above + aside, APPROACH, false)?;
            self.go(pressed + aside, APPROACH, false)?;
        }
        let step = self.go(pressed, APPROACH, false)?;
        self.compare(place, &step);
        if self.random.share() < 0.5 {
            let pulled = pressed + normal * PULL_M + normal.any_orthonormal_vector() * 0.002;
            let step = self.go(pulled, PULL, true)?;
            self.compare(place, &step);
        }
        self.go(point + normal * 0.02, LEAVE, false)?;
        Ok(())
    }

    /// In a straight line; the last step is at `to` exactly.
    fn go(&mut self, to: DVec3, steps: usize, grasp: bool) -> anyhow::Result<Step> {
        let from = self.probe;
        let mut last = Step::default();
        for step in 1..=steps {
            self.probe = if step == steps { to } else { from.lerp(to, step as f64 / steps as f64) };
            self.stamp_ns += STEP_NS;
            last = self.interaction.step(&self.body, &self.tissue, self.stamp_ns, self.probe, grasp)?;
            self.now.steps += 1;
            self.now.peak_force_n = self.now.peak_force_n.max(last.force_n.length());
        }
        Ok(last)
    }

    fn compare(&mut self, place: usize, step: &Step) {
        let Some(SurfacePoint { face, barycentric }) = step.surface_point else { return };
        let memory = (face, barycentric.to_array().map(f64::to_bits));
        self.field.update(&self.body, &self.tissue, self.interaction.impressions());
        let answer = Answer {
            force_n: step.force_n,
            energy_j: self.tissue.law().at_depth(step.depth_m).map_or(f64::NAN, |response| response.energy_j),
            vertices: self.field.vertices().to_vec(),
            displacements_m: self.field.displacements().to_vec(),
        };
        let answers = self.first.entry((place, step.mode == Mode::Grasp)).or_default();
        match answers.get(&memory) {
            Some(first) => self.now.same_memory.add(first, &answer),
            None => {
                if let Some(other) = answers.values().next() {
                    self.now.other_memory.add(other, &answer);
                }
                answers.insert(memory, answer);
            }
        }
    }
}

impl Drift {
    fn add(&mut self, first: &Answer, now: &Answer) {
        self.compared += 1;
        // A difference that is no number is the largest of all.
        let larger = |most: f64, difference: f64| if difference <= most { most } else { difference };
        self.force_n = larger(self.force_n, (now.force_n - first.force_n).length());
        self.energy_j = larger(self.energy_j, (now.energy_j - first.energy_j).abs());
        self.field_m = larger(self.field_m, field_difference_m(first, now));
    }
}

/// Largest difference over all vertices; where one field has no entry, nothing moves.
fn field_difference_m(a: &Answer, b: &Answer) -> f64 {
    let entries = |answer: &Answer| {
        answer.vertices.iter().copied().zip(answer.displacements_m.iter().copied()).collect()
    };
    let (a, b): (BTreeMap<u32, DVec3>, BTreeMap<u32, DVec3>) = (entries(a), entries(b));
    let of = |field: &BTreeMap<u32, DVec3>, vertex| field.get(vertex).copied().unwrap_or(DVec3::ZERO);
    let vertices = a.keys().chain(b.keys());
    vertices.map(|vertex| (of(&a, vertex) - of(&b, vertex)).length()).fold(0.0, f64::max)
}

/// Three chains of the default scene's kind.
fn tissue() -> anyhow::Result<Tissue> {
    let chain = |rod_length_m, ratio, units, normal, tangential| ChainParameters {
        rod_length_m,
        angle_rad: 0.8,
        ratio,
        units,
        normal_stiffness_n_per_m: normal,
        tangential_stiffness_n_per_m: tangential,
        tangential_growth: 20.0,
        weight: 1.0 / 3.0,
        pitch_m: 0.002,
    };
    let chains = [
        chain(0.012, 0.513, 8, 230.0, 14.0),
        chain(0.005, 0.801, 23, 580.0, 35.0),
        chain(0.002, 0.923, 63, 1240.0, 75.0),
    ];
    let law = ContactLaw::new(Formulation::Energy, &chains)?;
    let surface = SurfaceParameters { contact_radius_m: 0.002, ..SurfaceParameters::default() };
    Ok(Tissue::new(law, surface, PROBE_RADIUS_M, 0.5)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whatever_happened_in_between_the_same_memory_gives_the_same_bits() {
        let checkpoint = Session::new().unwrap().run(100_000).unwrap();
        let Drift { compared, force_n, field_m, energy_j } = checkpoint.same_memory;
        assert!(compared > 200, "{checkpoint:?}");
        assert_eq!((force_n, field_m, energy_j), (0.0, 0.0, 0.0));
        assert!(checkpoint.peak_force_n > 0.5, "it is really touched: {checkpoint:?}");
    }

    #[test]
    fn a_field_that_differs_in_one_vertex_by_a_bit_is_seen() {
        let one = Answer {
            force_n: DVec3::X,
            energy_j: 1.0,
            vertices: vec![3, 7],
            displacements_m: vec![DVec3::X, DVec3::Y],
        };
        let mut other = one.clone();
        let mut drift = Drift::default();
        drift.add(&one, &other);
        assert_eq!(drift, Drift { compared: 1, ..Drift::default() });
        other.displacements_m[1].y = 1.0_f64.next_up();
        drift.add(&one, &other);
        assert_eq!(drift.field_m, f64::EPSILON);
        other.vertices[1] = 8;
        drift.add(&one, &other);
        assert_eq!(drift.field_m, 1.0_f64.next_up());
    }
}
