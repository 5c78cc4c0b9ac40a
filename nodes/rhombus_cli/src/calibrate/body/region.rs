//! Parts of a body as the command line names them.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{Context, bail, ensure};
use glam::DVec3;
use rhombus_chain::{Body, SurfaceMesh};
use serde_json::{Value, json};

/// What a region may be, with the text it was given as.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Region {
    text: String,
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// `n.x <= d`.
    Plane { normal: DVec3, d: f64 },
    /// Between two corners.
    Box { low: DVec3, high: DVec3 },
    /// Within a distance.
    Ball { centre: DVec3, radius_m: f64 },
    /// Vertex numbers in a file.
    Vertices(PathBuf),
    /// Vertices painted so.
    Colour([u8; 3]),
    /// Vertices whose normal points so, up to a cosine.
    Facing { direction: DVec3, cosine: f64 },
}

/// Colours of a mesh file are fractions; those of a region are bytes.
const SAME_COLOUR: f64 = 1.0 / 255.0 + 1e-9;

const FORMS: &str = "plane:NX,NY,NZ,D, box:X0,Y0,Z0,X1,Y1,Z1, ball:X,Y,Z,R, vertices:FILE, colour:#RRGGBB or \
                     facing:NX,NY,NZ,COSINE";

impl FromStr for Region {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (kind, rest) = text.split_once(':').ok_or_else(|| format!("accepted: {FORMS}"))?;
        let shape = match kind {
            "plane" => {
                let [x, y, z, d] = numbers(rest, "plane:NX,NY,NZ,D in m")?;
                Shape::Plane { normal: direction(x, y, z)?, d }
            }
            "box" => {
                let [x0, y0, z0, x1, y1, z1] = numbers(rest, "box:X0,Y0,Z0,X1,Y1,Z1 in m")?;
                let (low, high) = (DVec3::new(x0, y0, z0), DVec3::new(x1, y1, z1));
                if !low.cmplt(high).all() {
                    return Err("a box without an inside; accepted: the smaller corner first".to_owned());
                }
                Shape::Box { low, high }
            }
            "ball" => {
                let [x, y, z, radius_m] = numbers(rest, "ball:X,Y,Z,R in m")?;
                if radius_m <= 0.0 {
                    return Err(format!("radius {radius_m}; accepted: greater than 0, m"));
                }
                Shape::Ball { centre: DVec3::new(x, y, z), radius_m }
            }
            "vertices" if !rest.is_empty() => Shape::Vertices(PathBuf::from(rest)),
            "colour" => Shape::Colour(colour(rest).ok_or("accepted: colour:#RRGGBB, as colour:#ff0000")?),
            "facing" => {
                let [x, y, z, cosine] = numbers(rest, "facing:NX,NY,NZ,COSINE")?;
                if !(-1.0..=1.0).contains(&cosine) {
                    return Err(format!("cosine {cosine}; accepted: -1 to 1"));
                }
                Shape::Facing { direction: direction(x, y, z)?.normalize_or_zero(), cosine }
            }
            _ => return Err(format!("accepted: {FORMS}")),
        };
        Ok(Self { text: text.to_owned(), shape })
    }
}

/// So many finite numbers between commas.
fn numbers<const N: usize>(text: &str, form: &str) -> Result<[f64; N], String> {
    let parsed: Option<Vec<f64>> = text
        .split(',')
        .map(|word| word.trim().parse().ok().filter(|number: &f64| number.is_finite()))
        .collect();
    parsed
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| format!("{text:?}: accepted: {form}, {N} finite numbers"))
}

fn direction(x: f64, y: f64, z: f64) -> Result<DVec3, String> {
    let direction = DVec3::new(x, y, z);
    let usable = direction.try_normalize().is_some();
    usable.then_some(direction).ok_or_else(|| format!("direction {x},{y},{z}; accepted: not 0"))
}

fn colour(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6 && digits.is_ascii())?;
    let part = |k: usize| u8::from_str_radix(&digits[2 * k..2 * k + 2], 16).ok();
    Some([part(0)?, part(1)?, part(2)?])
}

impl Region {
    /// As it was given.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// The same with the bare name of a file: the same words wherever the file lies.
    pub(super) fn words(&self) -> String {
        match &self.shape {
            Shape::Vertices(path) => {
                format!("vertices:{}", path.file_name().unwrap_or(path.as_os_str()).to_string_lossy())
            }
            _ => self.text.clone(),
        }
    }

    /// Which vertices of a surface belong to it. `colours`: those of its file, where it has any.
    pub(super) fn vertices(
        &self,
        mesh: &SurfaceMesh,
        colours: &[Option<[f64; 3]>],
    ) -> anyhow::Result<Vec<bool>> {
        let total = mesh.vertices().len();
        let places = |inside: &dyn Fn(DVec3) -> bool| mesh.vertices().iter().map(|v| inside(*v)).collect();
        Ok(match &self.shape {
            Shape::Plane { normal, d } => places(&|v| normal.dot(v) <= *d),
            Shape::Box { low, high } => places(&|v| low.cmple(v).all() && v.cmple(*high).all()),
            Shape::Ball { centre, radius_m } => places(&|v| v.distance(*centre) <= *radius_m),
            Shape::Facing { direction, cosine } => {
                mesh.vertex_normals().iter().map(|n| n.dot(*direction) >= *cosine).collect()
            }
            Shape::Colour(wanted) => {
                ensure!(
                    colours.iter().any(Option::is_some),
                    "{}: the mesh has no vertex colours; accepted: an OBJ file with lines \"v x y z r g b\"",
                    self.text
                );
                let same = |colour: &[f64; 3]| {
                    colour.iter().zip(wanted).all(|(c, w)| (c - f64::from(*w) / 255.0).abs() <= SAME_COLOUR)
                };
                colours.iter().map(|colour| colour.as_ref().is_some_and(same)).collect()
            }
            Shape::Vertices(path) => {
                let mut inside = vec![false; total];
                for vertex in listed(path, total)? {
                    inside[vertex] = true;
                }
                inside
            }
        })
    }

    /// As the Python programs read a part of the inside; `None` for regions that only a surface has.
    pub(super) fn solid(&self) -> Option<Value> {
        match &self.shape {
            Shape::Plane { normal: n, d } => Some(json!({"plane": [n.x, n.y, n.z, d]})),
            Shape::Box { low: a, high: b } => Some(json!({"box": [a.x, a.y, a.z, b.x, b.y, b.z]})),
            Shape::Ball { centre: c, radius_m } => Some(json!({"ball": [c.x, c.y, c.z, radius_m]})),
            _ => None,
        }
    }

    /// A region without tissue is a slip in a coordinate or unit.
    pub(super) fn check_meets(&self, body: &Body) -> anyhow::Result<()> {
        let mesh = body.mesh();
        let all = self.vertices(mesh, &[])?;
        let meets = all.contains(&true)
            || match &self.shape {
                Shape::Ball { centre, radius_m } => {
                    body.index().encloses(mesh, *centre)
                        || body.index().closest(mesh, *centre, *radius_m).is_some()
                }
                Shape::Box { low, high } => {
                    grid(*low, *high, mesh.extents()).any(|point| body.index().encloses(mesh, point))
                }
                _ => false,
            };
        ensure!(
            meets,
            "--second-region {}: no tissue lies there; accepted: a region that meets the body",
            self.text
        );
        if all.iter().all(|inside| *inside) {
            bail!(
                "--second-region {}: all of the body lies there; accepted: a part of it, or --young alone",
                self.text
            );
        }
        Ok(())
    }
}

/// Points all over the part of a box that lies in another one.
fn grid(low: DVec3, high: DVec3, [from, to]: [DVec3; 2]) -> impl Iterator<Item = DVec3> {
    const STEPS: usize = 16;
    let (low, high) = (low.max(from), high.min(to));
    let overlap = low.cmple(high).all();
    let along = |k: usize| (k as f64 + 0.5) / STEPS as f64;
    (0..STEPS * STEPS * STEPS).filter(move |_| overlap).map(move |k| {
        let share = DVec3::new(along(k % STEPS), along(k / STEPS % STEPS), along(k / STEPS / STEPS));
        low + (high - low) * share
    })
}

/// Vertex numbers from 0, one for each line or between commas; `#` starts a comment.
fn listed(path: &Path, vertices: usize) -> anyhow::Result<Vec<usize>> {
    let text = std::fs::read_to_string(path)
        .with_context(|| format!("--fixed: {}: cannot be read", path.display()))?;
    let mut found = Vec::new();
    for (line, text) in text.lines().enumerate() {
        let text = text.split('#').next().unwrap_or_default();
        for word in text.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty()) {
            let number = word.parse().ok().filter(|vertex| *vertex < vertices);
            found.push(number.with_context(|| {
                format!(
                    "{}:{}: {word:?}; accepted: vertex numbers from 0 to {}",
                    path.display(),
                    line + 1,
                    vertices.saturating_sub(1)
                )
            })?);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_region_says_what_is_accepted() {
        for (text, words) in [
            ("bottom", "accepted: plane:NX,NY,NZ,D, box:"),
            ("plane:0,0,1", "accepted: plane:NX,NY,NZ,D in m, 4 finite numbers"),
            ("plane:0,0,0,1", "direction 0,0,0; accepted: not 0"),
            ("plane:0,0,nan,1", "4 finite numbers"),
            ("box:0,0,0,1,1,0", "a box without an inside"),
            ("ball:0,0,0,-1", "radius -1; accepted: greater than 0"),
            ("colour:red", "accepted: colour:#RRGGBB"),
            ("facing:0,0,1,2", "cosine 2; accepted: -1 to 1"),
            ("vertices:", "accepted: plane"),
        ] {
            let error = text.parse::<Region>().unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
    }
}
