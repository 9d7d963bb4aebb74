// Buttons for what may be done to the selected keys.

import {element} from "../dom.js";
import {icon} from "../icons.js";
import {addMenu} from "../menu.js";
import {askNumbers} from "../popover.js";
import {keysOf} from "../shortcuts.js";

export const kEases = [["linear", "Linear"], ["in", "Begin slowly"], ["out", "End slowly"], ["both", "Begin and end slowly"], ["spline", "Spline"]];
const kCurve = [["x1", 0.4], ["y1", 0], ["x2", 0.6], ["y2", 1]];

export class KeyBar {
  constructor(acts, keys, state) {
    Object.assign(this, {acts, keys});
    const button = (glyph, text, command, act) => element("button", {class: "quiet icon", "aria-label": text, title: `${text} (${keysOf(command)})`,
                                                                     "data-key": `keys.${glyph}`, onclick: act}, icon(glyph));
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
    for (const button of [this.ease, this.time, this.remove]) button.disabled = none;
  }

  openEases() { this.ease.click(); }
  openTimes() { this.time.click(); }

  #eases() {
    const now = new Set(this.keys.picked().map(({key}) => String(key.ease)));
    const one = now.size === 1 ? [...now][0] : null;
    const numbers = kCurve.map(([name, value], i) => ({name, value: one?.includes(",") ? Number(one.split(",")[i]) : value, step: 0.05,
                                                       ...(name[0] === "x" ? {least: 0, most: 1} : {least: -10, most: 10})}));
    const curve = () => askNumbers(this.ease, "Curve", "Two control points, x in time, y of the way.", numbers, (four, event) => this.acts.ease(four.join(","), event));
    return [{heading: "To the next key"},
            ...kEases.map(([ease, text]) => ({text, chosen: one === ease, act: (event) => this.acts.ease(ease, event)})),
            {text: "Curve by four numbers\u2026", chosen: one?.includes(",") ?? false, act: curve}];
  }

  #times() {
    const {acts, time} = this;
    const ask = (title, hint, name, value, apply, least) => () => askNumbers(time, title, hint, [{name, value, step: 1, least}], ([number], event) => apply(number, event));
    return [{heading: "Timing"},
            {text: "Stretch\u2026", act: ask("Stretch", "From the first selected key to the last; later keys follow.", "Times", 1.5, (by, event) => acts.stretch(by, event), 0.01)},
            {text: "Hold\u2026", act: ask("Hold", "Stand still from the frame that shows; later keys follow.", "Frames", 6, (by, event) => acts.retime("hold", by, event), 1)},
            {text: "Shift\u2026", act: ask("Shift", "All keys from the frame that shows on; negative: earlier.", "Frames", 4, (by, event) => acts.retime("shift", by, event))},
            {heading: "Swing"},
            {text: "Anticipate, overshoot\u2026", act: () => askNumbers(time, "Swing", "Percent of the motion.", [{name: "Back at first", value: 15, least: 0, most: 100}, {name: "Beyond at last", value: 10, least: 0, most: 100}],
                                                                      (two, event) => acts.swing(...two, event))}];
  }
}
