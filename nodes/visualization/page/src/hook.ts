// `window.rhombus`: what the page knows, for tests and for the curious. Everything is read only except `setView`.

import type { App } from "./app.ts";
import type { View } from "./camera.ts";
import type { Vec3 } from "./vector.ts";

/** Publish the hook. Lengths in m, body frame; pixels are CSS pixels from the upper left corner of the picture. */
export function install(app: App): void {
  const hook = {
    /** Of the page, and of the node it is connected to (null: none yet). */
    version: PAGE_VERSION,
    get nodeVersion() {
      return app.hello?.version ?? null;
    },
    get bootId() {
      return app.hello?.boot_id ?? null;
    },
    /** "connecting", "connected", "silent" or "waiting", and how often the page lost its node. */
    get connection() {
      return { phase: app.connection.state.phase, ...app.connection.counts };
    },
    /** Since the page was opened. `received`: surface updates that arrived; `applied`: that were written to the surface. */
    get counters() {
      const { counts } = app.inbox;
      return {
        received: counts.surfaces,
        applied: app.applied,
        dropped: app.state?.dropped ?? 0,
        missing: counts.missing,
        refused: counts.garbage + counts.outOfOrder + app.otherMesh,
        garbage: counts.garbage,
        outOfOrder: counts.outOfOrder,
        otherMesh: app.otherMesh,
        notFinite: counts.notFinite + (app.body?.notFinite ?? 0),
        refusedByNode: app.refusals,
        states: counts.states,
        meshes: counts.meshes,
        bytes: counts.bytes,
        pictures: app.stage.pictures,
      };
    },
    /** null: no body yet. */
    get mesh() {
      const { body } = app;
      if (!body) return null;
      return { vertices: body.vertexCount, triangles: body.triangleCount, topologyVersion: body.topologyVersion, hasStiffness: body.stiffness !== null };
    },
    /** Every vertex that is displaced now: its number, place at rest and displacement. */
    get moved() {
      const { body } = app;
      if (!body) return [];
      return Array.from(body.moved.subarray(0, body.movedCount), (vertex) => ({
        vertex,
        rest: [...body.rest.subarray(3 * vertex, 3 * vertex + 3)],
        displacement: [...body.displacements.subarray(3 * vertex, 3 * vertex + 3)],
      }));
    },
    /** Newest state of each device, by name. */
    get devices() {
      return Object.fromEntries((app.hello?.devices ?? []).map((name, i) => [name, app.state?.devices[i] ?? null]));
    },
    get status() {
      return app.status;
    },
    get parameters() {
      return app.parameters;
    },
    get chains() {
      return app.chains;
    },
    /** Rhombi that are drawn. */
    get units() {
      return app.stage.unitCount;
    },
    get pointer() {
      const { device, hold, target, depthM, reason } = app.hand;
      return { device, hold, target, depthM, reason };
    },
    get notices() {
      return app.notices.texts;
    },
    /** Seconds before now that are shown; 0: live. */
    get lookingBackS() {
      return app.lookingBackS;
    },
    get view(): View {
      return app.stage.orbit.current;
    },
    setView(view: Partial<View>): void {
      app.stage.orbit.set({ ...app.stage.orbit.current, ...view });
    },
    /** Where a point is in the picture; null: behind the camera. */
    project: (point: Vec3) => app.stage.orbit.project(point),
    /** Point and normal of the rest surface under a place in the picture; null: none. */
    pick: (x: number, y: number) => app.hand.pick(x, y),
    renderer: app.stage.rendererName,
    /** From the start of the navigation to the first picture with a body, ms; null: not yet. */
    get first_picture_ms() {
      return app.firstPictureMs;
    },
  };
  Object.defineProperty(window, "rhombus", { value: Object.freeze(hook) });
}
