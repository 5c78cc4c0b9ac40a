//! Reference solutions of a body: what 3-D elasticity says about pressing it at many sites, one unit depth each.
//!
//! A file is an `.npz` of numpy with, for S sites on a surface of V vertices and T triangles:
//!
//! | array | shape | unit | meaning |
//! |---|---|---|---|
//! | `vertices` | V, 3 | m | rest positions |
//! | `faces` | T, 3 | | corners, counter-clockwise seen from outside |
//! | `fixed` | V | | 1 where the body is held |
//! | `site_vertex` | S or S, K | | the pressed vertex; K contacts at once |
//! | `point`, `normal` | S, 3 or S, K, 3 | m, 1 | its position and outward normal |
//! | `contact_radius` | S | m | radius of the rigid disc |
//! | `young`, `poisson` | S | Pa, 1 | material |
//! | `stiffness` | S or S, K | N/m | force on the hand for each metre of depth |
//! | `displacement` | S, V, 3 | 1 | m for each m of depth, body frame |
//! | `held_out` | S | | 1: never used to calibrate, only to judge |
//! | `depth` | S | m | only where the answer is not linear: the depth that a solution is of, divided by it like all others |

pub(crate) mod arrays;

use std::path::Path;

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

use arrays::Arrays;

/// Reference solutions on one surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The file, for messages.
    pub file: String,
    /// Rest positions, m.
    pub vertices: Vec<DVec3>,
    /// Corners of the triangles.
    pub faces: Vec<[u32; 3]>,
    /// Where the body is held, one for each vertex.
    pub fixed: Vec<bool>,
    /// The solutions, in file order.
    pub sites: Vec<ReferenceSite>,
}

/// One solution: a contact, or several at once, at unit depth.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceSite {
    /// The contacts, one or more.
    pub contacts: Vec<ReferenceContact>,
    /// Radius of each contact's disc, m.
    pub contact_radius_m: f64,
    /// Young's modulus, Pa.
    pub young_pa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Displacement of each vertex for each metre of depth, body frame.
    pub displacement: Vec<DVec3>,
    /// Never used to calibrate.
    pub held_out: bool,
    /// The depth that it is of, m, where it is not in proportion to the depth; force and displacement are divided by it.
    pub depth_m: Option<f64>,
}

/// Where a solution is pressed, and how hard the body answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceContact {
    /// The pressed vertex.
    pub vertex: u32,
    /// Its position, m.
    pub point: DVec3,
    /// Unit outward normal there.
    pub normal: DVec3,
    /// Force on the hand along the normal for each metre of depth, N/m.
    pub stiffness_n_per_m: f64,
}

/// Why a reference file is not accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReferenceError {
    /// The file.
    pub file: String,
    /// The array to blame, where it is one.
    pub array: Option<&'static str>,
    /// What is wrong, and what is accepted.
    pub problem: String,
}

impl std::fmt::Display for ReferenceError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.array {
            Some(array) => write!(f, "{}: {array}: {}", self.file, self.problem),
            None => write!(f, "{}: {}", self.file, self.problem),
        }
    }
}

impl std::error::Error for ReferenceError {}

/// Vertices of the reference may be this far from the mesh's, as a share of its largest extent.
const SAME_POSITION: f64 = 1e-6;

impl Reference {
    /// Reads a reference file.
    ///
    /// # Errors
    /// The file cannot be read, an array is missing or has another type or shape, a number makes no sense.
    pub fn read(path: &Path) -> Result<Self, ReferenceError> {
        let mut arrays = Arrays::open(path)?;
        let vertices = vectors(&arrays.shaped("vertices", &[0, 3])?);
        let v = vertices.len();
        let faces = arrays.shaped("faces", &[0, 3])?;
        let faces: Vec<[u32; 3]> =
            faces.chunks_exact(3).map(|t| [t[0] as u32, t[1] as u32, t[2] as u32]).collect();
        let fixed = flags(&arrays.shaped("fixed", &[v])?);
        let site_vertex = arrays.read("site_vertex")?;
        let (s, k) = match site_vertex.shape[..] {
            [s] => (s, 1),
            [s, k] if k > 0 => (s, k),
            _ => {
                let shape = &site_vertex.shape;
                return Err(arrays.error("site_vertex", format!("shape {shape:?}; accepted: S, or S and K")));
            }
        };
        let several = site_vertex.shape.len() == 2;
        let with_contacts =
            |last: &[usize]| [if several { vec![s, k] } else { vec![s] }, last.to_vec()].concat();
        let point = vectors(&arrays.shaped("point", &with_contacts(&[3]))?);
        let normal = vectors(&arrays.shaped("normal", &with_contacts(&[3]))?);
        let stiffness = arrays.shaped("stiffness", &with_contacts(&[]))?;
        let contact_radius = arrays.shaped("contact_radius", &[s])?;
        let young = arrays.shaped("young", &[s])?;
        let poisson = arrays.shaped("poisson", &[s])?;
        let displacement = vectors(&arrays.shaped("displacement", &[s, v, 3])?);
        let held_out = flags(&arrays.shaped("held_out", &[s])?);
        let depth = if arrays.has("depth") { Some(arrays.shaped("depth", &[s])?) } else { None };
        if let Some(place) = site_vertex.values.iter().position(|x| !(0.0..v as f64).contains(x)) {
            let value = site_vertex.values[place];
            let problem =
                format!("entry {place} is {value}; accepted: a vertex, 0 to {}", v.saturating_sub(1));
            return Err(arrays.error("site_vertex", problem));
        }
        let positive = [("stiffness", &stiffness), ("contact_radius", &contact_radius), ("young", &young)];
        for (name, values) in positive.into_iter().chain(depth.as_ref().map(|depth| ("depth", depth))) {
            if let Some(place) = values.iter().position(|x| *x <= 0.0) {
                let problem = format!("entry {place} is {}; accepted: greater than 0", values[place]);
                return Err(arrays.error(name, problem));
            }
        }
        if let Some(place) = normal.iter().position(|n| (n.length() - 1.0).abs() > 1e-3) {
            let problem = format!("entry {place} is {}; accepted: a unit vector", normal[place]);
            return Err(arrays.error("normal", problem));
        }
        let contact = |at: usize| ReferenceContact {
            vertex: site_vertex.values[at] as u32,
            point: point[at],
            normal: normal[at].normalize_or_zero(),
            stiffness_n_per_m: stiffness[at],
        };
        let sites = (0..s)
            .map(|site| ReferenceSite {
                contacts: (site * k..(site + 1) * k).map(contact).collect(),
                contact_radius_m: contact_radius[site],
                young_pa: young[site],
                poisson: poisson[site],
                displacement: displacement[site * v..(site + 1) * v].to_vec(),
                held_out: held_out[site],
                depth_m: depth.as_ref().map(|depth| depth[site]),
            })
            .collect();
        Ok(Self { file: path.display().to_string(), vertices, faces, fixed, sites })
    }

    /// Whether the reference was made on this surface: same vertices, same triangles, same order.
    ///
    /// # Errors
    /// What differs first.
    pub fn check_mesh(&self, mesh: &SurfaceMesh) -> Result<(), ReferenceError> {
        let error = |array, problem| ReferenceError { file: self.file.clone(), array: Some(array), problem };
        let accepted = "accepted: the references of the very mesh that is calibrated";
        let (found, expected) = (self.vertices.len(), mesh.vertices().len());
        if found != expected {
            return Err(error("vertices", format!("{found}, the mesh has {expected}; {accepted}")));
        }
        let [low, high] = mesh.extents();
        let tolerance_m = SAME_POSITION * (high - low).max_element();
        let apart = |(a, b): (&DVec3, &DVec3)| a.distance(*b) > tolerance_m;
        if let Some(vertex) = self.vertices.iter().zip(mesh.vertices()).position(apart) {
            let (there, here) = (self.vertices[vertex], mesh.vertices()[vertex]);
            let problem =
                format!("vertex {vertex} (from 0) is at {there} m, in the mesh at {here} m; {accepted}");
            return Err(error("vertices", problem));
        }
        if self.faces != mesh.triangles() {
            let (found, expected) = (self.faces.len(), mesh.triangles().len());
            let first = self.faces.iter().zip(mesh.triangles()).position(|(a, b)| a != b);
            let problem = match first {
                Some(face) => {
                    format!("triangle {face} (from 0) joins other vertices than the mesh's; {accepted}")
                }
                None => format!("{found}, the mesh has {expected}; {accepted}"),
            };
            return Err(error("faces", problem));
        }
        Ok(())
    }

    /// Numbers of the sites that a calibration may use.
    pub fn used(&self) -> Vec<usize> {
        (0..self.sites.len()).filter(|site| !self.sites[*site].held_out).collect()
    }

    /// Numbers of the sites that only judge.
    pub fn held_out(&self) -> Vec<usize> {
        (0..self.sites.len()).filter(|site| self.sites[*site].held_out).collect()
    }
}

fn vectors(values: &[f64]) -> Vec<DVec3> {
    values.chunks_exact(3).map(|v| DVec3::new(v[0], v[1], v[2])).collect()
}

fn flags(values: &[f64]) -> Vec<bool> {
    values.iter().map(|x| *x != 0.0).collect()
}
