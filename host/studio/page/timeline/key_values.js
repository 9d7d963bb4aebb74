// The selected key as numbers: its frame, its value on each axis; a spline's slopes made flat or automatic.

import {element, keepingFocus} from "../dom.js";
import {numberField} from "../fields.js";
import {onAxis} from "./curve_data.js";

export class KeyValues {
  #built = "";
  #fields = [];

  constructor(acts, keys, state) {
    Object.assign(this, {acts, keys, state});
    this.root = element("div", {class: "key-values", role: "group", "aria-label": "Selected key"});
    state.on("keys", () => this.#update());
    this.#update();
  }

  #update() {
    const picked = this.keys.picked(), one = picked.length === 1 ? picked[0] : null;
    const built = JSON.stringify(one ? [one.thing, one.part.name, one.key.frame, one.key.ease, one.part.axes] : picked.length);
    if (built !== this.#built) {
      this.#built = built;
      keepingFocus(this.root, () => this.#build(one, picked));
    }
    if (one) for (const field of this.#fields) field(one);
  }

  #build(one, picked) {
    this.#fields = [];
    const frames = new Set(picked.map(({key}) => key.frame)).size;
    const text = picked.length === 0 ? "No key selected" : `${picked.length} keys selected, at ${frames === 1 ? "one frame" : `${frames} frames`}`;
    if (!one) return this.root.replaceChildren(element("span", {class: "hint"}, text));
    this.root.replaceChildren(element("strong", {}, one.part.name), this.#frame(one),
                              ...one.part.axes.filter((axis) => onAxis(one.key.value, one.part.axes, axis) !== null).map((axis) => this.#value(one, axis)),
                              ...this.#slopes(one, picked));
  }

  #frame({key}) {
    const field = numberField({name: "Frame of the key", letter: "f", axis: "", step: 1, least: 0, digits: 0, key: "key.frame", commit: (frame, event) => {
      this.acts.nudge(Math.round(frame) - key.frame, event);
    }});
    this.#fields.push((now) => field.set(now.key.frame));
    return field.root;
  }

  #value({thing, part, key}, axis) {
    const word = part.axes.length > 1 || "xyz".includes(axis) ? `${part.name}.${axis}` : part.name;
    const commands = (value) => [["animate", "pose", thing, `${word}=${value}`, "--frame", `${key.frame}`, "--clamp"]];
    const field = numberField({name: `Value ${axis} of the key`, letter: "xyz".includes(axis) ? axis : "", step: 1, key: `key.${axis}`,
                               preview: (value, event) => this.acts.tryOut(commands(value), event),
                               commit: (value, event) => this.acts.commit(commands(value), event), cancel: () => this.acts.cancel()});
    this.#fields.push((now) => field.set(onAxis(now.key.value, now.part.axes, axis)));
    return field.root;
  }

  #slopes({thing, part, key}) {
    const before = part.keys[part.keys.findIndex(({frame}) => frame === key.frame) - 1];
    if (key.ease !== "spline" && before?.ease !== "spline") return [];
    const button = (text, option, title) => element("button", {title, "data-key": `key.${option}`, onclick: (event) =>
      this.acts.commit([["animate", "tangent", thing, part.name, "--frame", `${key.frame}`, `--${option}`]], event)}, text);
    return [button("Flat", "flat", "Slopes of 0: the curve rests here"), button("Auto", "auto", "Slopes as the neighbouring keys ask for")];
  }
}
