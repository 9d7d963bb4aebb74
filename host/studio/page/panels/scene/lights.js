// A film's lights: one is chosen here or in a view, and changed at the frame.

import {element} from "../../dom.js";
import {part} from "../../fields.js";
import {joined, rangeOf} from "./controls.js";

const kKinds = {directional: "Sun", point: "Bulb", spot: "Spot"};
const kNew = {directional: ["direction=1,-1,2"], point: ["place=0,-3,4"], spot: ["place=0,-4,5", "at=0,0,1"]};

export function lightsPart(controls) {
  const lights = controls.project.lights ?? [], {thing: selected} = controls.state.selected;
  const shown = lights.find(({thing}) => thing === selected);
  const one = ({thing, kind}) => element("button", {"aria-pressed": String(thing === selected), "data-key": thing,
                                                    onclick: () => controls.edits.selectThing(thing)}, `${thing.split("/")[1]} ${kKinds[kind]}`);
  const add = (kind) => controls.button(`+ ${kKinds[kind]}`, `light.add.${kind}`, () => ["film", "light", "add", ...kNew[kind]]);
  return part("Lights", lights.length ? element("div", {class: "actions three"}, lights.map(one))
                                      : element("p", {class: "hint"}, "The film has none of its own: three are shown."),
              shown && ofLight(controls, shown), element("div", {class: "actions three"}, Object.keys(kKinds).map(add)));
}

function ofLight(controls, {thing, kind}) {
  const now = () => controls.project.lights?.find((light) => light.thing === thing);
  const vector = (label, member) => controls.vector(label, `Light, ${label.toLowerCase()}`, `light.${member}`, 0.1,
    (value) => controls.posed(thing, `${member}=${joined(value)}`), () => now()?.[member]);
  const intensity = {name: "Light, intensity", ...rangeOf(controls.project.keys.light.intensity), step: 0.1, key: "light.intensity"};
  return [
    kind === "directional" ? vector("Direction", "direction") : vector("Place", "place"),
    kind === "spot" && vector("Aims at", "at"),
    controls.number("Intensity", intensity, (value) => controls.posed(thing, `intensity=${value}`), () => now()?.intensity),
    controls.color("Colour", "Light, colour", "light.color", (value) => controls.posed(thing, `color=${joined(value)}`), () => now()?.color),
    element("div", {class: "actions"},
            controls.button("Insert key", "light.key", () => ["animate", "key", thing, ...controls.atFrame()]),
            controls.button("Remove", "light.remove", () => ["film", "light", "remove", thing.split("/")[1]])),
  ];
}
