//! A first triangulation: two poles on the x axis and rings of vertices between them, spaced as evenly on the body as
//! rings allow.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::round::RoundBody;

/// Samples along a meridian and around a ring from which lengths are measured.
const MERIDIAN: usize = 400;
const AROUND: usize = 128;

/// Points of the unit sphere and outward triangles between them: exactly `vertices` points (at least 14).
pub(super) fn triangulate(body: &impl RoundBody, vertices: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let layout = Layout::measure(body);
    let counts = layout.ring_counts(vertices);
    let mut points = vec![-DVec3::X];
    let mut rings: Vec<Ring> = Vec::new();
    for (j, count) in counts.iter().enumerate() {
        let tilt = layout.tilt_at(layout.length() * (j + 1) as f64 / (counts.len() + 1) as f64);
        // Every other ring starts half a step later, so that triangles are nearly equilateral from the start.
        let shift = if j % 2 == 0 { 0.0 } else { 0.5 };
        let ring = Ring { first: points.len() as u32, count: *count as u32, shift };
        points.extend(evenly_around(body, tilt, *count, shift));
        rings.push(ring);
    }
    points.push(DVec3::X);
    (points, stitch(&rings))
}

/// Lengths on the body along the axis: `along[k]` from the first pole to tilt `PI k / MERIDIAN`, `around[k]` the
/// perimeter there.
struct Layout {
    along: Vec<f64>,
    around: Vec<f64>,
}

impl Layout {
    fn measure(body: &impl RoundBody) -> Layout {
        let ring = |k: usize| -> Vec<DVec3> {
            let tilt = PI * k as f64 / MERIDIAN as f64;
            (0..AROUND)
                .map(|i| body.body_from_ball(on_sphere(tilt, TAU * i as f64 / AROUND as f64)))
                .collect()
        };
        let mut previous = ring(0);
        let (mut along, mut around) = (vec![0.0], vec![0.0]);
        let mut total = 0.0;
        for k in 1..=MERIDIAN {
            let here = ring(k);
            let step: f64 = here.iter().zip(&previous).map(|(a, b)| a.distance(*b)).sum();
            total += step / AROUND as f64;
            along.push(total);
            around.push((0..AROUND).map(|i| here[i].distance(here[(i + 1) % AROUND])).sum());
            previous = here;
        }
        Layout { along, around }
    }

    fn length(&self) -> f64 {
        self.along[MERIDIAN]
    }

    /// Where between samples the length from the first pole is `length`: sample and fraction.
    fn locate(&self, length: f64) -> (usize, f64) {
        let k = self.along.partition_point(|along| *along <= length).clamp(1, MERIDIAN) - 1;
        let step = self.along[k + 1] - self.along[k];
        (k, ((length - self.along[k]) / step).clamp(0.0, 1.0))
    }

    fn tilt_at(&self, length: f64) -> f64 {
        let (k, fraction) = self.locate(length);
        PI * (k as f64 + fraction) / MERIDIAN as f64
    }

    fn perimeter_at(&self, length: f64) -> f64 {
        let (k, fraction) = self.locate(length);
        self.around[k] + fraction * (self.around[k + 1] - self.around[k])
    }

    /// How many vertices each ring gets, `vertices` less the two poles in all: rows of equilateral triangles would have
    /// a height of `sqrt(3)/2` of their edge.
    fn ring_counts(&self, vertices: usize) -> Vec<usize> {
        let area: f64 = (0..MERIDIAN)
            .map(|k| (self.along[k + 1] - self.along[k]) * (self.around[k + 1] + self.around[k]) / 2.0)
            .sum();
        let row = (3.0_f64.sqrt() / 2.0 * area / vertices as f64).sqrt();
        let rings = ((self.length() / row).round() as usize).saturating_sub(1).clamp(1, (vertices - 2) / 4);
        let perimeters: Vec<f64> = (0..rings)
            .map(|j| self.perimeter_at(self.length() * (j + 1) as f64 / (rings + 1) as f64))
            .collect();
        apportion(&perimeters, vertices - 2, 4)
    }
}

/// `total` seats, at least `least` for each, the rest in proportion, largest remainders first.
fn apportion(shares: &[f64], total: usize, least: usize) -> Vec<usize> {
    let spare = (total - least * shares.len()) as f64;
    // What is above the least is shared out among those whose proportion is above it.
    let whole: f64 = shares.iter().sum();
    let above: Vec<f64> = shares.iter().map(|s| (s / whole * total as f64 - least as f64).max(0.0)).collect();
    let sum: f64 = above.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let exact: Vec<f64> = above.iter().map(|a| least as f64 + a / sum * spare).collect();
    let mut counts: Vec<usize> = exact.iter().map(|e| *e as usize).collect();
    let mut order: Vec<usize> = (0..shares.len()).collect();
    order.sort_by(|a, b| (exact[*b].fract()).total_cmp(&exact[*a].fract()).then(a.cmp(b)));
    let missing = total.saturating_sub(counts.iter().sum());
    for i in 0..missing {
        counts[order[i % order.len()]] += 1;
    }
    counts
}

fn on_sphere(tilt: f64, turn: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(tilt);
    let (sin_turn, cos_turn) = libm::sincos(turn);
    DVec3::new(-cos, sin * cos_turn, sin * sin_turn)
}

/// `count` points of one ring, equally spaced on the body.
fn evenly_around(body: &impl RoundBody, tilt: f64, count: usize, shift: f64) -> impl Iterator<Item = DVec3> {
    let samples = (4 * count).max(AROUND);
    let turn = move |i: f64| TAU * i / samples as f64;
    let mut lengths = vec![0.0];
    let mut previous = body.body_from_ball(on_sphere(tilt, 0.0));
    let mut total = 0.0;
    for i in 1..=samples {
        let here = body.body_from_ball(on_sphere(tilt, turn(i as f64)));
        total += here.distance(previous);
        lengths.push(total);
        previous = here;
    }
    (0..count).map(move |i| {
        let length = (i as f64 + shift) / count as f64 * total;
        let k = lengths.partition_point(|l| *l <= length).clamp(1, samples) - 1;
        let fraction = (length - lengths[k]) / (lengths[k + 1] - lengths[k]);
        on_sphere(tilt, turn(k as f64 + fraction))
    })
}

struct Ring {
    first: u32,
    count: u32,
    shift: f64,
}

impl Ring {
    fn vertex(&self, i: u32) -> u32 {
        self.first + i % self.count
    }

    /// Where vertex `i` is on the ring, one turn being 1.
    fn place(&self, i: u32) -> f64 {
        (f64::from(i) + self.shift) / f64::from(self.count)
    }
}

/// Triangles between the poles and the rings. Turning grows from y to z, so seen from the first pole (-x, outside) a
/// ring runs clockwise.
fn stitch(rings: &[Ring]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    if let Some(first) = rings.first() {
        triangles.extend((0..first.count).map(|i| [0, first.vertex(i + 1), first.vertex(i)]));
    }
    for pair in rings.windows(2) {
        let (low, high) = (&pair[0], &pair[1]);
        let (mut i, mut j) = (0, 0);
        while i < low.count || j < high.count {
            let advance_low = j == high.count || (i < low.count && low.place(i + 1) <= high.place(j + 1));
            if advance_low {
                triangles.push([low.vertex(i), low.vertex(i + 1), high.vertex(j)]);
                i += 1;
            } else {
                triangles.push([low.vertex(i), high.vertex(j + 1), high.vertex(j)]);
                j += 1;
            }
        }
    }
    if let Some(last) = rings.last() {
        let pole = last.first + last.count;
        triangles.extend((0..last.count).map(|i| [pole, last.vertex(i), last.vertex(i + 1)]));
    }
    triangles
}
