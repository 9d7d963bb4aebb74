// Banners stay while something is wrong, toasts go by themselves.

import {element} from "./dom.js";
import {icon} from "./icons.js";

const kShown = 6000, kMost = 3;

export class Notices {
  #banners = new Map();
  #place = document.getElementById("banners");
  #toasts = document.getElementById("toasts");

  // `about` names the banner; "" as text takes it away. Parts: text, and detail in small.
  banner(about, text, {detail = "", kind = "warning"} = {}) {
    const now = `${kind} ${text} ${detail}`;
    const shown = this.#banners.get(about);
    if (shown?.text === now) return;
    shown?.root.remove();
    this.#banners.delete(about);
    if (text === "") return;
    const root = element("div", {class: `banner ${kind}`, "data-about": about}, icon(kind === "error" ? "error" : "warning"),
                         element("strong", {}, text), detail && element("span", {}, detail));
    this.#place.append(root);
    this.#banners.set(about, {root, text: now});
  }

  toast(text, kind = "error") {
    const close = element("button", {class: "quiet icon", "aria-label": "Close this message"}, icon("close"));
    const root = element("div", {class: `toast ${kind}`}, icon(kind === "error" ? "error" : "info"),
                         element("span", {}, text), close);
    close.addEventListener("click", () => root.remove());
    this.#toasts.append(root);
    while (this.#toasts.children.length > kMost) this.#toasts.firstChild.remove();
    this.#leave(root);
  }

  // Not while somebody reads it.
  #leave(root) {
    setTimeout(() => root.matches(":hover, :focus-within") ? this.#leave(root) : root.remove(), kShown);
  }
}
