//! The surface that is calibrated: one closed piece in metres that does not cross itself.

use anyhow::{bail, ensure};
use rhombus_chain::{Body, SurfaceMesh};
use scene::{BodyKind, MeshFile, SceneError};

use super::crossing;

/// A body, and what its file says besides.
pub(super) struct Surface {
    pub(super) body: Body,
    /// Colours of the vertices, where the file has any.
    pub(super) colours: Vec<Option<[f64; 3]>>,
}

/// Longest extents of what may be an organ, m: a biopsy to a whole patient.
const EXTENT_M: std::ops::RangeInclusive<f64> = 0.005..=2.0;

/// Reads an OBJ file, or makes a generated body.
///
/// # Errors
/// What `MeshFile` refuses; a size no organ has; several pieces; a surface that crosses itself. All say where.
pub(super) fn read(name: &str, scale: f64) -> anyhow::Result<Surface> {
    let file = match name.parse::<BodyKind>() {
        Ok(kind) => MeshFile::generated(kind),
        Err(_) => MeshFile::read(name.as_ref())?,
    };
    let colours = file.colours();
    let mesh = file.surface(scale).map_err(|error: SceneError| anyhow::anyhow!("--body {error}"))?;
    check_size(name, &mesh, scale)?;
    check_one_piece(name, &mesh)?;
    if let Some(crossing::Crossing { triangles: [a, b], near }) = crossing::find(&mesh) {
        bail!(
            "--body {name}: the surface crosses itself: triangles {a} and {b} (counted from 0) meet near {near} m; accepted: a \
             surface without self-intersections (repair it in the program that made it)"
        );
    }
    Ok(Surface { body: Body::new(mesh), colours })
}

fn check_size(name: &str, mesh: &SurfaceMesh, scale: f64) -> anyhow::Result<()> {
    let [low, high] = mesh.extents();
    let size = high - low;
    let longest_m = size.max_element();
    if EXTENT_M.contains(&longest_m) {
        return Ok(());
    }
    // Millimetres, then other units, taken for metres.
    const FACTORS: [f64; 6] = [1e-3, 1e-2, 1e3, 1e-6, 1e-1, 1e1];
    let likely = FACTORS.into_iter().find(|factor| (0.02..=1.0).contains(&(longest_m * factor)));
    let hint = match likely {
        Some(factor) => {
            format!("; is it in another unit? --scale {:?} makes it a likely size", scale * factor)
        }
        None => String::new(),
    };
    bail!(
        "--body {name}: {:.4} x {:.4} x {:.4} m; accepted: a longest side of {} to {} m{hint}",
        size.x,
        size.y,
        size.z,
        EXTENT_M.start(),
        EXTENT_M.end()
    );
}

fn check_one_piece(name: &str, mesh: &SurfaceMesh) -> anyhow::Result<()> {
    let mut seen = vec![false; mesh.vertices().len()];
    let mut pieces = Vec::new();
    for start in 0..seen.len() {
        if seen[start] {
            continue;
        }
        pieces.push(start);
        let mut waiting = vec![start as u32];
        seen[start] = true;
        while let Some(vertex) = waiting.pop() {
            for next in mesh.neighbours(vertex) {
                if !std::mem::replace(&mut seen[next as usize], true) {
                    waiting.push(next);
                }
            }
        }
    }
    let where_else = pieces.get(1).copied().unwrap_or_default();
    ensure!(
        pieces.len() == 1,
        "--body {name}: {} separate surfaces (vertex {where_else}, counted from 0, at {} m is on the second one); accepted: one \
         closed surface without cavities",
        pieces.len(),
        mesh.vertices()[where_else]
    );
    Ok(())
}
