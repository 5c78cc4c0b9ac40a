//! Whether a surface crosses or touches itself, and where: no tetrahedra fill such a body.
//!
//! Pairs of triangles whose boxes meet are told apart by the signs of determinants that are exact, so neighbours are never
//! taken for a crossing. With `o(a, b, c, p)` the side of the plane of a, b, c on which p lies, an edge p-q meets a triangle
//! when p and q are not on one side of it and the edge's line passes all of its edges on the same side.

use glam::DVec3;
use rhombus_chain::SurfaceMesh;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Two triangles that have more in common than their common vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// Both, counted from 0.
    pub(super) triangles: [usize; 2],
    /// A corner of the first, m.
    pub(super) near: DVec3,
}

type Triangle = [DVec3; 3];

/// The first crossing along the body's longest axis.
pub(super) fn find(mesh: &SurfaceMesh) -> Option<Crossing> {
    let [low, high] = mesh.extents();
    let size = high - low;
    let axis = (0..3).max_by(|a, b| size[*a].total_cmp(&size[*b])).unwrap_or(0);
    let mut boxes: Vec<(usize, [DVec3; 2])> = (0..mesh.triangles().len())
        .map(|face| {
            let [a, b, c] = mesh.corners(face as u32);
            (face, [a.min(b).min(c), a.max(b).max(c)])
        })
        .collect();
    boxes.sort_by(|(_, [a, _]), (_, [b, _])| a[axis].total_cmp(&b[axis]));
    for (place, (first, [low, high])) in boxes.iter().enumerate() {
        let ahead = boxes[place + 1..].iter().take_while(|(_, [other, _])| other[axis] <= high[axis]);
        for (second, [other_low, other_high]) in ahead {
            let meet = low.cmple(*other_high).all() && other_low.cmple(*high).all();
            if meet && cross(mesh, *first, *second) {
                let triangles = [*first.min(second), *first.max(second)];
                return Some(Crossing { triangles, near: mesh.corners(triangles[0] as u32)[0] });
            }
        }
    }
    None
}

/// Whether two triangles have a point in common that is no common vertex or edge.
fn cross(mesh: &SurfaceMesh, first: usize, second: usize) -> bool {
    let (a, b) = (mesh.triangles()[first], mesh.triangles()[second]);
    let (p, q) = (mesh.corners(first as u32), mesh.corners(second as u32));
    let shared = |corner: u32| b.iter().position(|other| *other == corner);
    let own: Vec<usize> = (0..3).filter(|k| shared(a[*k]).is_none()).collect();
    match own[..] {
        // Nothing in common: any edge in the other triangle.
        [_, _, _] => edges(&p).any(|edge| meets(edge, &q)) || edges(&q).any(|edge| meets(edge, &p)),
        // A vertex in common: what leaves it together ends on the edge opposite to it, of one or the other.
        [i, j] => {
            let others: Vec<usize> = (0..3).filter(|k| !a.contains(&b[*k])).collect();
            let [k, l] = others[..] else { return true };
            meets([p[i], p[j]], &q) || meets([q[k], q[l]], &p)
        }
        // An edge in common: only when one is folded onto the other.
        [i] => {
            let Some(k) = (0..3).find(|k| !a.contains(&b[*k])) else { return true };
            let [u, v] = [p[(i + 1) % 3], p[(i + 2) % 3]];
            side([u, v, p[i]], q[k]) == 0.0 && {
                let axis = widest(&p);
                let sign = |point: DVec3| turn(axis, u, v, point);
                sign(p[i]) * sign(q[k]) > 0.0
            }
        }
        _ => true,
    }
}

fn edges(triangle: &Triangle) -> impl Iterator<Item = [DVec3; 2]> + '_ {
    (0..3).map(|k| [triangle[k], triangle[(k + 1) % 3]])
}

/// Whether an edge and a triangle have a point in common.
fn meets([p, q]: [DVec3; 2], triangle: &Triangle) -> bool {
    let (from, to) = (side(*triangle, p), side(*triangle, q));
    if from == 0.0 && to == 0.0 {
        return meets_in_plane([p, q], triangle);
    }
    if from * to > 0.0 {
        return false;
    }
    let [a, b, c] = *triangle;
    let sides = [side([p, q, a], b), side([p, q, b], c), side([p, q, c], a)];
    !(sides.iter().any(|s| *s > 0.0) && sides.iter().any(|s| *s < 0.0))
}

/// The same where both lie in one plane.
fn meets_in_plane([p, q]: [DVec3; 2], triangle: &Triangle) -> bool {
    let axis = widest(triangle);
    let turns = |a: DVec3, b: DVec3, c: DVec3| turn(axis, a, b, c);
    let inside = |point: DVec3| {
        let sides = [0, 1, 2].map(|k| turns(triangle[k], triangle[(k + 1) % 3], point));
        sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
    };
    // Edges that cross; those that only touch end on the other or in it.
    inside(p)
        || inside(q)
        || edges(triangle).any(|[a, b]| {
            let (from, to) = (turns(p, q, a), turns(p, q, b));
            let apart = turns(a, b, p) * turns(a, b, q) < 0.0;
            apart && from * to <= 0.0 && (from != 0.0 || to != 0.0)
        })
}

/// Sign of the volume of a tetrahedron: on which side of the plane of three points another one lies; exact. -1, 0 or 1.
fn side([a, b, c]: Triangle, point: DVec3) -> f64 {
    let coordinates = |v: DVec3| Coord3D { x: v.x, y: v.y, z: v.z };
    sign(orient3d(coordinates(a), coordinates(b), coordinates(c), coordinates(point)))
}

/// Sign of the area of a triangle seen along an axis, exact. -1, 0 or 1.
fn turn(axis: usize, a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let seen = |v: DVec3| Coord { x: v[(axis + 1) % 3], y: v[(axis + 2) % 3] };
    sign(orient2d(seen(a), seen(b), seen(c)))
}

fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

/// The axis along which a triangle is seen widest.
fn widest([a, b, c]: &Triangle) -> usize {
    let normal = (*b - *a).cross(*c - *a).abs();
    (0..3).max_by(|i, j| normal[*i].total_cmp(&normal[*j])).unwrap_or(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{BodyKind, generate};

    fn mesh(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> SurfaceMesh {
        SurfaceMesh::new(vertices, triangles).unwrap()
    }

    #[test]
    fn generated_bodies_do_not_cross_themselves() {
        for kind in [BodyKind::Liver, BodyKind::Block, BodyKind::Sphere] {
            let shape = generate::body(kind, kind.default_vertices());
            assert_eq!(find(&mesh(shape.vertices, shape.triangles)), None, "{}", kind.name());
        }
    }

    #[test]
    fn a_vertex_pushed_through_the_other_side_is_found_and_one_short_of_it_is_not() {
        let shape = generate::body(BodyKind::Sphere, 600);
        let top = (0..shape.vertices.len())
            .max_by(|a, b| shape.vertices[*a].z.total_cmp(&shape.vertices[*b].z))
            .unwrap();
        let low = shape.vertices.iter().map(|v| v.z).fold(f64::INFINITY, f64::min);
        for (share, crosses) in [(0.9, false), (1.1, true)] {
            let mut vertices = shape.vertices.clone();
            vertices[top].z = share * low;
            let found = find(&mesh(vertices, shape.triangles.clone()));
            assert_eq!(found.is_some(), crosses, "{share}: {found:?}");
        }
    }

    /// Two tetrahedra, the second one moved.
    fn pair(offset: DVec3) -> SurfaceMesh {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let vertices = corners.iter().copied().chain(corners.iter().map(|c| *c + offset)).collect();
        let triangles = faces.iter().copied().chain(faces.map(|f| f.map(|v| v + 4))).collect();
        mesh(vertices, triangles)
    }

    #[test]
    fn what_touches_counts_whether_at_a_corner_an_edge_or_a_face() {
        let touching = [
            DVec3::new(1.0, 0.0, 0.0),   // corner on corner
            DVec3::new(0.5, 0.0, 0.0),   // an edge within an edge
            DVec3::new(0.25, 0.25, 0.5), // corner on a face
            DVec3::new(0.2, 0.2, 0.2),   // through each other
            DVec3::new(0.0, 0.0, -1.0),  // tip on a corner
        ];
        for offset in touching {
            assert!(find(&pair(offset)).is_some(), "{offset}");
        }
        for offset in [DVec3::new(1.0 + 1e-12, 0.0, 0.0), DVec3::splat(0.34), DVec3::new(0.0, 0.0, -1.1)] {
            assert_eq!(find(&pair(offset)), None, "{offset}");
        }
    }

    #[test]
    fn a_triangle_folded_onto_its_neighbour_is_found() {
        // A tent whose ridge was laid down: the two roofs lie in one plane, on the same side of their common edge.
        let u = DVec3::ZERO;
        let v = DVec3::X;
        let a = DVec3::new(0.3, 1.0, 0.0);
        let b = DVec3::new(0.6, 0.8, 0.0);
        let below = DVec3::new(0.5, 0.4, -1.0);
        let folded = mesh(
            vec![u, v, a, b, below],
            vec![[0, 1, 2], [1, 0, 3], [1, 4, 2], [2, 4, 0], [4, 1, 3], [0, 4, 3]],
        );
        assert!(find(&folded).is_some());
    }
}
