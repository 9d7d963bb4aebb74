// The rows' names at the left of the sheet (ARIA's tree, one stop for Tab). Only those in sight are elements.

import {element, newId} from "../dom.js";
import {icon} from "../icons.js";
import {RowsInSight} from "../rows_in_sight.js";

export const kRow = 22;  // pixels
const kGlyphs = {all: "key", camera: "camera", light: "sun", material: "drop", actor: "actor"};

export class RowList {
  constructor(rows, {state, choose}) {
    Object.assign(this, {rows, choose});
    this.id = newId("rows");
    this.root = element("div", {class: "row-list", role: "tree", tabindex: 0, "aria-label": "Things with keys", "aria-multiselectable": "true",
                                "data-key": "rows"});
    this.sight = new RowsInSight(this.root, kRow, {make: (row, index) => this.#row(row, index), look: (row) => this.#look(row),
                                                   scrolled: () => state.tell("scrolled")});
    this.root.addEventListener("click", (event) => this.#click(event));
    this.root.addEventListener("keydown", (event) => this.#key(event));
    state.on("rows", () => { this.show(); this.sight.reveal(this.rows.index(this.rows.active)); });
    state.on("keys", () => this.show());
  }

  get top() { return this.root.scrollTop; }
  scrollBy(pixels) { this.root.scrollTop += pixels; }
  index(y) { return Math.floor((y + this.top) / kRow); }
  rowAt(y) { return this.rows.at(this.index(y)); }

  show() {
    this.sight.show(this.rows.list);
    const id = `${this.id}-${this.rows.index(this.rows.active)}`;
    if (document.getElementById(id)) this.root.setAttribute("aria-activedescendant", id);
    else this.root.removeAttribute("aria-activedescendant");
  }

  #look({id, open}) { return [id, open, this.rows.chosen.has(id), id === this.rows.active]; }

  #row(row, index) {
    const {id, kind, name, level, open} = row;
    const item = element("div", {role: "treeitem", id: `${this.id}-${index}`, class: "key-row", "data-row": id.replace("\n", " "),
                                 "data-index": index, "aria-level": level + 1, "aria-label": name, "aria-expanded": open === undefined ? null : String(open),
                                 "aria-selected": String(this.rows.chosen.has(id))},
                         element("span", {class: "twist"}, open !== undefined && icon("twist")), kGlyphs[kind] && icon(kGlyphs[kind]),
                         element("span", {class: "name"}, name));
    item.classList.toggle("active", id === this.rows.active);
    item.style.setProperty("--level", level);
    return item;
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
