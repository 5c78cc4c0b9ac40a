//! The script of a session: press, slide, grasp and pull at the sites of a body.

use glam::DVec3;

use super::{Phase, Script, ScriptError, Segment};

/// A place on a body's surface, in the device frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// Point of the rest surface.
    pub point: DVec3,
    /// Unit normal there, out of the body.
    pub normal: DVec3,
    /// Where a slide leads from `point`: further points of the surface with their outward unit normals; empty for none.
    pub slide: Vec<(DVec3, DVec3)>,
}

/// Sizes of the motion. Depths are where the hand means to be: the body's force keeps it from getting there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Radius of the probe, m: the target's depth is measured from its lowest point.
    pub probe_radius_m: f64,
    /// Intended depth of a press, m.
    pub depth_m: f64,
    /// Intended pull along the outward normal, m.
    pub pull_m: f64,
    /// Gap between probe and surface before and after a contact, m.
    pub clearance_m: f64,
    /// Height (z in the device frame) at which the hand goes from site to site, m.
    pub travel_height_m: f64,
    /// Opening angle of the gripper when it holds nothing.
    pub open_rad: f64,
    /// Opening angle of the gripper when it holds the surface.
    pub closed_rad: f64,
    /// Time for one pair of sites, s.
    pub period_s: f64,
}

impl Default for Motion {
    fn default() -> Self {
        Motion {
            probe_radius_m: 0.005,
            depth_m: 0.008,
            pull_m: 0.007,
            clearance_m: 0.01,
            travel_height_m: 0.05,
            open_rad: 0.5,
            closed_rad: 0.05,
            period_s: 12.0,
        }
    }
}

/// Depth of the light press before the gripper closes, as a share of the full depth.
const LIGHT_PRESS: f64 = 0.3;
/// Sideways part of a pull, as a share of the pull.
const SIDEWAYS: f64 = 0.4;

/// The script for sites taken two by two: press, hold and slide at the first of a pair; press lightly, grasp, pull, push
/// back and let go at the second. With one site the pair is that site twice, with an odd number the last is paired with
/// the first. The script repeats after `period_s` for each pair.
///
/// # Errors
/// [`ScriptError::NoSite`] without a site; [`ScriptError::Segment`] for numbers that are not finite.
pub fn press_slide_grasp_pull(sites: &[Site], motion: &Motion) -> Result<Script, ScriptError> {
    let first = sites.first().ok_or(ScriptError::NoSite)?;
    let pairs: Vec<(&Site, &Site)> =
        sites.chunks(2).map(|pair| (&pair[0], pair.get(1).unwrap_or(first))).collect();
    let (_, last) = pairs[pairs.len() - 1];
    let mut writer = Writer { motion, segments: Vec::new(), above: raised(last, motion) };
    for (pressed, grasped) in pairs {
        writer.press_and_slide(pressed);
        writer.grasp_and_pull(grasped);
    }
    Script::new(writer.segments)
}

/// Where the probe's centre is when it is `depth_m` deep.
fn at_depth(point: DVec3, normal: DVec3, motion: &Motion, depth_m: f64) -> DVec3 {
    point + normal * (motion.probe_radius_m - depth_m)
}

/// The point at travel height above the place where the hand leaves a site.
fn raised(site: &Site, motion: &Motion) -> DVec3 {
    at_depth(site.point, site.normal, motion, -motion.clearance_m).with_z(motion.travel_height_m)
}

/// Appends segments. Durations are in twelfths of the period, so the default motion shows them in seconds.
struct Writer<'a> {
    motion: &'a Motion,
    segments: Vec<Segment>,
    /// At travel height above where the hand is.
    above: DVec3,
}

impl Writer<'_> {
    fn add(&mut self, phase: Phase, twelfths: f64, path: Vec<DVec3>, gripper_rad: f64) {
        let duration_s = twelfths / 12.0 * self.motion.period_s;
        self.segments.push(Segment { phase, duration_s, path, gripper_rad });
    }

    /// Up, across and down to just above the site.
    fn travel_to(&mut self, site: &Site) {
        let goal = raised(site, self.motion);
        let clear = at_depth(site.point, site.normal, self.motion, -self.motion.clearance_m);
        self.add(Phase::Travel, 1.2, vec![self.above, goal, clear], self.motion.open_rad);
    }

    /// 6.6 twelfths.
    fn press_and_slide(&mut self, site: &Site) {
        let Motion { depth_m, clearance_m, open_rad, .. } = *self.motion;
        let at = |(point, normal): (DVec3, DVec3), depth_m| at_depth(point, normal, self.motion, depth_m);
        let start = (site.point, site.normal);
        let end = site.slide.last().copied().unwrap_or(start);
        let touching = at(start, 0.0);
        let pressed = at(start, depth_m);
        let slide: Vec<DVec3> = site.slide.iter().map(|&sample| at(sample, depth_m)).collect();
        let released = at(end, -clearance_m);
        self.travel_to(site);
        self.add(Phase::Approach, 0.6, vec![touching], open_rad);
        self.add(Phase::Press, 1.0, vec![pressed], open_rad);
        self.add(Phase::Hold, 0.6, vec![], open_rad);
        self.add(Phase::Slide, 2.0, slide, open_rad);
        self.add(Phase::Release, 1.2, vec![released], open_rad);
        self.above = released.with_z(self.motion.travel_height_m);
    }

    /// 5.4 twelfths.
    fn grasp_and_pull(&mut self, site: &Site) {
        let Motion { depth_m, pull_m, clearance_m, open_rad, closed_rad, .. } = *self.motion;
        let at = |depth_m| at_depth(site.point, site.normal, self.motion, depth_m);
        let grasped = at(LIGHT_PRESS * depth_m);
        let pulled = grasped + site.normal * pull_m + sideways(site) * (SIDEWAYS * pull_m);
        let (touching, pushed, released) = (at(0.0), at(2.0 * LIGHT_PRESS * depth_m), at(-clearance_m));
        self.travel_to(site);
        self.add(Phase::Approach, 0.4, vec![touching], open_rad);
        self.add(Phase::Press, 0.4, vec![grasped], open_rad);
        self.add(Phase::Grasp, 0.4, vec![], closed_rad);
        self.add(Phase::Pull, 0.8, vec![pulled], closed_rad);
        self.add(Phase::Hold, 0.3, vec![], closed_rad);
        self.add(Phase::PushBack, 0.8, vec![pushed], closed_rad);
        self.add(Phase::Open, 0.4, vec![], open_rad);
        self.add(Phase::Release, 0.7, vec![released], open_rad);
        self.above = raised(site, self.motion);
    }
}

/// A unit vector across the site's normal: along its slide when it has one.
fn sideways(site: &Site) -> DVec3 {
    let along = site.slide.first().map_or(DVec3::ZERO, |(point, _)| *point - site.point);
    let across = along - site.normal * along.dot(site.normal);
    across.try_normalize().unwrap_or_else(|| site.normal.any_orthonormal_vector())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat_site(x: f64) -> Site {
        let slide = (1..=5).map(|i| (DVec3::new(x, 0.006 * f64::from(i), 0.0), DVec3::Z)).collect();
        Site { point: DVec3::new(x, 0.0, 0.0), normal: DVec3::Z, slide }
    }

    #[test]
    fn every_phase_occurs_within_twelve_seconds() {
        let script =
            press_slide_grasp_pull(&[flat_site(-0.03), flat_site(0.03)], &Motion::default()).unwrap();
        assert!((script.period_s() - 12.0).abs() < 1e-9);
        let seen: std::collections::BTreeSet<Phase> =
            (0..1200).map(|i| script.at(0.01 * f64::from(i)).phase).collect();
        assert_eq!(seen.len(), 10, "{seen:?}");
    }

    #[test]
    fn the_slide_keeps_the_depth_and_goes_its_whole_length() {
        let motion = Motion::default();
        let script = press_slide_grasp_pull(&[flat_site(0.0)], &motion).unwrap();
        let slide: Vec<_> = (0..12_000)
            .map(|i| script.at(1e-3 * f64::from(i)))
            .filter(|target| target.phase == Phase::Slide)
            .collect();
        for target in &slide {
            assert!((motion.probe_radius_m - target.position.z - motion.depth_m).abs() < 1e-12);
        }
        let length = (slide[slide.len() - 1].position - slide[0].position).length();
        assert!((length - 0.03).abs() < 1e-4, "{length}");
    }

    #[test]
    fn the_gripper_is_closed_from_the_pull_to_the_push_back_and_open_in_all_other_motion() {
        let motion = Motion::default();
        let script = press_slide_grasp_pull(&[flat_site(-0.03), flat_site(0.03)], &motion).unwrap();
        for i in 0..12_000 {
            let target = script.at(1e-3 * f64::from(i));
            match target.phase {
                Phase::Pull | Phase::PushBack => assert_eq!(target.gripper_rad, motion.closed_rad),
                Phase::Grasp | Phase::Open | Phase::Hold => {}
                _ => assert_eq!(target.gripper_rad, motion.open_rad),
            }
        }
    }

    #[test]
    fn a_pull_ends_outside_the_place_of_the_grasp_by_its_size() {
        let motion = Motion::default();
        let script = press_slide_grasp_pull(&[flat_site(0.0)], &motion).unwrap();
        let targets: Vec<_> = (0..12_000).map(|i| script.at(1e-3 * f64::from(i))).collect();
        let grasp = targets.iter().find(|t| t.phase == Phase::Grasp).unwrap().position;
        let pulled = targets.iter().rfind(|t| t.phase == Phase::Pull).unwrap().position;
        assert!((pulled.z - grasp.z - motion.pull_m).abs() < 1e-6);
        assert!(((pulled - grasp).truncate().length() - SIDEWAYS * motion.pull_m).abs() < 1e-6);
    }

    #[test]
    fn travel_never_touches_a_flat_body() {
        let motion = Motion::default();
        let script =
            press_slide_grasp_pull(&[flat_site(-0.1), flat_site(0.1), flat_site(0.0)], &motion).unwrap();
        assert!((script.period_s() - 24.0).abs() < 1e-9);
        for i in 0..24_000 {
            let target = script.at(1e-3 * f64::from(i));
            if target.phase == Phase::Travel {
                assert!(target.position.z >= motion.probe_radius_m + 0.5 * motion.clearance_m, "{target:?}");
            }
        }
    }

    #[test]
    fn without_a_site_there_is_no_script() {
        assert_eq!(press_slide_grasp_pull(&[], &Motion::default()).unwrap_err(), ScriptError::NoSite);
    }
}
