// A film's lights: one is chosen here or in a view, and its keys of the table are changed at the frame.

import {element} from "../../dom.js";
import {part} from "../../fields.js";
import {keyFields} from "./key_fields.js";

export function lightsPart(controls) {
  const lights = controls.project.lights ?? [], {light: kinds} = controls.project.keys.kinds, {thing: selected} = controls.state.selected;
  const shown = lights.find(({thing}) => thing === selected);
  const labelOf = (kind) => kinds.find(({name}) => name === kind).label;
  const one = ({thing, kind}) => element("button", {"aria-pressed": String(thing === selected), "data-key": thing,
                                                    onclick: () => controls.edits.selectThing(thing)}, `${thing.split("/")[1]} ${labelOf(kind)}`);
  const add = ({name, label, begins_with}) => controls.button(`+ ${label}`, `light.add.${name}`, () => ["film", "light", "add", ...begins_with]);
  return part("Lights", lights.length ? element("div", {class: "actions three"}, lights.map(one))
                                      : element("p", {class: "hint"}, "The film has none of its own: three are shown."),
              shown && ofLight(controls, shown), element("div", {class: "actions three"}, kinds.map(add)));
}

function ofLight(controls, {thing, kind}) {
  const now = () => controls.project.lights?.find((light) => light.thing === thing);
  return [
    keyFields(controls, {of: "light", kind, now, words: (name, _, text) => controls.changed(thing, now(), name, text)}),
    element("div", {class: "actions"},
            controls.button("Insert key", "light.key", () => ["animate", "key", thing, ...controls.atFrame()]),
            controls.button("Remove", "light.remove", () => ["film", "light", "remove", thing.split("/")[1]])),
  ];
}
