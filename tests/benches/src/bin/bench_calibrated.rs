//! Surface update and force query of a calibrated body against the same body without its calibration.
//!
//! Numbers of the response are smooth and made up: the time depends on how many there are, not on what they are. The bodies
//! take turns, some presses of one walk each, so that what slows the machine slows them all. The first press of a turn, when
//! the caches hold what another body left there, counts for itself.

use std::fs::File;
use std::hint::black_box;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Parser;
use glam::DVec3;
use rhombus_benches::{PRESS_M, Spread, machine_name, pressed, walk_on_surface};
use rhombus_chain::{
    Body, ChainParameters, ContactLaw, Formulation, Impression, Interaction, Response, ResponseParts,
    SurfaceField, SurfaceMesh, SurfaceParameters, Tissue,
};
use scene::{BodyKind, generate};

#[derive(Parser)]
#[command(about = "Time of a surface update and of a force query on a calibrated body")]
struct Options {
    /// Vertices of the generated liver.
    #[arg(long, default_value_t = 3116)]
    vertices: usize,
    /// Places that are pressed.
    #[arg(long, default_value_t = 2000)]
    samples: usize,
    /// File for the results.
    #[arg(long)]
    csv: PathBuf,
}

/// Way between two presses: 0.2 m/s at 60 Hz.
const STEP_M: f64 = 0.003;
const PROBE_RADIUS_M: f64 = 0.005;
const CONTACT_RADIUS_M: f64 = 0.005;
const PITCH_M: f64 = 0.005;
/// Lengths in which the chains' shapes fall to 1/e, m, and how many of them a chain reaches.
const DECAYS_M: [f64; 6] = [0.0025, 0.005, 0.01, 0.02, 0.04, 0.08];
const REACH_IN_DECAYS: f64 = 14.0;
/// Presses of a turn.
const TURN: usize = 20;
/// Force queries behind one sample.
const QUERIES: usize = 50;

/// One body that is timed.
struct Subject {
    name: &'static str,
    body: Body,
    field: SurfaceField,
    build_ms: f64,
    touched: usize,
    updates_us: Vec<f64>,
    first_updates_us: Vec<f64>,
    queries_us: Vec<f64>,
}

fn main() -> Result<()> {
    let options = Options::parse();
    let tissue = tissue()?;
    let shape = generate::body(BodyKind::Liver, options.vertices);
    let mesh = SurfaceMesh::new(shape.vertices, shape.triangles)?;
    let subject = |name, response: Option<(usize, usize)>| -> Result<Subject> {
        let body = Body::new(mesh.clone());
        let body = match response {
            Some((harmonics, modes)) => {
                body.with_response(Response::new(made_up(&mesh, harmonics, modes), &mesh)?)?
            }
            None => body,
        };
        let start = Instant::now();
        let field = SurfaceField::new(&body, &tissue);
        let build_ms = start.elapsed().as_secs_f64() * 1e3;
        let [updates_us, first_updates_us, queries_us] = Default::default();
        Ok(Subject { name, body, field, build_ms, touched: 0, updates_us, first_updates_us, queries_us })
    };
    let mut subjects = [
        subject("plain_chains", None)?,
        subject("calibrated_h0", Some((0, 0)))?,
        subject("calibrated_h2", Some((2, 0)))?,
        subject("calibrated_h2_24_modes", Some((2, 24)))?,
    ];
    let walk = walk_on_surface(&mesh, options.samples, STEP_M);
    let mut passes_us = Vec::new();
    let mut displaced = mesh.vertices().to_vec();
    for turn in pressed(&walk, PROBE_RADIUS_M, |_| PRESS_M).chunks(TURN) {
        for subject in &mut subjects {
            for (place, probe) in turn.iter().enumerate() {
                subject.press(&tissue, *probe, place == 0);
            }
        }
        for _ in turn {
            let start = Instant::now();
            for vertex in black_box(&mut displaced) {
                *vertex += DVec3::splat(1e-9);
            }
            passes_us.push(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    write(&options, &mut subjects, &mut passes_us)
}

impl Subject {
    /// A new contact, its field, and the force under a probe that stays there.
    fn press(&mut self, tissue: &Tissue, probe: DVec3, is_first: bool) {
        let mut interaction = Interaction::new();
        if interaction.step(&self.body, tissue, 0, probe, false).is_err() {
            return;
        }
        let impressions: Vec<Impression> = interaction.impressions().collect();
        let start = Instant::now();
        self.field.update(&self.body, tissue, black_box(impressions));
        let update_us = start.elapsed().as_secs_f64() * 1e6;
        if is_first { &mut self.first_updates_us } else { &mut self.updates_us }.push(update_us);
        self.touched = self.touched.max(self.field.vertices().len());
        let start = Instant::now();
        for k in 1..=QUERIES {
            let step = interaction.step(&self.body, tissue, k as i64 * 1_000_000, black_box(probe), false);
            black_box(step.is_ok());
        }
        self.queries_us.push(start.elapsed().as_secs_f64() * 1e6 / QUERIES as f64);
    }
}

/// Chains as a calibration chooses them: one pitch, decays a factor of two apart, no boundary inside their reach.
fn tissue() -> Result<Tissue> {
    let chains = DECAYS_M.map(|decay_m| ChainParameters {
        rod_length_m: 0.004,
        angle_rad: 0.8,
        ratio: libm::exp(-PITCH_M / decay_m),
        units: (REACH_IN_DECAYS * decay_m / PITCH_M).round() as u32,
        normal_stiffness_n_per_m: 60.0,
        tangential_stiffness_n_per_m: 10.0,
        tangential_growth: 10.0,
        weight: 1.0 / DECAYS_M.len() as f64,
        pitch_m: PITCH_M,
    });
    let law = ContactLaw::new(Formulation::Energy, &chains)?;
    let surface =
        SurfaceParameters { cutoff: 0.0, contact_radius_m: CONTACT_RADIUS_M, ..SurfaceParameters::default() };
    Ok(Tissue::new(law, surface, PROBE_RADIUS_M, 0.5)?)
}

/// Waves over the body.
fn made_up(mesh: &SurfaceMesh, harmonics: usize, modes: usize) -> ResponseParts {
    let mut parts = ResponseParts { chains: DECAYS_M.len(), harmonics, modes, ..ResponseParts::default() };
    let wave = |vertex: &DVec3, number: usize| {
        let k = number as f64;
        0.1 * libm::sin(20.0 * (vertex.x + vertex.y * libm::cos(k) + vertex.z * libm::sin(k)) + k)
    };
    let per_chain = parts.coefficients_per_chain();
    for vertex in mesh.vertices() {
        let begin = parts.coefficients.len();
        parts.coefficients.extend((0..DECAYS_M.len() * per_chain).map(|number| wave(vertex, number) as f32));
        let others: f32 = parts.coefficients[begin + per_chain..].iter().step_by(per_chain).sum();
        parts.coefficients[begin] = 1.0 - others;
        parts.amplitudes.extend((0..modes).map(|number| wave(vertex, number) as f32));
    }
    for number in 0..modes {
        let axes =
            mesh.vertices().iter().flat_map(|vertex| [0, 1, 2].map(|axis| wave(vertex, number + axis)));
        parts.mode_fields.extend(axes.map(|value| value as f32));
    }
    parts
}

fn write(options: &Options, subjects: &mut [Subject], passes_us: &mut [f64]) -> Result<()> {
    let mut csv =
        File::create(&options.csv).with_context(|| format!("creating {}", options.csv.display()))?;
    writeln!(csv, "# {}", machine_name())?;
    writeln!(
        csv,
        "# {} vertices, {} chains with decays {DECAYS_M:?} m, reach {REACH_IN_DECAYS} decays, pitch {PITCH_M} m, contact radius {CONTACT_RADIUS_M} m, press {PRESS_M} m, a new place each time",
        options.vertices,
        DECAYS_M.len()
    )?;
    writeln!(
        csv,
        "# ratio: median over that of plain_chains; build_ms: of the field; memory_bytes: of the field and the response"
    )?;
    writeln!(csv, "subject,quantity,unit,touched,build_ms,memory_bytes,ratio,{}", Spread::CSV_HEADER)?;
    let baseline = Spread::of(passes_us).context("no samples")?;
    let mut plain: Option<[f64; 3]> = None;
    for subject in subjects {
        let update = Spread::of(&mut subject.updates_us).context("no samples")?;
        let first = Spread::of(&mut subject.first_updates_us).context("no samples")?;
        let query = Spread::of(&mut subject.queries_us).context("no samples")?;
        let plain = *plain.get_or_insert([update.median, first.median, query.median]);
        let memory = subject.field.memory_bytes() + subject.body.response().map_or(0, Response::memory_bytes);
        let rows =
            [("surface_update", update), ("first_surface_update_of_a_turn", first), ("force_query", query)];
        for ((quantity, spread), plain) in rows.into_iter().zip(plain) {
            let ratio = spread.median / plain;
            writeln!(
                csv,
                "{},{quantity},us,{},{:.1},{memory},{ratio:.3},{}",
                subject.name,
                subject.touched,
                subject.build_ms,
                spread.csv()
            )?;
            eprintln!(
                "{:24} {quantity:30} median {:8.3} us  (quartiles {:.3} to {:.3}, p99 {:.3})  {ratio:.2} of plain chains; {} vertices, built in {:.0} ms, {:.1} MB",
                subject.name,
                spread.median,
                spread.q1,
                spread.q3,
                spread.p99,
                subject.touched,
                subject.build_ms,
                memory as f64 * 1e-6
            );
        }
    }
    writeln!(csv, "pass_over_all_vertices,surface_update,us,{},,,,{}", options.vertices, baseline.csv())?;
    eprintln!("pass over all vertices: median {:.3} us", baseline.median);
    Ok(())
}
