//! Displacements, four vertices at a time.

use glam::DVec3;

use super::lanes::{ALL, LANES};

/// What has been moved so far, in memory for all vertices.
pub(super) struct Moved<'a> {
    pub(super) vertices: &'a mut [u32],
    pub(super) displacements: &'a mut [DVec3],
    pub(super) count: usize,
}

impl Moved<'_> {
    /// Takes the vertices from `begin` on whose bit in `moving` is set, with `unit` (x, y, z) times the elongation.
    #[inline(always)]
    pub(super) fn push_four(
        &mut self,
        begin: usize,
        moving: u32,
        unit: [[f32; LANES]; 3],
        elongation_m: f64,
    ) {
        let displacement = |lane: usize| {
            let [x, y, z] = [unit[0][lane], unit[1][lane], unit[2][lane]].map(f64::from);
            DVec3::new(x, y, z) * elongation_m
        };
        let room = self.count..self.count + LANES;
        let room = self.vertices.get_mut(room.clone()).zip(self.displacements.get_mut(room));
        match room {
            Some((vertices, displacements)) if moving == ALL => {
                for lane in 0..LANES {
                    vertices[lane] = (begin + lane) as u32;
                    displacements[lane] = displacement(lane);
                }
                self.count += LANES;
            }
            _ => {
                for lane in (0..LANES).filter(|lane| moving & (1 << lane) != 0) {
                    // What is left of the last block is no vertex.
                    if begin + lane < self.vertices.len() {
                        self.vertices[self.count] = (begin + lane) as u32;
                        self.displacements[self.count] = displacement(lane);
                        self.count += 1;
                    }
                }
            }
        }
    }
}
