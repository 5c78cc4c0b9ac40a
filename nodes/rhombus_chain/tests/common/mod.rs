//! Bodies and tissues the tests share. Metres, newton.
#![allow(dead_code, reason = "every test file uses its own selection")]
#![allow(clippy::expect_used, reason = "what is made here is valid by construction")]

use std::collections::BTreeMap;

use glam::DVec3;
use rhombus_chain::{
    Body, ChainParameters, ContactLaw, Formulation, Spread, SurfaceMesh, SurfaceParameters, SurfacePoint,
    Tissue,
};

/// Sphere from a subdivided icosahedron: `20 * 4^subdivisions` faces.
pub(crate) fn icosphere(radius: f64, subdivisions: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let phi = 0.5 * (1.0 + 5.0f64.sqrt());
    let mut vertices: Vec<DVec3> = [
        [-1.0, phi, 0.0],
        [1.0, phi, 0.0],
        [-1.0, -phi, 0.0],
        [1.0, -phi, 0.0],
        [0.0, -1.0, phi],
        [0.0, 1.0, phi],
        [0.0, -1.0, -phi],
        [0.0, 1.0, -phi],
        [phi, 0.0, -1.0],
        [phi, 0.0, 1.0],
        [-phi, 0.0, -1.0],
        [-phi, 0.0, 1.0],
    ]
    .map(|p| DVec3::from_array(p).normalize_or_zero())
    .to_vec();
    let mut triangles = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    for _ in 0..subdivisions {
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                vertices.push((vertices[a as usize] + vertices[b as usize]).normalize_or_zero());
                vertices.len() as u32 - 1
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    (vertices.into_iter().map(|p| p * radius).collect(), triangles)
}

/// A liver-like body of about 0.2 m: an ellipsoid with a thin lobe and bumps of some centimetres.
pub(crate) fn bumpy(subdivisions: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (vertices, triangles) = icosphere(1.0, subdivisions);
    let bump = |p: DVec3| {
        let thin = 1.0 - 0.55 * (0.5 + 0.5 * p.x);
        let waves = 1.0
            + 0.08 * libm::sin(4.0 * p.x + 1.0) * libm::cos(5.0 * p.y)
            + 0.05 * libm::sin(7.0 * p.z + 2.0 * p.x);
        DVec3::new(0.10 * p.x, 0.07 * p.y, 0.05 * p.z * thin) * waves
    };
    (vertices.into_iter().map(bump).collect(), triangles)
}

/// A block from `-size/2` to `size/2` with `n` squares along each edge of each side.
pub(crate) fn block(size: DVec3, n: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut vertices = Vec::new();
    let mut numbers = BTreeMap::new();
    let mut triangles = Vec::new();
    let mut vertex = |grid: [u32; 3]| {
        *numbers.entry(grid).or_insert_with(|| {
            let at = DVec3::from_array(grid.map(|k| f64::from(k) / f64::from(n) - 0.5));
            vertices.push(at * size);
            vertices.len() as u32 - 1
        })
    };
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (side, i, j) in (0..2 * n * n).map(|k| (k / (n * n), k / n % n, k % n)) {
            let mut corner = |di: u32, dj: u32| {
                let mut grid = [0; 3];
                (grid[axis], grid[u], grid[v]) = (side * n, i + di, j + dj);
                vertex(grid)
            };
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            if side == 1 {
                triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                triangles.extend([[a, c, b], [a, d, c]]);
            }
        }
    }
    (vertices, triangles)
}

pub(crate) fn body((vertices, triangles): (Vec<DVec3>, Vec<[u32; 3]>)) -> Body {
    Body::new(SurfaceMesh::new(vertices, triangles).expect("a closed surface"))
}

/// `chains` chains whose fields reach different distances.
pub(crate) fn law(chains: usize) -> ContactLaw {
    let parameters: Vec<ChainParameters> = (0..chains)
        .map(|p| ChainParameters {
            rod_length_m: 0.004 + 0.002 * p as f64,
            angle_rad: 0.8,
            ratio: 0.85,
            units: 20,
            normal_stiffness_n_per_m: 300.0 / chains as f64,
            tangential_stiffness_n_per_m: 40.0 / chains as f64,
            tangential_growth: 10.0,
            weight: 1.0 / chains as f64,
            pitch_m: 0.004 + 0.002 * p as f64,
        })
        .collect();
    ContactLaw::new(Formulation::Energy, &parameters).expect("an acceptable law")
}

pub(crate) fn surface(expansion: f64, spread: Spread) -> SurfaceParameters {
    SurfaceParameters { expansion, spread, ..SurfaceParameters::default() }
}

/// Two chains, a probe of 5 mm radius, geodesic spread, no expansion.
pub(crate) fn tissue() -> Tissue {
    tissue_with(2, surface(0.0, Spread::Geodesic))
}

pub(crate) fn tissue_with(chains: usize, surface: SurfaceParameters) -> Tissue {
    Tissue::new(law(chains), surface, 0.005, 0.5).expect("acceptable settings")
}

/// A sequence of numbers in 0..1 that is the same in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f64 {
        // SplitMix64 (Steele, Lea, Flood 2014).
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// Uniform over the unit sphere.
    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let p = DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0;
            if (0.01..1.0).contains(&p.length_squared()) {
                return p.normalize_or_zero();
            }
        }
    }

    /// Somewhere on a face drawn at random.
    pub(crate) fn surface_point(&mut self, mesh: &SurfaceMesh) -> SurfacePoint {
        let face = self.below(mesh.triangles().len()) as u32;
        let (mut u, mut v) = (self.unit(), self.unit());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        SurfacePoint { face, barycentric: DVec3::new(1.0 - u - v, u, v) }
    }
}
