//! Where to press: places that are flat enough for a contact, thick enough to give way, and well spread.

use glam::DVec3;
use rhombus_chain::Body;

/// A good place to press.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// A vertex of the rest surface.
    pub vertex: u32,
    /// Its position, body frame, m.
    pub point: DVec3,
    /// Outward unit normal there.
    pub normal: DVec3,
}

/// Vertices that are looked at; taken at equal steps of their number, so that a fine mesh costs no more.
const CANDIDATES: usize = 800;

/// A place is judged over a disc of this radius, smaller on small bodies, m.
const DISC_M: f64 = 0.010;

/// A place with this much tissue under it is thick, less on small bodies, m.
const THICK_M: f64 = 0.024;

/// Spread of the normals over the disc (1 less the length of their mean) at which a place counts as bent.
const BENT: f64 = 0.02;

/// Up to `count` sites, best first. The first is on the broad, thick, upward (+z) part of the body; each further one
/// is far from those before. Fewer when the body has fewer vertices.
pub fn sites(body: &Body, count: usize) -> Vec<Site> {
    let mut candidates = candidates(body);
    let upward = |c: &Candidate| 0.5 + 0.5 * c.site.normal.z;
    candidates.sort_by(|a, b| (b.quality * upward(b)).total_cmp(&(a.quality * upward(a))));
    let Some(best) = candidates.first().copied() else { return Vec::new() };
    // Only among good places first; the rest only when so many are asked for.
    let (mut good, mut rest): (Vec<_>, Vec<_>) =
        candidates.into_iter().partition(|c| c.quality > 0.6 * best.quality);
    let mut chosen = vec![best.site];
    while chosen.len() < count {
        let pool = if good.is_empty() { &mut rest } else { &mut good };
        let Some(next) = farthest(pool, &chosen, upward) else { break };
        chosen.push(pool.swap_remove(next).site);
    }
    chosen.truncate(count);
    chosen
}

#[derive(Clone, Copy)]
struct Candidate {
    site: Site,
    /// 0 to 1.
    quality: f64,
}

/// Index of the candidate farthest from all chosen sites, upward ones favoured; none when all are used up.
fn farthest(pool: &mut Vec<Candidate>, chosen: &[Site], upward: impl Fn(&Candidate) -> f64) -> Option<usize> {
    pool.retain(|c| chosen.iter().all(|site| site.vertex != c.site.vertex));
    let distance = |c: &Candidate| {
        chosen.iter().map(|site| site.point.distance(c.site.point)).fold(f64::INFINITY, f64::min) * upward(c)
    };
    (0..pool.len()).max_by(|a, b| distance(&pool[*a]).total_cmp(&distance(&pool[*b])).then(b.cmp(a)))
}

fn candidates(body: &Body) -> Vec<Candidate> {
    let mesh = body.mesh();
    let total = mesh.vertices().len();
    let [low, high] = mesh.extents();
    let size = (high - low).max_element();
    let (disc_m, thick_m) = (DISC_M.min(0.1 * size), THICK_M.min(0.15 * size));
    let mut seen = Seen { marks: vec![0; total], round: 0, disc: Vec::new() };
    (0..total.min(CANDIDATES))
        .map(|i| {
            let vertex = (i * total / total.min(CANDIDATES)) as u32;
            let (point, normal) = (mesh.vertices()[vertex as usize], mesh.vertex_normals()[vertex as usize]);
            let quality = seen.flatness(body, vertex, disc_m) * thickness(body, point, normal, thick_m);
            Candidate { site: Site { vertex, point, normal }, quality }
        })
        .collect()
}

/// 1 where a ball of tissue of radius `thick_m` fits under the place, less where the body is thinner.
fn thickness(body: &Body, point: DVec3, normal: DVec3, thick_m: f64) -> f64 {
    [0.25, 0.5, 1.0]
        .map(|share| {
            let below_m = share * thick_m;
            let middle = point - normal * below_m;
            let near = body.index().closest(body.mesh(), middle, below_m);
            let inside = body.index().encloses(body.mesh(), middle);
            if inside { near.map_or(1.0, |(_, distance_m)| distance_m / below_m) } else { 0.0 }
        })
        .into_iter()
        .fold(1.0, f64::min)
}

/// Scratch for walking over the surface.
struct Seen {
    marks: Vec<u32>,
    round: u32,
    disc: Vec<u32>,
}

impl Seen {
    /// 1 on a plane, towards 0 where normals within `radius_m` point in many directions.
    fn flatness(&mut self, body: &Body, start: u32, radius_m: f64) -> f64 {
        let mesh = body.mesh();
        let centre = mesh.vertices()[start as usize];
        self.round += 1;
        self.disc.clear();
        self.disc.push(start);
        self.marks[start as usize] = self.round;
        let (mut sum, mut area, mut next) = (DVec3::ZERO, 0.0, 0);
        while let Some(vertex) = self.disc.get(next).copied() {
            next += 1;
            let weight = mesh.vertex_areas()[vertex as usize];
            sum += mesh.vertex_normals()[vertex as usize] * weight;
            area += weight;
            for neighbour in mesh.neighbours(vertex) {
                let mark = &mut self.marks[neighbour as usize];
                // The first ring always counts: a mesh coarser than the disc has edges too.
                let near = mesh.vertices()[neighbour as usize].distance(centre) <= radius_m;
                if *mark != self.round && (near || vertex == start) {
                    *mark = self.round;
                    self.disc.push(neighbour);
                }
            }
        }
        let spread = 1.0 - sum.length() / area;
        1.0 / (1.0 + spread / BENT)
    }
}
