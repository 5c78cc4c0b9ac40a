// Frames as the server writes them, byte by byte from the protocol.

/** A mesh frame. */
export function meshFrame(version: number, xyz: number[], corners: number[], factors?: number[]): ArrayBuffer {
  const parts = new Writer(1, 1);
  parts.u32(version, xyz.length / 3, corners.length / 3, factors ? 1 : 0);
  parts.f32(...xyz).u32(...corners).f32(...(factors ?? []));
  return parts.done();
}

/** A surface frame. */
export function surfaceFrame(sequence: number, version: number, vertices: number[], xyz: number[]): ArrayBuffer {
  return new Writer(2, sequence).u32(version, vertices.length).f64(1.5).u32(...vertices).f32(...xyz).done();
}

export interface DeviceBytes {
  mode?: number;
  flags?: number;
  stamp?: number;
  probe?: number[];
  quaternion?: number[];
  proxy?: number[];
  normal?: number[];
  force?: number[];
  depth?: number;
  normalForce?: number;
  stiffness?: number;
  latency?: number;
  rate?: number;
  handle?: number[];
  command?: number[];
}

/** A state frame. */
export function stateFrame(sequence: number, devices: DeviceBytes[]): ArrayBuffer {
  const parts = new Writer(3, sequence).f64(100).u32(0, devices.length);
  for (const one of devices) {
    parts.u8(one.mode ?? 0, one.flags ?? 0, 0, 0).u32(0).f64(one.stamp ?? 0);
    parts.f32(...(one.probe ?? [0, 0, 0]), ...(one.quaternion ?? [0, 0, 0, 1]), ...(one.proxy ?? [0, 0, 0]));
    parts.f32(...(one.normal ?? [0, 0, 1]), ...(one.force ?? [0, 0, 0]), one.depth ?? 0, one.normalForce ?? 0);
    parts.f32(one.stiffness ?? 0, one.latency ?? NaN, one.rate ?? 0, ...(one.handle ?? [0, 0, 0]), ...(one.command ?? [0, 0, 0]), 0);
  }
  return parts.done();
}

class Writer {
  private readonly bytes: number[] = [];

  constructor(kind: number, sequence: number) {
    this.u8(kind, 0, 0, 0).u32(sequence);
  }

  u8(...values: number[]): this {
    return this.write(new Uint8Array(values));
  }

  u32(...values: number[]): this {
    return this.write(new Uint32Array(values));
  }

  f32(...values: number[]): this {
    return this.write(new Float32Array(values));
  }

  f64(...values: number[]): this {
    return this.write(new Float64Array(values));
  }

  done(): ArrayBuffer {
    return new Uint8Array(this.bytes).buffer;
  }

  private write(values: ArrayBufferView): this {
    this.bytes.push(...new Uint8Array(values.buffer));
    return this;
  }
}
