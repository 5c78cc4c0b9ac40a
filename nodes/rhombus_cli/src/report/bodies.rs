//! Calibrated bodies made by `rhombus calibrate --body` before this run, as a session reads them.

use std::path::Path;

use anyhow::{Context as _, Result, bail, ensure};
use rhombus_chain::{Body, Response, StiffnessMap, SurfaceMesh, Tissue};
use rhombus_cli::reference::Reference;
use scene::{Reader, ResponseHeader, Scene, read_response};

use super::truth::{self, TruthSite};

/// A calibrated body.
pub(crate) struct CalibratedBody {
    /// Law, shape and probe of its scene.
    pub(crate) tissue: Tissue,
    /// What its file says about it.
    pub(crate) header: ResponseHeader,
    /// Size of the file.
    pub(crate) file_bytes: u64,
    mesh: SurfaceMesh,
    map: StiffnessMap,
    response: Response,
    without_modes: Response,
}

/// What is left of a calibrated body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kept {
    /// Everything.
    All,
    /// Everything but its body modes.
    WithoutModes,
    /// Its stiffness map alone: chains that are the same in all directions.
    MapAlone,
}

/// Where the bodies' commands are.
const COMMANDS: &str = "tests/reference/README.md";

impl CalibratedBody {
    /// From `NAME.body` and the scene that names it, `NAME.yaml`.
    ///
    /// # Errors
    /// A file is missing, with the command that makes it; or the scene, its mesh or the calibrated body is not accepted.
    pub(crate) fn read(folder: &Path, name: &str) -> Result<Self> {
        let [path, yaml] = ["body", "yaml"].map(|end| folder.join(format!("{name}.{end}")));
        for file in [&path, &yaml] {
            ensure!(
                file.is_file(),
                "{} is missing; make it with: rhombus calibrate --body MESH --young 1e4 --poisson {} --fixed REGION --output {}, \
                 see {COMMANDS}",
                file.display(),
                poisson(name),
                path.display()
            );
        }
        let file_bytes = std::fs::metadata(&path).with_context(|| path.display().to_string())?.len();
        let scene = Scene::from_file(&yaml, Reader::Everything)?;
        let tissue = scene.tissue()?;
        let whole = scene.load_body()?.body;
        let header = read_response(&path)?.header;
        let (Some(response), Some(map)) = (whole.response().cloned(), whole.stiffness().cloned()) else {
            bail!("{}: body.response is missing; accepted: {name}.body", yaml.display());
        };
        let mut parts = response.parts().clone();
        (parts.modes, parts.amplitudes, parts.mode_fields) = (0, Vec::new(), Vec::new());
        let mesh = whole.mesh().clone();
        let without_modes = Response::new(parts, &mesh)?;
        Ok(Self { tissue, header, file_bytes, mesh, map, response, without_modes })
    }

    /// The rest surface.
    pub(crate) fn mesh(&self) -> &SurfaceMesh {
        &self.mesh
    }

    /// The body, or what is kept of it.
    ///
    /// # Errors
    /// None: the parts fitted each other when they were read.
    pub(crate) fn body(&self, kept: Kept) -> Result<Body> {
        let body = Body::new(self.mesh.clone()).with_stiffness(self.map.clone())?;
        Ok(match kept {
            Kept::All => body.with_response(self.response.clone())?,
            Kept::WithoutModes => body.with_response(self.without_modes.clone())?,
            Kept::MapAlone => body,
        })
    }

    /// Those `wanted` sites of a reference on the same mesh, none of which the calibration used.
    ///
    /// # Errors
    /// The reference is of another mesh, or the calibration used one of the sites.
    pub(crate) fn sites(&self, reference: &Reference, wanted: &[usize]) -> Result<Vec<TruthSite>> {
        reference.check_mesh(&self.mesh)?;
        let used = self.used_vertices();
        let sites = wanted.iter().filter_map(|site| reference.sites.get(*site));
        for contact in sites.flat_map(|site| &site.contacts) {
            ensure!(
                !used.contains(&contact.vertex),
                "{}: the calibrated body has used the site at vertex {}; accepted: a body calibrated with --held-out of this file",
                reference.file,
                contact.vertex
            );
        }
        Ok(truth::on(&self.mesh, reference, &Body::new(self.mesh.clone()), wanted))
    }

    /// Vertices of the sites that the calibration used, as the file says: `sites (80): 17 230 ...`.
    fn used_vertices(&self) -> Vec<u32> {
        let line = self.header.made.iter().find_map(|line| line.strip_prefix("sites (")?.split_once("):"));
        line.map_or_else(Vec::new, |(_, vertices)| {
            vertices.split_whitespace().filter_map(|vertex| vertex.parse().ok()).collect()
        })
    }

    /// P, H and J in words.
    pub(crate) fn size(&self) -> String {
        let ResponseHeader { chains, harmonics, modes, .. } = &self.header;
        format!("{} chains, {harmonics} harmonics, {modes} body modes", chains.len())
    }
}

/// Poisson's ratio of a body by its name.
fn poisson(name: &str) -> &'static str {
    match name {
        "liver_nu30" => "0.30",
        "liver_nu49" => "0.49",
        _ => "0.45",
    }
}

#[cfg(test)]
mod tests {
    use super::{CalibratedBody, Kept};
    use glam::DVec3;
    use rhombus_chain::ResponseParts;
    use rhombus_cli::reference::{Reference, ReferenceContact, ReferenceSite};
    use scene::{ChainShape, Reader, ResponseFile, ResponseHeader, Scene, mesh_checksum};

    const MESH: &str = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    const CHAINS: &str = "chains.rod_length: [0.004], chains.angle: [0.8], chains.ratio: [0.9], chains.units: [20], \
        chains.normal_stiffness: [200.0], chains.tangential_stiffness: [10.0], chains.tangential_growth: [10.0], chains.pitch: [0.004]";

    /// A tetrahedron with a response of two modes, calibrated at vertices 0 and 2.
    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
        let scene = |more: &str| {
            format!("/**: {{ros__parameters: {{body.mesh: organ.obj, {CHAINS}{more}}}}}\n").into_bytes()
        };
        write("organ.obj", MESH.as_bytes());
        write("organ.yaml", &scene(""));
        let plain = Scene::from_file(&folder.path().join("organ.yaml"), Reader::Everything).unwrap();
        let body = plain.load_body().unwrap().body;
        let header = ResponseHeader {
            vertices: 4,
            mesh_crc32: mesh_checksum(body.mesh()),
            chains: plain.law().unwrap().chains().iter().map(|c| ChainShape::of(c.parameters())).collect(),
            contact_radius_m: 0.005,
            modes: 2,
            made: vec!["sites (2): 0 2".to_owned()],
            ..ResponseHeader::default()
        };
        let parts = ResponseParts {
            chains: 1,
            modes: 2,
            coefficients: [1.0, 0.1].repeat(4),
            amplitudes: vec![0.5; 8],
            mode_fields: vec![0.01; 24],
            ..ResponseParts::default()
        };
        let file = ResponseFile { header, parts, factors: vec![1.0, 2.0, 0.5, 1.5] };
        write("organ.body", &file.to_bytes().unwrap());
        write("organ.yaml", &scene(", body.response: organ.body"));
        folder
    }

    /// Solutions at two vertices of the tetrahedron.
    fn reference(vertices: [u32; 2]) -> Reference {
        let places = [DVec3::ZERO, DVec3::X * 0.1, DVec3::Y * 0.1, DVec3::Z * 0.1];
        let site = |vertex: u32| ReferenceSite {
            contacts: vec![ReferenceContact {
                vertex,
                point: places[vertex as usize],
                normal: DVec3::Z,
                stiffness_n_per_m: 100.0,
            }],
            contact_radius_m: 0.005,
            young_pa: 1e4,
            poisson: 0.45,
            displacement: vec![DVec3::ZERO; 4],
            held_out: true,
            depth_m: None,
        };
        Reference {
            file: "truth.npz".to_owned(),
            vertices: places.to_vec(),
            faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
            fixed: vec![false; 4],
            sites: vertices.map(site).to_vec(),
        }
    }

    #[test]
    fn what_is_taken_away_is_gone_and_the_rest_is_as_before() {
        let folder = folder();
        let own = CalibratedBody::read(folder.path(), "organ").unwrap();
        let [all, bare, alone] =
            [Kept::All, Kept::WithoutModes, Kept::MapAlone].map(|kept| own.body(kept).unwrap());
        let [all_parts, bare_parts] = [&all, &bare].map(|body| body.response().unwrap().parts());
        assert_eq!((all_parts.modes, bare_parts.modes), (2, 0));
        assert_eq!(all_parts.coefficients, bare_parts.coefficients);
        assert!(alone.response().is_none());
        for body in [all, bare, alone] {
            assert_eq!(body.stiffness().unwrap().range(), (0.5, 2.0));
        }
        let size = std::fs::metadata(folder.path().join("organ.body")).unwrap().len();
        assert_eq!(own.file_bytes, size);
    }

    #[test]
    fn a_site_that_the_calibration_has_used_does_not_judge_it() {
        let folder = folder();
        let own = CalibratedBody::read(folder.path(), "organ").unwrap();
        assert_eq!(own.sites(&reference([1, 3]), &[0, 1]).unwrap().len(), 2);
        let used = reference([1, 2]);
        assert_eq!(own.sites(&used, &[0]).unwrap().len(), 1);
        let refusal = own.sites(&used, &[0, 1]).map(|_| ()).unwrap_err().to_string();
        assert!(refusal.contains("truth.npz") && refusal.contains("used the site at vertex 2"), "{refusal}");
    }

    #[test]
    fn what_is_missing_is_named() {
        let folder = folder();
        let refusal =
            |name: &str| CalibratedBody::read(folder.path(), name).map(|_| ()).unwrap_err().to_string();
        let missing = refusal("liver_nu30");
        for words in
            ["liver_nu30.body is missing", "rhombus calibrate --body MESH --young 1e4 --poisson 0.30"]
        {
            assert!(missing.contains(words), "{missing}");
        }
        let text = std::fs::read_to_string(folder.path().join("organ.yaml")).unwrap();
        let without = text.replace(", body.response: organ.body", "");
        std::fs::write(folder.path().join("organ.yaml"), without).unwrap();
        assert!(refusal("organ").contains("organ.yaml: body.response is missing; accepted: organ.body"));
    }
}
