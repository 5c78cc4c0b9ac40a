// Depth, force, rate, latency and missed deadlines over the last minute.

import uPlot from "uplot";
import { h, write } from "./dom.ts";
import { HISTORY_S } from "./history.ts";
import { fixed } from "./nice.ts";
import { Series } from "./series.ts";
import { colour, seriesColour } from "./theme.ts";

/** What is plotted, one value for each device, in this order in each row of the series. */
export const QUANTITIES = [
  { key: "depth", title: "Depth", unit: "mm", decimals: 2, least: 1 },
  { key: "force", title: "Force", unit: "N", decimals: 2, least: 0.5 },
  { key: "rate", title: "Rate", unit: "Hz", decimals: 0, least: 10 },
  { key: "latency", title: "Latency", unit: "ms", decimals: 2, least: 1 },
  { key: "missed", title: "Missed deadlines", unit: "1/s", decimals: 0, least: 1 },
] as const;

/** What is recorded of each device: what is plotted, and both forces for the CSV. */
const RECORDED = QUANTITIES.length + 2;
export const [APPLIED, COMMANDED] = [QUANTITIES.length, QUANTITIES.length + 1];

const HEIGHT_PX = 74;
const LAST_HEIGHT_PX = 96;
/** Time between two drawings, ms. */
const PERIOD_MS = 150;

export class Plots {
  private plots: uPlot[] = [];
  private readonly readings: HTMLElement[] = [];
  private devices: readonly string[] = [];
  private drawnMs = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private endS = 0;
  /** The moment that is looked at; null: now. */
  private markS: number | null = null;
  private visible = true;

  constructor(
    private readonly root: HTMLElement,
    private readonly series: () => Series,
    private readonly onPick: (agoS: number) => void,
  ) {
    new ResizeObserver(() => this.resize()).observe(root);
    // What nobody sees is not drawn.
    new IntersectionObserver((entries) => {
      this.visible = entries.some((entry) => entry.isIntersecting);
      if (this.visible) this.schedule();
    }).observe(root);
  }

  /** Begin anew for these devices. */
  setDevices(devices: readonly string[]): void {
    this.devices = devices;
    this.rebuild();
  }

  /** Colours of lines and axes follow the theme. */
  rebuild(): void {
    for (const plot of this.plots) plot.destroy();
    this.readings.length = 0;
    this.root.replaceChildren(...(this.devices.length > 1 ? [this.key()] : []));
    const sync = uPlot.sync("rhombus");
    this.plots = QUANTITIES.map((quantity, i) => {
      const reading = h("span", { class: "reading" });
      this.readings.push(reading);
      const title = h("h3", {}, `${quantity.title} `, h("span", { class: "unit" }, quantity.unit));
      const place = h("div", { class: "plot", role: "img", "aria-label": `${quantity.title} over the last minute` });
      this.root.append(h("div", { class: "plot-head" }, title, reading), place);
      return new uPlot(this.options(i, sync.key), [[]], place);
    });
    this.draw();
  }

  /** There is something new up to this time; drawn at most a few times a second. */
  update(endS: number): void {
    this.endS = endS;
    this.schedule();
  }

  /** Mark a moment before the end, and show its numbers; 0: the end. */
  mark(agoS: number): void {
    this.markS = agoS > 0 ? this.endS - agoS : null;
    this.draw();
  }

  private schedule(): void {
    if (this.timer !== undefined || !this.visible || document.hidden) return;
    const waitMs = Math.max(0, PERIOD_MS - (performance.now() - this.drawnMs));
    this.timer = setTimeout(() => {
      this.timer = undefined;
      this.draw();
    }, waitMs);
  }

  private draw(): void {
    this.drawnMs = performance.now();
    const series = this.series();
    const from = series.firstSince(this.endS - HISTORY_S);
    const to = Math.max(series.firstSince(this.endS + 1e-9), from);
    const times = series.times(from, to);
    this.plots.forEach((plot, i) => {
      const columns = this.devices.map((_, device) => series.column(column(device, i), from, to));
      plot.setData([times, ...columns], false);
      plot.setScale("x", { min: this.endS - HISTORY_S, max: this.endS });
      const row = this.markS === null ? to - from - 1 : series.firstSince(this.markS) - from;
      const shown = this.devices.map((_, device) => columns[device][row]);
      const text = shown.map((value) => fixed(value, QUANTITIES[i].decimals)).join("  ·  ");
      write(this.readings[i], text);
    });
  }

  private resize(): void {
    const width = this.root.clientWidth;
    if (width === 0) return;
    for (const [i, plot] of this.plots.entries()) plot.setSize({ width, height: this.height(i) });
  }

  private height(i: number): number {
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize) / 14;
    return Math.round((i === QUANTITIES.length - 1 ? LAST_HEIGHT_PX : HEIGHT_PX) * rem);
  }

  private drawMark(plot: uPlot): void {
    if (this.markS === null) return;
    const x = Math.round(plot.valToPos(this.markS, "x", true));
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.fillStyle = colour("text");
    ctx.fillRect(x - 1, bbox.top, 1.5, bbox.height);
    ctx.restore();
  }

  /** A click looks back to that moment. */
  private listen(plot: uPlot): void {
    plot.over.addEventListener("click", (event) => {
      const agoS = this.endS - plot.posToVal(event.offsetX, "x");
      this.onPick(Math.min(Math.max(agoS, 0), HISTORY_S));
    });
  }

  private key(): HTMLElement {
    const entries = this.devices.map((name, i) => {
      const mark = h("i", { class: "mark", "aria-hidden": "true" });
      mark.style.background = seriesColour(i);
      return h("span", {}, mark, name);
    });
    return h("p", { class: "key" }, ...entries);
  }

  private options(i: number, syncKey: string): uPlot.Options {
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const last = i === QUANTITIES.length - 1;
    const text = colour("text-2");
    const grid = { stroke: colour("grid"), width: 1 };
    const font = `${Math.round(0.79 * rem)}px system-ui, sans-serif`;
    const { least, decimals } = QUANTITIES[i];
    return {
      width: Math.max(this.root.clientWidth, 100),
      height: this.height(i),
      padding: [6, 18, last ? 0 : 4, 0],
      legend: { show: false },
      hooks: { draw: [(plot) => this.drawMark(plot)], ready: [(plot) => this.listen(plot)] },
      cursor: { y: false, drag: { x: false, y: false }, sync: { key: syncKey, setSeries: false }, points: { size: 5 } },
      scales: {
        x: { time: false },
        y: { range: (_, low, high) => range(low, high, least) },
      },
      axes: [
        {
          show: last,
          stroke: text,
          font,
          grid,
          ticks: { show: false },
          size: 1.6 * rem,
          gap: 4,
          splits: () => [45, 30, 15, 0].map((ago) => this.endS - ago),
          values: (_, splits) => splits.map((at) => (at === this.endS ? "now" : `−${Math.round(this.endS - at)} s`)),
        },
        {
          stroke: text,
          font,
          grid,
          ticks: { show: false },
          size: 3.1 * rem,
          gap: 6,
          space: 1.6 * rem,
          values: (_, splits) => splits.map((value) => String(Number(value.toFixed(decimals + 1))).replace("-", "−")),
        },
      ],
      series: [
        {},
        ...this.devices.map((_, device) => ({
          stroke: seriesColour(device),
          width: 1.5,
          points: { show: false },
          spanGaps: false,
        })),
      ],
    };
  }
}

/** Where a quantity of a device is in a row. */
export function column(device: number, quantity: number): number {
  return device * RECORDED + quantity;
}

/** Limits of an axis: 0 is always in it, and noise around nothing does not fill it. */
function range(low: number | null, high: number | null, least: number): [number, number] {
  const [from, to] = [Math.min(low ?? 0, 0), Math.max(high ?? 0, 0)];
  const size = Math.max(to - from, least);
  return [from < 0 ? from - 0.05 * size : 0, to > 0 || from === 0 ? Math.max(to, from + least) + 0.06 * size : 0];
}
