// The tree of joints (ARIA's tree pattern): one stop for Tab, arrows go and select. Letters are the page's shortcuts; a
// field beside the title finds by the first letters. What is in sight alone is elements (rows_in_sight.js).

import {element, newId} from "./dom.js";
import {icon} from "./icons.js";
import {RowsInSight} from "./rows_in_sight.js";
import {keysOf} from "./shortcuts.js";

const kRow = 23;         // pixels

export class Tree {
  #closed = new Set();   // keys of entries that are shut
  #known = new Set();    // actors that were shown: a film's are shut at first
  #entries = [];         // those that are in no shut one
  #at = 0;               // where the keyboard is among them: the selected one, or else the first

  constructor(place, {state, edits, rename}) {
    Object.assign(this, {state, edits, rename});
    this.id = newId("tree");
    this.title = element("h2", {}, "Joints");
    this.count = element("span", {class: "count"});
    this.root = element("div", {role: "tree", tabindex: 0, "aria-label": "Joints", "aria-multiselectable": "true",
                                "data-key": "tree"});
    const add = element("button", {class: "quiet icon", "aria-label": "Add a joint", title: `Add a joint (${keysOf("addJoint")})`,
                                   onclick: () => edits.addJoint()}, icon("add"));
    this.find = element("input", {type: "text", class: "find", "aria-label": "Find by the first letters", placeholder: `Find (${keysOf("find")})`,
                                  "data-key": "tree.find", autocomplete: "off", spellcheck: "false"});
    place.append(element("div", {class: "panel-title"}, this.title, this.count, this.find, add), this.root);
    this.add = add;
    this.rows = new RowsInSight(this.root, kRow, {make: (entry, index) => this.#item(entry, index), look: (entry) => this.#look(entry)});
    this.root.addEventListener("keydown", (event) => this.#key(event));
    this.find.addEventListener("input", () => this.#find(this.find.value.trim().toLowerCase()));
    this.find.addEventListener("keydown", (event) => this.#found(event));
    this.find.addEventListener("blur", () => { this.find.value = ""; });
    this.root.addEventListener("click", (event) => this.#click(event));
    this.root.addEventListener("dblclick", ({target}) => { if (target.closest(".row") && !target.closest(".twist")) this.rename(); });
    state.on("project", () => this.#project());
    state.on("selected", () => this.#select());
  }

  #project() {
    const {actors} = this.state.project, film = this.state.isFilm();
    for (const {name} of actors) {
      if (film && !this.#known.has(name)) this.#closed.add(keyOf(name, null));
      this.#known.add(name);
    }
    this.title.textContent = film ? "Actors" : "Joints";
    this.count.textContent = film ? actors.length : actors.reduce((sum, actor) => sum + actor.joints.length, 0);
    this.add.hidden = film;
    this.#show();
  }

  #select() {
    const {actor, joint} = this.state.selected;
    for (let up = this.state.joint(); up; up = this.state.joint(up.parent ?? null, actor))
      if (up.name !== joint) this.#closed.delete(keyOf(actor, up.name));
    if (joint !== null) this.#closed.delete(keyOf(actor, null));
    this.#show();
    if (this.#entries[this.#at] && this.#isSelected(this.#entries[this.#at])) this.rows.reveal(this.#at);
    this.#point();
  }

  #isSelected({actor, joint}) { return actor === this.state.selected.actor && joint === this.state.selected.joint; }

  #isAlso({actor, joint}) { return actor === this.state.selected.actor && this.state.selected.more.includes(joint); }

  // ---- entries: {key, actor, joint (null: the actor), name, level, open (undefined: has none below), keyed, at, of}

  #show() {
    if (!this.state.project) return;
    const {actors} = this.state.project;
    this.#entries = this.state.isFilm() ? actors.flatMap((actor, i) => this.#ofActor(actor, i, actors.length))
                                        : actors.flatMap((actor) => this.#joints(actor, 1));
    this.#at = Math.max(0, this.#entries.findIndex((entry) => this.#isSelected(entry)));
    this.rows.show(this.#entries);
    this.#point();
  }

  #point() {
    const id = `${this.id}-${this.#at}`;
    if (document.getElementById(id)) this.root.setAttribute("aria-activedescendant", id);
    else this.root.removeAttribute("aria-activedescendant");
  }

  #ofActor(actor, at, of) {
    const entry = this.#entry({actor: actor.name, joint: null, name: actor.name, level: 1, at, of}, actor.joints.length > 0);
    return entry.open ? [entry, ...this.#joints(actor, 2)] : [entry];
  }

  #joints(actor, level) {
    const below = new Map(actor.joints.map(({name}) => [name, []]));
    const first = [];
    for (const joint of actor.joints) (below.get(joint.parent) ?? first).push(joint);
    const list = (joints, depth) => joints.flatMap(({name, keyed}, at) => {
      const children = below.get(name);
      const entry = this.#entry({actor: actor.name, joint: name, name, level: depth, keyed, at, of: joints.length}, children.length > 0);
      return entry.open ? [entry, ...list(children, depth + 1)] : [entry];
    });
    return list(first, level);
  }

  #entry(entry, hasSome) {
    const key = keyOf(entry.actor, entry.joint);
    return {...entry, key, open: hasSome ? !this.#closed.has(key) : undefined};
  }

  #look(entry) { return [entry, this.#isSelected(entry), this.#isAlso(entry), entry === this.#entries[this.#at]]; }

  #item(entry, index) {
    const {key, joint, name, level, open, keyed, at, of} = entry;
    const row = element("div", {class: "row"}, element("span", {class: "twist"}, open !== undefined && icon("twist")), icon(joint === null ? "actor" : "joint"),
                        element("span", {class: "name"}, name), keyed && element("span", {class: "keyed", title: "Has a key here"}, icon("key")));
    row.style.setProperty("--level", level - 1);
    return element("div", {role: "treeitem", id: `${this.id}-${index}`, class: index === this.#at && "active", "aria-level": level, "aria-posinset": at + 1, "aria-setsize": of,
                           "aria-expanded": open === undefined ? null : String(open), "aria-label": name,
                           "aria-selected": String(this.#isSelected(entry) || this.#isAlso(entry)), "data-key": key}, row);
  }

  // ---- hands

  #open({key}, open) {
    if (open) this.#closed.delete(key);
    else this.#closed.add(key);
    this.#show();
  }

  #choose(entry) { if (entry) this.edits.select(entry.actor, entry.joint); }

  // Selects the joint beside those of the same actor that are selected. With `flips`, a joint among them leaves.
  #add(entry, flips) {
    const {actor, joint, more} = this.state.selected;
    if (!entry || entry.actor !== actor || entry.joint === null || joint === null) return this.#choose(entry);
    const others = [joint, ...more].filter((name) => name !== entry.joint);
    if (!flips || others.length > more.length) this.edits.select(actor, entry.joint, others);
    else if (others.length > 0) this.edits.select(actor, others[0], others.slice(1));
  }

  #click({target, shiftKey}) {
    const key = target.closest("[role=treeitem]")?.dataset.key;
    const entry = this.#entries.find((each) => each.key === key);
    if (!entry) return;
    if (target.closest(".twist") && entry.open !== undefined) this.#open(entry, !entry.open);
    else if (shiftKey) this.#add(entry, true);
    else this.#choose(entry);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const entries = this.#entries, at = this.#at, entry = entries[at];
    if (!entry) return;
    const goTo = (to) => event.shiftKey ? this.#add(to, false) : this.#choose(to);
    const acts = {
      ArrowDown: () => goTo(entries[at + 1]),
      ArrowUp: () => goTo(entries[at - 1]),
      Home: () => this.#choose(entries[0]),
      End: () => this.#choose(entries.at(-1)),
      ArrowRight: () => entry.open === false ? this.#open(entry, true) : entry.open && this.#choose(entries[at + 1]),
      ArrowLeft: () => entry.open ? this.#open(entry, false) : this.#choose(entries.slice(0, at).findLast(({level}) => level < entry.level)),
      Enter: () => this.#choose(entry),
    };
    if (!acts[event.key]) return;
    acts[event.key]();
    event.preventDefault();
  }

  // The first from the selected one on, also where it does not show yet.
  #find(text) {
    if (text === "") return;
    const all = this.state.project.actors.flatMap((actor) => this.#ofAll(actor));
    const at = Math.max(0, all.findIndex((each) => this.#isSelected(each)));
    const found = [...all.slice(at), ...all.slice(0, at)].find(({name}) => name.toLowerCase().startsWith(text));
    this.find.setAttribute("aria-invalid", String(found === undefined));
    this.#choose(found);
  }

  #ofAll({name, joints}) {
    const own = joints.map((joint) => ({actor: name, joint: joint.name, name: joint.name}));
    return this.state.isFilm() ? [{actor: name, joint: null, name}, ...own] : own;
  }

  #found(event) {
    if (!["Enter", "Escape", "ArrowDown"].includes(event.key)) return;
    event.preventDefault();
    this.root.focus();
  }
}

// Names have no slash.
const keyOf = (actor, joint) => joint === null ? `${actor}` : `${actor}/${joint}`;
