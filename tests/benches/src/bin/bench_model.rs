//! Force query and surface update at 3116, 50 000 and 1 000 000 vertices.
//!
//! Baselines of the same run: for the force query, the spatial index asked for the closest point (what a model without
//! contact memory would do at every pose); for the surface update, one pass that adds a constant to every vertex (what a model
//! that moves the whole mesh cannot do without).

use std::fs::File;
use std::hint::black_box;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Parser;
use glam::DVec3;
use rhombus_benches::{PRESS_M, Spread, machine_name, pressed, walk_on_surface};
use rhombus_chain::{Body, Impression, Interaction, SurfaceField, SurfaceMesh, Tissue};
use scene::{BodyKind, Reader, Scene, generate};

#[derive(Parser)]
#[command(about = "Time of a force query and of a surface update")]
struct Options {
    /// Vertices of the generated livers.
    #[arg(long, value_delimiter = ',', default_value = "3116,50000,1000000")]
    vertices: Vec<usize>,
    /// Scene whose chains are used.
    #[arg(long, default_value = "config/liver.yaml")]
    scene: PathBuf,
    /// Samples of each kind.
    #[arg(long, default_value_t = 300)]
    samples: usize,
    /// File for the results.
    #[arg(long)]
    csv: PathBuf,
}

/// Poses behind one sample of the force query: long enough for the clock, short against a time slice.
const QUERIES_PER_SAMPLE: usize = 200;
/// Way of the probe between two poses at 1 kHz and 0.2 m/s.
const STEP_M: f64 = 0.000_2;
/// Poses between two updates of the surface: 60 Hz would be 17.
const STEPS_PER_UPDATE: usize = 15;

/// One row of the result.
struct Row<'a> {
    vertices: usize,
    quantity: &'a str,
    unit: &'a str,
    touched: usize,
    values: Vec<f64>,
}

fn main() -> Result<()> {
    let options = Options::parse();
    let scene = Scene::from_file(&options.scene, Reader::Everything)?;
    let tissue = scene.tissue()?;
    let mut csv =
        File::create(&options.csv).with_context(|| format!("creating {}", options.csv.display()))?;
    writeln!(csv, "# {}", machine_name())?;
    writeln!(
        csv,
        "# scene {}, {} chains, press {PRESS_M} m",
        options.scene.display(),
        tissue.law().chains().len()
    )?;
    writeln!(csv, "vertices,quantity,unit,touched,{}", Spread::CSV_HEADER)?;
    for &vertices in &options.vertices {
        let shape = generate::body(BodyKind::Liver, vertices);
        let body = Body::new(SurfaceMesh::new(shape.vertices, shape.triangles)?);
        for mut row in measure(&body, &tissue, options.samples) {
            let spread = Spread::of(&mut row.values).context("no samples")?;
            writeln!(csv, "{},{},{},{},{}", row.vertices, row.quantity, row.unit, row.touched, spread.csv())?;
            eprintln!(
                "{:>8} vertices  {:32} median {:9.3} {}  (quartiles {:.3} to {:.3}, p99 {:.3}){}",
                row.vertices,
                row.quantity,
                spread.median,
                row.unit,
                spread.q1,
                spread.q3,
                spread.p99,
                if row.touched > 0 { format!("  {} vertices touched", row.touched) } else { String::new() }
            );
        }
    }
    Ok(())
}

fn measure<'a>(body: &Body, tissue: &Tissue, samples: usize) -> Vec<Row<'a>> {
    let vertices = body.mesh().vertices().len();
    let walk = walk_on_surface(body.mesh(), samples * QUERIES_PER_SAMPLE, STEP_M);
    let radius_m = tissue.probe_radius_m();
    let in_contact = pressed(&walk, radius_m, |i| PRESS_M * (0.6 + 0.4 * libm::sin(i as f64 * 0.01)));
    let above = pressed(&walk, radius_m, |_| -0.002);
    let row = |quantity, unit, touched, values| Row { vertices, quantity, unit, touched, values };
    let (touched, moving, resting) = surface_updates(body, tissue, &walk, samples);
    vec![
        row("force_in_contact", "us", 0, force_queries(body, tissue, &in_contact)),
        row("force_in_free_motion_at_2mm", "us", 0, force_queries(body, tissue, &above)),
        row("baseline_closest_point_by_index", "us", 0, closest_points(body, &in_contact)),
        row("surface_update_contact_moves", "us", touched, moving),
        row("surface_update_contact_rests", "us", touched, resting),
        row("baseline_pass_over_all_vertices", "us", vertices, passes_over_all(body.mesh(), samples)),
    ]
}

/// Microseconds per query, one value for each batch.
fn batches(positions: &[DVec3], mut query: impl FnMut(usize, DVec3)) -> Vec<f64> {
    let mut index = 0;
    positions
        .chunks(QUERIES_PER_SAMPLE)
        .map(|batch| {
            let start = Instant::now();
            for &position in batch {
                query(index, position);
                index += 1;
            }
            start.elapsed().as_secs_f64() * 1e6 / batch.len() as f64
        })
        .collect()
}

fn force_queries(body: &Body, tissue: &Tissue, positions: &[DVec3]) -> Vec<f64> {
    let mut interaction = Interaction::new();
    batches(positions, |index, position| {
        let step = interaction.step(body, tissue, index as i64 * 1_000_000, black_box(position), false);
        black_box(step.is_ok());
    })
}

fn closest_points(body: &Body, positions: &[DVec3]) -> Vec<f64> {
    batches(positions, |_, position| {
        black_box(body.index().closest(body.mesh(), black_box(position), f64::INFINITY));
    })
}

/// Touched vertices (median), microseconds with a contact that moves by 3 mm between updates (0.2 m/s at 60 Hz), and with one
/// whose depth alone changes.
fn surface_updates(
    body: &Body,
    tissue: &Tissue,
    walk: &[(DVec3, DVec3)],
    samples: usize,
) -> (usize, Vec<f64>, Vec<f64>) {
    let radius_m = tissue.probe_radius_m();
    let mut field = SurfaceField::new(body, tissue);
    let (mut touched, mut moving, mut resting) = (Vec::new(), Vec::new(), Vec::new());
    let places: Vec<_> = walk.iter().copied().step_by(STEPS_PER_UPDATE).take(samples).collect();
    let mut interaction = Interaction::new();
    for (index, probe) in pressed(&places, radius_m, |_| PRESS_M).into_iter().enumerate() {
        if interaction.step(body, tissue, index as i64, probe, false).is_err() {
            continue;
        }
        let impressions: Vec<Impression> = interaction.impressions().collect();
        let timed = |field: &mut SurfaceField, impressions: Vec<Impression>| {
            let start = Instant::now();
            field.update(body, tissue, black_box(impressions));
            start.elapsed().as_secs_f64() * 1e6
        };
        let shallower = impressions.iter().map(|i| Impression { depth_m: i.depth_m * 0.999, ..*i }).collect();
        moving.push(timed(&mut field, impressions));
        touched.push(field.vertices().len());
        resting.push(timed(&mut field, shallower));
    }
    touched.sort_unstable();
    (touched.get(touched.len() / 2).copied().unwrap_or_default(), moving, resting)
}

fn passes_over_all(mesh: &SurfaceMesh, samples: usize) -> Vec<f64> {
    let mut displaced = mesh.vertices().to_vec();
    (0..samples)
        .map(|_| {
            let start = Instant::now();
            for vertex in black_box(&mut displaced) {
                *vertex += DVec3::splat(1e-9);
            }
            start.elapsed().as_secs_f64() * 1e6
        })
        .collect()
}
