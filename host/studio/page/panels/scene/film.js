// A film's materials, whose colours are keyed, and its settings.

import {element} from "../../dom.js";
import {line, numberField, part} from "../../fields.js";
import {joined, rangeOf} from "./controls.js";

export function materialsPart(controls) {
  const materials = controls.project.materials ?? [];
  if (materials.length === 0) return null;
  const one = ({name}) => controls.color(name, `Colour of ${name}`, `material.${name}`,
    (value) => controls.posed(`material/${name}`, `color=${joined(value)}`),
    () => controls.project.materials.find((each) => each.name === name)?.color);
  return part("Materials", element("p", {class: "hint"}, "A colour is keyed at the frame."), materials.map(one));
}

export function filmPart(controls) {
  const set = (text) => ["film", "set", text];
  const number = (label, key) => controls.number(label, {key: `film.${key}`, step: 1, ...rangeOf(controls.project.keys.film[key]), digits: 0},
                                                 (value) => set(`${key}=${value}`), () => controls.project[key]);
  const side = (name, at) => controls.field(numberField({
    name, key: `film.size${at}`, least: 16, step: 10, digits: 0,
    ...controls.gestures((value) => set(`size=${controls.project.size.map((each, i) => i === at ? value : each).join(",")}`)),
  }), () => controls.project.size[at]);
  const background = controls.project.background &&
    controls.color("Background", "Background", "film.background", (value) => set(`background=${joined(value)}`), () => controls.project.background);
  return part("Film", number("Frames", "frames"), number("Rate", "rate"),
              line("Size", element("div", {class: "several"}, side("Width", 0), side("Height", 1))), background);
}
