// The header: what is open, history, the tool, scene or rendering, theme, help.

import {element} from "./dom.js";
import {icon, logo} from "./icons.js";
import {addMenu} from "./menu.js";
import {keysOf} from "./shortcuts.js";
import {kRingAxes} from "./state.js";

export const kTools = [["none", "Select", "toolNone"], ["turn", "Turn", "toolTurn"], ["move", "Move", "toolMove"],
                       ["box", "Box", "toolBox"], ["points", "Control points", "toolPoints"], ["reach", "Reach", "toolReach"]];
const kToolsOfModels = ["box", "points"], kToolsOfFilms = ["reach"];
const kFalloffs = [0, 4, 8, 16, 32];  // frames
const kWorkspaces = [["scene", "Scene", "scene"], ["rendering", "Rendering", "render"]];

export class Header {
  constructor(place, {state, edits}, {help, theme, ghosts, importFiles}) {
    this.state = state;
    this.file = element("span", {class: "file"});
    this.kind = element("span", {class: "kind"});
    this.undo = iconButton("undo", () => edits.undo());
    this.redo = iconButton("redo", () => edits.redo());
    this.imports = iconButton("import", importFiles);
    this.imports.setAttribute("aria-label", "Import files");
    this.imports.title = "Import figures, objects and motions of other programs. You can also drop their files on the page";
    this.imports.dataset.key = "import";
    this.tools = segmented("Tool", kTools.map(([tool, text, command]) => ({value: tool, text, tip: `${text} (${keysOf(command)})`, glyph: tool})),
                           (tool) => state.set("tool", tool), false);
    this.axes = iconButton("axes");
    name(this.axes, "Rings turn about", keysOf("nextAxes"));
    this.axes.dataset.key = "axes";
    addMenu(this.axes, () => this.#axes());
    this.rings = element("div", {class: "group"}, this.axes);
    this.workspaces = segmented("Workspace", kWorkspaces.map(([value, text, glyph]) => ({value, text, glyph, tip: `${text} (${keysOf("workspace")})`})),
                                (value) => state.set("workspace", value), true);
    this.theme = iconButton(null, theme);
    this.marks = iconButton("marks", () => state.set("marks", !state.marks));
    this.ghosts = iconButton("ghosts");
    addMenu(this.ghosts, ghosts);
    this.pin = iconButton("pin", () => edits.pin());
    this.blend = element("button", {class: "quiet"});
    addMenu(this.blend, () => this.#blends());
    this.film = element("div", {class: "group", hidden: true}, this.ghosts, this.marks, this.pin, this.blend);
    name(this.ghosts, "Ghosts", keysOf("ghosts"));
    name(this.marks, "Marks of camera and lights", keysOf("marks"));
    name(this.pin, "Pin the selected joint", keysOf("pin"));
    const sheet = iconButton("help", help);
    name(sheet, "Keys and mouse", keysOf("help"));
    place.append(element("div", {class: "brand"}, logo(), element("h1", {}, this.file), this.kind),
                 element("div", {class: "group"}, this.undo, this.redo, this.imports), this.tools.root, this.rings, this.film, element("span", {class: "spring"}),
                 this.workspaces.root, element("span", {class: "spring"}), element("div", {class: "group"}, this.theme, sheet));
    state.on("project", () => this.#project());
    state.on("tool", () => this.tools.set(state.tool));
    state.on("workspace", () => this.#workspace());
    state.on("ghosts marks falloff pins selected project", () => this.#shown());
    state.on("axes", () => this.#turning());
    this.tools.set(state.tool);
    this.#turning();
    this.#workspace();
    this.#history({});
  }

  #axes() {
    const one = ([value, text]) => ({text, chosen: this.state.axes === value, act: () => this.state.set("axes", value)});
    return [{heading: "Rings turn about"}, ...kRingAxes.map(one)];
  }

  #turning() { this.axes.setAttribute("aria-pressed", String(this.state.axes !== "numbers")); }

  #blends() {
    const one = (frames) => ({text: frames === 0 ? "This frame alone" : `${frames} frames to both sides`, chosen: this.state.falloff === frames,
                              act: () => this.state.set("falloff", frames)});
    return [{heading: "A pose changes"}, ...kFalloffs.map(one)];
  }

  // Loud while it is on: then each pose changes frames that do not show.
  #showBlend(falloff) {
    const on = falloff > 0;
    this.blend.replaceChildren(icon("blend"), ...(on ? [`Blend \u00b1${falloff} frames`] : []));
    this.blend.classList.toggle("icon", !on);
    this.blend.classList.toggle("loud", on);
    this.blend.setAttribute("aria-pressed", String(on));
    this.blend.setAttribute("aria-label", on ? `Blend is on: poses also change ${falloff} frames to both sides` : "Blend poses into the frames around");
    this.blend.title = on ? "Each pose also changes the frames around, up to the next cut. The menu turns it off"
      : "Blend poses into the frames around: where keys are dense, one alone would pop";
  }

  #project() {
    const {file, kind} = this.state.project;
    this.file.textContent = file.split("/").at(-1);
    this.file.title = file;
    this.kind.textContent = kind;
    document.title = `${this.file.textContent} \u2013 MARS studio`;
    this.#history(this.state.project);
  }

  #history({undo, redo}) {
    this.undo.disabled = !undo;
    this.redo.disabled = !redo;
    name(this.undo, undo ? `Undo: ${undo}` : "Nothing to undo", keysOf("undo"));
    name(this.redo, redo ? `Redo: ${redo}` : "Nothing to redo", keysOf("redo"));
  }

  #shown() {
    const {ghosts, marks, falloff, pins, selected} = this.state;
    this.film.hidden = !this.state.isFilm();
    this.tools.without(this.state.isFilm() ? kToolsOfModels : kToolsOfFilms);
    this.ghosts.setAttribute("aria-pressed", String(ghosts !== null));
    this.marks.setAttribute("aria-pressed", String(marks));
    this.#showBlend(falloff);
    this.pin.disabled = selected.joint === null;
    this.pin.setAttribute("aria-pressed", String(pins.some(({actor, joint}) => actor === selected.actor && joint === selected.joint)));
  }

  #workspace() {
    this.workspaces.set(this.state.workspace);
    for (const root of [this.tools.root, this.rings, this.film]) root.classList.toggle("away", this.state.workspace !== "scene");
  }
}

function iconButton(glyph, act) {
  return element("button", {class: "quiet icon", onclick: act}, glyph && icon(glyph));
}

function name(button, text, keys) {
  button.setAttribute("aria-label", text);
  button.title = `${text} (${keys})`;
}

// One of several, as buttons side by side (ARIA's radio group: arrows choose).
function segmented(name, choices, choose, withText) {
  const buttons = choices.map(({value, text, tip, glyph}) =>
    element("button", {role: "radio", "aria-label": text, title: tip, "data-value": value, onclick: () => choose(value)},
            icon(glyph), withText && element("span", {}, text)));
  const root = element("div", {class: "segmented", role: "radiogroup", "aria-label": name}, buttons);
  root.addEventListener("keydown", (event) => {
    const by = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    const open = buttons.filter(({hidden}) => !hidden), at = open.indexOf(event.target);
    if (by === undefined || at < 0) return;
    event.preventDefault();
    const next = open[(at + by + open.length) % open.length];
    next.focus();
    choose(next.dataset.value);
  });
  return {root, without: (values) => { for (const button of buttons) button.hidden = values.includes(button.dataset.value); }, set: (value) => {
    for (const button of buttons) {
      const on = button.dataset.value === value;
      button.setAttribute("aria-checked", String(on));
      button.tabIndex = on ? 0 : -1;
    }
  }};
}
