// The rows' names at the left of the sheet (ARIA's tree, one stop for Tab). Only those in sight are elements.

import {element, newId} from "../dom.js";
import {icon} from "../icons.js";

export const kRow = 22;  // pixels
const kGlyphs = {all: "key", camera: "camera", light: "sun", material: "drop", actor: "actor"};

export class RowList {
  #shown = "";

  constructor(rows, {state, choose}) {
    Object.assign(this, {rows, choose});
    this.id = newId("rows");
    this.filler = element("div", {class: "filler", role: "presentation"});
    this.root = element("div", {class: "row-list", role: "tree", tabindex: 0, "aria-label": "Things with keys", "aria-multiselectable": "true",
                                "data-key": "rows"}, this.filler);
    this.root.addEventListener("scroll", () => { this.show(); state.tell("scrolled"); });
    this.root.addEventListener("click", (event) => this.#click(event));
    this.root.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => this.show()).observe(this.root);
    state.on("rows", () => { this.show(); this.#reveal(); });
    state.on("keys", () => this.show());
  }

  get top() { return this.root.scrollTop; }
  scrollBy(pixels) { this.root.scrollTop += pixels; }
  rowAt(y) { return this.rows.at(Math.floor((y + this.top) / kRow)); }

  show() {
    const {list, chosen, active} = this.rows;
    this.filler.style.height = `${list.length * kRow}px`;
    const first = Math.max(0, Math.floor(this.top / kRow));
    const seen = list.slice(first, first + Math.ceil(this.root.clientHeight / kRow) + 1);
    const shown = JSON.stringify([first, seen.map(({id, open}) => [id, open, chosen.has(id), id === active])]);
    if (shown === this.#shown) return;
    this.#shown = shown;
    this.filler.replaceChildren(...seen.map((row, i) => this.#row(row, first + i)));
    const at = this.rows.index(active);
    if (at >= first && at < first + seen.length) this.root.setAttribute("aria-activedescendant", `${this.id}-${at}`);
    else this.root.removeAttribute("aria-activedescendant");
  }

  #row(row, index) {
    const {id, kind, name, level, open} = row;
    const item = element("div", {role: "treeitem", id: `${this.id}-${index}`, class: "key-row", "data-row": id.replace("\n", " "),
                                 "data-index": index, "aria-level": level + 1, "aria-label": name, "aria-expanded": open === undefined ? null : String(open),
                                 "aria-selected": String(this.rows.chosen.has(id))},
                         element("span", {class: "twist"}, open !== undefined && icon("twist")), kGlyphs[kind] && icon(kGlyphs[kind]),
                         element("span", {class: "name"}, name));
    item.classList.toggle("active", id === this.rows.active);
    item.style.top = `${index * kRow}px`;
    item.style.setProperty("--level", level);
    return item;
  }

  #reveal() {
    const at = this.rows.index(this.rows.active);
    if (at < 0) return;
    const top = at * kRow, {clientHeight} = this.root;
    if (top < this.top) this.root.scrollTop = top;
    else if (top + kRow > this.top + clientHeight) this.root.scrollTop = top + kRow - clientHeight;
  }

  #click(event) {
    const item = event.target.closest("[role=treeitem]");
    const row = item && this.rows.at(Number(item.dataset.index));
    if (!row) return;
    if (event.target.closest(".twist") && row.open !== undefined) this.rows.setOpen(row.thing, !row.open);
    else this.choose(row, event.shiftKey ? "to" : event.ctrlKey || event.metaKey ? "flip" : "only");
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const {list} = this.rows, at = this.rows.index(this.rows.active), row = this.rows.at(at);
    const go = {ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: list.length - 1}[event.key];
    if (go !== undefined) {
      if (list[go]) this.choose(list[go], event.shiftKey ? "to" : "only");
    } else if (row && event.key === "ArrowRight" && row.open === false) this.rows.setOpen(row.thing, true);
    else if (row && event.key === "ArrowLeft" && row.part !== null) this.choose(this.rows.at(this.rows.index(row.thing)), "only");
    else if (row && event.key === "ArrowLeft" && row.open) this.rows.setOpen(row.thing, false);
    else return;
    event.preventDefault();
  }
}
