// The curves of the chosen parts as the studio computes them, for the frames in sight; their keys as points.

const kSpare = 0.5;  // of the frames in sight, asked for at each side

export class CurveData {
  #asked = "";
  message = null;  // {thing, first, parts: [{name, axes, limits, values}]}
  shown = false;

  constructor({connection, pace, state}, keys, rows, axis) {
    Object.assign(this, {pace, state, keys, rows, axis});
    connection.on("curves", (message) => {
      this.message = message;
      state.tell("curves");
    });
    connection.on("connected", () => { this.#asked = ""; });
    state.on("rows keys project", () => this.#ask());
    axis.on(() => this.#ask());
  }

  show(on) {
    this.shown = on;
    this.#ask();
  }

  #ask() {
    if (!this.state.isFilm()) return;
    const {thing, parts} = this.rows.chosenParts();
    const wanted = this.shown && thing !== null && thing !== "--all" && parts.length > 0;
    const message = wanted ? {do: "curves", thing, parts, ...this.#frames()} : {do: "curves"};
    if (!wanted) this.message = null;
    const asked = JSON.stringify(message);
    if (asked === this.#asked || (this.#asked === "" && !wanted)) return;
    this.#asked = asked;
    this.pace.send("curves", message);
  }

  // Rounded, so that a small pan asks for nothing.
  #frames() {
    const {axis} = this, seen = axis.width / axis.perFrame, grain = Math.max(1, Math.round(seen * kSpare));
    const last = Math.ceil((axis.frameAt(axis.width) + 1) / grain) * grain;
    return {first: Math.max(0, Math.floor(axis.from / grain) * grain), last: Math.max(1, last)};
  }

  // [{part, axis, limits, values, first, keys: [{key, value}]}], a line for each axis.
  lines() {
    const {message} = this;
    return (message?.parts ?? []).flatMap((curve) => {
      const part = this.keys.part(message.thing, curve.name);
      return curve.axes.map((axis, i) => ({
        thing: message.thing, part: curve.name, axis, axes: part?.axes ?? curve.axes, several: curve.axes.length > 1,
        limits: curve.limits?.[i] ?? null, values: curve.values[i], first: message.first,
        keys: (part?.keys ?? []).map((key) => ({key, value: onAxis(key.value, part.axes, axis)})).filter(({value}) => value !== null),
      }));
    });
  }
}

// A number of a key's value, of its slope; null where it is none, such as a camera that follows an actor.
export function onAxis(value, axes, axis) {
  if (typeof value === "number") return value;
  if (!Array.isArray(value)) return null;
  const number = value[value.length === axes.length ? axes.indexOf(axis) : "xyz".indexOf(axis)];
  return typeof number === "number" ? number : null;
}
