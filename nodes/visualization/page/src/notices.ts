// What somebody must know now: one sentence each, above the controls, read aloud when it comes. Each can be closed,
// and stays closed while it says the same.

import { h } from "./dom.ts";

interface Notice {
  readonly text: string;
  readonly element: HTMLElement;
  closed: boolean;
}

export class Notices {
  private readonly known = new Map<string, Notice>();
  private readonly timers = new Map<string, ReturnType<typeof setTimeout>>();

  constructor(private readonly root: HTMLElement) {}

  /** Show a sentence under a key, in place of the one before; null takes it away. It goes by itself after `forMs`. */
  set(key: string, text: string | null, forMs?: number): void {
    clearTimeout(this.timers.get(key));
    if (text !== null && forMs !== undefined) this.timers.set(key, setTimeout(() => this.set(key, null), forMs));
    const before = this.known.get(key);
    if (before?.text === text) return;
    before?.element.remove();
    this.known.delete(key);
    if (text === null) return;
    const close = h("button", { type: "button", class: "close", title: "Close", "aria-label": "Close", onclick: () => {
      notice.closed = true;
      notice.element.remove();
    } }, "×");
    const notice: Notice = { text, element: h("p", { class: "notice" }, h("span", { title: text }, text), close), closed: false };
    this.known.set(key, notice);
    this.root.append(notice.element);
  }

  /** The sentences that are shown. */
  get texts(): string[] {
    return [...this.known.values()].filter(({ closed }) => !closed).map(({ text }) => text);
  }
}
