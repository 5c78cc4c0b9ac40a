//! The stiffest contact that stays stable: contact law evaluated in the motor loop, against the same contact commanded
//! through topics, by the topics' delay and by the damping of hand and handle.
//!
//! Everything is computed, nothing is timed: a run gives the same numbers on every machine. The passivity controller is
//! off, so that the limit is the contact's own. With it on (dashed) a hand that damps little swings at the same stiffness,
//! with bounded energy; where the hand damps more, the controller brings every contact to rest that was tried.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result, anyhow};
use clap::Parser;
use devices::simulated::HandSettings;
use plotters::prelude::*;
use rhombus_benches::{ClosedLoop, Transport};
use rhombus_chain::ContactLaw;
use scene::{Reader, Scene};

#[derive(Parser)]
#[command(about = "Largest stable stiffness: contact law in the motor loop against topics")]
struct Options {
    /// Scene whose chains are used.
    #[arg(long, default_value = "config/liver.yaml")]
    scene: PathBuf,
    /// Folder for closed_loop_stiffness.csv and two figures.
    #[arg(long)]
    output: PathBuf,
}

const HAND: HandSettings = HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 5.0 };
/// Of the topics, where that is not what changes, s.
const DELAY_S: f64 = 0.003;

/// One line of a figure.
struct Line {
    name: &'static str,
    rate_hz: f64,
    in_the_loop: bool,
    passivity: bool,
    colour: RGBColor,
}

const LINES: [Line; 5] = [
    Line {
        name: "in the loop, 4 kHz",
        rate_hz: 4000.0,
        in_the_loop: true,
        passivity: false,
        colour: BLUE_DARK,
    },
    Line { name: "in the loop, 1 kHz", rate_hz: 1000.0, in_the_loop: true, passivity: false, colour: BLUE },
    Line { name: "topics, 1 kHz", rate_hz: 1000.0, in_the_loop: false, passivity: false, colour: ORANGE },
    Line {
        name: "in the loop, 1 kHz, passivity controller on",
        rate_hz: 1000.0,
        in_the_loop: true,
        passivity: true,
        colour: BLUE,
    },
    Line {
        name: "topics, 1 kHz, passivity controller on",
        rate_hz: 1000.0,
        in_the_loop: false,
        passivity: true,
        colour: ORANGE,
    },
];
/// Height of letters in a figure, pixels.
const TEXT: u32 = 16;
const BLUE_DARK: RGBColor = RGBColor(0x0b, 0x3d, 0x66);
const BLUE: RGBColor = RGBColor(0x1f, 0x7a, 0xc4);
const ORANGE: RGBColor = RGBColor(0xd5, 0x5e, 0x00);

/// One figure: what changes, and what came of it for each line.
struct Study {
    file: &'static str,
    label: &'static str,
    values: &'static [f64],
    setup: fn(f64) -> (HandSettings, f64),
}

const STUDIES: [Study; 2] = [
    Study {
        file: "delay",
        label: "delay from pose to force or law, ms (hand 0.3 kg, 500 N/m, 5 N s/m)",
        values: &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0],
        setup: |delay_ms| (HAND, delay_ms * 1e-3),
    },
    Study {
        file: "damping",
        label: "damping of hand and handle, N s/m (0.3 kg, 500 N/m; delay 3 ms)",
        values: &[1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0],
        setup: |damping_n_s_per_m| (HandSettings { damping_n_s_per_m, ..HAND }, DELAY_S),
    },
];

/// Largest stable stiffness of each value; none where every contact tried is stable.
type Curve = Vec<(f64, Option<f64>)>;

fn main() -> Result<()> {
    let options = Options::parse();
    let law = Arc::new(Scene::from_file(&options.scene, Reader::Everything)?.law()?);
    std::fs::create_dir_all(&options.output)?;
    let mut csv = format!(
        "# chains of {}; stiffness in N/m at the depth where the hand rests; empty: stable up to 200000 N/m\n\
         study,value,line,largest_stable_n_per_m\n",
        options.scene.display()
    );
    for study in &STUDIES {
        let curves = LINES.iter().map(|line| curve(&law, study, line)).collect::<Result<Vec<Curve>>>()?;
        for (line, curve) in LINES.iter().zip(&curves) {
            for (value, stiffness) in curve {
                let text = stiffness.map_or_else(String::new, |n_per_m| format!("{n_per_m:.1}"));
                writeln!(csv, "{},{value},\"{}\",{text}", study.file, line.name)?;
                eprintln!("{:8} {value:5} {:45} {text}", study.file, line.name);
            }
        }
        for ((value, in_the_loop), (_, topics)) in curves[1].iter().zip(&curves[2]) {
            if let (Some(in_the_loop), Some(topics)) = (in_the_loop, topics) {
                eprintln!(
                    "{:8} {value:5} in the loop {:.1} times as stiff",
                    study.file,
                    in_the_loop / topics
                );
            }
        }
        let file = options.output.join(format!("closed_loop_stiffness_{}.svg", study.file));
        draw(&file, study, &curves).with_context(|| format!("drawing {}", file.display()))?;
    }
    let file = options.output.join("closed_loop_stiffness.csv");
    std::fs::write(&file, csv).with_context(|| format!("writing {}", file.display()))
}

fn curve(law: &Arc<ContactLaw>, study: &Study, line: &Line) -> Result<Curve> {
    let point = |&value: &f64| {
        let (hand, delay_s) = (study.setup)(value);
        let transport =
            if line.in_the_loop { Transport::InTheLoop { delay_s } } else { Transport::Topics { delay_s } };
        let closed_loop = ClosedLoop {
            law: law.clone(),
            hand,
            rate_hz: line.rate_hz,
            pose_rate_hz: 1000.0,
            transport,
            passivity: line.passivity,
        };
        Ok((value, closed_loop.largest_stable_n_per_m()?))
    };
    study.values.iter().map(point).collect()
}

/// Both axes from the data; stiffness by decades.
fn draw(file: &Path, study: &Study, curves: &[Curve]) -> Result<()> {
    let failed = |error: DrawingAreaErrorKind<std::io::Error>| anyhow!("{error}");
    let stiffnesses = || curves.iter().flatten().filter_map(|(_, stiffness)| *stiffness);
    let low = stiffnesses().fold(f64::INFINITY, f64::min) * 0.7;
    // Room for the legend above the lines.
    let high = stiffnesses().fold(0.0, f64::max) * 12.0;
    let right = study.values.iter().copied().fold(0.0, f64::max) * 1.02;
    let root = SVGBackend::new(file, (900, 560)).into_drawing_area();
    root.fill(&WHITE).map_err(failed)?;
    let mut chart = ChartBuilder::on(&root)
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(80)
        .build_cartesian_2d(0.0..right, (low..high).log_scale())
        .map_err(failed)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .label_style(("sans-serif", TEXT))
        .axis_desc_style(("sans-serif", TEXT))
        .x_desc(study.label)
        .y_desc("largest stable stiffness, N/m")
        .y_label_formatter(&|n_per_m| format!("{n_per_m:.0}"))
        .draw()
        .map_err(failed)?;
    for (line, curve) in LINES.iter().zip(curves) {
        let style = line.colour.stroke_width(2);
        let points: Vec<(f64, f64)> = curve.iter().filter_map(|&(x, y)| Some((x, y?))).collect();
        let legend = move |at: (i32, i32)| {
            let dash = if line.passivity { 8 } else { 24 };
            PathElement::new([at, (at.0 + dash, at.1)], style)
        };
        if line.passivity {
            let dashed = DashedLineSeries::new(points.iter().copied(), 6, 4, style);
            chart.draw_series(dashed).map_err(failed)?.label(line.name).legend(legend);
        } else {
            let solid = LineSeries::new(points.iter().copied(), style);
            chart.draw_series(solid).map_err(failed)?.label(line.name).legend(legend);
        }
        let marks = points.iter().map(|&at| Circle::new(at, 3, line.colour.filled()));
        chart.draw_series(marks).map_err(failed)?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .label_font(("sans-serif", TEXT))
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.2))
        .draw()
        .map_err(failed)?;
    root.present().map_err(failed)
}
