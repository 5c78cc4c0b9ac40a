//! `rhombus mesh`: make bodies, look at mesh files, find places to press, say where they are stiff.

mod stiffness;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Args, Subcommand, ValueHint};
use rhombus_chain::{Body, Inspection};
use scene::{BodyKind, MeshFile, Obj, SceneError, generate, sites};
use serde::Serialize;

use crate::output;

/// Make, inspect and use body meshes
#[derive(Subcommand)]
pub(crate) enum Mesh {
    Make(Make),
    Info(Info),
    Sites(Sites),
    Stiffness(stiffness::Stiffness),
}

impl Mesh {
    pub(crate) fn run(self) -> anyhow::Result<()> {
        match self {
            Mesh::Make(command) => command.run(),
            Mesh::Info(command) => command.run(),
            Mesh::Sites(command) => command.run(),
            Mesh::Stiffness(command) => command.run(),
        }
    }
}

/// Write a generated body as an OBJ file, in metres
#[derive(Args)]
pub(crate) struct Make {
    /// liver, block or sphere
    kind: BodyKind,
    /// Number of vertices; the block takes the nearest a box of square cells can have
    #[arg(long, value_name = "N")]
    vertices: Option<usize>,
    /// File to write
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: PathBuf,
}

impl Make {
    fn run(self) -> anyhow::Result<()> {
        let asked = self.vertices.unwrap_or(self.kind.default_vertices());
        let accepted = self.kind.fewest_vertices()..=generate::MOST_VERTICES;
        anyhow::ensure!(
            accepted.contains(&asked),
            "--vertices {asked} is not accepted for a {}; accepted: {} to {}",
            self.kind.name(),
            accepted.start(),
            accepted.end()
        );
        let shape = generate::body(self.kind, asked);
        let (vertices, triangles) = (shape.vertices.len(), shape.triangles.len());
        let comment = format!(
            "{}, {vertices} vertices, {triangles} triangles, metres\nmade by: rhombus mesh make {} --vertices {vertices}",
            self.kind.name(),
            self.kind.name()
        );
        let obj = Obj { comment: &comment, vertices: &shape.vertices, triangles: &shape.triangles };
        let path = self.output.display();
        std::fs::write(&self.output, obj.to_string())
            .with_context(|| format!("{path}: cannot be written"))?;
        let nearest = if vertices == asked { "" } else { ", the nearest to what was asked for" };
        output::text(&format!("{path}: {vertices} vertices{nearest}, {triangles} triangles\n"))
    }
}

/// What a mesh file holds, and whether it can be a body
#[derive(Args)]
pub(crate) struct Info {
    #[command(flatten)]
    mesh: MeshArgument,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct MeshArgument {
    /// OBJ file, or liver, block or sphere as in body.mesh
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Factor that makes the file's coordinates metres, as body.scale
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = scale)]
    scale: f64,
}

fn scale(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0);
    number.ok_or_else(|| "accepted: a finite number > 0".to_owned())
}

impl MeshArgument {
    fn read(&self) -> Result<MeshFile, SceneError> {
        let mut mesh = match self.file.to_str().and_then(|name| name.parse::<BodyKind>().ok()) {
            Some(kind) => MeshFile::generated(kind),
            None => MeshFile::read(&self.file)?,
        };
        for vertex in &mut mesh.vertices {
            *vertex *= self.scale;
        }
        Ok(mesh)
    }
}

/// Field names and their order are the JSON.
#[derive(Serialize)]
struct Report {
    file: PathBuf,
    vertices: usize,
    triangles: usize,
    closed: bool,
    manifold: bool,
    oriented: bool,
    parts: usize,
    volume_m3: Option<f64>,
    area_m2: f64,
    extents_m: Option<Extents>,
    degenerate_triangles: usize,
    open_edges: usize,
    non_manifold_edges: usize,
    misoriented_edges: usize,
    non_manifold_vertices: usize,
    unreferenced_vertices: usize,
    accepted: bool,
    problem: Option<String>,
}

#[derive(Serialize)]
struct Extents {
    min: [f64; 3],
    max: [f64; 3],
    size: [f64; 3],
}

impl Info {
    fn run(self) -> anyhow::Result<()> {
        let mesh = self.mesh.read()?;
        let found = mesh.inspect();
        let problem = mesh.surface(1.0).err().map(|error| error.to_string());
        let report = Report::new(&self.mesh.file, &found, problem);
        match self.json {
            true => output::json(&report),
            false => output::text(&report.to_string()),
        }
    }
}

impl Report {
    fn new(file: &Path, found: &Inspection, problem: Option<String>) -> Report {
        Report {
            file: file.to_owned(),
            vertices: found.vertices,
            triangles: found.triangles,
            closed: found.is_closed(),
            manifold: found.is_manifold(),
            oriented: found.is_oriented(),
            parts: found.parts,
            volume_m3: found.volume_m3,
            area_m2: found.area_m2,
            extents_m: found.extents.map(|[min, max]| Extents {
                min: min.to_array(),
                max: max.to_array(),
                size: (max - min).to_array(),
            }),
            degenerate_triangles: found.degenerate_triangles,
            open_edges: found.open_edges,
            non_manifold_edges: found.non_manifold_edges,
            misoriented_edges: found.misoriented_edges,
            non_manifold_vertices: found.non_manifold_vertices,
            unreferenced_vertices: found.unreferenced_vertices,
            accepted: problem.is_none(),
            problem,
        }
    }
}

impl std::fmt::Display for Report {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let yes_no = |yes: bool| if yes { "yes" } else { "no" };
        writeln!(f, "vertices   {}", self.vertices)?;
        writeln!(f, "triangles  {}", self.triangles)?;
        writeln!(f, "closed     {}", yes_no(self.closed))?;
        writeln!(f, "manifold   {}", yes_no(self.manifold))?;
        writeln!(f, "oriented   {}", yes_no(self.oriented))?;
        writeln!(f, "parts      {}", self.parts)?;
        match self.volume_m3 {
            Some(volume) => writeln!(f, "volume     {volume:.6e} m3")?,
            None => writeln!(f, "volume     none: the surface encloses nothing")?,
        }
        writeln!(f, "area       {:.6e} m2", self.area_m2)?;
        if let Some(Extents { min, max, size }) = &self.extents_m {
            let axes = |[x, y, z]: &[f64; 3]| format!("{x:.6} {y:.6} {z:.6}");
            writeln!(f, "extents    {} m, from {} to {}", axes(size), axes(min), axes(max))?;
        }
        match &self.problem {
            Some(problem) => writeln!(f, "accepted   no: {problem}"),
            None => writeln!(f, "accepted   yes"),
        }
    }
}

/// Good places to press: flat, thick, well apart; the best first
#[derive(Args)]
pub(crate) struct Sites {
    #[command(flatten)]
    mesh: MeshArgument,
    /// How many
    #[arg(long, value_name = "N", default_value_t = 5)]
    count: usize,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct SiteReport {
    vertex: u32,
    point_m: [f64; 3],
    normal: [f64; 3],
}

impl Sites {
    fn run(self) -> anyhow::Result<()> {
        let body = Body::new(self.mesh.read()?.surface(1.0)?);
        let found: Vec<SiteReport> = sites(&body, self.count)
            .into_iter()
            .map(|site| SiteReport {
                vertex: site.vertex,
                point_m: site.point.to_array(),
                normal: site.normal.to_array(),
            })
            .collect();
        if self.json {
            return output::json(&found);
        }
        let mut text = "vertex            point m                          outward normal\n".to_owned();
        for SiteReport { vertex, point_m: [x, y, z], normal: [nx, ny, nz] } in &found {
            writeln!(text, "{vertex:>6}  {x:>9.6} {y:>9.6} {z:>9.6}   {nx:>9.6} {ny:>9.6} {nz:>9.6}")?;
        }
        output::text(&text)
    }
}
