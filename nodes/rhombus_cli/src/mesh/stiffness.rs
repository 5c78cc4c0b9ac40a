//! `rhombus mesh stiffness`: a `body.stiffness_map` from vertex colours, and stiff or soft balls by hand.

use std::path::PathBuf;

use anyhow::{Context, ensure};
use clap::{Args, ValueHint};
use glam::DVec3;
use rhombus_chain::StiffnessMap;
use scene::StiffnessFile;

use super::MeshArgument;
use crate::output;

/// Write a body.stiffness_map: a factor on the contact law for each vertex
///
/// From vertex colours (lines "v x y z r g b", 0 to 1): black becomes the factor --dark, white becomes --light, linear in
/// between over 0.2126 r + 0.7152 g + 0.0722 b. Without --dark and --light every factor is 1 to begin with. Balls come on
/// top of that: the factor is multiplied by FACTOR up to half the RADIUS from the ball's centre and by 1 from one and a half
/// RADIUS on, with a smooth step in between.
#[derive(Args)]
pub(crate) struct Stiffness {
    #[command(flatten)]
    mesh: MeshArgument,
    /// Factor of vertices painted black
    #[arg(long, value_name = "FACTOR", requires = "light", value_parser = factor)]
    dark: Option<f64>,
    /// Factor of vertices painted white
    #[arg(long, value_name = "FACTOR", requires = "dark", value_parser = factor)]
    light: Option<f64>,
    /// Centre and radius in metres (--scale included), and the factor inside; may be given several times
    #[arg(long, num_args = 5, value_names = ["X", "Y", "Z", "RADIUS", "FACTOR"], allow_negative_numbers = true,
          action = clap::ArgAction::Append)]
    ball: Vec<f64>,
    /// CSV file to write
    #[arg(short, long, value_name = "MAP.csv", value_hint = ValueHint::FilePath)]
    out: PathBuf,
}

fn factor(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| (1e-3..=1e3).contains(x));
    number.ok_or_else(|| "accepted: a number from 0.001 to 1000".to_owned())
}

/// Tissue that is stiffer or softer than what is around it.
struct Ball {
    centre: DVec3,
    radius_m: f64,
    factor: f64,
}

impl Ball {
    fn new(numbers: &[f64]) -> anyhow::Result<Ball> {
        let [x, y, z, radius_m, factor] = *numbers else {
            anyhow::bail!("--ball has {} numbers; accepted: X Y Z RADIUS FACTOR", numbers.len());
        };
        let centre = DVec3::new(x, y, z);
        ensure!(centre.is_finite(), "--ball {x} {y} {z}: accepted: finite coordinates, in m");
        ensure!(
            radius_m > 0.0 && radius_m.is_finite(),
            "--ball radius {radius_m}: accepted: a number > 0, in m"
        );
        ensure!(
            (1e-3..=1e3).contains(&factor),
            "--ball factor {factor}: accepted: a number from 0.001 to 1000"
        );
        Ok(Ball { centre, radius_m, factor })
    }

    /// 1 far outside, the factor inside.
    fn at(&self, point: DVec3) -> f64 {
        let share = (1.5 - point.distance(self.centre) / self.radius_m).clamp(0.0, 1.0);
        1.0 + (self.factor - 1.0) * (share * share * (3.0 - 2.0 * share))
    }

    /// A ball that changes nothing is a slip in its centre or unit.
    fn check_reach(&self, vertices: &[DVec3]) -> anyhow::Result<()> {
        let nearest = vertices.iter().map(|p| p.distance(self.centre)).fold(f64::INFINITY, f64::min);
        let reach_m = 1.5 * self.radius_m;
        ensure!(
            nearest < reach_m,
            "--ball at {}: the nearest vertex is {nearest:.4} m away and the ball reaches {reach_m:.4} m; accepted: a ball \
             that reaches a vertex",
            self.centre
        );
        Ok(())
    }
}

impl Stiffness {
    pub(crate) fn run(self) -> anyhow::Result<()> {
        ensure!(
            self.dark.is_some() || !self.ball.is_empty(),
            "nothing to write: accepted: --dark FACTOR --light FACTOR for a painted mesh, --ball X Y Z RADIUS FACTOR, or both"
        );
        let file = self.mesh.read()?;
        let mut factors = match (self.dark, self.light) {
            (Some(dark), Some(light)) => {
                file.luminances()?.into_iter().map(|y| (dark + y * (light - dark)).clamp(1e-3, 1e3)).collect()
            }
            _ => vec![1.0; file.vertices.len()],
        };
        for ball in self.ball.chunks(5).map(Ball::new) {
            let ball = ball?;
            ball.check_reach(&file.vertices)?;
            for (factor, vertex) in factors.iter_mut().zip(&file.vertices) {
                *factor *= ball.at(*vertex);
            }
        }
        let comment = self.comment();
        let text = StiffnessFile { comment: &comment, factors: &factors }.to_string();
        let map = StiffnessMap::new(factors, &file.surface(1.0)?)?;
        let path = self.out.display();
        std::fs::write(&self.out, text).with_context(|| format!("{path}: cannot be written"))?;
        let (low, high) = map.range();
        output::text(&format!("{path}: {low} to {high} times the contact law\n"))
    }

    fn comment(&self) -> String {
        let mut comment =
            format!("factors on the contact law for the vertices of {}", self.mesh.file.display());
        if let (Some(dark), Some(light)) = (self.dark, self.light) {
            comment.push_str(&format!("\nvertex colours: black {dark}, white {light}"));
        }
        for ball in self.ball.chunks(5) {
            let numbers: Vec<String> = ball.iter().map(f64::to_string).collect();
            comment.push_str(&format!("\nball x y z radius factor: {}", numbers.join(" ")));
        }
        comment
    }
}
