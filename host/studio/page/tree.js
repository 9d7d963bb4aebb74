// The tree of joints (ARIA's tree pattern): one stop for Tab, arrows go and select. Letters are the page's shortcuts; a
// field beside the title finds by the first letters.

import {element} from "./dom.js";
import {icon} from "./icons.js";
import {keysOf} from "./shortcuts.js";

export class Tree {
  #closed = new Set();   // keys of items that are shut
  #items = new Map();    // key -> element
  #shape = "";           // what the tree shows now

  constructor(place, {state, edits, rename}) {
    Object.assign(this, {state, edits, rename});
    this.title = element("h2", {}, "Joints");
    this.count = element("span", {class: "count"});
    this.root = element("ul", {role: "tree", "aria-label": "Joints"});
    const add = element("button", {class: "quiet icon", "aria-label": "Add a joint", title: `Add a joint (${keysOf("addJoint")})`,
                                   onclick: () => edits.addJoint()}, icon("add"));
    this.find = element("input", {type: "text", class: "find", "aria-label": "Find by the first letters", placeholder: `Find (${keysOf("find")})`,
                                  "data-key": "tree.find", autocomplete: "off", spellcheck: "false"});
    place.append(element("div", {class: "panel-title"}, this.title, this.count, this.find, add), this.root);
    this.add = add;
    this.root.addEventListener("keydown", (event) => this.#key(event));
    this.find.addEventListener("input", () => this.#find(this.find.value.trim().toLowerCase()));
    this.find.addEventListener("keydown", (event) => this.#found(event));
    this.find.addEventListener("blur", () => { this.find.value = ""; });
    this.root.addEventListener("click", (event) => this.#click(event));
    this.root.addEventListener("dblclick", ({target}) => { if (target.closest(".row") && !target.closest(".twist")) this.rename(); });
    state.on("project", () => this.#project());
    state.on("selected", () => this.#select());
  }

  focus() { this.#current()?.focus(); }

  #project() {
    const {actors, kind} = this.state.project;
    const shape = JSON.stringify([kind, actors.map(({name, joints}) => [name, joints.map(({name, parent, keyed}) => [name, parent, keyed])])]);
    if (shape === this.#shape) return;
    if (this.state.isFilm()) for (const {name} of actors) if (!this.#items.has(keyOf(name, null))) this.#closed.add(keyOf(name, null));
    this.#shape = shape;
    const had = this.root.contains(document.activeElement);
    this.#items.clear();
    const film = this.state.isFilm();
    this.root.replaceChildren(...actors.flatMap((actor) => film ? [this.#actor(actor)] : this.#joints(actor, null, 1)));
    this.title.textContent = film ? "Actors" : "Joints";
    this.count.textContent = film ? actors.length : actors.reduce((sum, actor) => sum + actor.joints.length, 0);
    this.add.hidden = film;
    this.#select();
    if (had) this.focus();
  }

  #actor(actor) {
    return this.#item(keyOf(actor.name, null), actor.name, 1, "actor", this.#joints(actor, null, 2), false);
  }

  #joints(actor, parent, level) {
    const names = new Set(actor.joints.map(({name}) => name));
    return actor.joints.filter((joint) => (names.has(joint.parent) ? joint.parent : null) === parent)
      .map((joint) => this.#item(keyOf(actor.name, joint.name), joint.name, level, "joint",
                                 this.#joints(actor, joint.name, level + 1), joint.keyed));
  }

  #item(key, name, level, kind, children, keyed) {
    const row = element("div", {class: "row"}, element("span", {class: "twist"}, children.length > 0 && icon("twist")), icon(kind),
                        element("span", {class: "name"}, name), keyed && element("span", {class: "keyed", title: "Has a key here"}, icon("key")));
    row.style.setProperty("--level", level - 1);
    const open = children.length > 0 ? String(!this.#closed.has(key)) : null;
    const item = element("li", {role: "treeitem", tabindex: -1, "aria-level": level, "aria-expanded": open, "aria-label": name,
                                "data-key": key}, row, children.length > 0 && element("ul", {role: "group"}, children));
    this.#items.set(key, item);
    return item;
  }

  #select() {
    const key = keyOf(this.state.selected.actor, this.state.selected.joint);
    for (const [each, item] of this.#items) {
      item.setAttribute("aria-selected", String(each === key));
      item.tabIndex = -1;
    }
    const item = this.#items.get(key);
    for (let up = item?.parentElement.closest("[role=treeitem]"); up; up = up.parentElement.closest("[role=treeitem]")) this.#open(up, true);
    const current = this.#current();
    if (current) current.tabIndex = 0;
    item?.querySelector(".row").scrollIntoView({block: "nearest"});
    if (item && this.root.contains(document.activeElement)) item.focus({preventScroll: true});
  }

  #current() {
    return this.#items.get(keyOf(this.state.selected.actor, this.state.selected.joint)) ?? this.#visible()[0];
  }

  #visible() {
    return [...this.#items.values()].filter((item) => !item.parentElement.closest('[aria-expanded="false"]')).sort(inDocument);
  }

  #open(item, open) {
    if (!item.hasAttribute("aria-expanded")) return;
    item.setAttribute("aria-expanded", String(open));
    if (open) this.#closed.delete(item.dataset.key);
    else this.#closed.add(item.dataset.key);
  }

  #choose(item) {
    if (!item) return;
    item.focus({preventScroll: true});
    this.edits.select(...partsOf(item.dataset.key));
  }

  #click({target}) {
    const item = target.closest("[role=treeitem]");
    if (!item) return;
    if (target.closest(".twist")) this.#open(item, item.getAttribute("aria-expanded") !== "true");
    else this.#choose(item);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const item = event.target.closest("[role=treeitem]");
    if (!item) return;
    const visible = this.#visible();
    const at = visible.indexOf(item);
    const open = item.getAttribute("aria-expanded");
    const acts = {
      ArrowDown: () => this.#choose(visible[at + 1]),
      ArrowUp: () => this.#choose(visible[at - 1]),
      Home: () => this.#choose(visible[0]),
      End: () => this.#choose(visible.at(-1)),
      ArrowRight: () => open === "false" ? this.#open(item, true) : open && this.#choose(visible[at + 1]),
      ArrowLeft: () => open === "true" ? this.#open(item, false) : this.#choose(item.parentElement.closest("[role=treeitem]")),
      Enter: () => this.#choose(item),
    };
    if (!acts[event.key]) return;
    acts[event.key]();
    event.preventDefault();
  }

  // The first from the selected one on, also where it does not show yet.
  #find(text) {
    if (text === "") return;
    const keys = [...this.#items.values()].sort(inDocument).map((item) => item.dataset.key), at = Math.max(0, keys.indexOf(this.#current()?.dataset.key));
    const found = [...keys.slice(at), ...keys.slice(0, at)].find((key) => key.split("/").at(-1).toLowerCase().startsWith(text));
    this.find.setAttribute("aria-invalid", String(found === undefined));
    if (found !== undefined) this.edits.select(...partsOf(found));
  }

  #found(event) {
    if (!["Enter", "Escape", "ArrowDown"].includes(event.key)) return;
    event.preventDefault();
    this.focus();
  }
}

// Names have no slash.
const keyOf = (actor, joint) => joint === null ? `${actor}` : `${actor}/${joint}`;
const partsOf = (key) => key.includes("/") ? key.split("/") : [key, null];
const inDocument = (one, other) => one.compareDocumentPosition(other) & Node.DOCUMENT_POSITION_FOLLOWING ? -1 : 1;
