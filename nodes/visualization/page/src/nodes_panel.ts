// What the nodes say about themselves, and the counters of this page.

import { h, write } from "./dom.ts";
import type { NodeStatus, Status } from "./messages.ts";

interface Row {
  readonly root: HTMLDetailsElement;
  readonly badge: HTMLElement;
  readonly summary: HTMLElement;
  readonly values: HTMLElement;
}

const LEVELS = { ok: "ok", warn: "warning", error: "error", stale: "silent" } as const;

export class NodesPanel {
  private readonly rows = new Map<string, Row>();
  private readonly list = h("div", { class: "nodes" });
  private readonly publishers = h("p", { class: "note" });

  constructor(root: HTMLElement) {
    root.append(this.list, this.publishers);
  }

  update(status: Status): void {
    const names = new Set(status.nodes.map((node) => node.name));
    for (const [name, row] of this.rows) {
      if (names.has(name)) continue;
      row.root.remove();
      this.rows.delete(name);
    }
    for (const node of status.nodes) this.show(node);
    const counts = Object.entries(status.publishers).map(([topic, count]) => `${topic} ${count}`);
    const pages = status.pages === 1 ? "1 page" : `${status.pages} pages`;
    write(this.publishers, `Publishers: ${counts.join(", ") || "not known"}. ${pages} open.`);
  }

  private show(node: NodeStatus): void {
    let row = this.rows.get(node.name);
    if (!row) {
      row = makeRow(node.name);
      this.rows.set(node.name, row);
      this.list.append(row.root);
    }
    row.badge.dataset.level = node.level;
    write(row.badge, LEVELS[node.level]);
    write(row.summary, node.summary);
    if (!row.root.open) return;
    const pairs = Object.entries(node.values);
    if (row.values.childElementCount !== pairs.length) {
      row.values.replaceChildren(...pairs.map(() => h("div", {}, h("dt"), h("dd"))));
    }
    pairs.forEach(([key, value], i) => {
      const pair = row.values.children[i];
      write(pair.children[0], key);
      write(pair.children[1], value);
    });
  }
}

function makeRow(name: string): Row {
  const [badge, summary, values] = [h("span", { class: "badge" }), h("span", { class: "summary" }), h("dl", { class: "values" })];
  const head = h("summary", {}, h("span", { class: "name" }, name), badge, summary);
  return { root: h("details", { class: "node" }, head, values), badge, summary, values };
}
