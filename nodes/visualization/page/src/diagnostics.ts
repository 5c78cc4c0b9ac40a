// Numbers from the nodes' diagnostics: which status says what, and how a count becomes a rate.

import type { DeviceStatus, NodeStatus, Status } from "./messages.ts";

/**
 * The status that says a key for a device: one that names the device, else the only one that has the key. A status of the
 * driver is called "/left/haptic_device: force", one of the model "/deformation: left".
 */
function statusFor(status: Status | null, device: string, key: string): NodeStatus | undefined {
  const having = status?.nodes.filter((node) => key in node.values) ?? [];
  const named = device === "" ? undefined : having.find((node) => names(node, device));
  return named ?? (device === "" || having.length === 1 ? having[0] : undefined);
}

/** The value of a key for a device. NaN: not said. */
export function valueFor(status: Status | null, device: string, key: string): number {
  const value = statusFor(status, device, key)?.values[key];
  return value === undefined || value.trim() === "" ? NaN : Number(value);
}

function names(node: NodeStatus, device: string): boolean {
  return node.name.split(/[/:\s]+/).includes(device);
}

/** What a count that only grows has grown by in each second. */
export class Growth {
  private last: { timeS: number; count: number } | null = null;
  private perSecond = NaN;

  /** A count and the time at which it was so. One that went back belongs to a node that was restarted. */
  update(timeS: number, count: number): number {
    if (!Number.isFinite(count)) return this.perSecond;
    const { last } = this;
    if (last?.timeS === timeS) return this.perSecond;
    const seconds = last === null ? 0 : timeS - last.timeS;
    this.perSecond = last === null || seconds < 0 || count < last.count ? 0 : (count - last.count) / seconds;
    this.last = { timeS, count };
    return this.perSecond;
  }

  /** The same of a value in the diagnostics of a device, from each of its stamps to the next. NaN: nobody says it now. */
  of(status: Status | null, device: string, key: string): number {
    const node = statusFor(status, device, key);
    if (node && node.level !== "stale" && node.stamp_s !== null) return this.update(node.stamp_s, valueFor(status, device, key));
    this.last = null;
    this.perSecond = NaN;
    return NaN;
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
