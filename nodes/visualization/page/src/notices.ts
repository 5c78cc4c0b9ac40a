// What somebody must know now: one sentence each, over the picture, read aloud when it comes.

import { h } from "./dom.ts";

export class Notices {
  private readonly shown = new Map<string, { text: string; element: HTMLElement }>();
  private readonly timers = new Map<string, ReturnType<typeof setTimeout>>();

  constructor(private readonly root: HTMLElement) {}

  /** Show a sentence under a key, in place of the one before; null takes it away. It goes by itself after `forMs`. */
  set(key: string, text: string | null, forMs?: number): void {
    clearTimeout(this.timers.get(key));
    if (text !== null && forMs !== undefined) this.timers.set(key, setTimeout(() => this.set(key, null), forMs));
    const before = this.shown.get(key);
    if (before?.text === text) return;
    before?.element.remove();
    this.shown.delete(key);
    if (text === null) return;
    const element = h("p", { class: "notice" }, text);
    this.shown.set(key, { text, element });
    this.root.append(element);
  }

  /** The sentences that are shown. */
  get texts(): string[] {
    return [...this.shown.values()].map(({ text }) => text);
  }
}
