// The tree of joints (ARIA's tree pattern): one stop for Tab, arrows go and select, letters find. What is in sight alone
// is elements (rows_in_sight.js).

import {element, newId} from "./dom.js";
import {icon} from "./icons.js";
import {RowsInSight} from "./rows_in_sight.js";
import {keysOf} from "./shortcuts.js";

const kTypeAhead = 700;  // ms between letters of one word
const kRow = 23;         // pixels

export class Tree {
  #closed = null;        // keys of entries that are shut; null: nothing was shown yet
  #entries = [];         // those that are in no shut one
  #at = 0;               // where the keyboard is among them: the selected one, or else the first
  #word = {text: "", time: 0};

  constructor(place, {state, edits, rename}) {
    Object.assign(this, {state, edits, rename});
    this.id = newId("tree");
    this.title = element("h2", {}, "Joints");
    this.count = element("span", {class: "count"});
    this.root = element("div", {role: "tree", tabindex: 0, "aria-label": "Joints", "data-key": "tree"});
    const add = element("button", {class: "quiet icon", "aria-label": "Add a joint", title: `Add a joint (${keysOf("addJoint")})`,
                                   onclick: () => edits.addJoint()}, icon("add"));
    place.append(element("div", {class: "panel-title"}, this.title, this.count, add), this.root);
    this.add = add;
    this.rows = new RowsInSight(this.root, kRow, {make: (entry, index) => this.#item(entry, index), look: (entry) => this.#look(entry)});
    this.root.addEventListener("keydown", (event) => this.#key(event));
    this.root.addEventListener("click", (event) => this.#click(event));
    this.root.addEventListener("dblclick", ({target}) => { if (target.closest(".row") && !target.closest(".twist")) this.rename(); });
    state.on("project", () => this.#project());
    state.on("selected", () => this.#select());
  }

  #project() {
    const {actors} = this.state.project, film = this.state.isFilm();
    this.#closed ??= new Set(film ? actors.map(({name}) => keyOf(name, null)) : []);
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

  #look(entry) { return [entry, this.#isSelected(entry), entry === this.#entries[this.#at]]; }

  #item(entry, index) {
    const {key, joint, name, level, open, keyed, at, of} = entry;
    const row = element("div", {class: "row"}, element("span", {class: "twist"}, open !== undefined && icon("twist")), icon(joint === null ? "actor" : "joint"),
                        element("span", {class: "name"}, name), keyed && element("span", {class: "keyed", title: "Has a key here"}, icon("key")));
    row.style.setProperty("--level", level - 1);
    return element("div", {role: "treeitem", id: `${this.id}-${index}`, class: index === this.#at && "active", "aria-level": level, "aria-posinset": at + 1, "aria-setsize": of,
                           "aria-expanded": open === undefined ? null : String(open), "aria-label": name,
                           "aria-selected": String(this.#isSelected(entry)), "data-key": key}, row);
  }

  // ---- hands

  #open({key}, open) {
    if (open) this.#closed.delete(key);
    else this.#closed.add(key);
    this.#show();
  }

  #choose(entry) { if (entry) this.edits.select(entry.actor, entry.joint); }

  #click({target}) {
    const key = target.closest("[role=treeitem]")?.dataset.key;
    const entry = this.#entries.find((each) => each.key === key);
    if (!entry) return;
    if (target.closest(".twist") && entry.open !== undefined) this.#open(entry, !entry.open);
    else this.#choose(entry);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const entries = this.#entries, at = this.#at, entry = entries[at];
    if (!entry) return;
    const acts = {
      ArrowDown: () => this.#choose(entries[at + 1]),
      ArrowUp: () => this.#choose(entries[at - 1]),
      Home: () => this.#choose(entries[0]),
      End: () => this.#choose(entries.at(-1)),
      ArrowRight: () => entry.open === false ? this.#open(entry, true) : entry.open && this.#choose(entries[at + 1]),
      ArrowLeft: () => entry.open ? this.#open(entry, false) : this.#choose(entries.slice(0, at).findLast(({level}) => level < entry.level)),
      Enter: () => this.#choose(entry),
    };
    if (acts[event.key]) acts[event.key]();
    else if (/^[\p{L}\p{N}_-]$/u.test(event.key) && !(event.shiftKey && event.key === "A")) this.#find(event.key, at, event.timeStamp);
    else return;
    event.preventDefault();
  }

  #find(letter, at, time) {
    const goesOn = time - this.#word.time < kTypeAhead;
    this.#word = {text: (goesOn ? this.#word.text : "") + letter.toLowerCase(), time};
    const {text} = this.#word, entries = this.#entries;
    const order = [...entries.slice(at + (text.length > 1 ? 0 : 1)), ...entries.slice(0, at + 1)];
    this.#choose(order.find(({name}) => name.toLowerCase().startsWith(text)));
  }
}

// Names have no slash.
const keyOf = (actor, joint) => joint === null ? `${actor}` : `${actor}/${joint}`;
