//! `rhombus calibrate --reference`: chains and regional stiffness from solutions at many sites.
#![expect(clippy::expect_used, reason = "a test may fail here")]

mod common;

use std::io::Write;
use std::path::Path;

use common::Folder;
use glam::DVec3;
use npyz::{AutoSerialize, WriterBuilder};
use rhombus_chain::{
    Body, ChainParameters, ContactLaw, Formulation, Impression, SurfaceField, SurfaceMesh, SurfaceParameters,
    SurfacePoint, Tissue,
};
use rhombus_cli::calibrate::errors::{self, Which};
use rhombus_cli::calibrate::sites;
use rhombus_cli::reference::Reference;
use scene::{BodyKind, Obj, generate};

const SITES: usize = 40;
const RADIUS_M: f64 = 0.005;

/// Arrays of a reference file, as numpy would have them.
struct Arrays {
    vertices: Vec<f64>,
    faces: Vec<i32>,
    site_vertex: Vec<i32>,
    point: Vec<f64>,
    normal: Vec<f64>,
    stiffness: Vec<f64>,
    displacement: Vec<f32>,
    held_out: Vec<u8>,
    depth: Option<Vec<f64>>,
}

fn chain(decay_m: f64, weight: f64) -> ChainParameters {
    ChainParameters {
        rod_length_m: 0.01,
        angle_rad: 0.5,
        ratio: libm::exp(-0.16),
        units: 100,
        normal_stiffness_n_per_m: 300.0,
        tangential_stiffness_n_per_m: 0.0,
        tangential_growth: 20.0,
        weight,
        pitch_m: 0.16 * decay_m,
    }
}

/// Twice as stiff on one side as on the other, in log.
fn factor(normal: DVec3) -> f64 {
    libm::exp(0.3 * normal.x + 0.2 * normal.z)
}

fn mesh() -> SurfaceMesh {
    let shape = generate::body(BodyKind::Sphere, 600);
    SurfaceMesh::new(shape.vertices, shape.triangles).expect("a surface")
}

/// What the model itself says at sites all over a sphere: the truth is known, and inside what can be fitted.
fn arrays() -> Arrays {
    let body = Body::new(mesh());
    let law = ContactLaw::new(Formulation::Energy, &[chain(0.004, 0.6), chain(0.02, 0.4)]).expect("a law");
    let surface =
        SurfaceParameters { cutoff: 0.0, contact_radius_m: RADIUS_M, ..SurfaceParameters::default() };
    let tissue = Tissue::new(law.clone(), surface, RADIUS_M, 0.5).expect("a tissue");
    let mesh = body.mesh();
    let mut arrays = Arrays {
        vertices: mesh.vertices().iter().flat_map(|v| v.to_array()).collect(),
        faces: mesh.triangles().iter().flatten().map(|v| *v as i32).collect(),
        site_vertex: Vec::new(),
        point: Vec::new(),
        normal: Vec::new(),
        stiffness: Vec::new(),
        displacement: Vec::new(),
        held_out: Vec::new(),
        depth: None,
    };
    let mut field = SurfaceField::new(&body, &tissue);
    for site in 0..SITES {
        let vertex = (site * mesh.vertices().len() / SITES) as u32;
        let (face, corners) =
            mesh.triangles().iter().enumerate().find(|(_, t)| t.contains(&vertex)).expect("a face");
        let corner = corners.iter().position(|v| *v == vertex).expect("a corner");
        let at = SurfacePoint { face: face as u32, barycentric: DVec3::AXES[corner] };
        let (position, normal) = (mesh.position(at), mesh.normal(at));
        field.update(
            &body,
            &tissue,
            [Impression { at, position, normal, depth_m: RADIUS_M, lateral_m: DVec3::ZERO }],
        );
        let mut moved = vec![DVec3::ZERO; mesh.vertices().len()];
        for (vertex, displacement) in field.vertices().iter().zip(field.displacements()) {
            moved[*vertex as usize] = *displacement / RADIUS_M;
        }
        arrays.site_vertex.push(vertex as i32);
        arrays.point.extend(position.to_array());
        arrays.normal.extend(normal.to_array());
        arrays.stiffness.push(factor(normal) * law.rest_stiffness_n_per_m());
        arrays.displacement.extend(moved.iter().flat_map(|u| u.to_array()).map(|x| x as f32));
        arrays.held_out.push(u8::from(site % 5 == 2));
    }
    arrays
}

fn entry<T: AutoSerialize + Copy>(
    zip: &mut zip::ZipWriter<std::fs::File>,
    name: &str,
    shape: &[u64],
    data: &[T],
) {
    let mut bytes = Vec::new();
    let mut writer = npyz::WriteOptions::new()
        .default_dtype()
        .shape(shape)
        .writer(&mut bytes)
        .begin_nd()
        .expect("a header");
    writer.extend(data.iter().copied()).expect("data");
    writer.finish().expect("an end");
    zip.start_file(format!("{name}.npy"), zip::write::SimpleFileOptions::default()).expect("an entry");
    zip.write_all(&bytes).expect("bytes");
}

impl Arrays {
    fn write(&self, path: &Path) {
        self.write_without(path, "");
    }

    fn write_without(&self, path: &Path, left_out: &str) {
        let (v, t, s) =
            (self.vertices.len() as u64 / 3, self.faces.len() as u64 / 3, self.site_vertex.len() as u64);
        let mut zip = zip::ZipWriter::new(std::fs::File::create(path).expect("a file"));
        let sites = self.site_vertex.len();
        entry(&mut zip, "vertices", &[v, 3], &self.vertices);
        entry(&mut zip, "faces", &[t, 3], &self.faces);
        entry(&mut zip, "fixed", &[v], &vec![0_u8; v as usize]);
        entry(&mut zip, "site_vertex", &[s], &self.site_vertex);
        entry(&mut zip, "point", &[s, 3], &self.point);
        entry(&mut zip, "normal", &[s, 3], &self.normal);
        entry(&mut zip, "contact_radius", &[s], &vec![RADIUS_M; sites]);
        entry(&mut zip, "young", &[s], &vec![10e3; sites]);
        entry(&mut zip, "poisson", &[s], &vec![0.45; sites]);
        if left_out != "stiffness" {
            entry(&mut zip, "stiffness", &[s], &self.stiffness);
        }
        entry(&mut zip, "displacement", &[s, v, 3], &self.displacement);
        entry(&mut zip, "held_out", &[s], &self.held_out);
        if let Some(depth) = &self.depth {
            entry(&mut zip, "depth", &[s], depth);
        }
        zip.finish().expect("a whole archive");
    }

    fn reference(&self, folder: &Folder) -> Reference {
        self.write(&folder.path("sites.npz"));
        Reference::read(&folder.path("sites.npz")).expect("a reference")
    }
}

fn median_of(errors: &[errors::SiteError], part: fn(&errors::SiteError) -> f64) -> f64 {
    errors::median(errors.iter().map(part).collect())
}

#[test]
fn chains_and_regional_stiffness_come_back_from_sites_made_with_them() {
    let reference = arrays().reference(&Folder::new());
    let found = sites::fit(&reference, 2, true).expect("it fits");
    for (found, decay_m) in found.chains.iter().zip([0.004, 0.02]) {
        let decay = -found.pitch_m / found.ratio.ln();
        assert!((decay / decay_m - 1.0).abs() < 0.05, "{decay} m, made with {decay_m} m");
    }
    assert_eq!(found.held_out.len(), 8);
    assert!(median_of(&found.held_out, |e| e.near_rel_l2) < 0.02, "{:?}", found.held_out);
    assert!(median_of(&found.held_out, |e| e.full_rel_l2) < 0.02, "{:?}", found.held_out);
    assert!(found.held_out.iter().all(|e| e.force_rel < 0.03), "{:?}", found.held_out);
    // Everywhere, not at the sites only.
    let mesh = mesh();
    let map = found.map.expect("a map");
    let mean =
        map.iter().zip(mesh.vertex_normals()).map(|(c, n)| c / factor(*n)).sum::<f64>() / map.len() as f64;
    let off = map.iter().zip(mesh.vertex_normals()).map(|(c, n)| (c / factor(*n) / mean - 1.0).abs());
    assert!(off.fold(0.0, f64::max) < 0.1);

    let constant = sites::fit(&reference, 2, false).expect("it fits");
    assert_eq!(constant.map, None);
    assert!(
        median_of(&constant.held_out, |e| e.force_rel) > 5.0 * median_of(&found.held_out, |e| e.force_rel)
    );
}

#[test]
fn the_errors_of_a_perfect_model_are_none() {
    let reference = arrays().reference(&Folder::new());
    let law = ContactLaw::new(Formulation::Energy, &[chain(0.004, 0.6), chain(0.02, 0.4)]).expect("a law");
    let surface =
        SurfaceParameters { cutoff: 0.0, contact_radius_m: RADIUS_M, ..SurfaceParameters::default() };
    let tissue = Tissue::new(law, surface, RADIUS_M, 0.5).expect("a tissue");
    let body = Body::new(mesh());
    let errors = errors::at_sites(&body, &tissue, &reference, Which::Used).expect("errors");
    assert_eq!(errors.len(), 32);
    for error in errors {
        let normal = reference.sites[error.site].contacts[0].normal;
        assert!(error.near_rel_l2 < 1e-6 && error.full_rel_l2 < 1e-6 && error.worst_rel < 1e-6, "{error:?}");
        assert!((error.force_rel - (1.0 / factor(normal) - 1.0).abs()).abs() < 1e-9, "{error:?}");
    }
}

#[test]
fn held_out_sites_change_nothing_that_is_fitted() {
    let mut arrays = arrays();
    let before = sites::fit(&arrays.reference(&Folder::new()), 2, true).expect("it fits");
    let v = arrays.vertices.len();
    for site in (0..SITES).filter(|site| site % 5 == 2) {
        arrays.stiffness[site] *= 3.0;
        arrays.displacement[site * v..(site + 1) * v].iter_mut().for_each(|x| *x = -*x);
    }
    let after = sites::fit(&arrays.reference(&Folder::new()), 2, true).expect("it fits");
    assert_eq!((&before.chains, &before.map, &before.used), (&after.chains, &after.map, &after.used));
    assert_ne!(before.held_out, after.held_out);
}

#[test]
fn the_written_scene_has_the_map_beside_it_and_gives_the_errors_it_says() {
    let folder = Folder::new();
    let mesh = mesh();
    let obj = Obj { comment: "a sphere", vertices: mesh.vertices(), triangles: mesh.triangles() }.to_string();
    let folder = folder.with("sphere.obj", &obj);
    arrays().write(&folder.path("sites.npz"));
    let command =
        ["calibrate", "--reference", "sites.npz", "--mesh", "sphere.obj", "--chains", "2", "-o", "out.yaml"];
    let said = folder.success(&command);
    assert!(
        said.contains("out_stiffness.csv written") && said.contains("8 sites held out: force, median"),
        "{said}"
    );
    let scene =
        scene::Scene::from_file(&folder.path("out.yaml"), scene::Reader::Everything).expect("a scene");
    let body = scene.load_body().expect("a body").body;
    assert!(body.stiffness().is_some());
    let reference = Reference::read(&folder.path("sites.npz")).expect("a reference");
    let errors = errors::at_sites(&body, &scene.tissue().expect("a tissue"), &reference, Which::HeldOut);
    assert_eq!(errors.expect("errors"), sites::fit(&reference, 2, true).expect("it fits").held_out);

    let said = folder.refusal(&command);
    assert!(said.contains("out.yaml exists"), "{said}");
    std::fs::remove_file(folder.path("out.yaml")).expect("a file");
    let said = folder.refusal(&command);
    assert!(said.contains("out_stiffness.csv exists; --force replaces it"), "{said}");
    assert!(!folder.path("out.yaml").exists(), "no parameter file without its map");
    folder.success(&[&command[..], &["--map", "off"]].concat());
    assert!(!std::fs::read_to_string(folder.path("out.yaml")).expect("a file").contains("stiffness_map"));
}

#[test]
fn a_reference_may_say_of_which_depth_each_solution_is() {
    let mut deep = arrays();
    assert!(deep.reference(&Folder::new()).sites.iter().all(|site| site.depth_m.is_none()));
    let depths: Vec<f64> = (1..=SITES).map(|site| 1e-4 * site as f64).collect();
    deep.depth = Some(depths.clone());
    let read: Vec<f64> =
        deep.reference(&Folder::new()).sites.iter().filter_map(|site| site.depth_m).collect();
    assert_eq!(read, depths);
    let folder = Folder::new();
    deep.depth = Some(vec![0.0; SITES]);
    deep.write(&folder.path("flat.npz"));
    let error = Reference::read(&folder.path("flat.npz")).expect_err("no depth").to_string();
    assert!(error.contains("depth: entry 0 is 0; accepted: greater than 0"), "{error}");
}

#[test]
fn references_that_do_not_fit_are_refused() {
    let folder = Folder::new();
    let whole = arrays();
    whole.write(&folder.path("sites.npz"));
    let refuse = |arguments: &[&str]| folder.refusal(&[&["calibrate", "-o", "out.yaml"], arguments].concat());
    let said = refuse(&["--reference", "sites.npz"]);
    assert!(said.contains("sites.npz: vertices: ") && said.contains("the mesh has 3116"), "{said}");

    let mut moved = arrays();
    moved.vertices[7] += 1e-4;
    let other = moved.reference(&Folder::new());
    let error = other.check_mesh(&mesh()).expect_err("another mesh").to_string();
    assert!(error.contains("vertex 2 (from 0)"), "{error}");
    moved = arrays();
    moved.faces.swap(0, 1);
    let error = moved.reference(&Folder::new()).check_mesh(&mesh()).expect_err("another mesh").to_string();
    assert!(error.contains("triangle 0"), "{error}");

    whole.write_without(&folder.path("without.npz"), "stiffness");
    assert!(refuse(&["--reference", "without.npz"]).contains("without.npz: stiffness: missing"));
    let bytes = std::fs::read(folder.path("sites.npz")).expect("bytes");
    std::fs::write(folder.path("cut.npz"), &bytes[..bytes.len() / 2]).expect("a file");
    assert!(refuse(&["--reference", "cut.npz"]).contains("accepted: an .npz file of numpy.savez"));
    assert!(refuse(&["--reference", "none.npz"]).contains("none.npz: cannot be read"));

    let mut negative = arrays();
    negative.stiffness[3] = -1.0;
    negative.write(&folder.path("negative.npz"));
    let said = refuse(&["--reference", "negative.npz"]);
    assert!(said.contains("stiffness: entry 3 is -1; accepted: greater than 0"), "{said}");

    let mut few = arrays();
    few.held_out.iter_mut().enumerate().for_each(|(site, held_out)| *held_out = u8::from(site >= 5));
    let error = sites::fit(&few.reference(&Folder::new()), 1, true).expect_err("too few").to_string();
    assert!(error.contains("5 sites are too few for a map; accepted: 8 or more"), "{error}");
    few.held_out.fill(1);
    let error = sites::fit(&few.reference(&Folder::new()), 1, false).expect_err("none").to_string();
    assert!(error.contains("no site that is not held out"), "{error}");
}

#[test]
fn no_number_of_chains_leaves_less_than_the_best_single_shape() {
    // Sites that differ: every other one with its dent turned into a bulge beyond the contact's neighbours.
    let mut arrays = arrays();
    let v = arrays.vertices.len();
    for site in (0..SITES).filter(|site| site % 2 == 0) {
        arrays.displacement[site * v..(site + 1) * v]
            .iter_mut()
            .for_each(|x| *x = if x.abs() < 0.3 { -*x } else { *x });
    }
    let reference = arrays.reference(&Folder::new());
    for chains in [1, 3] {
        let found = sites::fit(&reference, chains, false).expect("it fits");
        let rms =
            (found.used.iter().map(|e| e.near_rel_l2.powi(2)).sum::<f64>() / found.used.len() as f64).sqrt();
        assert!(found.least_near > 0.1 && rms > 0.99 * found.least_near, "{rms}, {}", found.least_near);
    }
}
