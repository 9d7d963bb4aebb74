// Banners stay while something is wrong. Messages stand in the last line, over nothing that is worked in: the newest
// shows until something else is done; all are in a list that it opens.

import {element} from "./dom.js";
import {icon} from "./icons.js";
import {openPopover} from "./popover.js";

const kNew = 6000;  // ms for which a message catches the eye
const kKept = 20;

const glyphOf = (kind) => icon(kind === "error" ? "error" : "info");

export class Notices {
  #banners = new Map();
  #place = document.getElementById("banners");
  #line = document.getElementById("messages");
  #messages = [];  // {text, kind}
  #timer = 0;

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

  message(text, kind = "error") {
    this.#messages = [...this.#messages, {text, kind}].slice(-kKept);
    const root = this.#show(`message new ${kind}`, text, glyphOf(kind), element("span", {}, text));
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => root.classList.remove("new"), kNew);
  }

  // The newest message is over; the list can still be opened.
  settle() { if (this.#messages.length > 0) this.#show("message info", "Messages", glyphOf("info")); }

  #show(look, title, ...children) {
    const root = element("button", {class: look, title, "data-key": "messages", onclick: () => this.#open(root)}, children);
    this.#line.replaceChildren(root);
    return root;
  }

  #open(anchor) {
    const lines = this.#messages.map(({text, kind}) => element("li", {class: `message ${kind}`}, glyphOf(kind), element("span", {}, text)));
    const list = element("ol", {class: "message-lines", tabindex: 0}, lines);
    openPopover(anchor, "Messages", element("h3", {}, "Messages"), list);
    list.scrollTo(0, 1e6);
  }
}
