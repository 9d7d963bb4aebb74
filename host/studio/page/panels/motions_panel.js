// Motions: what an actor can do, with its parameters; the studio makes the keys, `mars animate FILM ACTION ...` does the
// same. Values that are left empty are the action's own.

import {element} from "../dom.js";
import {choice, line, part, toggle} from "../fields.js";

const kGroups = [["figure", "Figures"], ["kinematic", "Things"], ["camera", "Camera"]];
const kChoices = {SIDE: ["left", "right"], AXIS: ["x", "y", "z"], EASE: ["linear", "in", "out", "both"]};

const titled = (name) => name[0].toUpperCase() + name.slice(1).replaceAll("-", " ");
const purposeOf = ({purpose, needs}) => needs ? `${purpose}. Limbs: ${needs}.` : `${purpose}.`;

export class MotionsPanel {
  #actions = [];
  #action = null;
  #fields = [];         // {name, values(): words, or none}
  #previews = false;
  #lengthens = true;

  constructor(place, {connection, state, edits}) {
    Object.assign(this, {place, connection, state, edits});
    connection.on("actions", ({actions}) => {
      this.#actions = actions;
      this.#build();
    });
    connection.on("gone", () => { this.asked = false; });
    state.on("project", () => this.#ask());
    state.on("selected", () => this.#who());
    state.on("frame", () => { if (this.#previews && this.start.value === "frame") this.#preview(); });
    this.#build();
  }

  #ask() {
    if (this.asked || !this.state.isFilm()) return this.#who();
    this.asked = this.connection.send({do: "actions"});
  }

  // The studio's word on a preview of this panel; whether it was one.
  refused({do: what, text}) {
    if (what !== "preview" || !this.#previews) return false;
    this.#say(text);
    return true;
  }

  #build() {
    this.who = element("p", {class: "motion-who"});
    this.form = element("div", {});
    this.place.replaceChildren(this.who, ...kGroups.map(([group, title]) => this.#group(group, title)).filter(Boolean), this.form);
    this.#show();
  }

  #group(group, title) {
    const buttons = this.#actions.filter((action) => action.group === group).map((action) => this.#button(action));
    return buttons.length > 0 && part(title, element("div", {class: "motions", role: "group", "aria-label": title}, buttons));
  }

  #button(action) {
    return element("button", {title: purposeOf(action), "data-key": `motion.${action.name}`, "data-motion": action.name, "aria-pressed": "false",
                              onclick: () => this.#choose(action)}, titled(action.name));
  }

  #choose(action) {
    this.#stop();
    this.#action = action;
    this.#show();
  }

  #who() {
    const {actor} = this.state.selected;
    this.who.replaceChildren(...(actor === null ? ["Select an actor in the tree."] : ["Who: ", element("strong", {}, actor)]));
    if (this.applyButton) this.applyButton.disabled = this.previewButton.disabled = this.#subject() === null;
    if (this.#previews) this.#preview();
  }

  #subject() { return this.#action?.group === "camera" ? "camera" : this.state.selected.actor; }

  #show() {
    const action = this.#action;
    for (const button of this.place.querySelectorAll("[data-motion]"))
      button.setAttribute("aria-pressed", String(button.dataset.motion === action?.name));
    if (!action) return this.form.replaceChildren();
    this.#fields = action.parameters.map((parameter) => this.#field(parameter));
    const starts = [["last", "At its last key"], ["frame", "At the frame that shows"]];
    const start = choice({name: "Begins", options: starts, key: "motion.start", commit: () => this.#changed()});
    this.start = start.root.querySelector("select");
    const lengthen = toggle({name: "Lengthen the film", text: "May lengthen the film", key: "motion.lengthen",
                             commit: (on) => { this.#lengthens = on; this.#changed(); }});
    lengthen.set(this.#lengthens);
    this.problem = element("p", {class: "motion-problem", role: "status"});
    this.previewButton = element("button", {"aria-pressed": "false", "data-key": "motion.preview",
                                            onclick: (event) => this.#flip(event)}, "Preview");
    this.applyButton = element("button", {class: "primary", "data-key": "motion.apply", onclick: (event) => this.#apply(event)}, "Apply");
    // Always in sight, however many fields there are.
    const end = element("div", {class: "motion-end"}, lengthen.root, this.problem, element("div", {class: "actions"}, this.previewButton, this.applyButton));
    const begins = line("Begins", start.root);
    const body = part(titled(action.name), element("p", {class: "hint"}, purposeOf(action)), begins, this.#fields.map(({root}) => root), end);
    body.classList.add("motion-form");
    this.form.replaceChildren(body);
    // Where a page is so small that no field shows under the motions, the form takes its place.
    const hidden = begins.getBoundingClientRect().bottom > this.place.getBoundingClientRect().bottom - end.offsetHeight;
    if (hidden) body.scrollIntoView({block: "start"});
    this.#who();
  }

  #field(parameter) {
    return kChoices[parameter.value] ? this.#oneOf(parameter, kChoices[parameter.value]) : this.#numbers(parameter);
  }

  #oneOf({name, meaning}, choices) {
    const options = [[null, "\u2013"], ...choices.map((each) => [each, each])];
    const made = choice({name: titled(name), options, key: `motion.${name}`, commit: () => this.#changed()});
    made.root.title = meaning;
    const select = made.root.querySelector("select");
    return {name, root: line(titled(name), made.root), values: () => select.value === "" ? [] : [select.value]};
  }

  #numbers({name, value, meaning, example, count}) {
    const otherwise = /default: ([-\d.]+)/.exec(meaning)?.[1], letters = value.split(" "), examples = example.split(" ");
    const inputs = Array.from({length: count}, (_, i) => element("input", {
      type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", title: meaning, "data-key": `motion.${name}${i || ""}`,
      "aria-label": count > 1 ? `${titled(name)} ${letters[i]}` : titled(name), placeholder: otherwise ?? `e.g. ${examples[i]}`,
      oninput: () => this.#changed(),
    }));
    const values = () => inputs.map((input) => input.value.trim().replace(",", "."));
    return {name, root: line(titled(name), element("div", {class: "several"}, inputs)), values: () => values().includes("") ? [] : values()};
  }

  #commands() {
    const at = this.start.value === "frame" ? ["--at", `${this.state.project.frame}`] : [];
    const given = this.#fields.flatMap(({name, values}) => values().length ? [`--${name}`, ...values()] : []);
    return [["animate", this.#action.name, this.#subject(), ...given, ...at, ...(this.#lengthens ? ["--lengthen"] : [])]];
  }

  #changed() {
    this.#say("");
    if (this.#previews) this.#preview();
  }

  #flip(event) {
    if (this.#previews) return this.#stop();
    this.#previews = true;
    this.previewButton.setAttribute("aria-pressed", "true");
    this.#preview(event);
  }

  #preview(event) {
    if (this.#subject() === null) return;
    this.#say("");
    this.edits.preview({commands: this.#commands()}, event);
  }

  #stop() {
    if (!this.#previews) return;
    this.#previews = false;
    this.previewButton.setAttribute("aria-pressed", "false");
    this.edits.cancel();
  }

  #apply(event) {
    this.#previews = false;
    this.previewButton.setAttribute("aria-pressed", "false");
    this.#say("");
    this.edits.commit({commands: this.#commands()}, event);
  }

  #say(text) { if (this.problem) this.problem.textContent = text; }
}
