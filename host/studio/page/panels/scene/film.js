// A film's materials, whose colours are keyed, and its settings, the keys of the table.

import {element} from "../../dom.js";
import {part} from "../../fields.js";
import {joined} from "./controls.js";
import {keyFields} from "./key_fields.js";

export function materialsPart(controls) {
  const materials = controls.project.materials ?? [];
  if (materials.length === 0) return null;
  const one = ({name}) => controls.color(name, `Colour of ${name}`, `material.${name}`,
    (value) => controls.posed(`material/${name}`, `color=${joined(value)}`),
    () => controls.project.materials.find((each) => each.name === name)?.color);
  return part("Materials", element("p", {class: "hint"}, "A colour is keyed at the frame."), materials.map(one));
}

export function filmPart(controls) {
  const now = () => controls.project.settings;
  return part("Film", keyFields(controls, {of: "film", kind: now().color, now, words: (name, _, text) => ["film", "set", `${name}=${text}`]}));
}
