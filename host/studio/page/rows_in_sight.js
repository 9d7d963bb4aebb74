// A list that scrolls, with rows of one height: only those in sight are elements, so that it may be long.

import {element} from "./dom.js";

export class RowsInSight {
  #shown = "";
  list = [];

  // `make(row, index)` gives a row's element; `look(row)` has all on which it depends.
  constructor(root, height, {make, look, scrolled = () => {}}) {
    Object.assign(this, {root, height, make, look});
    this.filler = element("div", {class: "filler", role: "presentation"});
    root.append(this.filler);
    root.addEventListener("scroll", () => { this.show(); scrolled(); });
    new ResizeObserver(() => this.show()).observe(root);
  }

  get top() { return this.root.scrollTop; }

  show(list = this.list) {
    this.list = list;
    const {height} = this, first = Math.max(0, Math.floor(this.top / height) - 1);
    const seen = list.slice(first, first + Math.ceil(this.root.clientHeight / height) + 2);
    const shown = JSON.stringify([list.length, first, seen.map((row) => this.look(row))]);
    if (shown === this.#shown) return;
    this.#shown = shown;
    this.filler.style.height = `${list.length * height}px`;
    this.filler.replaceChildren(...seen.map((row, i) => this.#placed(this.make(row, first + i), first + i)));
  }

  reveal(index) {
    if (index < 0) return;
    const top = index * this.height, {clientHeight} = this.root;
    if (top < this.top) this.root.scrollTop = top;
    else if (top + this.height > this.top + clientHeight) this.root.scrollTop = top + this.height - clientHeight;
    this.show();
  }

  #placed(item, index) {
    item.style.top = `${index * this.height}px`;
    return item;
  }
}
