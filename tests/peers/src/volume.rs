//! Tetrahedra of a body: read from a file, or cut from a block.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Error, Read};
use std::path::Path;

use glam::DVec3;
use npyz::{NpyFile, Order};
use rhombus_chain::SurfaceMesh;
use thiserror::Error as ThisError;
use zip::ZipArchive;

/// A body filled with tetrahedra.
#[derive(Clone, Debug, PartialEq)]
pub struct TetMesh {
    /// Node positions in m; the first [`surface_vertices`](Self::surface_vertices) are the surface's, in its order.
    pub nodes: Vec<DVec3>,
    /// Corner nodes of the tetrahedra, each of positive volume.
    pub tets: Vec<[u32; 4]>,
    /// How many of the nodes are vertices of the surface.
    pub surface_vertices: usize,
    /// For each vertex of the surface: whether it is held.
    pub fixed: Vec<bool>,
}

/// Why a file of tetrahedra is refused.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum VolumeError {
    /// The file cannot be read as numpy's npz.
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: String,
        /// What the system says.
        source: Error,
    },
    /// An array is missing or of another form.
    #[error("{path}: array '{array}': {why}")]
    Array {
        /// The file.
        path: String,
        /// The array's name in the file.
        array: &'static str,
        /// What is wrong, and what is accepted.
        why: String,
    },
}

/// Reads one array of a file: its numbers in C order.
struct Arrays<'a> {
    path: &'a Path,
    archive: ZipArchive<BufReader<File>>,
}

impl Arrays<'_> {
    fn fault(&self, array: &'static str, why: String) -> VolumeError {
        VolumeError::Array { path: self.path.display().to_string(), array, why }
    }

    fn bytes(&mut self, array: &str) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        self.archive.by_name(&format!("{array}.npy"))?.read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    /// `columns` 1 is a list, more is a table of that width.
    fn read<T: npyz::Deserialize>(
        &mut self,
        array: &'static str,
        columns: u64,
    ) -> Result<Vec<T>, VolumeError> {
        let bytes = self.bytes(array).map_err(|error| self.fault(array, error.to_string()))?;
        let file = NpyFile::new(&bytes[..]).map_err(|error| self.fault(array, error.to_string()))?;
        let fits = match file.shape() {
            [_] => columns == 1,
            [_, width] => *width == columns,
            _ => false,
        };
        if !fits || file.order() != Order::C {
            let why = format!(
                "shape {:?}, {:?} order; expected {columns} columns, C order",
                file.shape(),
                file.order()
            );
            return Err(self.fault(array, why));
        }
        file.into_vec().map_err(|error| self.fault(array, error.to_string()))
    }
}

impl TetMesh {
    /// Reads `nodes` (N, 3) f8 in m, `tets` (T, 4) i4 and `fixed` (V,) u1 of an npz file: the first V nodes are the
    /// vertices of the surface.
    ///
    /// # Errors
    /// The file cannot be read, an array is missing or of another type or shape, a node does not exist or is not finite, or a
    /// tetrahedron has no positive volume.
    pub fn read(path: &Path) -> Result<Self, VolumeError> {
        let file_fault = |source| VolumeError::File { path: path.display().to_string(), source };
        let file = File::open(path).map_err(file_fault)?;
        let archive = ZipArchive::new(BufReader::new(file)).map_err(|error| file_fault(error.into()))?;
        let mut arrays = Arrays { path, archive };
        let nodes: Vec<DVec3> =
            arrays.read::<f64>("nodes", 3)?.chunks_exact(3).map(DVec3::from_slice).collect();
        let corners = arrays.read::<i32>("tets", 4)?;
        let fixed: Vec<bool> = arrays.read::<u8>("fixed", 1)?.into_iter().map(|held| held != 0).collect();
        if let Some(node) = nodes.iter().position(|at| !at.is_finite()) {
            return Err(arrays.fault("nodes", format!("node {node} is not finite")));
        }
        if fixed.len() > nodes.len() {
            return Err(arrays.fault("fixed", format!("{} entries for {} nodes", fixed.len(), nodes.len())));
        }
        let mut tets = Vec::with_capacity(corners.len() / 4);
        for corner in corners.chunks_exact(4) {
            let mut tet = [0u32; 4];
            for (to, &from) in tet.iter_mut().zip(corner) {
                let known = u32::try_from(from).ok().filter(|&node| (node as usize) < nodes.len());
                *to = known.ok_or_else(|| arrays.fault("tets", format!("there is no node {from}")))?;
            }
            if volume_m3(&nodes, tet) <= 0.0 {
                let why = format!("tetrahedron {} has no positive volume", tets.len());
                return Err(arrays.fault("tets", why));
            }
            tets.push(tet);
        }
        Ok(Self { surface_vertices: fixed.len(), nodes, tets, fixed })
    }

    /// A block with nodes at all combinations of ascending coordinates (two or more in each direction), six tetrahedra in
    /// each cell, held at its lowest z; and its surface. Bodies whose answers are known.
    ///
    /// # Panics
    /// When the coordinates are not those of a block.
    #[must_use]
    pub fn block(x_m: &[f64], y_m: &[f64], z_m: &[f64]) -> (SurfaceMesh, Self) {
        let sizes = [x_m.len(), y_m.len(), z_m.len()];
        let mut positions = Vec::new();
        for &z in z_m {
            for &y in y_m {
                positions.extend(x_m.iter().map(|&x| DVec3::new(x, y, z)));
            }
        }
        let number = |cell: [usize; 3]| cell[0] + sizes[0] * (cell[1] + sizes[1] * cell[2]);
        let mut tets = Vec::new();
        for k in 0..sizes[2] - 1 {
            for j in 0..sizes[1] - 1 {
                for i in 0..sizes[0] - 1 {
                    tets.extend(cell_paths().map(|path| path.map(|[a, b, c]| number([i + a, j + b, k + c]))));
                }
            }
        }
        surface_first(&positions, &tets)
    }
}

/// The six tetrahedra of a cube: one for each order in which x, y and z step from corner 0 to corner 7 (Kuhn), the last two
/// corners exchanged where needed for a positive volume.
fn cell_paths() -> impl Iterator<Item = [[usize; 3]; 4]> {
    let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    orders.into_iter().enumerate().map(|(which, order)| {
        let mut path = [[0; 3]; 4];
        for step in 0..3 {
            path[step + 1] = path[step];
            path[step + 1][order[step]] = 1;
        }
        if which >= 3 {
            path.swap(2, 3);
        }
        path
    })
}

/// Renumbers: surface nodes first.
#[expect(clippy::expect_used, reason = "documented: coordinates that are not those of a block panic")]
fn surface_first(positions: &[DVec3], tets: &[[usize; 4]]) -> (SurfaceMesh, TetMesh) {
    let mut once = BTreeMap::new();
    for &[a, b, c, d] in tets {
        for face in [[b, c, d], [a, d, c], [a, b, d], [a, c, b]] {
            let mut key = face;
            key.sort_unstable();
            if once.remove(&key).is_none() {
                once.insert(key, face);
            }
        }
    }
    let mut on_surface = vec![false; positions.len()];
    for &node in once.values().flatten() {
        on_surface[node] = true;
    }
    let mut old = Vec::with_capacity(positions.len());
    old.extend((0..positions.len()).filter(|&node| on_surface[node]));
    let surface_vertices = old.len();
    old.extend((0..positions.len()).filter(|&node| !on_surface[node]));
    let mut new = vec![0u32; positions.len()];
    for (to, &from) in (0u32..).zip(&old) {
        new[from] = to;
    }
    let nodes: Vec<DVec3> = old.iter().map(|&node| positions[node]).collect();
    let lowest = nodes.iter().map(|at| at.z).fold(f64::INFINITY, f64::min);
    let vertices = nodes[..surface_vertices].to_vec();
    let fixed = vertices.iter().map(|at| at.z <= lowest).collect();
    let triangles = once.values().map(|face| face.map(|node| new[node])).collect();
    let surface = SurfaceMesh::new(vertices, triangles).expect("a block has a closed surface");
    let tets = tets.iter().map(|tet| tet.map(|node| new[node])).collect();
    (surface, TetMesh { nodes, tets, surface_vertices, fixed })
}

/// Signed volume of a tetrahedron.
fn volume_m3(nodes: &[DVec3], tet: [u32; 4]) -> f64 {
    let [a, b, c, d] = tet.map(|node| nodes[node as usize]);
    (b - a).cross(c - a).dot(d - a) / 6.0
}

#[cfg(test)]
mod tests {
    use super::{TetMesh, volume_m3};
    use std::path::Path;

    #[test]
    fn a_block_is_filled_once_and_its_surface_encloses_it() {
        let (surface, volume) = TetMesh::block(&[0.0, 0.3, 0.5, 1.0], &[0.0, 1.0, 2.0], &[-1.0, -0.25, 0.0]);
        let volumes: Vec<f64> = volume.tets.iter().map(|&tet| volume_m3(&volume.nodes, tet)).collect();
        assert!(volumes.iter().all(|&volume| volume > 0.0));
        assert!((volumes.iter().sum::<f64>() - 2.0).abs() < 1e-12);
        assert!((surface.volume_m3() - 2.0).abs() < 1e-12);
        assert_eq!(volume.nodes.len(), 36);
        assert_eq!(volume.surface_vertices, 34);
        assert_eq!(volume.fixed.iter().filter(|&&held| held).count(), 12);
        assert_eq!(surface.vertices(), &volume.nodes[..34]);
    }

    #[test]
    fn the_tetrahedra_of_the_liver_fill_it() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../reference/tets");
        let volume = TetMesh::read(&folder.join("liver_500.npz")).unwrap();
        assert_eq!(volume.surface_vertices, 500);
        let held = volume.fixed.iter().filter(|&&held| held).count();
        assert!(held > 3 && held < 250, "{held}");
        let total: f64 = volume.tets.iter().map(|&tet| volume_m3(&volume.nodes, tet)).sum();
        assert!(total > 0.0005 && total < 0.002, "{total} m³");
    }

    #[test]
    fn what_is_not_a_file_of_tetrahedra_is_named() {
        let error = TetMesh::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml")).unwrap_err();
        assert!(error.to_string().contains("Cargo.toml: "), "{error}");
        let error = TetMesh::read(Path::new("nowhere.npz")).unwrap_err();
        assert!(error.to_string().starts_with("nowhere.npz: "), "{error}");
    }
}
