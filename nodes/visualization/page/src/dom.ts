// Elements of the page, made and found.

type Child = Node | string | null;
type Properties = Readonly<Record<string, string | number | boolean | EventListener>>;

/** A new element. Keys that begin with "on" are listeners, "class" and "aria-…" attributes; a false attribute is none. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** An element that the page has. */
export function find<E extends Element = HTMLElement>(id: string): E {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element ${id}`);
  return found as unknown as E;
}

/** Write a text only when it changed, so that nothing is laid out or read aloud for nothing. */
export function write(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

let ids = 0;

/** A name for an element that a label refers to. */
export function newId(): string {
  ids += 1;
  return `e${ids}`;
}

/** Save bytes as a file of the user. */
export function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = h("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** A moment as a part of a file name: 2026-01-31T12-00-00. */
export function fileStamp(date: Date): string {
  return date.toISOString().slice(0, 19).replaceAll(":", "-");
}

/** What the user chose last time; null: nothing, or this browser keeps nothing. */
export function remembered(key: string): string | null {
  try {
    return localStorage.getItem(`rhombus.${key}`);
  } catch {
    return null;
  }
}

export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(`rhombus.${key}`, value);
  } catch {
    // A browser that keeps nothing: the choice holds until the page is closed.
  }
}
