//! A picture of the error over the surface: four views, the sites, a scale.
//!
//! Between the sites the error is their average, weighted by how alike a place and a site are in position and normal:
//! `exp(-|dx|^2 / 2 l^2 - |dn|^2 / 2)`, `l` half the mean distance from a site to the next one.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};
use rhombus_chain::SurfaceMesh;

use super::errors::Judged;

/// Right and up of a view, seen from where the two span a right-handed frame with it.
struct View {
    name: &'static str,
    right: DVec3,
    up: DVec3,
}

const VIEWS: [View; 4] = [
    View { name: "from above (+z)", right: DVec3::X, up: DVec3::Y },
    View { name: "from the front (-y)", right: DVec3::X, up: DVec3::Z },
    View { name: "from the right (+x)", right: DVec3::Y, up: DVec3::Z },
    View { name: "from the left (-x)", right: DVec3::NEG_Y, up: DVec3::Z },
];

/// Pixels: a view's square, and what is around it.
const VIEW: f64 = 400.0;
const MARGIN: f64 = 24.0;
const LEGEND: f64 = 92.0;

/// From no error to the largest, red, green and blue: light to dark, apart for colour-blind eyes.
const COLOURS: [[f64; 3]; 5] = [
    [247.0, 244.0, 221.0],
    [238.0, 199.0, 110.0],
    [219.0, 126.0, 62.0],
    [158.0, 53.0, 72.0],
    [70.0, 22.0, 66.0],
];

/// An SVG document. `title`: what is shown, one line.
pub(super) fn draw(mesh: &SurfaceMesh, sites: &[Judged], title: &str) -> String {
    let largest = sites.iter().map(|site| site.field).fold(0.0, f64::max);
    let top = scale_top(largest);
    let errors = at_vertices(mesh, sites);
    let (width, height) = (2.0 * VIEW + 3.0 * MARGIN, 2.0 * VIEW + 3.0 * MARGIN + LEGEND);
    // Writing to a String does not fail.
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"13\" fill=\"#22262b\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    let _ = writeln!(svg, "<text x=\"{MARGIN}\" y=\"22\">{}</text>", escaped(title));
    legend(&mut svg, top, sites.len());
    let [low, high] = mesh.extents();
    let middle = (low + high) / 2.0;
    let scale = (VIEW - MARGIN) / (high - low).max_element();
    for (place, view) in VIEWS.iter().enumerate() {
        let corner = DVec2::new(
            MARGIN + (place % 2) as f64 * (VIEW + MARGIN),
            LEGEND + MARGIN + (place / 2) as f64 * (VIEW + MARGIN),
        );
        let centre = corner + VIEW / 2.0;
        let towards = view.right.cross(view.up);
        let seen = |point: DVec3| {
            let offset = point - middle;
            centre + scale * DVec2::new(offset.dot(view.right), -offset.dot(view.up))
        };
        let _ = writeln!(svg, "<text x=\"{:.0}\" y=\"{:.0}\">{}</text>", corner.x, corner.y, view.name);
        let _ = writeln!(svg, "<g stroke-width=\"0.4\" stroke-linejoin=\"round\">");
        let mut faces: Vec<(f64, u32)> = (0..mesh.triangles().len() as u32)
            .filter(|face| mesh.face_normal(*face).dot(towards) > 0.0)
            .map(|face| (mesh.corners(face).iter().map(|corner| corner.dot(towards)).sum(), face))
            .collect();
        faces.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (_, face) in faces {
            let corners = mesh.triangles()[face as usize];
            let error = corners.iter().map(|vertex| errors[*vertex as usize]).sum::<f64>() / 3.0;
            let light = 0.72 + 0.28 * mesh.face_normal(face).dot(towards);
            let fill = colour(error / top, light);
            let points = mesh.corners(face).map(seen).map(|p| format!("{:.1},{:.1}", p.x, p.y));
            let _ = writeln!(
                svg,
                "<path d=\"M{}L{}L{}z\" fill=\"{fill}\" stroke=\"{fill}\"/>",
                points[0], points[1], points[2]
            );
        }
        let _ = writeln!(svg, "</g>");
        for site in sites {
            // Those on the other side are not seen; those behind a lobe are, through it.
            if mesh.vertex_normals()[site.vertex].dot(towards) > 0.0 {
                let at = seen(mesh.vertices()[site.vertex]);
                let _ = writeln!(
                    svg,
                    "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"4\" fill=\"{}\" stroke=\"#22262b\"><title>vertex {}: {:.1} %</title></circle>",
                    at.x,
                    at.y,
                    colour(site.field / top, 1.0),
                    site.vertex,
                    100.0 * site.field
                );
            }
        }
    }
    svg.push_str("</svg>\n");
    svg
}

/// The scale ends at a round number: steps of 5 %, or 1 % for small errors.
fn scale_top(largest: f64) -> f64 {
    let step = if largest <= 0.05 { 0.01 } else { 0.05 };
    step * (largest / step - 1e-9).ceil().max(1.0)
}

fn legend(svg: &mut String, top: f64, sites: usize) {
    const STEPS: usize = 50;
    let (left, y, width) = (MARGIN, 36.0, 300.0);
    for step in 0..STEPS {
        let share = (step as f64 + 0.5) / STEPS as f64;
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{y}\" width=\"{:.1}\" height=\"14\" fill=\"{}\"/>",
            left + width * step as f64 / STEPS as f64,
            width / STEPS as f64 + 0.5,
            colour(share, 1.0)
        );
    }
    for quarter in 0..5 {
        let share = f64::from(quarter) / 4.0;
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"66\" text-anchor=\"middle\">{}</text>",
            left + width * share,
            (1e4 * top * share).round() / 100.0
        );
    }
    let words = format!("circles: {sites} sites, each left out of the fit that judges it");
    for (y, line) in [(47, "relative L2 error of the whole field [%]"), (66, &words)] {
        let _ = writeln!(svg, "<text x=\"{:.1}\" y=\"{y}\">{line}</text>", left + width + 20.0);
    }
}

fn colour(share: f64, light: f64) -> String {
    let along = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let begin = (along as usize).min(COLOURS.len() - 2);
    let part = along - begin as f64;
    let channel = |k: usize| {
        let value = COLOURS[begin][k] + part * (COLOURS[begin + 1][k] - COLOURS[begin][k]);
        (light * value).round().clamp(0.0, 255.0) as u8
    };
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}

fn at_vertices(mesh: &SurfaceMesh, sites: &[Judged]) -> Vec<f64> {
    let place = |vertex: usize| (mesh.vertices()[vertex], mesh.vertex_normals()[vertex]);
    let places: Vec<(DVec3, DVec3)> = sites.iter().map(|site| place(site.vertex)).collect();
    let next = |k: usize| {
        let others = places.iter().enumerate().filter(|(other, _)| *other != k);
        others.map(|(_, (point, _))| point.distance(places[k].0)).fold(f64::INFINITY, f64::min)
    };
    let spacing_m =
        (0..places.len()).map(next).filter(|d| d.is_finite()).sum::<f64>() / places.len().max(1) as f64;
    let length_m = 0.5 * spacing_m.max(f64::MIN_POSITIVE);
    (0..mesh.vertices().len())
        .map(|vertex| {
            let (point, normal) = place(vertex);
            let exponents: Vec<f64> = places
                .iter()
                .map(|(p, n)| {
                    0.5 * (p.distance_squared(point) / (length_m * length_m) + n.distance_squared(normal))
                })
                .collect();
            // The nearest site counts 1: far from all sites nothing vanishes.
            let least = exponents.iter().copied().fold(f64::INFINITY, f64::min);
            let (mut sum, mut weights) = (0.0, 0.0);
            for (exponent, site) in exponents.iter().zip(sites) {
                let weight = libm::exp(least - exponent);
                sum += weight * site.field;
                weights += weight;
            }
            if weights > 0.0 { sum / weights } else { 0.0 }
        })
        .collect()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{BodyKind, generate};

    #[test]
    fn the_surface_is_coloured_by_the_sites_and_never_beyond_them() {
        let shape = generate::body(BodyKind::Sphere, 300);
        let mesh = SurfaceMesh::new(shape.vertices, shape.triangles).unwrap();
        let sites: Vec<Judged> = (0..12)
            .map(|k| Judged { vertex: 25 * k, field: 0.02 * k as f64, near: 0.0, force: 0.0 })
            .collect();
        let errors = at_vertices(&mesh, &sites);
        assert!(errors.iter().all(|error| (0.0..=0.22).contains(error)));
        for site in &sites {
            assert!((errors[site.vertex] - site.field).abs() < 0.05, "{site:?}: {}", errors[site.vertex]);
        }
        let svg = draw(&mesh, &sites, "a <sphere>");
        assert!(svg.contains("a &lt;sphere&gt;") && svg.contains("vertex 275: 22.0 %"), "{svg:.300}");
        assert_eq!(svg, draw(&mesh, &sites, "a <sphere>"));
    }

    #[test]
    fn the_scale_ends_at_a_round_number_above_the_largest_error() {
        for (largest, top) in [(0.0, 0.01), (0.012, 0.02), (0.05, 0.05), (0.051, 0.10), (0.27, 0.30)] {
            assert!((scale_top(largest) - top).abs() < 1e-12, "{largest}");
        }
    }
}
