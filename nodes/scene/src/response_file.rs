//! `body.response`: the file of a calibrated body; in and out.
//!
//! ```text
//! RHOMBUS BODY RESPONSE 1\n         the format and its version
//! u32                               bytes of the header
//! header                            YAML: see ResponseHeader
//! f32 x V P (2 + 6 H)               coefficients, see rhombus_chain::ResponseParts
//! f32 x V J                         amplitudes of the body modes
//! f32 x J V 3                       body modes, body frame
//! f32 x V                           factors on the contact law
//! u32                               CRC-32 of all bytes before
//! ```
//!
//! Numbers are little-endian. A file is for one mesh and for chains of one shape; both are checked.

use std::io::Write as _;
use std::path::Path;

use rhombus_chain::{
    ChainParameters, ContactLaw, MOST_CHAINS, MOST_HARMONICS, MOST_MODES, Response, ResponseParts,
    StiffnessMap, SurfaceMesh,
};
use serde::{Deserialize, Serialize};

use crate::{Problem, SceneError};

const KEY: &str = "body.response";
const MAGIC: &[u8] = b"RHOMBUS BODY RESPONSE ";
const VERSION: u32 = 1;
/// More is no header: brackets alone would keep a YAML parser busy for seconds.
const LARGEST_HEADER: usize = 1 << 14;
const NUMBER: usize = size_of::<f32>();

/// What a calibrated body says about itself.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ResponseHeader {
    /// Vertices of the mesh, V.
    pub vertices: usize,
    /// CRC-32 of the mesh, see [`mesh_checksum`].
    pub mesh_crc32: u32,
    /// The shapes of the chains, P of them.
    pub chains: Vec<ChainShape>,
    /// Radius of the contact that it was made for, m.
    pub contact_radius_m: f64,
    /// H.
    pub harmonics: usize,
    /// J.
    pub modes: usize,
    /// How it was made: material, sites, command.
    #[serde(default)]
    pub made: Vec<String>,
    /// Errors at sites that were not used, by region.
    #[serde(default)]
    pub errors: Vec<RegionError>,
}

/// What decides the shape of a chain: the stiffness does not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainShape {
    /// q.
    pub ratio: f64,
    /// n.
    pub units: u32,
    /// h, m.
    pub pitch_m: f64,
}

/// How far a calibrated body is from what it was calibrated with, at sites that were not used; shares of 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RegionError {
    /// Which part of the body.
    pub region: String,
    /// Sites there.
    pub sites: usize,
    /// Median and largest relative L2 error of the whole field.
    pub field: [f64; 2],
    /// The same within 30 mm of the contact.
    pub near_field: [f64; 2],
    /// Median and largest relative error of the force.
    pub force: [f64; 2],
}

/// A calibrated body as a file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseFile {
    /// About itself.
    pub header: ResponseHeader,
    /// The field.
    pub parts: ResponseParts,
    /// Factors on the contact law, one for each vertex.
    pub factors: Vec<f32>,
}

/// A calibrated body that fits its mesh.
#[derive(Clone, Debug)]
pub struct LoadedResponse {
    /// About itself.
    pub header: ResponseHeader,
    /// The field.
    pub response: Response,
    /// Factors on the contact law.
    pub stiffness: StiffnessMap,
}

impl ChainShape {
    /// That of a chain.
    #[must_use]
    pub fn of(chain: &ChainParameters) -> Self {
        Self { ratio: chain.ratio, units: chain.units, pitch_m: chain.pitch_m }
    }
}

impl ResponseHeader {
    /// Lengths and ratios are finite and above 0, errors finite and not below.
    fn check_numbers(&self) -> Result<(), String> {
        let chains =
            self.chains.iter().flat_map(|chain| [("ratio", chain.ratio), ("pitch_m", chain.pitch_m)]);
        let mut sizes = chains.chain([("contact_radius_m", self.contact_radius_m)]);
        if let Some((key, value)) = sizes.find(|(_, value)| !(value.is_finite() && *value > 0.0)) {
            return Err(format!("header: {key} is {value}; accepted: a finite number greater than 0"));
        }
        let errors = self.errors.iter().flat_map(|region| {
            let parts = [("field", region.field), ("near_field", region.near_field), ("force", region.force)];
            parts.into_iter().flat_map(|(key, values)| values.map(|value| (key, value)))
        });
        let mut errors = errors.filter(|(_, value)| !(value.is_finite() && *value >= 0.0));
        errors.next().map_or(Ok(()), |(key, value)| {
            Err(format!("header: an error of {key} is {value}; accepted: a finite number, 0 or more"))
        })
    }
}

/// CRC-32 of the coordinates (f64, little-endian) and corners (u32, little-endian) of a mesh, in their order.
#[must_use]
pub fn mesh_checksum(mesh: &SurfaceMesh) -> u32 {
    let mut hash = crc32fast::Hasher::new();
    mesh.vertices().iter().flat_map(|vertex| vertex.to_array()).for_each(|x| hash.update(&x.to_le_bytes()));
    mesh.triangles().iter().flatten().for_each(|corner| hash.update(&corner.to_le_bytes()));
    hash.finalize()
}

/// Reads the file of a calibrated body.
///
/// # Errors
/// The file cannot be read, is none, is cut, damaged or newer, or says of itself what it does not hold.
pub fn read_response(path: &Path) -> Result<ResponseFile, SceneError> {
    let bytes = std::fs::read(path).map_err(|fault| error(path, Problem::Unreadable(fault)))?;
    ResponseFile::from_bytes(&bytes).map_err(|reason| error(path, Problem::Response(reason)))
}

/// Reads the file of a calibrated body for `mesh` and the chains of `law`.
///
/// # Errors
/// As [`read_response`]; and it is for another mesh or other chains, or its numbers are none.
pub fn load_response(
    path: &Path,
    mesh: &SurfaceMesh,
    law: &ContactLaw,
) -> Result<LoadedResponse, SceneError> {
    let ResponseFile { header, parts, factors } = read_response(path)?;
    let refused = |reason: String| error(path, Problem::Response(reason));
    if (header.vertices, header.mesh_crc32) != (mesh.vertices().len(), mesh_checksum(mesh)) {
        return Err(refused(format!(
            "made for another mesh ({} vertices, checksum {:08x}); accepted: one made for this one ({} vertices, checksum {:08x})",
            header.vertices,
            header.mesh_crc32,
            mesh.vertices().len(),
            mesh_checksum(mesh)
        )));
    }
    let chains: Vec<ChainShape> =
        law.chains().iter().map(|chain| ChainShape::of(chain.parameters())).collect();
    if chains != header.chains {
        return Err(refused(format!(
            "made for chains with (ratio, units, pitch) {}; the scene has {}",
            in_words(&header.chains),
            in_words(&chains)
        )));
    }
    let response = Response::new(parts, mesh).map_err(|fault| refused(fault.to_string()))?;
    let factors = factors.into_iter().map(f64::from).collect();
    let stiffness = StiffnessMap::new(factors, mesh).map_err(|fault| refused(fault.to_string()))?;
    Ok(LoadedResponse { header, response, stiffness })
}

fn in_words(chains: &[ChainShape]) -> String {
    let words = chains.iter().map(|chain| format!("({}, {}, {} m)", chain.ratio, chain.units, chain.pitch_m));
    words.collect::<Vec<_>>().join(" ")
}

fn error(path: &Path, problem: Problem) -> SceneError {
    SceneError {
        file: path.display().to_string(),
        line: None,
        key: Some(KEY.to_owned()),
        problem: Box::new(problem),
    }
}

impl ResponseFile {
    /// What the bytes of a file hold.
    ///
    /// # Errors
    /// Bytes that are no such file, cut, damaged or newer, or that say of themselves what they do not hold.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let rest = bytes
            .strip_prefix(MAGIC)
            .ok_or("not the file of a calibrated body; accepted: what rhombus calibrate --body writes")?;
        let end = rest
            .iter()
            .take(10)
            .position(|byte| *byte == b'\n')
            .ok_or("the version is missing; the file is damaged")?;
        let (version, rest) = (rest.get(..end).unwrap_or_default(), rest.get(end + 1..).unwrap_or_default());
        let version: u32 = std::str::from_utf8(version)
            .ok()
            .and_then(|version| version.parse().ok())
            .ok_or("the version is no number; the file is damaged")?;
        if version != VERSION {
            return Err(format!("version {version}; accepted: {VERSION}"));
        }
        let whole = bytes.len().checked_sub(NUMBER).and_then(|end| bytes.split_at_checked(end));
        let (covered, checksum) = whole.ok_or("the file is cut")?;
        let found = crc32fast::hash(covered);
        if checksum != found.to_le_bytes() {
            return Err(format!(
                "{} bytes with another checksum than theirs; the file is cut or damaged",
                bytes.len()
            ));
        }
        let cut = "the file is cut";
        let rest = rest.get(..rest.len().checked_sub(NUMBER).ok_or(cut)?).ok_or(cut)?;
        let (length, rest) = rest.split_first_chunk::<4>().ok_or(cut)?;
        let length = u32::from_le_bytes(*length) as usize;
        let (header, numbers) =
            rest.split_at_checked(length).filter(|_| length <= LARGEST_HEADER).ok_or(cut)?;
        let header: ResponseHeader =
            serde_yaml::from_slice(header).map_err(|fault| format!("header: {fault}"))?;
        header.check_numbers()?;
        let (vertices, chains, harmonics, modes) =
            (header.vertices, header.chains.len(), header.harmonics, header.modes);
        if chains > MOST_CHAINS || harmonics > MOST_HARMONICS || modes > MOST_MODES || vertices > bytes.len()
        {
            return Err(format!(
                "{vertices} vertices, {chains} chains, {harmonics} harmonics, {modes} modes; accepted: as many vertices as the file \
                 has numbers for, {MOST_CHAINS} chains, {MOST_HARMONICS} harmonics, {MOST_MODES} modes"
            ));
        }
        let mut parts = ResponseParts { chains, harmonics, modes, ..ResponseParts::default() };
        let counts =
            [chains * parts.coefficients_per_chain(), modes, 3 * modes, 1].map(|each| each * vertices);
        let wanted = counts.iter().sum::<usize>() * NUMBER;
        if numbers.len() != wanted {
            return Err(format!("{} bytes of numbers, and its header asks for {wanted}", numbers.len()));
        }
        let mut all =
            numbers.chunks_exact(NUMBER).map(|bytes| bytes.try_into().map_or(f32::NAN, f32::from_le_bytes));
        let mut take = |count: usize| all.by_ref().take(count).collect::<Vec<f32>>();
        let [coefficients, amplitudes, mode_fields, factors] = counts.map(&mut take);
        (parts.coefficients, parts.amplitudes, parts.mode_fields) = (coefficients, amplitudes, mode_fields);
        Ok(Self { header, parts, factors })
    }

    /// The bytes of the file.
    ///
    /// # Errors
    /// A header that cannot be written as YAML, or that is longer than one that is read.
    pub fn to_bytes(&self) -> Result<Vec<u8>, String> {
        let header = serde_yaml::to_string(&self.header).map_err(|fault| fault.to_string())?;
        let length = u32::try_from(header.len()).ok().filter(|length| *length as usize <= LARGEST_HEADER);
        let length =
            length.ok_or(format!("a header of {} bytes; accepted: up to {LARGEST_HEADER}", header.len()))?;
        let mut bytes = MAGIC.to_vec();
        // Writing to memory does not fail.
        let _ = writeln!(bytes, "{VERSION}");
        bytes.extend(length.to_le_bytes());
        bytes.extend(header.as_bytes());
        let ResponseParts { coefficients, amplitudes, mode_fields, .. } = &self.parts;
        for numbers in [coefficients, amplitudes, mode_fields, &self.factors] {
            bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        }
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        Ok(bytes)
    }
}
