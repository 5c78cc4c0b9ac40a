//! What closed paths over the generated liver leave of the hand's work: normals are interpolated, facets are not, so the force
//! is not the exact gradient of an energy on a coarse curved mesh. Measured and bounded.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use glam::DVec3;
use rhombus_chain::checks::{ClosedPath, Work, work};
use rhombus_chain::{Body, StiffnessMap, Tissue};
use scene::{MeshFile, Origin, Scene, Value, sites};

const PATHS: u32 = 2000;
const STEPS: u32 = 64;

fn tissue() -> Tissue {
    let one = |x: f64| Value::DoubleArray(vec![x]);
    let values = [
        ("chains.rod_length", one(0.004)),
        ("chains.angle", one(0.9)),
        ("chains.ratio", one(0.78)),
        ("chains.units", Value::IntegerArray(vec![24])),
        ("chains.normal_stiffness", one(1060.0)),
        ("chains.tangential_stiffness", one(100.0)),
        ("chains.tangential_growth", one(10.0)),
    ];
    let values = values.map(|(name, value)| (name.to_owned(), value));
    Scene::from_values(values, Origin::named("a test")).and_then(|scene| scene.tissue()).expect("accepted")
}

/// SplitMix64 (Steele, Lea, Flood 2014), 0 to 1.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Root mean square and largest net work as shares of the exchanged work. Paths go 15 mm around good places to press, up to
/// 4.6 mm deep.
fn residual(body: &Body) -> (f64, f64) {
    let (tissue, mut state) = (tissue(), 5);
    let places = sites(body, 20);
    let (mut squares, mut largest) = (0.0, 0.0_f64);
    for path in 0..PATHS {
        let site = &places[path as usize % places.len()];
        let centre = DVec3::Z * (tissue.probe_radius_m() - 0.002);
        let numbers = std::array::from_fn(|_| random(&mut state));
        let path = ClosedPath::from_unit(numbers, centre, DVec3::new(0.015, 0.015, 0.0026));
        let (u, v) = site.normal.any_orthonormal_pair();
        let probe_at = |share| {
            let DVec3 { x, y, z } = path.at(share);
            // Over the surface under the tangent plane, so that the depth is what the path says.
            let aside = site.point + u * x + v * y;
            let (at, _) = body.index().closest(body.mesh(), aside, f64::INFINITY).expect("a surface");
            body.mesh().position(at) + body.mesh().normal(at) * z
        };
        let Work { net_j, exchanged_j } = work(body, &tissue, STEPS, probe_at).expect("accepted");
        let share = net_j.abs() / exchanged_j;
        squares += share * share;
        largest = largest.max(share);
    }
    ((squares / f64::from(PATHS)).sqrt(), largest)
}

#[test]
fn interpolated_normals_leave_little_of_the_work_on_a_closed_path() {
    for (vertices, allowed) in [(3116, 0.02), (12_000, 0.01)] {
        let shape = scene::generate::body(scene::BodyKind::Liver, vertices);
        let obj =
            scene::Obj { comment: "", vertices: &shape.vertices, triangles: &shape.triangles }.to_string();
        let mesh =
            MeshFile::parse("liver", obj.as_bytes()).and_then(|file| file.surface(1.0)).expect("a liver");
        let plain = Body::new(mesh);
        let factors =
            plain.mesh().vertices().iter().map(|p| 2.0 + libm::sin(40.0 * p.x) * libm::cos(60.0 * p.y));
        let map = StiffnessMap::new(factors.collect(), plain.mesh()).expect("accepted factors");
        let mapped = plain.clone().with_stiffness(map).expect("its own map");
        for (name, body) in [("liver", &plain), ("liver with a map", &mapped)] {
            let (rms, largest) = residual(body);
            println!(
                "{name}, {vertices} vertices: net work {:.3} % of the exchanged, {:.2} % at most",
                100.0 * rms,
                100.0 * largest
            );
            assert!(rms < allowed, "{name}: {rms}");
        }
    }
}
