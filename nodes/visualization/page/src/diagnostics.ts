// Numbers from the nodes' diagnostics: which status says what, and how a count becomes a rate.

import type { DeviceStatus, NodeStatus, Status } from "./messages.ts";

/**
 * The value of a key for a device: from a status that names the device, else from the only one that has the key. A status
 * of the driver is called "/left/haptic_device: force", one of the model "/deformation: left". NaN: not said.
 */
export function valueFor(status: Status | null, device: string, key: string): number {
  const having = status?.nodes.filter((node) => key in node.values) ?? [];
  const named = device === "" ? undefined : having.find((node) => names(node, device));
  const chosen = named ?? (device === "" || having.length === 1 ? having[0] : undefined);
  const value = chosen?.values[key];
  return value === undefined || value.trim() === "" ? NaN : Number(value);
}

function names(node: NodeStatus, device: string): boolean {
  return node.name.split(/[/:\s]+/).includes(device);
}

/** What a count that only grows has grown by in each second. */
export class Growth {
  private last: { timeS: number; count: number } | null = null;
  private perSecond = NaN;

  /** A count that went back belongs to a node that was restarted. */
  update(timeS: number, count: number): number {
    if (!Number.isFinite(count)) return this.perSecond;
    const { last } = this;
    if (last === null || count < last.count) {
      this.last = { timeS, count };
      this.perSecond = 0;
    } else if (timeS - last.timeS >= 0.9) {
      this.perSecond = (count - last.count) / (timeS - last.timeS);
      this.last = { timeS, count };
    }
    return this.perSecond;
  }
}

/** What is wrong with the publishers, one sentence each; empty: nothing. */
export function missingPublishers(publishers: Readonly<Record<string, number>>): string[] {
  const sentences: Readonly<Record<string, string>> = {
    body_mesh: "Nothing comes on body_mesh: is the deformation node running?",
    surface_displacement: "Nothing comes on surface_displacement: the surface does not move.",
    contact_state: "Nothing comes on contact_state: depth and contact are not known.",
  };
  return Object.entries(publishers)
    .filter(([, count]) => count === 0)
    .map(([topic]) => sentences[topic] ?? `Nothing comes on ${topic}.`);
}

/** The same for the devices: one that says nothing is as good as gone. */
export function silentDevices(devices: readonly DeviceStatus[]): string[] {
  const silent = devices.filter(({ alive }) => !alive).map(({ name }) => (name === "" ? "haptic_device" : name));
  return silent.map((name) => `Nothing comes from ${name}: is its driver running?`);
}
