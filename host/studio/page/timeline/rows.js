// The rows of the sheet: everything, then each thing with its parts below it where it is open. A row: {id, kind, name,
// level, thing, part, open, marks()}; its marks are the frames that have keys: [{frame, look, still, keys}].

const kLooks = ["linear", "eased", "spline", "slopes", "hold"];
const kOrder = ["camera", "light", "material", "actor"];

function lookOf({ease = "linear", in: reach, out}) {
  if (ease === "spline") return reach !== undefined || out !== undefined ? "slopes" : "spline";
  return ease === "linear" || ease === "hold" ? ease : "eased";
}

export class Rows {
  #open = new Set();
  #marks = new Map();  // id -> marks
  list = [];
  chosen = new Set();  // ids
  active = null;       // the id that arrows go from

  constructor(keys, state) {
    Object.assign(this, {keys, state});
    state.on("keys", () => this.#rebuild());
  }

  // What the keys' listeners see afterwards.
  #rebuild() {
    if (this.things !== this.keys.things) {
      if (!this.things && this.keys.things.length === 1) this.#open.add(this.keys.things[0].thing);
      this.things = this.keys.things;
      this.#marks.clear();
    }
    this.#list();
  }

  #list() {
    const things = [...this.things].sort((one, other) => kOrder.indexOf(one.kind) - kOrder.indexOf(other.kind));
    this.list = things.length === 0 ? [] : [{id: "", kind: "all", name: "All keys", level: 0, thing: null, part: null}];
    for (const {thing, kind, parts} of things) {
      const open = this.#open.has(thing);
      this.list.push({id: thing, kind, name: thing, level: 0, thing, part: null, open});
      if (open) for (const {name} of parts) this.list.push({id: `${thing}\n${name}`, kind: "part", name, level: 1, thing, part: name});
    }
  }

  at(index) { return this.list[index] ?? null; }
  index(id) { return this.list.findIndex((row) => row.id === id); }

  setOpen(thing, open) {
    if (open) this.#open.add(thing);
    else this.#open.delete(thing);
    this.#list();
    this.state.tell("rows");
  }

  // `how`: "only" it, "flip" it, "to": all from the active one to it.
  choose(row, how = "only") {
    if (how === "flip" && this.chosen.has(row.id)) this.chosen.delete(row.id);
    else if (how === "to" && this.index(this.active) >= 0) {
      const ends = [this.index(this.active), this.index(row.id)].sort((one, other) => one - other);
      this.chosen = new Set(this.list.slice(ends[0], ends[1] + 1).map(({id}) => id));
    } else this.chosen = new Set([...(how === "only" ? [] : this.chosen), row.id]);
    if (how !== "to") this.active = row.id;
    this.state.tell("rows");
  }

  // A thing's part, or the thing alone; its row shows then.
  reveal(thing, part) {
    if (!this.keys.thing(thing)) return;
    const known = part !== null && this.keys.part(thing, part) ? part : null;
    if (known !== null) this.#open.add(thing);
    this.#list();
    this.choose({id: known === null ? thing : `${thing}\n${known}`});
  }

  // Of the first thing that is chosen, or has a chosen part: these parts, none where all of it is chosen.
  named() {
    if (this.chosen.has("")) return {thing: "--all", parts: []};
    const rows = this.list.filter(({id}) => this.chosen.has(id));
    const thing = rows[0]?.thing ?? null;
    return {thing, parts: rows.filter((row) => row.thing === thing && row.part !== null).map(({part}) => part)};
  }

  // The same with all parts where none is named.
  chosenParts() {
    const {thing, parts} = this.named();
    return {thing, parts: parts.length ? parts : this.keys.thing(thing)?.parts.map(({name}) => name) ?? []};
  }

  marks(row) {
    if (!this.#marks.has(row.id)) this.#marks.set(row.id, this.#makeRow(row));
    return this.#marks.get(row.id);
  }

  keysOf(row) { return this.marks(row).flatMap(({keys}) => keys); }

  #makeRow({thing, part}) {
    const marks = new Map();
    for (const each of this.things) {
      if (thing !== null && each.thing !== thing) continue;
      for (const {name, keys} of each.parts) if (part === null || part === name) addMarks(marks, each.thing, name, keys);
    }
    return [...marks.values()].sort((one, other) => one.frame - other.frame);
  }
}

function addMarks(marks, thing, part, keys) {
  keys.forEach((key, i) => {
    const look = lookOf(key);
    const still = keys[i + 1] !== undefined && key.ease !== "spline" && String(keys[i + 1].value) === String(key.value);
    const mark = marks.get(key.frame) ?? {frame: key.frame, look, still: true, keys: []};
    if (kLooks.indexOf(look) > kLooks.indexOf(mark.look)) mark.look = look;
    mark.still &&= still;
    mark.keys.push({thing, part, frame: key.frame});
    marks.set(key.frame, mark);
  });
}

// The first mark at this frame or later: an index.
export function firstFrom(marks, frame) {
  let low = 0, high = marks.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (marks[middle].frame < frame) low = middle + 1;
    else high = middle;
  }
  return low;
}
