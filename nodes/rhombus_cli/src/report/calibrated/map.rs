//! Where on the body the calibrated field is off: the surface seen along the contact's normal, coloured by its error.

use glam::{DVec2, DVec3};
use rhombus_chain::SurfaceMesh;

use super::FULL;
use super::judged::Judged;
use crate::report::figure::{Axis, Figure, Line, Marker, Point, Series};
use crate::report::plot;
use crate::report::section::Exhibit;
use crate::report::subject::{Model, Place, Subject};
use crate::report::table::Table;
use crate::report::truth::TruthSite;

/// Depth of the press, m.
const DEPTH_M: f64 = 0.005;
/// Upper ends of the classes of error, % of depth, and their colours in the palette: blue to red.
const CLASSES: [(f64, usize); 6] = [(1.0, 0), (2.0, 6), (5.0, 2), (10.0, 4), (20.0, 1), (f64::INFINITY, 10)];

/// The site with the median error and the worst one. `model` is set up for the body.
pub(super) fn maps(judged: &Judged, model: &mut Model) -> Vec<Exhibit> {
    let mut places: Vec<usize> = (0..judged.score.0.len()).collect();
    let full = |place: usize| FULL(&judged.score.0[place].1);
    places.sort_by(|a, b| full(*a).total_cmp(&full(*b)));
    let wanted = [
        ("calibrated_map_median", "the site in the middle", places.get(places.len().saturating_sub(1) / 2)),
        ("calibrated_map_worst", "the worst site", places.last()),
    ];
    let draw = |(name, words, place): (_, _, Option<&usize>)| {
        let site = judged.sites.get(*place?)?;
        Some(map(name, words, full(*place?), judged.body.mesh(), site, model))
    };
    wanted.into_iter().filter_map(draw).collect()
}

fn map(
    name: &'static str,
    words: &str,
    full: f64,
    mesh: &SurfaceMesh,
    site: &TruthSite,
    model: &mut Model,
) -> Exhibit {
    let mut field = vec![DVec3::ZERO; mesh.vertices().len()];
    model.settled(&Place::from(site), DEPTH_M, &mut field);
    let errors: Vec<f64> = (field.iter().zip(&site.displacement))
        .map(|(moved, exact)| 100.0 * (*moved / DEPTH_M - *exact).length())
        .collect();
    let class = |face: &[u32; 3]| {
        let error = face.iter().map(|corner| errors[*corner as usize]).sum::<f64>() / 3.0;
        CLASSES.iter().position(|(most, _)| error <= *most).unwrap_or(CLASSES.len() - 1)
    };
    let view = View::new(site);
    let mut table = Table::new([("error", "% of depth"), ("share of the surface", "%")]);
    let mut areas_m2 = [0.0; CLASSES.len()];
    for face in mesh.triangles() {
        areas_m2[class(face)] += area_m2(corners(mesh, face));
    }
    let all_m2: f64 = areas_m2.iter().sum();
    let mut shapes: [Vec<Point>; CLASSES.len()] = std::array::from_fn(|_| Vec::new());
    for face in view.visible(mesh) {
        shapes[class(&face)].extend(corners(mesh, &face).map(|corner| view.point(corner)));
    }
    let mut series = Vec::new();
    for (which, shape) in shapes.into_iter().enumerate() {
        let name = range(which);
        table.push([name.as_str().into(), (100.0 * areas_m2[which] / all_m2).into()]);
        let name = format!("error {name} % of depth");
        series.push(Series {
            name,
            points: shape,
            line: Line::Faces,
            marker: Marker::None,
            colour: CLASSES[which].1,
        });
    }
    let contact = view.point(site.point);
    series.push(Series {
        name: "contact".to_owned(),
        points: vec![contact],
        line: Line::None,
        marker: Marker::Ring,
        colour: 5,
    });
    let (x, y) = ranges(&series);
    Exhibit {
        name,
        title: format!("Error over the surface: {words}"),
        caption: format!(
            "Site {}, pressed {:.0} mm deep, seen along the normal of the contact: size of the error of each vertex's displacement vector. \
             Relative L2 error of the whole surface {:.1} %. The table counts the faces that are not seen too.",
            site.site,
            1e3 * DEPTH_M,
            100.0 * full
        ),
        figure: Some(Figure {
            x: Axis::linear("across [mm]").within(x.0, x.1),
            y: Axis::linear("up [mm]").within(y.0, y.1),
            series,
        }),
        table,
        raw: None,
    }
}

fn range(class: usize) -> String {
    let low = class.checked_sub(1).map_or(0.0, |before| CLASSES[before].0);
    match CLASSES[class].0 {
        most if most.is_finite() => format!("{low} to {most}"),
        _ => format!("above {low}"),
    }
}

fn corners(mesh: &SurfaceMesh, face: &[u32; 3]) -> [DVec3; 3] {
    face.map(|corner| mesh.vertices()[corner as usize])
}

fn area_m2([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).cross(c - a).length()
}

/// Ranges of both axes with one scale and all points.
fn ranges(series: &[Series]) -> ((f64, f64), (f64, f64)) {
    let points = || series.iter().flat_map(|series| &series.points).map(|point| DVec2::new(point.x, point.y));
    let low = points().fold(DVec2::INFINITY, DVec2::min);
    let high = points().fold(DVec2::NEG_INFINITY, DVec2::max);
    let (middle, half) = (0.5 * (low + high), 0.53 * (high - low));
    let half_height = half.y.max(half.x / plot::ASPECT);
    let half_width = half_height * plot::ASPECT;
    ((middle.x - half_width, middle.x + half_width), (middle.y - half_height, middle.y + half_height))
}

/// The body as it is seen from outside along the normal of a contact.
struct View {
    right: DVec3,
    up: DVec3,
    towards: DVec3,
}

impl View {
    fn new(site: &TruthSite) -> Self {
        let towards = site.normal;
        // Up is up, but for a contact that is seen from above.
        let above = if towards.z.abs() < 0.9 { DVec3::Z } else { DVec3::Y };
        let up = (above - towards * above.dot(towards)).normalize_or_zero();
        Self { right: up.cross(towards), up, towards }
    }

    fn seen(&self, at: DVec3) -> DVec2 {
        DVec2::new(at.dot(self.right), at.dot(self.up))
    }

    /// In mm, to a hundredth.
    fn point(&self, at: DVec3) -> Point {
        let [x, y] = self.seen(at).to_array().map(|metres| (1e5 * metres).round() / 100.0);
        Point::new(x, y)
    }

    /// Faces that look this way and whose middle no other hides.
    fn visible(&self, mesh: &SurfaceMesh) -> Vec<[u32; 3]> {
        let near = |[a, b, c]: [DVec3; 3]| (a + b + c).dot(self.towards) / 3.0;
        let faces: Vec<([u32; 3], [DVec2; 3], f64)> = mesh
            .triangles()
            .iter()
            .map(|face| (face, corners(mesh, face)))
            .map(|(face, corners)| (*face, corners.map(|corner| self.seen(corner)), near(corners)))
            .filter(|(_, [a, b, c], _)| (*b - *a).perp_dot(*c - *a) > 0.0)
            .collect();
        let hidden = |(_, [a, b, c], depth): &([u32; 3], [DVec2; 3], f64)| {
            let middle = (*a + *b + *c) / 3.0;
            faces.iter().any(|(_, corners, other)| *other > *depth && holds(corners, middle))
        };
        faces.iter().filter(|face| !hidden(face)).map(|(face, _, _)| *face).collect()
    }
}

/// Whether a counter-clockwise triangle holds a point.
fn holds([a, b, c]: &[DVec2; 3], point: DVec2) -> bool {
    [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| (*to - *from).perp_dot(point - *from) > 0.0)
}

#[cfg(test)]
mod tests {
    use super::{View, area_m2};
    use glam::DVec3;
    use rhombus_chain::SurfaceMesh;
    use scene::{BodyKind, generate};

    fn view(towards: DVec3) -> View {
        let up = towards.any_orthonormal_vector();
        View { right: up.cross(towards), up, towards }
    }

    #[test]
    fn of_a_ball_half_is_seen_and_it_looks_like_a_disc() {
        let shape = generate::body(BodyKind::Sphere, 2000);
        let mesh = SurfaceMesh::new(shape.vertices, shape.triangles).unwrap();
        for towards in [DVec3::Z, -DVec3::X, DVec3::new(0.6, 0.0, 0.8)] {
            let view = view(towards);
            let seen = view.visible(&mesh);
            let flat = |face: [u32; 3]| {
                area_m2(face.map(|corner| view.seen(mesh.vertices()[corner as usize]).extend(0.0)))
            };
            let area_m2: f64 = seen.into_iter().map(flat).sum();
            assert!((area_m2 / (std::f64::consts::PI * 0.05 * 0.05) - 1.0).abs() < 0.01, "{area_m2}");
        }
    }

    #[test]
    fn what_lies_behind_is_not_seen() {
        // A small ball behind a large one: two parts of one surface.
        let ball = |at: DVec3, size: f64, first: u32| {
            let shape = generate::body(BodyKind::Sphere, 300);
            let vertices: Vec<DVec3> = shape.vertices.iter().map(|vertex| at + size * *vertex).collect();
            let faces: Vec<[u32; 3]> =
                shape.triangles.iter().map(|face| face.map(|corner| corner + first)).collect();
            (vertices, faces)
        };
        let (mut vertices, mut faces) = ball(DVec3::ZERO, 1.0, 0);
        let first = vertices.len() as u32;
        let (behind, behind_faces) = ball(-0.2 * DVec3::Z, 0.5, first);
        vertices.extend(behind);
        faces.extend(behind_faces);
        let mesh = SurfaceMesh::new(vertices, faces).unwrap();
        let of_small = |towards| view(towards).visible(&mesh).iter().filter(|face| face[0] >= first).count();
        assert_eq!(of_small(DVec3::Z), 0);
        assert!(of_small(-DVec3::Z) > 200);
        assert!(of_small(DVec3::X) > 200);
    }
}
