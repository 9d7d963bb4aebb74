// A film's scene in the panel: the film's settings, its actors, camera, lights and materials. Each change is a command of
// `mars film` or `mars animate`. A part is built when its things change, and set when their values do.

import {element} from "../dom.js";
import {choice, colorField, line, numberField, part, textField, vectorField} from "../fields.js";
import {written} from "../numbers.js";

const kLights = {directional: ["Sun", ["direction=1,-1,2"]], point: ["Bulb", ["place=0,-3,4"]], spot: ["Spot", ["place=0,-4,5", "at=0,0,1"]]};
const comma = (numbers) => numbers.map((number) => written(number, 4)).join(",");

export class FilmScene {
  #fields = [];

  constructor({state, edits}) { Object.assign(this, {state, edits}); }

  // What decides which controls there are.
  shape() {
    const {project, selected} = this.state;
    return [selected.actor, selected.thing, Boolean(project.camera), project.actors.map(({name}) => name), project.library,
            (project.lights ?? []).map(({thing, kind}) => [thing, kind]), (project.materials ?? []).map(({name}) => name)];
  }

  parts() {
    this.#fields = [];
    const {actor, thing} = this.state.selected;
    const lights = this.#lights(thing), lit = thing?.startsWith("light/");  // what is selected comes first
    return [actor !== null && this.#actor(actor), lit && lights, this.#camera(), !lit && lights, this.#cast(), this.#materials(),
            this.#settings()].filter(Boolean);
  }

  set() { for (const field of this.#fields) field(); }

  #do(...words) { return (event) => this.edits.commit({commands: [words]}, event); }
  #frame() { return ["--frame", `${this.state.project.frame}`]; }

  #field(made, of) {
    this.#fields.push(() => { const value = of(); if (value !== undefined && value !== null) made.set(value); });
    return made.root;
  }

  // A step for each value, or a list of words.
  #gestures(stepOf) {
    const step = (value) => { const made = stepOf(value); return Array.isArray(made) ? {commands: [made]} : made; };
    return {
      preview: (value, event) => this.edits.preview(step(value), event),
      commit: (value, event) => this.edits.commit(step(value), event),
      cancel: () => this.edits.cancel(),
    };
  }

  #posed(thing, text) { return ["animate", "pose", thing, text, ...this.#frame()]; }

  // ---- actors

  #actor(name) {
    if (!this.state.actor()?.place) return element("p", {class: "nothing"}, "This actor moves by matrices.");
    const rename = textField({name: "Name of the actor", key: "actor.name", commit: (to, event) => this.#do("film", "rename", name, to)(event)});
    rename.set(name);
    const remove = element("button", {"data-key": "actor.remove", onclick: this.#do("film", "remove", name)}, "Remove");
    return part(`Actor ${name}`, line("Name", rename.root), this.#ofActor("Place", "place", 0.1), this.#ofActor("Turn", "turn", 5),
                this.#attach(name), element("div", {class: "actions"}, remove));
  }

  #ofActor(label, member, step) {
    const {actor} = this.state.selected;
    return line(label, this.#field(vectorField({
      name: `${label} of the actor`, key: `actor.${member}`, step, ...this.#gestures((value) => ({set: member, actor, [member]: value})),
    }), () => this.state.actor()?.[member]));
  }

  #targets(without) {
    return this.state.project.actors.filter(({name}) => name !== without)
      .flatMap(({name, joints}) => [[name, name], ...joints.map((joint) => [`${name}/${joint.name}`, `${name} \u203a ${joint.name}`])]);
  }

  #attach(name) {
    const to = choice({name: "Carried by", options: [[null, "Nobody: let go"], ...this.#targets(name)], key: "actor.attach", commit: (target, event) =>
      this.#do("animate", target === null ? "detach" : "attach", name, ...(target === null ? [] : ["--to", target]), ...this.#frame())(event)});
    this.#fields.push(() => {
      const {attach} = this.state.actor(name) ?? {};
      to.set(attach ? [attach.actor, attach.joint].filter(Boolean).join("/") : null);
    });
    return line("Carried by", to.root);
  }

  #cast() {
    const list = this.state.project.library ?? [];
    const options = element("datalist", {id: "library"}, list.map((each) => element("option", {value: each.name ?? each}, each.what ?? "")));
    const model = element("input", {type: "text", list: "library", "aria-label": "Model", "data-key": "cast.model", placeholder: "man, ball, FILE.json", autocomplete: "off"});
    const name = element("input", {type: "text", "aria-label": "Name of the new actor", "data-key": "cast.name", placeholder: "as the model", autocomplete: "off"});
    const add = (event) => {
      const of = model.value.trim();
      if (of === "") return model.focus();
      const called = name.value.trim() || this.#freeName(of.split("/").at(-1).replace(/\..*$/, ""));
      this.#do("film", "add", called, "--model", of)(event);
    };
    return part("Add an actor", line("Model", model, options), line("Name", name),
                element("div", {class: "actions"}, element("button", {"data-key": "cast.add", onclick: add}, "Add")));
  }

  #freeName(wanted) {
    const names = new Set(this.state.project.actors.map(({name}) => name));
    for (let number = 1;; ++number) {
      const name = number === 1 ? wanted : `${wanted}-${number}`;
      if (!names.has(name)) return name;
    }
  }

  // ---- camera

  #camera() {
    if (!this.state.project.camera) return null;
    const now = () => this.state.project.camera;
    const stepOf = (change) => ({set: "camera", eye: now().eye, at: now().at, fov: now().fov, ...change});
    const vector = (label, member) => line(label, this.#field(vectorField({
      name: `Camera, ${label.toLowerCase()}`, key: `camera.${member}`, step: 0.1, ...this.#gestures((value) => stepOf({[member]: value})),
    }), () => now()?.[member]));
    const fov = numberField({name: "Camera, view angle", unit: "°", least: 0.01, most: 179, step: 1, key: "camera.fov", ...this.#gestures((value) => stepOf({fov: value}))});
    return part("Camera", vector("Eye", "eye"), vector("Looks at", "at"), line("View angle", this.#field(fov, () => now()?.fov)),
                this.#bound("Look at", "look"), this.#bound("Go along", "follow"));
  }

  #bound(label, word) {
    const made = choice({name: `Camera: ${label.toLowerCase()} an actor`, options: [["", "Choose an actor\u2026"], ["--end", "Nobody from here on"], ...this.#targets(null)],
                         key: `camera.${word}`, commit: (target, event) => {
                           if (target !== null) this.#do("animate", word, target, ...this.#frame())(event);
                           made.set("");
                         }});
    return line(label, made.root);
  }

  // ---- lights

  #lights(selected) {
    const lights = this.state.project.lights ?? [];
    const button = ({thing, kind}) => element("button", {"aria-pressed": String(thing === selected), "data-key": `light.${thing}`,
                                                         onclick: () => this.edits.selectThing(thing)}, `${thing.split("/")[1]} ${kLights[kind]?.[0] ?? kind}`);
    const add = ([name, words]) => element("button", {title: "Add this light", "data-key": `light.add.${name}`, onclick: this.#do("film", "light", "add", ...words)}, `+ ${name}`);
    const light = lights.find(({thing}) => thing === selected);
    return part("Lights", lights.length ? element("div", {class: "actions three"}, lights.map(button)) : element("p", {class: "hint"}, "The film has none of its own: three are shown."),
                light && this.#light(light), element("div", {class: "actions three"}, Object.values(kLights).map(add)));
  }

  #light({thing, kind}) {
    const now = () => this.state.project.lights?.find((light) => light.thing === thing);
    const vector = (label, member) => line(label, this.#field(vectorField({
      name: `Light, ${label.toLowerCase()}`, key: `light.${member}`, step: 0.1, ...this.#gestures((value) => this.#posed(thing, `${member}=${comma(value)}`)),
    }), () => now()?.[member]));
    const intensity = numberField({name: "Light, intensity", least: 0, step: 0.1, key: "light.intensity", ...this.#gestures((value) => this.#posed(thing, `intensity=${value}`))});
    const color = colorField({name: "Light, colour", key: "light.color", ...this.#gestures((value) => this.#posed(thing, `color=${comma(value)}`))});
    return [kind === "directional" ? vector("Direction", "direction") : vector("Place", "place"), kind === "spot" && vector("Aims at", "at"),
            line("Intensity", this.#field(intensity, () => now()?.intensity)), line("Colour", this.#field(color, () => now()?.color)),
            element("div", {class: "actions"}, element("button", {"data-key": "light.key", onclick: (event) => this.#do("animate", "key", thing, ...this.#frame())(event)}, "Insert key"),
                    element("button", {"data-key": "light.remove", onclick: this.#do("film", "light", "remove", thing.split("/")[1])}, "Remove"))];
  }

  // ---- materials and the film

  #materials() {
    const materials = this.state.project.materials ?? [];
    if (materials.length === 0) return null;
    return part("Materials", element("p", {class: "hint"}, "A colour is keyed at the frame."), materials.map(({name}) => {
      const color = colorField({name: `Colour of ${name}`, key: `material.${name}`, ...this.#gestures((value) => this.#posed(`material/${name}`, `color=${comma(value)}`))});
      return line(name, this.#field(color, () => this.state.project.materials.find((each) => each.name === name)?.color));
    }));
  }

  #settings() {
    const {project} = this.state, set = (text) => this.#gestures(text).commit;
    const number = (label, key, of) => line(label, this.#field(numberField({name: label, key: `film.${key}`, step: 1, least: 1, digits: 0, commit: set((value) => ["film", "set", `${key}=${value}`])}), of));
    const side = (name, at) => this.#field(numberField({name, key: `film.size${at}`, least: 16, step: 10, digits: 0, commit: set((value) =>
      ["film", "set", `size=${this.state.project.size.map((each, i) => i === at ? value : each).join(",")}`])}), () => this.state.project.size[at]);
    const background = project.background && line("Background", this.#field(colorField({name: "Background", key: "film.background", commit: set((value) =>
      ["film", "set", `background=${comma(value)}`])}), () => this.state.project.background));
    return part("Film", number("Frames", "frames", () => this.state.project.frames), number("Rate", "rate", () => this.state.project.rate),
                line("Size", element("div", {class: "several"}, side("Width", 0), side("Height", 1))), background);
  }
}
