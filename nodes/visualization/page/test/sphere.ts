// A sphere of 50 mm radius, as a body to test with.

import type { MeshFrame } from "../src/frames.ts";

export function sphere(rings: number, topologyVersion: number): MeshFrame {
  const sectors = 2 * rings;
  const radius = 0.05;
  const xyz = [0, 0, radius];
  for (let ring = 1; ring < rings; ring += 1) {
    const polar = (Math.PI * ring) / rings;
    for (let sector = 0; sector < sectors; sector += 1) {
      const turn = (2 * Math.PI * sector) / sectors;
      xyz.push(radius * Math.sin(polar) * Math.cos(turn), radius * Math.sin(polar) * Math.sin(turn), radius * Math.cos(polar));
    }
  }
  xyz.push(0, 0, -radius);
  const south = xyz.length / 3 - 1;
  const at = (ring: number, sector: number): number => 1 + (ring - 1) * sectors + (sector % sectors);
  const corners: number[] = [];
  for (let sector = 0; sector < sectors; sector += 1) {
    corners.push(0, at(1, sector), at(1, sector + 1));
    for (let ring = 1; ring < rings - 1; ring += 1) {
      corners.push(at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1));
      corners.push(at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1));
    }
    corners.push(south, at(rings - 1, sector + 1), at(rings - 1, sector));
  }
  return {
    kind: "mesh", sequence: 0, topologyVersion, positions: new Float32Array(xyz), corners: new Uint32Array(corners), stiffness: null,
  };
}
