//! Rule: no force drives the device against its mechanical stops.

use glam::DVec3;

use super::LimitsHit;
use crate::{DeviceState, Workspace, Wrench};

/// The workspace and how wide its edge is.
#[derive(Clone, Copy, Debug)]
pub(super) struct WorkspaceEdge {
    workspace: Workspace,
    margin_m: f64,
}

impl WorkspaceEdge {
    pub(super) fn new(workspace: Workspace, margin_m: f64) -> WorkspaceEdge {
        WorkspaceEdge { workspace, margin_m }
    }

    /// The wrench without the part of its force that pushes outward where the handle is at the edge of the workspace or
    /// beyond it; continuous, because that part fades over the margin. Inward and sideways force stays. RT safe.
    pub(super) fn apply(&self, wrench: Wrench, state: &DeviceState, hit: &mut LimitsHit) -> Wrench {
        let Workspace { centre, radius_m, height_m } = self.workspace;
        let at = state.pose.translation - centre;
        let across = at.with_z(0.0);
        let radial = self.faded(wrench.force_n, across, radius_m);
        let force_n = self.faded(radial, DVec3::Z * at.z, 0.5 * height_m);
        hit.insert_if(force_n != wrench.force_n, LimitsHit::WORKSPACE);
        Wrench { force_n, ..wrench }
    }

    /// `from_middle` points from the middle to the handle; the edge is at its length `edge_m`.
    fn faded(&self, force_n: DVec3, from_middle: DVec3, edge_m: f64) -> DVec3 {
        let distance_m = from_middle.length();
        // In the middle there is no outward; a margin wider than half the way would reach it.
        let margin_m = self.margin_m.min(0.5 * edge_m);
        let inside_m = edge_m - distance_m;
        if inside_m >= margin_m || distance_m <= 0.0 {
            return force_n;
        }
        let outward = from_middle / distance_m;
        let share = if margin_m > 0.0 { (inside_m / margin_m).clamp(0.0, 1.0) } else { 0.0 };
        force_n - outward * ((1.0 - share) * force_n.dot(outward).max(0.0))
    }
}
