// Materials: their list, and the one that is chosen. The project says which numbers there are, of which reflection
// models, and their ranges (`keys`: host/content/keys).

import {element, keepingFocus} from "../dom.js";
import {choice, colorField, line, part, sliderField, textField, toggle} from "../fields.js";
import {icon} from "../icons.js";
import {hexOf} from "../numbers.js";
import {materialStep, removeMaterialStep} from "../words.js";

const titled = (name) => name[0].toUpperCase() + name.slice(1);

export class MaterialsPanel {
  #chosen = null;
  #built = "";
  #fields = [];

  constructor(place, {state, edits}) {
    Object.assign(this, {place, state, edits});
    state.on("project", () => this.#update());
    state.on("selected", () => this.#ofJoint());
  }

  get #keys() { return this.state.project.keys.material; }
  get #material() { return this.state.project.materials.find(({name}) => name === this.#chosen); }

  #ofJoint() {
    const material = this.state.joint()?.material;
    if (material) this.#choose(material);
  }

  #choose(name) {
    this.#chosen = name;
    this.#update();
  }

  #update() {
    const {materials} = this.state.project;
    if (!this.#material) this.#chosen = materials[0]?.name ?? null;
    const built = JSON.stringify([this.#chosen, this.#material?.reflection, materials.map(({name, color}) => [name, color])]);
    if (built !== this.#built) {
      this.#built = built;
      keepingFocus(this.place, () => this.#build(materials));
    }
    for (const field of this.#fields) field();
  }

  #build(materials) {
    this.#fields = [];
    const list = element("div", {class: "swatches", role: "listbox", "aria-label": "Materials"}, materials.map((each) => this.#swatch(each)));
    list.addEventListener("keydown", (event) => this.#key(event, materials));
    const add = element("button", {onclick: (event) => this.#add(event)}, icon("add"), "Add");
    const remove = element("button", {disabled: !this.#material, onclick: (event) => this.edits.commit(removeMaterialStep(this.#chosen), event)},
                           icon("remove"), "Remove");
    this.place.replaceChildren(list, element("div", {class: "actions"}, add, remove), ...(this.#material ? this.#editor() : []));
  }

  #swatch({name, color}) {
    const dot = element("span", {class: "dot"});
    dot.style.background = hexOf(color ?? this.#keys.color.default);
    return element("button", {role: "option", "aria-selected": String(name === this.#chosen), tabindex: name === this.#chosen ? 0 : -1,
                              "data-key": `swatch ${name}`, onclick: () => this.#choose(name)}, dot, element("span", {}, name));
  }

  #key(event, materials) {
    const by = {ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1}[event.key];
    if (by === undefined) return;
    event.preventDefault();
    const next = materials[materials.findIndex(({name}) => name === this.#chosen) + by];
    if (!next) return;
    this.#choose(next.name);
    this.place.querySelector('[aria-selected="true"]').focus();
  }

  #add(event) {
    const names = this.state.project.materials.map(({name}) => name);
    let number = 1;
    while (names.includes(`material-${number}`)) ++number;
    this.#chosen = `material-${number}`;
    this.edits.commit(materialStep("add", this.#chosen, {color: this.#keys.color.default}), event);
  }

  #changes(changeOf) {
    const step = (value) => materialStep("set", this.#chosen, changeOf(value));
    return {
      preview: (value, event) => this.edits.preview(step(value), event),
      commit: (value, event) => this.edits.commit(step(value), event),
      cancel: () => this.edits.cancel(),
    };
  }

  #field(made, of) {
    this.#fields.push(() => { if (this.#material) made.set(of(this.#material)); });
    return made.root;
  }

  #editor() {
    const reflection = this.#material.reflection ?? this.#keys.reflection.default;
    const pick = (text, key) => line(text, this.#field(
      choice({name: text, key: `material.${key}`, options: this.#keys[key].choices.map((each) => [each, titled(each)]),
              ...this.#changes((value) => ({[key]: value}))}), (now) => now[key] ?? this.#keys[key].default));
    const numbers = Object.entries(this.#keys).filter(([, {of}]) => of?.includes(reflection)).map(([key, {slider: [from, to], least, most, default: usual, meaning}]) =>
      line(titled(key), this.#field(
        sliderField({name: key, title: meaning, key: `material.${key}`, least: from, most: to, bounds: [least, most], step: to > 100 ? 1 : 0.05, digits: 3, ...this.#changes((value) => ({[key]: value}))}),
        (now) => now[key] ?? usual)));
    const name = textField({name: "Name of the material", key: "material.name", commit: (to, event) => {
      const step = materialStep("set", this.#chosen, {name: to});
      this.#chosen = to;
      this.edits.commit(step, event);
    }});
    const sides = choice({name: "Sides", key: "material.sides", options: [["2", "Both"], ["1", "Outside only"]],
                          ...this.#changes((value) => ({sides: Number(value)}))});
    const flags = Object.entries(this.#keys).filter(([, {type}]) => type === "flag").map(([key, {meaning, default: usual}]) => {
      const shown = line(titled(key), this.#field(
        toggle({name: titled(key), text: "", key: `material.${key}`, ...this.#changes((value) => ({[key]: value}))}), (now) => now[key] ?? usual));
      shown.title = titled(meaning.replaceAll("`", ""));
      return shown;
    });
    return [
      part("Material", line("Name", this.#field(name, (now) => now.name)),
           line("Colour", this.#field(colorField({name: "Colour", key: "material.color", ...this.#changes((color) => ({color}))}), (now) => now.color ?? this.#keys.color.default))),
      part("Reflection", pick("Model", "reflection"), numbers),
      part("Surface", pick("Shading", "interpolation"), line("Sides", this.#field(sides, (now) => String(now.sides ?? this.#keys.sides.default))), flags),
    ];
  }
}
