//! Where the body is pressed: well-spread vertices, and which of them share a mesh of tetrahedra.

use anyhow::ensure;
use glam::DVec3;
use rhombus_chain::{ArcLengths, SurfaceMesh};

use crate::calibrate::errors::at_vertex;

/// Sites where nothing else is asked for.
pub(super) const DEFAULT_SITES: usize = 80;

/// The fit takes minutes and memory: 4 minutes and 2.2 GB for a block with 160; with 240 it had 3.2 GB and was not at its end
/// after 12 minutes.
pub(super) const MOST_SITES: usize = 240;

/// A site is at least this many contact radii from what is held: a disc there would touch it.
const CLEARANCE: f64 = 2.0;
/// Sites of a batch are pressed one by one on one mesh; it is refined around each.
const MOST_IN_BATCH: usize = 8;
/// Contact radii between two sites of a batch.
const APART: f64 = 6.4;
/// There is no way from a site to a vertex.
const FAR: f32 = 1e9;

/// What is chosen.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sites {
    /// Vertices, in an order of which any first part is well spread.
    pub(super) vertices: Vec<usize>,
    /// Places in `vertices` that share a mesh.
    pub(super) batches: Vec<Vec<usize>>,
}

/// Fewest sites that tell about harmonics and body modes: `12 + 8 H`, and two for each mode.
pub(super) fn fewest(harmonics: usize, modes: usize) -> usize {
    (12 + 8 * harmonics).max(2 * modes)
}

/// Chooses `count` vertices, each the one farthest from all before it, from `held` and from `taken` (sites that only judge,
/// which are not used themselves). The first is the vertex farthest from where the body is held.
///
/// # Errors
/// Fewer vertices than `count` are far enough from where the body is held.
pub(super) fn choose(
    mesh: &SurfaceMesh,
    held: &[bool],
    taken: &[usize],
    count: usize,
    contact_radius_m: f64,
) -> anyhow::Result<Sites> {
    let points = mesh.vertices();
    let held_points: Vec<DVec3> =
        points.iter().zip(held).filter(|(_, held)| **held).map(|(p, _)| *p).collect();
    let clearance: Vec<f64> = points.iter().map(|point| nearest(*point, &held_points)).collect();
    let mut candidates: Vec<usize> = (0..points.len())
        .filter(|vertex| clearance[*vertex] >= CLEARANCE * contact_radius_m && !taken.contains(vertex))
        .collect();
    ensure!(
        candidates.len() >= count,
        "--sites {count}: {} vertices are {CLEARANCE} contact radii ({:.4} m) or more from where the body is held; accepted: so \
         many sites at most",
        candidates.len(),
        CLEARANCE * contact_radius_m
    );
    let taken_points: Vec<DVec3> = taken.iter().map(|vertex| points[*vertex]).collect();
    // How far each candidate is from what was chosen; from what is held as long as nothing was.
    let mut distance: Vec<f64> = candidates
        .iter()
        .map(
            |vertex| {
                if taken.is_empty() { clearance[*vertex] } else { nearest(points[*vertex], &taken_points) }
            },
        )
        .collect();
    let mut vertices = Vec::with_capacity(count);
    while vertices.len() < count {
        // The first of several that are as far.
        let farthest =
            (0..candidates.len()).max_by(|a, b| distance[*a].total_cmp(&distance[*b]).then(b.cmp(a)));
        let Some(place) = farthest else { break };
        let vertex = candidates.swap_remove(place);
        distance.swap_remove(place);
        let first = vertices.is_empty() && taken.is_empty();
        for (distance, other) in distance.iter_mut().zip(&candidates) {
            let apart = points[*other].distance(points[vertex]);
            *distance = if first { apart } else { distance.min(apart) };
        }
        vertices.push(vertex);
    }
    let batches = batches(points, &vertices, APART * contact_radius_m);
    Ok(Sites { vertices, batches })
}

fn nearest(point: DVec3, others: &[DVec3]) -> f64 {
    others.iter().map(|other| other.distance_squared(point)).fold(f64::INFINITY, f64::min).sqrt()
}

/// Each site into the first batch with room whose sites are far enough away.
fn batches(points: &[DVec3], vertices: &[usize], apart_m: f64) -> Vec<Vec<usize>> {
    let mut batches: Vec<Vec<usize>> = Vec::new();
    for (site, vertex) in vertices.iter().enumerate() {
        let fits = |batch: &&mut Vec<usize>| {
            batch.len() < MOST_IN_BATCH
                && batch.iter().all(|other| points[vertices[*other]].distance(points[*vertex]) >= apart_m)
        };
        match batches.iter_mut().find(fits) {
            Some(batch) => batch.push(site),
            None => batches.push(vec![site]),
        }
    }
    batches
}

/// Arc lengths from each site to all vertices, S x V, m.
pub(super) fn arcs(mesh: &SurfaceMesh, sites: &[usize]) -> Vec<f32> {
    let vertices = mesh.vertices().len();
    let mut solver = ArcLengths::new(mesh);
    let mut arcs = vec![FAR; sites.len() * vertices];
    for (site, row) in sites.iter().zip(arcs.chunks_exact_mut(vertices)) {
        let Some(at) = at_vertex(mesh, *site as u32) else { continue };
        solver.solve(mesh, at, f64::INFINITY);
        for (vertex, arc_m) in solver.iter() {
            row[vertex as usize] = arc_m as f32;
        }
    }
    arcs
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{BodyKind, generate};

    fn liver() -> (SurfaceMesh, Vec<bool>) {
        let shape = generate::body(BodyKind::Liver, 3116);
        let mesh = SurfaceMesh::new(shape.vertices, shape.triangles).unwrap();
        let held = mesh.vertex_normals().iter().map(|n| n.z < -0.7).collect();
        (mesh, held)
    }

    #[test]
    fn sites_keep_away_from_what_is_held_from_each_other_and_from_those_that_judge() {
        let (mesh, held) = liver();
        let points = mesh.vertices();
        let taken = [1428, 2166, 85];
        let sites = choose(&mesh, &held, &taken, 80, 0.005).unwrap();
        assert_eq!(sites.vertices.len(), 80);
        for (i, site) in sites.vertices.iter().enumerate() {
            let clear =
                (0..points.len()).filter(|v| held[*v]).all(|v| points[v].distance(points[*site]) >= 0.010);
            let others = sites.vertices[..i].iter().chain(&taken);
            let apart =
                others.map(|other| points[*other].distance(points[*site])).fold(f64::INFINITY, f64::min);
            assert!(clear && apart > 0.012, "{site}: {apart}");
        }
        let in_batches: usize = sites.batches.iter().map(Vec::len).sum();
        assert_eq!(in_batches, 80);
        for batch in &sites.batches {
            let at = |k: usize| points[sites.vertices[batch[k]]];
            assert!(batch.len() <= 8);
            assert!((0..batch.len()).all(|i| (0..i).all(|j| at(i).distance(at(j)) >= 0.032)), "{batch:?}");
        }
    }

    #[test]
    fn a_longer_list_begins_as_a_shorter_one() {
        let (mesh, held) = liver();
        let long = choose(&mesh, &held, &[], 40, 0.005).unwrap().vertices;
        assert_eq!(long[..20], choose(&mesh, &held, &[], 20, 0.005).unwrap().vertices);
    }

    #[test]
    fn arcs_are_zero_at_the_site_and_never_shorter_than_the_straight_way() {
        let (mesh, _) = liver();
        let arcs = arcs(&mesh, &[85, 1428]);
        for (site, row) in [85, 1428].into_iter().zip(arcs.chunks_exact(3116)) {
            assert_eq!(row[site], 0.0);
            let straight = |vertex: usize| mesh.vertices()[vertex].distance(mesh.vertices()[site]);
            assert!((0..3116).all(|vertex| f64::from(row[vertex]) > 0.95 * straight(vertex) - 1e-7));
        }
    }
}
