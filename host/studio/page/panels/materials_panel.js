// Materials: their list, and the one that is chosen. A reflection model says which numbers there are.

import {element, keepingFocus} from "../dom.js";
import {choice, colorField, line, part, sliderField, textField} from "../fields.js";
import {icon} from "../icons.js";
import {hexOf} from "../numbers.js";

const kHighlights = ["phong", "blinn-phong"];
const kNumbers = [  // as film-format.md has them; `most`: of the slider
  {key: "ambient", otherwise: 0.1, least: 0, most: 2, of: [...kHighlights, "cook-torrance", "metallic-roughness"]},
  {key: "diffuse", otherwise: 0.65, least: 0, most: 2, of: [...kHighlights, "cook-torrance"]},
  {key: "specular", otherwise: 0.45, least: 0, most: 4, of: [...kHighlights, "cook-torrance"]},
  {key: "exponent", otherwise: 32, least: 0, most: 400, step: 1, of: kHighlights},
  {key: "roughness", otherwise: 0.5, least: 0, most: 1, of: ["cook-torrance", "metallic-roughness"]},
  {key: "metallic", otherwise: 0, least: 0, most: 1, of: ["metallic-roughness"]},
  {key: "refraction", otherwise: 1.5, least: 1.01, most: 4, of: ["cook-torrance"]},
];
const kReflections = [["phong", "Phong"], ["blinn-phong", "Blinn-Phong"], ["cook-torrance", "Cook-Torrance"],
                      ["metallic-roughness", "Metallic, roughness"]];
const kInterpolations = [["phong", "Phong"], ["gouraud", "Gouraud"], ["flat", "Flat"]];
const kGrey = [0.8, 0.8, 0.8];

export class MaterialsPanel {
  #chosen = null;
  #built = "";
  #fields = [];

  constructor(place, {state, edits}) {
    Object.assign(this, {place, state, edits});
    state.on("project", () => this.#update());
    state.on("selected", () => this.#ofJoint());
  }

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
    const remove = element("button", {disabled: !this.#material, onclick: (event) => this.edits.commit({remove: "material", material: this.#chosen}, event)},
                           icon("remove"), "Remove");
    this.place.replaceChildren(list, element("div", {class: "actions"}, add, remove), ...(this.#material ? this.#editor() : []));
  }

  #swatch({name, color}) {
    const dot = element("span", {class: "dot"});
    dot.style.background = hexOf(color ?? kGrey);
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
    this.edits.commit({add: "material", material: this.#chosen, change: {color: kGrey}}, event);
  }

  #changes(changeOf) {
    const step = (value) => ({set: "material", material: this.#chosen, change: changeOf(value)});
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
    const reflection = this.#material.reflection ?? "phong";
    const pick = (text, key, options, otherwise) => line(text, this.#field(
      choice({name: text, key: `material.${key}`, options, ...this.#changes((value) => ({[key]: value}))}), (now) => now[key] ?? otherwise));
    const numbers = kNumbers.filter(({of}) => of.includes(reflection)).map(({key, otherwise, least, most, step = 0.05}) =>
      line(key[0].toUpperCase() + key.slice(1), this.#field(
        sliderField({name: key, key: `material.${key}`, least, most, step, digits: 3, ...this.#changes((value) => ({[key]: value}))}),
        (now) => now[key] ?? otherwise)));
    const name = textField({name: "Name of the material", key: "material.name", commit: (to, event) => {
      const step = {set: "material", material: this.#chosen, change: {name: to}};
      this.#chosen = to;
      this.edits.commit(step, event);
    }});
    const sides = choice({name: "Sides", key: "material.sides", options: [["2", "Both"], ["1", "Outside only"]],
                          ...this.#changes((value) => ({sides: Number(value)}))});
    return [
      part("Material", line("Name", this.#field(name, (now) => now.name)),
           line("Colour", this.#field(colorField({name: "Colour", key: "material.color", ...this.#changes((color) => ({color}))}), (now) => now.color ?? kGrey))),
      part("Reflection", pick("Model", "reflection", kReflections, "phong"), numbers),
      part("Surface", pick("Shading", "interpolation", kInterpolations, "phong"), line("Sides", this.#field(sides, (now) => String(now.sides ?? 2)))),
    ];
  }
}
