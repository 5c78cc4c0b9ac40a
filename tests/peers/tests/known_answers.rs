//! The peers with an elastic body inside (finite and boundary elements) on bodies whose answers are known.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

use glam::DVec3;
use rhombus_chain::SurfaceMesh;
use rhombus_peers::{Job, Material, Peer, SetupError, TetMesh, all, patch};

struct Body {
    surface: SurfaceMesh,
    volume: TetMesh,
}

impl Body {
    fn block(x_m: &[f64], y_m: &[f64], z_m: &[f64]) -> Self {
        let (surface, volume) = TetMesh::block(x_m, y_m, z_m);
        Self { surface, volume }
    }

    fn job(&self, poisson: f64, contact_radius_m: f64) -> Job<'_> {
        Job {
            surface: &self.surface,
            volume: Some(&self.volume),
            fixed: &self.volume.fixed,
            material: Material { young_pa: 1e4, poisson },
            contact_radius_m,
            memory_limit_bytes: 1 << 30,
        }
    }

    fn vertex(&self, at: DVec3) -> u32 {
        let vertices = self.surface.vertices();
        (0u32..).zip(vertices).find(|(_, vertex)| vertex.distance(at) < 1e-9).unwrap().0
    }

    fn rest(&self) -> Vec<DVec3> {
        vec![DVec3::ZERO; self.surface.vertices().len()]
    }
}

/// Equal steps from zero.
fn steps(count: u32, step_m: f64) -> Vec<f64> {
    (0..=count).map(|k| f64::from(k) * step_m).collect()
}

/// The peers whose names contain `words`.
fn peers(words: &[&str], job: &Job) -> Vec<Box<dyn Peer>> {
    let kinds = all().iter().filter(|kind| words.iter().all(|word| kind.name.contains(word)));
    let peers: Vec<_> = kinds.map(|kind| (kind.setup)(job).unwrap()).collect();
    assert!(!peers.is_empty());
    peers
}

#[test]
fn a_block_without_sideways_strain_is_compressed_as_a_bar() {
    let body = Body::block(&steps(2, 0.01), &steps(2, 0.01), &steps(3, 0.01));
    let top = body.vertex(DVec3::new(0.01, 0.01, 0.03));
    for mut peer in peers(&["FEM"], &body.job(0.0, 0.02)) {
        peer.touch(top, DVec3::Z);
        let mut u = body.rest();
        let force_n = peer.query(0.001, &mut u);
        // E A depth / length
        assert!((force_n / (1e4 * 4e-4 * 0.001 / 0.03) - 1.0).abs() < 1e-5, "{}: {force_n} N", peer.name());
        for (u, at) in u.iter().zip(body.surface.vertices()) {
            let exact = DVec3::new(0.0, 0.0, -0.001 * at.z / 0.03);
            assert!(u.distance(exact) < 1e-8, "{}: {u} {exact}", peer.name());
        }
    }
}

#[test]
fn a_cantilever_bends_as_a_beam_in_second_order_and_boundary_elements_but_not_in_first_order() {
    let (thickness, length) = (0.01, 0.08);
    let body = Body::block(&steps(2, 0.005), &steps(2, 0.005), &steps(12, length / 12.0));
    let tip = body.vertex(DVec3::new(thickness, 0.5 * thickness, length));
    let job = body.job(0.3, 0.0);
    // Timoshenko: depth / force = L³ / 3 E I + 6 L (1 + nu) 2 / 5 E A.
    let (inertia, area) = (thickness.powi(4) / 12.0, thickness * thickness);
    let compliance = length.powi(3) / (3.0 * 1e4 * inertia) + 1.2 * length * 2.6 / (1e4 * area);
    let error = |words: &[&str]| {
        let mut largest: f64 = 0.0;
        for mut peer in peers(words, &job) {
            peer.touch(tip, DVec3::X);
            let force_n = peer.query(0.001, &mut body.rest());
            largest = largest.max((force_n / (0.001 / compliance) - 1.0).abs());
        }
        largest
    };
    let [first, second, boundary] = [error(&["FEM", "1st"]), error(&["FEM", "2nd"]), error(&["BEM"])];
    assert!(second < 0.02, "second order: {second}");
    assert!(boundary < 0.15, "boundary elements: {boundary}");
    assert!(first > 0.3, "first order: {first}");
}

#[test]
fn full_product_patch_columns_and_fixed_contact_say_the_same_and_obey_the_disc() {
    let body = Body::block(&steps(5, 0.01), &steps(4, 0.01), &[0.0, 0.012, 0.02, 0.025]);
    let (radius_m, depth_m) = (0.011, 0.0015);
    let job = body.job(0.45, radius_m);
    let mut families = [("1st", Vec::new()), ("2nd", Vec::new()), ("BEM", Vec::new())];
    for (family, answers) in &mut families {
        for mut peer in peers(&[*family], &job) {
            let mut u = body.rest();
            // Elsewhere first: what is remembered of a contact must not stay.
            for site in [DVec3::new(0.03, 0.01, 0.025), DVec3::new(0.02, 0.02, 0.025)] {
                let vertex = body.vertex(site);
                peer.touch(vertex, DVec3::Z);
                let force_n = peer.query(depth_m, &mut u);
                for touched in patch(&body.surface, vertex, DVec3::Z, radius_m) {
                    assert!((u[touched as usize].z + depth_m).abs() < 1e-8, "{}", peer.name());
                }
                assert!(force_n > 0.0);
                answers.push((force_n, u.clone()));
            }
            let held = u.iter().zip(&body.volume.fixed).filter(|&(_, &held)| held);
            assert!(held.into_iter().all(|(u, _)| *u == DVec3::ZERO), "{}", peer.name());
            let twice_n = peer.query(2.0 * depth_m, &mut u);
            assert!((twice_n / answers.last().unwrap().0 - 2.0).abs() < 1e-9);
        }
        let (one, others) = answers.split_at(2);
        for (k, (force_n, u)) in others.iter().enumerate() {
            let (expected_n, expected) = &one[k % 2];
            assert!((force_n / expected_n - 1.0).abs() < 1e-4, "{family}: {force_n} {expected_n}");
            let apart = u.iter().zip(expected).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(apart < 1e-4 * depth_m, "{family}: {apart}");
        }
    }
}

#[test]
fn what_does_not_fit_or_cannot_be_solved_is_refused() {
    let body = Body::block(&steps(2, 0.01), &steps(2, 0.01), &steps(2, 0.01));
    let kinds = || all().iter().filter(|kind| kind.name.contains("FEM") || kind.name.contains("BEM"));
    for kind in kinds() {
        let small = Job { memory_limit_bytes: 1000, ..body.job(0.3, 0.0) };
        assert!(
            matches!((kind.setup)(&small), Err(SetupError::DoesNotFit { limit_bytes: 1000, .. })),
            "{}",
            kind.name
        );
        let loose = vec![false; body.volume.surface_vertices];
        let floating = Job { fixed: &loose, ..body.job(0.3, 0.0) };
        assert!(matches!((kind.setup)(&floating), Err(SetupError::Singular { .. })), "{}", kind.name);
        let hollow = Job { volume: None, ..body.job(0.3, 0.0) };
        let refused = matches!((kind.setup)(&hollow), Err(SetupError::NoVolume));
        assert_eq!(refused, kind.name.contains("FEM"), "{}", kind.name);
        assert!(
            matches!((kind.setup)(&body.job(0.5, 0.0)), Err(SetupError::Material { .. })),
            "{}",
            kind.name
        );
    }
}
