//! Mesh files: Wavefront OBJ in, a checked surface out; and back.
//!
//! Only positions, faces and the vertices' colours are used; groups, materials, normals and texture coordinates are skipped. Vertices keep
//! the numbers they have in the file, so that messages, recordings and other programs mean the same vertex.

mod statements;

use std::fmt;
use std::path::Path;

use glam::DVec3;
use rhombus_chain::{Inspection, MeshError, SurfaceMesh, inspect};

use crate::generate::{self, Shape};
use crate::{BodyKind, Problem, SceneError};
use statements::Statements;

/// What a mesh file holds, in file units, before it is known to be a closed surface.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    name: String,
    /// Vertices in file order.
    pub vertices: Vec<DVec3>,
    /// Triangles in file order, vertices counted from 0; a face with more corners is cut into a fan, which is right
    /// for convex faces.
    pub triangles: Vec<[u32; 3]>,
    /// Red, green and blue of each vertex, as written; none where its line has no colour.
    colours: Vec<Option<[f64; 3]>>,
    vertex_lines: Vec<u32>,
    triangle_lines: Vec<u32>,
}

impl MeshFile {
    /// Reads an OBJ file.
    ///
    /// # Errors
    /// The file cannot be read, is empty, or has a line that is not accepted; the error names the line.
    pub fn read(path: &Path) -> Result<MeshFile, SceneError> {
        let name = path.display().to_string();
        match std::fs::read(path) {
            Ok(bytes) => MeshFile::parse(&name, &bytes),
            Err(error) => Err(SceneError {
                file: name,
                line: None,
                key: None,
                problem: Box::new(Problem::Unreadable(error)),
            }),
        }
    }

    /// Reads OBJ text; `name` stands for the file in messages.
    ///
    /// # Errors
    /// As [`MeshFile::read`].
    pub fn parse(name: &str, text: &[u8]) -> Result<MeshFile, SceneError> {
        let Statements { vertices, triangles, colours, vertex_lines, triangle_lines } =
            Statements::read(text).map_err(|(line, message)| SceneError {
                file: name.to_owned(),
                line,
                key: None,
                problem: Box::new(Problem::Mesh(message)),
            })?;
        Ok(MeshFile { name: name.to_owned(), vertices, triangles, colours, vertex_lines, triangle_lines })
    }

    /// A generated body with its default number of vertices, as if it had been read from a file of the body's name.
    pub fn generated(kind: BodyKind) -> MeshFile {
        let Shape { vertices, triangles } = generate::body(kind, kind.default_vertices());
        let name = kind.name().to_owned();
        let (colours, vertex_lines, triangle_lines) = (Vec::new(), Vec::new(), Vec::new());
        MeshFile { name, vertices, triangles, colours, vertex_lines, triangle_lines }
    }

    /// Counts and measures, whatever is wrong with the surface.
    pub fn inspect(&self) -> Inspection {
        inspect(&self.vertices, &self.triangles)
    }

    /// Red, green and blue of each vertex, 0 to 1 as written; none where its line has no colour.
    #[must_use]
    pub fn colours(&self) -> Vec<Option<[f64; 3]>> {
        let mut colours = self.colours.clone();
        colours.resize(self.vertices.len(), None);
        colours
    }

    /// How light each vertex is painted, 0 (black) to 1 (white): 0.2126 red + 0.7152 green + 0.0722 blue.
    ///
    /// # Errors
    /// A vertex without a colour, or with one outside 0 to 1; the error names its line.
    pub fn luminances(&self) -> Result<Vec<f64>, SceneError> {
        let error = |vertex: usize, found: String| SceneError {
            file: self.name.clone(),
            line: self.vertex_lines.get(vertex).map(|line| *line as usize),
            key: None,
            problem: Box::new(Problem::Mesh(format!(
                "vertex {vertex} (counted from 0) has {found}; accepted: v x y z r g b with colours from 0 to 1 for every \
                 vertex"
            ))),
        };
        (0..self.vertices.len())
            .map(|vertex| match self.colours.get(vertex) {
                Some(Some(colour)) if colour.iter().all(|part| (0.0..=1.0).contains(part)) => {
                    let [red, green, blue] = colour;
                    Ok(0.2126 * red + 0.7152 * green + 0.0722 * blue)
                }
                Some(Some([red, green, blue])) => {
                    Err(error(vertex, format!("the colour {red} {green} {blue}")))
                }
                _ => Err(error(vertex, "no colour".to_owned())),
            })
            .collect()
    }

    /// The surface in metres: coordinates times `scale`, checked to be closed, manifold and outward oriented.
    ///
    /// # Errors
    /// The first fault of the surface, with the line of the file where it is.
    pub fn surface(self, scale: f64) -> Result<SurfaceMesh, SceneError> {
        let scaled = self.vertices.iter().map(|v| *v * scale).collect();
        SurfaceMesh::new(scaled, self.triangles.clone()).map_err(|error| self.fault(&error))
    }

    fn fault(&self, error: &MeshError) -> SceneError {
        let line = match *error {
            MeshError::Coordinate { vertex, .. }
            | MeshError::NonManifoldVertex { vertex, .. }
            | MeshError::Unreferenced { vertex, .. } => self.vertex_lines.get(vertex),
            MeshError::IndexOutOfRange { triangle, .. }
            | MeshError::RepeatedCorner { triangle, .. }
            | MeshError::Degenerate { triangle, .. }
            | MeshError::OpenEdge { triangle, .. }
            | MeshError::NonManifoldEdge { triangle, .. }
            | MeshError::Flipped { triangle, .. } => self.triangle_lines.get(triangle),
            MeshError::InconsistentOrientation { triangles: [triangle, _], .. } => {
                self.triangle_lines.get(triangle)
            }
            _ => None,
        };
        let mut message = error.to_string();
        for vertex in places(error) {
            if let Some(at) = self.vertices.get(vertex) {
                message.push_str(&format!("; vertex {vertex} is at {at}"));
            }
        }
        message.push_str("; vertices and triangles are counted from 0");
        let doubles = self.double_vertices();
        if doubles > 0 && matches!(error, MeshError::OpenEdge { .. } | MeshError::Unreferenced { .. }) {
            message.push_str(&format!(
                "; {doubles} vertices lie exactly on another one: merge vertices by distance in the program that made \
                 the mesh"
            ));
        }
        SceneError {
            file: self.name.clone(),
            line: line.map(|line| *line as usize),
            key: None,
            problem: Box::new(Problem::Mesh(message)),
        }
    }

    /// How many vertices have the very position of an earlier one.
    fn double_vertices(&self) -> usize {
        let mut positions: Vec<[u64; 3]> = self
            .vertices
            .iter()
            // Adding 0 makes -0 and 0 one number.
            .map(|v| (*v + DVec3::ZERO).to_array().map(f64::to_bits))
            .collect();
        positions.sort_unstable();
        positions.windows(2).filter(|pair| pair[0] == pair[1]).count()
    }
}

/// Vertices that say where a fault is, for those errors that do not.
fn places(error: &MeshError) -> Vec<usize> {
    match error {
        MeshError::OpenEdge { edge, .. }
        | MeshError::NonManifoldEdge { edge, .. }
        | MeshError::InconsistentOrientation { edge, .. } => edge.iter().map(|v| *v as usize).collect(),
        MeshError::NonManifoldVertex { vertex, .. } | MeshError::Unreferenced { vertex, .. } => vec![*vertex],
        MeshError::RepeatedCorner { corners, .. } | MeshError::Degenerate { corners, .. } => {
            vec![corners[0] as usize]
        }
        _ => Vec::new(),
    }
}

/// A surface as OBJ text; coordinates read back to the same bits.
pub struct Obj<'a> {
    /// Comment lines at the top, without `#`.
    pub comment: &'a str,
    /// Vertices in metres.
    pub vertices: &'a [DVec3],
    /// Triangles, vertices counted from 0.
    pub triangles: &'a [[u32; 3]],
}

impl fmt::Display for Obj<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for line in self.comment.lines() {
            writeln!(f, "# {line}")?;
        }
        for v in self.vertices {
            writeln!(f, "v {:?} {:?} {:?}", v.x, v.y, v.z)?;
        }
        for [a, b, c] in self.triangles {
            // OBJ counts from 1; in 64 bits the last 32-bit index does too.
            let [a, b, c] = [a, b, c].map(|index| u64::from(*index) + 1);
            writeln!(f, "f {a} {b} {c}")?;
        }
        Ok(())
    }
}
