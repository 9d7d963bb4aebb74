// Buttons for what may be done to the selected keys.

import {element} from "../dom.js";
import {icon} from "../icons.js";
import {addMenu} from "../menu.js";
import {askNumbers} from "../popover.js";
import {keysOf} from "../shortcuts.js";

const kEases = [["linear", "Linear"], ["in", "Begin slowly"], ["out", "End slowly"], ["both", "Begin and end slowly"], ["spline", "Spline"], ["hold", "Hold, then jump"]];
const kCurve = [{name: "x1", value: 0.4}, {name: "y1", value: 0}, {name: "x2", value: 0.6}, {name: "y2", value: 1}];
const kSides = {x: {least: 0, most: 1}, y: {least: -10, most: 10}};
const kSwing = [{name: "Back at first", value: 15, least: 0, most: 100}, {name: "Beyond at last", value: 10, least: 0, most: 100}];

export class KeyBar {
  constructor(acts, keys, state) {
    Object.assign(this, {acts, keys});
    this.insert = button("insert", "Insert keys at the frame", "insertKeys", (event) => acts.insert(event));
    this.ease = button("ease", "Ease of the selected keys", "easeKeys");
    this.time = button("time", "Timing of the selected keys", "timeKeys");
    this.remove = button("remove", "Delete the selected keys", "removeKeys", (event) => acts.remove(event));
    addMenu(this.ease, () => this.#eases());
    addMenu(this.time, () => this.#times());
    this.root = element("div", {class: "group", role: "group", "aria-label": "Keys"}, this.insert, this.ease, this.time, this.remove);
    state.on("keys", () => this.#enable());
    this.#enable();
  }

  #enable() {
    const none = this.keys.picked().length === 0;
    for (const each of [this.ease, this.time, this.remove]) each.disabled = none;
  }

  openEases() { this.ease.click(); }
  openTimes() { this.time.click(); }

  // The ease that all selected keys have is marked.
  #eases() {
    const eases = new Set(this.keys.picked().map(({key}) => String(key.ease)));
    const one = eases.size === 1 ? [...eases][0] : "";
    return [{heading: "To the next key"},
            ...kEases.map(([ease, text]) => ({text, chosen: one === ease, act: (event) => this.acts.ease(ease, event)})),
            {text: "Curve by four numbers\u2026", chosen: one.includes(","), act: () => this.#askCurve(one.split(",").map(Number))}];
  }

  #askCurve(now) {
    const numbers = kCurve.map(({name, value}, i) => ({name, value: now.length === 4 ? now[i] : value, step: 0.05, ...kSides[name[0]]}));
    askNumbers(this.ease, "Curve", "Two control points: x in time, y of the way.", numbers, (four, event) => this.acts.ease(four.join(","), event));
  }

  #times() {
    const {acts} = this;
    const one = (title, hint, number, apply) =>
      ({text: `${title}\u2026`, act: () => askNumbers(this.time, title, hint, [number], ([value], event) => apply(value, event))});
    return [
      {heading: "Timing"},
      one("Stretch", "From the first selected key to the last; later keys follow.",
          {name: "Times", value: 1.5, step: 0.1, least: 0.01}, (by, event) => acts.stretch(by, event)),
      one("Hold", "Stand still from the frame that shows; later keys follow.",
          {name: "Frames", value: 6, step: 1, least: 1}, (by, event) => acts.retime("hold", by, event)),
      one("Shift", "All keys from the frame that shows on; negative: earlier.",
          {name: "Frames", value: 4, step: 1}, (by, event) => acts.retime("shift", by, event)),
      {heading: "Fewer keys"},
      one("Reduce", "Splines through a few of the keys, from the first selected one to the last.",
          {name: "Error", unit: "\u00b0", value: 1, step: 0.1, least: 0.001, most: 90}, (by, event) => acts.reduce(by, event)),
      {heading: "Swing"},
      {text: "Anticipate, overshoot\u2026",
       act: () => askNumbers(this.time, "Swing", "Percent of the motion.", kSwing, (two, event) => acts.swing(...two, event))},
    ];
  }
}

function button(glyph, text, command, act) {
  return element("button", {class: "quiet icon", "aria-label": text, title: `${text} (${keysOf(command)})`, "data-key": `keys.${glyph}`,
                            onclick: act}, icon(glyph));
}
