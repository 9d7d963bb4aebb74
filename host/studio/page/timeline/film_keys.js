// The film's keys as the studio tells them, and which of them are selected here. Listeners hear "keys" (either changed).

const kPatience = 1500;  // ms for the studio's answer

const idOf = (thing, part) => `${thing}\n${part}`;

export class FilmKeys {
  #picked = new Map();  // of a part (idOf) -> Set of frames
  #asked = false;
  #awaited = null;      // hears whether the studio took the last step
  things = [];          // {thing, kind, parts: [{name, axes, keys: [{frame, value, ease, in, out}]}]}

  constructor({connection, state}) {
    Object.assign(this, {connection, state});
    connection.on("channels", ({things}) => {
      this.things = things;
      this.#answered(true);
      state.tell("keys");
    });
    connection.on("refused", () => this.#answered(false));
    connection.on("gone", () => { this.#asked = false; });
    state.on("project", () => this.#ask());
  }

  #ask() {
    if (!this.state.isFilm() || this.#asked) return;
    this.#asked = this.connection.send({do: "channels", things: ["*"]});
  }

  // What a hand let go of stays where it shows until the studio has answered: `done(whether it took it)`.
  whenAnswered(done) {
    this.#answered(true);
    this.#awaited = done;
    setTimeout(() => { if (this.#awaited === done) this.#answered(false); }, kPatience);
  }

  // A hand that presses again does not wait: a late answer to its last step would end the new drag.
  presumeTaken() { this.#answered(true); }

  #answered(taken) {
    const done = this.#awaited;
    this.#awaited = null;
    done?.(taken);
  }

  thing(name) { return this.things.find(({thing}) => thing === name) ?? null; }
  part(thing, name) { return this.thing(thing)?.parts.find((part) => part.name === name) ?? null; }

  isPicked(thing, part, frame) { return this.#picked.get(idOf(thing, part))?.has(frame) ?? false; }

  // `keys`: [{thing, part, frame}]. `how`: "only" these, "add" them, "flip" them.
  pick(keys, how = "only") {
    if (how === "only") this.#picked.clear();
    const flipped = how === "flip" && keys.every(({thing, part, frame}) => this.isPicked(thing, part, frame));
    for (const {thing, part, frame} of keys) {
      const id = idOf(thing, part);
      if (!this.#picked.has(id)) this.#picked.set(id, new Set());
      if (flipped) this.#picked.get(id).delete(frame);
      else this.#picked.get(id).add(frame);
    }
    this.state.tell("keys");
  }

  pickAll() {
    this.pick(this.things.flatMap(({thing, parts}) => parts.flatMap((part) =>
      part.keys.map(({frame}) => ({thing, part: part.name, frame})))));
  }

  // What was selected is `by` frames later now.
  moved(by) {
    for (const [id, frames] of this.#picked) this.#picked.set(id, new Set([...frames].map((frame) => frame + by)));
    this.state.tell("keys");
  }

  // The selected keys: [{thing, part, key}].
  picked() {
    return this.things.flatMap(({thing, parts}) => parts.flatMap((part) =>
      part.keys.filter(({frame}) => this.isPicked(thing, part.name, frame)).map((key) => ({thing, part, key}))));
  }

  // All things as key_commands.js takes them.
  chosen() {
    return this.things.map(({thing, parts}) => ({thing, parts: parts.map(({name, keys}) => {
      const frames = new Set(keys.map(({frame}) => frame));
      return {name, frames, picked: (this.#picked.get(idOf(thing, name)) ?? new Set()).intersection(frames)};
    })}));
  }
}
