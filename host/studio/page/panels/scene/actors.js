// Actors of a film: the selected one's name, place, turn and carrier; others are added.

import {element} from "../../dom.js";
import {line, part, textField} from "../../fields.js";
import {modelCards} from "./model_cards.js";

export function actorPart(controls) {
  const {actor} = controls.state.selected;
  if (actor === null) return null;
  if (!controls.state.actor()?.place) return element("p", {class: "nothing"}, "This actor moves by matrices.");
  const name = textField({name: "Name of the actor", key: "actor.name",
                          commit: (to, event) => controls.commit(["film", "rename", actor, to], event)});
  name.set(actor);
  const ofActor = (label, member, step) => controls.vector(label, `${label} of the actor`, `actor.${member}`, step,
    (value) => controls.posed(actor, `${member}=${value.join(",")}`), () => controls.state.actor()?.[member]);
  return part(`Actor ${actor}`, line("Name", name.root), ofActor("Place", "place", 0.1), ofActor("Turn", "turn", 5),
              carrier(controls, actor),
              element("div", {class: "actions"}, controls.button("Remove", "actor.remove", () => ["film", "remove", actor])));
}

function carrier(controls, actor) {
  const words = (target) => target === null ? ["animate", "detach", actor] : ["animate", "attach", actor, "--to", target];
  return controls.target("Carried by", "Carried by", "actor.attach",
                         (target, event) => controls.commit([...words(target), ...controls.atFrame()], event),
                         () => controls.state.actor(actor)?.attach, actor);
}

export function castPart(controls) {
  const text = (name, key, hint) => element("input", {type: "text", "aria-label": name, "data-key": key, placeholder: hint, autocomplete: "off"});
  const model = text("Model of the new actor", "cast.model", "man, ball, FILE.json");
  const choose = (chosen) => {
    model.value = chosen;
    cards.set(chosen);
  };
  const cards = modelCards(controls.models, {list: controls.models.list, label: "Models", choose, chosen: null});
  cards.root.addEventListener("dblclick", (event) => add(event));
  model.addEventListener("input", () => cards.set(model.value.trim()));
  const name = text("Name of the new actor", "cast.name", "as its model");
  const add = (event) => {
    const of = model.value.trim();
    if (of === "") return model.focus();
    const called = name.value.trim() || freeName(controls.project.actors, of.split("/").at(-1).replace(/\..*$/, ""));
    controls.edits.addActor(called, of, event);
  };
  return part("Add an actor", cards.root, line("Model", model), line("Name", name),
              element("div", {class: "actions"}, element("button", {"data-key": "cast.add", onclick: add}, "Add")));
}

function freeName(actors, wanted) {
  const names = new Set(actors.map(({name}) => name));
  for (let number = 1;; ++number) {
    const name = number === 1 ? wanted : `${wanted}-${number}`;
    if (!names.has(name)) return name;
  }
}
