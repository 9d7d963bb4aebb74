// Motions: what an actor can do, with its parameters; the studio makes the keys, `mars animate FILM ACTION ...` does the
// same. Values that are left empty are the action's own.

import {element} from "../dom.js";
import {choice, line, part, toggle} from "../fields.js";
import {read, written} from "../numbers.js";

const kGroups = [["figure", "Figures"], ["kinematic", "Things"], ["camera", "Camera"]];
const kChoices = {SIDE: ["left", "right"], AXIS: ["x", "y", "z"], EASE: ["linear", "in", "out", "both"]};

const titled = (name) => name[0].toUpperCase() + name.slice(1).replaceAll("-", " ");

// What the letters of a parameter's value count, where its meaning does not say it.
const kUnits = {S: "seconds", DEGREES: "degrees", D: "units of length", H: "units of length", Z: "units of length",
                "X Y": "units of length", "X Y Z": "units of length"};

const kEnds = new Set(["commit", "drag", "undo", "redo", "cancel"]);  // messages after which the studio shows no preview

// These units show in the field.
const kShortUnits = {S: "s", DEGREES: "\u00b0", D: "units", H: "units", Z: "units"};

// The default of a number that is left out, if it is an amount: "2", "0.62 of the leg".
const amountIn = (meaning) => /default: (-?\d[^;,]*)/.exec(meaning)?.[1];

function titleOf({value, meaning}) {
  const unit = /units|degrees|seconds/.test(meaning) ? undefined : kUnits[value];
  return `${meaning[0].toUpperCase()}${meaning.slice(1)}.${unit ? ` In ${unit}.` : ""}`;
}

const purposeOf = ({purpose, needs}) => needs ? `${purpose}. Limbs: ${needs}.` : `${purpose}.`;

export class MotionsPanel {
  #actions = [];
  #action = null;
  #fields = [];         // {name, values(): words, or none, lacks(): what must be given, or ""}
  #typed = new Map();   // name of an action -> {key of a field: what was typed}
  #previews = false;
  #previewed = null;    // the step that the studio shows
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
    connection.on("sent", (message) => this.#sent(message));
    this.#build();
  }

  #ask() {
    if (this.asked || !this.state.isFilm()) return this.#who();
    this.asked = this.connection.send({do: "actions"});
  }

  // A change of the frame ends a preview in the studio: it is shown again.
  #sent({do: what, step}) {
    if (!this.#previews) return;
    if (what === "frame" && this.#previewed) this.edits.previewAgain(this.#previewed);
    else if (what === "preview" ? step !== this.#previewed : kEnds.has(what)) this.#over();
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
    const start = choice({name: "Begins", options: starts, key: "motion.start", commit: () => this.#begins()});
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
    const typed = this.#typed.get(action.name) ?? {};
    for (const field of this.#typedIn()) field.value = typed[field.dataset.key] ?? field.value;
    // Where a page is so small that no field shows under the motions, the form takes its place.
    const hidden = begins.getBoundingClientRect().bottom > this.place.getBoundingClientRect().bottom - end.offsetHeight;
    if (hidden) body.scrollIntoView({block: "start"});
    this.#who();
  }

  #field(parameter) {
    return kChoices[parameter.value] ? this.#oneOf(parameter, kChoices[parameter.value]) : this.#numbers(parameter);
  }

  // What keeps its value from one time that the action is chosen to the next.
  #typedIn() { return this.form.querySelectorAll("input[type=text], select"); }

  #oneOf(parameter, choices) {
    const {name} = parameter, title = titleOf(parameter);
    const options = [[null, "\u2013"], ...choices.map((each) => [each, each])];
    const made = choice({name: titled(name), options, key: `motion.${name}`, commit: () => this.#changed()});
    const select = made.root.querySelector("select");
    select.title = title;
    return {name, root: explained(title, line(titled(name), made.root)), values: () => select.value === "" ? [] : [select.value], lacks: () => ""};
  }

  #numbers(parameter) {
    const {name, value, meaning, example, count} = parameter, title = titleOf(parameter);
    const letters = value.split(" "), examples = example.split(" "), isNumber = examples.every((each) => read(each) !== null);
    const inputs = Array.from({length: count}, (_, i) => element("input", {
      type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", title, "data-key": `motion.${name}${i || ""}`,
      "aria-label": count > 1 ? `${titled(name)} ${letters[i]}` : titled(name), placeholder: amountIn(meaning) ?? `e.g. ${examples[i]}`,
      oninput: () => this.#changed(),
    }));
    const texts = () => inputs.map((input) => input.value.trim()).filter((text) => text !== "");
    const isWrong = () => isNumber && texts().some((text) => read(text) === null);
    const unit = kShortUnits[value] && element("span", {class: "unit", "aria-hidden": "true"}, kShortUnits[value]);
    return {name, root: explained(title, line(titled(name), element("div", {class: isNumber && count === 1 ? "number" : "several"}, inputs, unit))),
            values: () => texts().length < count ? [] : texts().map((text) => isNumber ? written(read(text), 6) : text),
            lacks: () => isWrong() ? `${titled(name)}: write a number, or an expression such as 1.5*2`
              : texts().length % count === 0 ? "" : `${titled(name)}: give ${listed(letters)}`};
  }

  #lacks() { return this.#fields.map(({lacks}) => lacks()).find((text) => text !== "") ?? ""; }

  #commands() {
    const at = this.start.value === "frame" ? ["--at", `${this.#previews ? this.at : this.state.project.frame}`] : [];
    const given = this.#fields.flatMap(({name, values}) => values().length ? [`--${name}`, ...values()] : []);
    return [["animate", this.#action.name, this.#subject(), ...given, ...at, ...(this.#lengthens ? ["--lengthen"] : [])]];
  }

  // A preview begins at the same frame while others are looked at.
  #begins() {
    this.at = this.state.project.frame;
    this.#changed();
  }

  #changed() {
    this.#typed.set(this.#action.name, Object.fromEntries([...this.#typedIn()].map(({dataset, value}) => [dataset.key, value])));
    this.#say("");
    if (this.#previews) this.#preview();
  }

  #flip(event) {
    if (this.#previews) return this.#stop();
    this.#previews = true;
    this.at = this.state.project.frame;
    this.previewButton.setAttribute("aria-pressed", "true");
    this.#preview(event);
  }

  #preview(event) {
    if (this.#subject() === null) return;
    const lacks = this.#lacks();
    if (lacks !== "") return this.#say(lacks);
    this.#say("Preview is on: play or scrub to see it.", "hint");
    this.#previewed = {commands: this.#commands()};
    this.edits.preview(this.#previewed, event);
  }

  #stop() {
    if (!this.#previews) return;
    this.#over();
    this.edits.cancel();
  }

  #over() {
    this.#previews = false;
    this.#previewed = null;
    this.previewButton.setAttribute("aria-pressed", "false");
    this.#say("");
  }

  #apply(event) {
    const lacks = this.#lacks();
    if (lacks !== "") return this.#say(lacks);
    const step = {commands: this.#commands()};
    this.#over();
    this.edits.commit(step, event);
  }

  #say(text, look = "problem") {
    if (!this.problem) return;
    this.problem.className = `motion-${look}`;
    this.problem.textContent = text;
  }
}

// A line whose label has this title, too.
function explained(title, root) {
  root.title = title;
  return root;
}

// "x, y and z".
function listed(letters) {
  const names = letters.map((letter) => letter.toLowerCase());
  return `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;
}
