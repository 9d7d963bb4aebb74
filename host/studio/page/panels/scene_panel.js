// What is not of one joint. A model: bodies of other proportions, made of the same segments. A film: the selected
// actor's place and turn, and the camera.

import {element, keepingFocus} from "../dom.js";
import {line, numberField, part, vectorField} from "../fields.js";

export class ScenePanel {
  #built = "";
  #fields = [];

  constructor(place, {state, edits}) {
    Object.assign(this, {place, state, edits});
    state.on("project selected", () => this.#update());
    state.on("poses", () => this.#set());
  }

  #update() {
    const {project, selected} = this.state;
    const built = JSON.stringify([project?.kind, selected.actor, project?.bodies, Boolean(project?.camera)]);
    if (built !== this.#built) {
      this.#built = built;
      keepingFocus(this.place, () => this.#build());
    }
    this.#set();
  }

  #set() { for (const field of this.#fields) field(); }

  #build() {
    this.#fields = [];
    this.place.replaceChildren(...(this.state.isFilm() ? this.#film() : this.#bodies()));
  }

  #bodies() {
    const bodies = this.state.project?.bodies ?? [];
    if (bodies.length === 0) return [element("p", {class: "nothing"}, "This model has no other bodies.")];
    const button = ({name, what}) => element("button", {title: what, onclick: (event) => this.edits.commit({body: name}, event)}, name);
    return [part("Bodies", element("p", {class: "hint"}, "The same segments with other proportions."),
                 element("div", {class: "actions"}, bodies.map(button)))];
  }

  #field(made, of) {
    this.#fields.push(() => { const value = of(); if (value) made.set(value); });
    return made.root;
  }

  #gestures(stepOf) {
    return {
      preview: (value, event) => this.edits.preview(stepOf(value), event),
      commit: (value, event) => this.edits.commit(stepOf(value), event),
      cancel: () => this.edits.cancel(),
    };
  }

  #film() {
    const name = this.state.selected.actor;
    const actor = !this.state.actor()?.place
      ? element("p", {class: "nothing"}, name === null ? "Select an actor in the tree." : "This actor moves by matrices.")
      : part(`Actor ${name}`, this.#ofActor("Place", "place", 0.1), this.#ofActor("Turn", "turn", 5));
    return this.state.project.camera ? [actor, this.#camera()] : [actor];
  }

  #ofActor(label, member, step) {
    const actor = this.state.selected.actor;
    return line(label, this.#field(vectorField({
      name: `${label} of the actor`, key: `actor.${member}`, step, ...this.#gestures((value) => ({set: member, actor, [member]: value})),
    }), () => this.state.actor()?.[member]));
  }

  #camera() {
    const now = () => this.state.project.camera;
    const stepOf = (change) => ({set: "camera", eye: now().eye, at: now().at, fov: now().fov, ...change});
    const vector = (label, member) => line(label, this.#field(vectorField({
      name: `Camera, ${label.toLowerCase()}`, key: `camera.${member}`, step: 0.1, ...this.#gestures((value) => stepOf({[member]: value})),
    }), () => now()?.[member]));
    const fov = numberField({name: "Camera, view angle", unit: "°", least: 0.01, most: 179, step: 1, key: "camera.fov", ...this.#gestures((value) => stepOf({fov: value}))});
    return part("Camera", vector("Eye", "eye"), vector("Looks at", "at"), line("View angle", this.#field(fov, () => now()?.fov)));
  }
}
