//! Where on a body the simulated hand presses: places on top of it that the device reaches, with flesh underneath.

use devices::Workspace;
use devices::simulated::{Motion, Site};
use glam::DVec3;
use rhombus_chain::Body;
use thiserror::Error;

use crate::placement::Placement;

/// Sites of one script: two pairs.
const SITES: usize = 4;
/// More vertices than this are thinned out before they are looked at closely.
const MOST_CANDIDATES: usize = 4000;
/// The upward part (device z) of a normal at which the hand still presses from above.
const LEAST_UPWARD: f64 = 0.8;
/// The same on the way of a slide.
const LEAST_UPWARD_SLIDING: f64 = 0.5;
/// Distance between the points of a slide, m.
const SLIDE_STEP_M: f64 = 0.0025;
/// The script keeps this far from the edge of the workspace, m.
const EDGE_MARGIN_M: f64 = 0.003;

/// There is nowhere to press.
#[derive(Debug, Error)]
#[error(
    "the simulated hand finds no place on the body that it can press from above: in the device frame the body is \
     {low_m:.3?} to {high_m:.3?} m, the device reaches {radius_m} m from its z axis and z within {half_height_m} m; \
     move one of them (body.pose, device.scene_from_device) or change device.motion_scale"
)]
pub(crate) struct NothingToPress {
    low_m: [f64; 3],
    high_m: [f64; 3],
    radius_m: f64,
    half_height_m: f64,
}

/// A body under a device, and the hand's sizes.
pub(crate) struct Ground<'a> {
    /// What is pressed.
    pub(crate) body: &'a Body,
    /// How it stands to the device.
    pub(crate) placement: Placement,
    /// Where the device's handle can be.
    pub(crate) workspace: Workspace,
    /// Sizes in metres of the scene; the travel height is not used.
    pub(crate) motion: Motion,
    /// Intended slide, metres of the scene.
    pub(crate) slide_m: f64,
}

/// A place on the surface in the body frame, with its unit normal.
#[derive(Clone, Copy)]
struct Place {
    point: DVec3,
    normal: DVec3,
}

impl Ground<'_> {
    /// Up to four sites, the first near the middle of what can be pressed and the others far from it and from each other,
    /// and the height (device frame, m) at which the hand passes over the body.
    pub(crate) fn sites(&self) -> Result<(Vec<Site>, f64), NothingToPress> {
        let travel_height_m = self.travel_height_m();
        let standing: Vec<Place> =
            self.tops().into_iter().filter(|place| self.can_be_pressed(place, travel_height_m)).collect();
        // Rather where the body is thick; thinner places when there is no other.
        let depth_m = self.motion.depth_m;
        let places = [3.0, 1.5, 0.0]
            .iter()
            .map(|times| {
                standing.iter().copied().filter(|p| self.is_thick(p, times * depth_m)).collect::<Vec<_>>()
            })
            .find(|places| !places.is_empty())
            .ok_or_else(|| self.nothing_to_press())?;
        let chosen = spread_out(&places);
        let middle = chosen.iter().map(|place| place.point).sum::<DVec3>() / chosen.len() as f64;
        Ok((chosen.iter().map(|place| self.site(place, middle)).collect(), travel_height_m))
    }

    /// Vertices that look upward, at most [`MOST_CANDIDATES`].
    fn tops(&self) -> Vec<Place> {
        let mesh = self.body.mesh();
        let up = self.placement.base_from_body.inverse().rotate(DVec3::Z);
        let tops: Vec<Place> = std::iter::zip(mesh.vertices(), mesh.vertex_normals())
            .map(|(&point, &normal)| Place { point, normal })
            .filter(|place| place.normal.dot(up) >= LEAST_UPWARD)
            .collect();
        let every = tops.len().div_ceil(MOST_CANDIDATES).max(1);
        tops.into_iter().step_by(every).collect()
    }

    /// Above everything that is under the device.
    fn travel_height_m(&self) -> f64 {
        let Motion { probe_radius_m, clearance_m, .. } = self.motion;
        let top_m = self.placement.top_m(self.body, &self.workspace);
        top_m + (probe_radius_m + 1.5 * clearance_m) / self.placement.motion_scale
    }

    /// Whether the hand gets there from above and presses without leaving the device's reach or meeting the body elsewhere.
    fn can_be_pressed(&self, place: &Place, travel_height_m: f64) -> bool {
        let Motion { probe_radius_m, clearance_m, depth_m, pull_m, .. } = self.motion;
        let at = |height_m| place.point + place.normal * height_m;
        let clear = at(probe_radius_m + clearance_m);
        let above = self.placement.to_device(clear).with_z(travel_height_m);
        let ends = [at(probe_radius_m - depth_m), at(probe_radius_m + pull_m)];
        self.reaches(above)
            && ends.iter().chain([&clear]).all(|&point| self.reaches(self.placement.to_device(point)))
            && self.is_free(clear, 0.9 * (probe_radius_m + clearance_m))
            && (1..=10).all(|tenth| {
                let on_the_way = self.placement.to_device(clear).lerp(above, f64::from(tenth) / 10.0);
                self.is_free(self.to_body(on_the_way), probe_radius_m)
            })
    }

    fn to_body(&self, point_in_device: DVec3) -> DVec3 {
        let Placement { base_from_body, motion_scale } = self.placement;
        base_from_body.inverse().transform_point(point_in_device * motion_scale)
    }

    /// Inside the workspace by a margin.
    fn reaches(&self, point_in_device: DVec3) -> bool {
        let Workspace { centre, radius_m, height_m } = self.workspace;
        let (radius_m, height_m) = (radius_m - EDGE_MARGIN_M, height_m - 2.0 * EDGE_MARGIN_M);
        let inner = Workspace { centre, radius_m, height_m };
        inner.contains(point_in_device)
    }

    /// Outside the body and at least `distance_m` from it.
    fn is_free(&self, point: DVec3, distance_m: f64) -> bool {
        let (mesh, index) = (self.body.mesh(), self.body.index());
        index.closest(mesh, point, distance_m).is_none() && !index.encloses(mesh, point)
    }

    /// Whether there is about `thickness_m` of body around a point that deep.
    fn is_thick(&self, place: &Place, thickness_m: f64) -> bool {
        let (mesh, index) = (self.body.mesh(), self.body.index());
        let inside = place.point - place.normal * thickness_m;
        thickness_m <= 0.0
            || (index.encloses(mesh, inside) && index.closest(mesh, inside, 0.8 * thickness_m).is_none())
    }

    /// The site at a place, in the device frame, with a slide along the surface past `towards`.
    fn site(&self, place: &Place, towards: DVec3) -> Site {
        let rotate = |direction| self.placement.base_from_body.rotate(direction);
        let to_device = |p: Place| (self.placement.to_device(p.point), rotate(p.normal));
        let (point, normal) = to_device(*place);
        Site { point, normal, slide: self.slide(place, towards).into_iter().map(to_device).collect() }
    }

    /// Points along the surface from a place in the direction of `towards`. Ends early where the surface turns down, folds
    /// or leaves the device's reach.
    fn slide(&self, from: &Place, towards: DVec3) -> Vec<Place> {
        let (mesh, index) = (self.body.mesh(), self.body.index());
        let Motion { probe_radius_m, clearance_m, .. } = self.motion;
        let up = self.placement.base_from_body.inverse().rotate(DVec3::Z);
        let across =
            |direction: DVec3, normal: DVec3| (direction - normal * direction.dot(normal)).try_normalize();
        let mut place = *from;
        let mut heading = across(towards - place.point, place.normal)
            .filter(|_| place.point.distance(towards) > 2.0 * SLIDE_STEP_M)
            .unwrap_or_else(|| place.normal.any_orthonormal_vector());
        let steps = (self.slide_m / SLIDE_STEP_M).floor() as usize;
        let mut slide = Vec::with_capacity(steps);
        while slide.len() < steps {
            let ahead = place.point + heading * SLIDE_STEP_M;
            let Some((at, _)) = index.closest(mesh, ahead, 2.0 * SLIDE_STEP_M) else { break };
            let next = Place { point: mesh.position(at), normal: mesh.normal(at) };
            let clear = next.point + next.normal * (probe_radius_m + clearance_m);
            let went_on = (next.point - place.point).dot(heading) > 0.5 * SLIDE_STEP_M;
            if !went_on
                || next.normal.dot(up) < LEAST_UPWARD_SLIDING
                || !self.reaches(self.placement.to_device(clear))
            {
                break;
            }
            heading = across(heading, next.normal).unwrap_or(heading);
            slide.push(next);
            place = next;
        }
        slide
    }

    fn nothing_to_press(&self) -> NothingToPress {
        let corners = self.body.mesh().vertices().iter().map(|&vertex| self.placement.to_device(vertex));
        let (low, high) = corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| {
            (low.min(point), high.max(point))
        });
        NothingToPress {
            low_m: low.to_array(),
            high_m: high.to_array(),
            radius_m: self.workspace.radius_m,
            half_height_m: 0.5 * self.workspace.height_m,
        }
    }
}

/// The sizes of a motion, given in metres of the scene, in metres of the device.
pub(crate) fn in_device_metres(motion: &Motion, motion_scale: f64, travel_height_m: f64) -> Motion {
    Motion {
        probe_radius_m: motion.probe_radius_m / motion_scale,
        depth_m: motion.depth_m / motion_scale,
        pull_m: motion.pull_m / motion_scale,
        clearance_m: motion.clearance_m / motion_scale,
        travel_height_m,
        ..*motion
    }
}

/// Up to [`SITES`] places: the most central one, then each time the one farthest from those chosen.
fn spread_out(places: &[Place]) -> Vec<Place> {
    let middle = places.iter().map(|place| place.point).sum::<DVec3>() / places.len() as f64;
    let central = places.iter().min_by(|a, b| a.point.distance(middle).total_cmp(&b.point.distance(middle)));
    let mut chosen: Vec<Place> = central.into_iter().copied().collect();
    while chosen.len() < SITES.min(places.len()) {
        let distance = |place: &Place| {
            chosen.iter().map(|other| other.point.distance(place.point)).fold(f64::INFINITY, f64::min)
        };
        let farthest = places.iter().max_by(|a, b| distance(a).total_cmp(&distance(b))).copied();
        chosen.extend(farthest);
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use devices::simulated::{LIMITS, Phase, press_slide_grasp_pull};
    use glam::DQuat;
    use rhombus_chain::{Pose, SurfaceMesh};

    fn body(kind: scene::BodyKind) -> Body {
        let shape = scene::generate::body(kind, kind.default_vertices());
        Body::new(SurfaceMesh::new(shape.vertices, shape.triangles).unwrap())
    }

    fn ground(body: &Body, base_from_body: Pose, motion_scale: f64) -> Ground<'_> {
        let placement = Placement { base_from_body, motion_scale };
        let motion = Motion { depth_m: 0.008, ..Motion::default() };
        Ground { body, placement, workspace: LIMITS.workspace, motion, slide_m: 0.03 }
    }

    #[test]
    fn sites_lie_on_the_surface_with_their_outward_normals_and_a_slide_along_it() {
        for kind in [scene::BodyKind::Liver, scene::BodyKind::Block, scene::BodyKind::Sphere] {
            let body = body(kind);
            let (sites, _) = ground(&body, Pose::IDENTITY, 1.0).sites().unwrap();
            assert_eq!(sites.len(), SITES);
            for site in &sites {
                let mut before = site.point;
                for &(point, normal) in std::iter::once(&(site.point, site.normal)).chain(&site.slide) {
                    let (at, distance) = body.index().closest(body.mesh(), point, 1.0).unwrap();
                    assert!(distance < 1e-9);
                    assert!(body.mesh().normal(at).dot(normal) > 0.9);
                    assert!(!body.index().encloses(body.mesh(), point + normal * 1e-3));
                    assert!(before.distance(point) < 1.5 * SLIDE_STEP_M);
                    before = point;
                }
            }
            let longest = sites.iter().map(|site| site.slide.len()).max().unwrap_or(0);
            assert_eq!(longest, 12, "30 mm in steps of 2.5 mm");
        }
    }

    #[test]
    fn the_whole_script_stays_within_reach_and_travels_clear_of_the_body() {
        let body = body(scene::BodyKind::Liver);
        let turned = Pose {
            translation: DVec3::new(0.02, -0.01, -0.03),
            rotation: DQuat::from_rotation_x(0.7) * DQuat::from_rotation_z(2.0),
        };
        for (base_from_body, motion_scale) in [(Pose::IDENTITY, 1.0), (turned, 1.0), (turned, 1.3)] {
            let ground = ground(&body, base_from_body, motion_scale);
            let (sites, travel_height_m) = ground.sites().unwrap();
            let motion = in_device_metres(&ground.motion, motion_scale, travel_height_m);
            let script = press_slide_grasp_pull(&sites, &motion).unwrap();
            for millisecond in 0..(1000.0 * script.period_s()) as u32 {
                let target = script.at(f64::from(millisecond) / 1000.0);
                assert!(LIMITS.workspace.contains(target.position), "{target:?}");
                if target.phase == Phase::Travel {
                    let probe = ground.to_body(target.position);
                    assert!(ground.is_free(probe, 0.8 * motion.probe_radius_m * motion_scale), "{target:?}");
                }
            }
        }
    }

    #[test]
    fn a_body_out_of_reach_is_said_with_where_it_is_and_what_to_do() {
        let body = body(scene::BodyKind::Liver);
        let far = Pose { translation: DVec3::new(3.0, 0.0, 0.0), rotation: DQuat::IDENTITY };
        let error = ground(&body, far, 1.0).sites().unwrap_err().to_string();
        assert!(error.contains("body.pose") && error.contains("0.18"), "{error}");
    }
}
