// One view: a canvas with MARS's picture, the handles over it, its title with the menu. It tells the studio what it
// shows; the eye moves by messages of the hand (hand.js).

import {element, svg} from "./dom.js";
import {showHandles} from "./handles.js";
import {icon} from "./icons.js";
import {kNoEvent} from "./latencies.js";
import {addMenu} from "./menu.js";
import {keysOf} from "./shortcuts.js";

export const kDisplays = [["surface", "Surface"], ["vertices", "Control vertices"], ["prisms", "Prisms"], ["stick", "Stick"]];
const kFroms = [["front", "Front"], ["side", "Side"], ["top", "Top"], ["free", "Free"], ["camera", "Film's camera"]];
const kLargest = 4096;  // pixels of a side
const nameOf = (list, key) => list.find(([each]) => each === key)[1];

export class View {
  #picture = 0;            // painted last
  #handles = new Map();    // picture -> shapes, of pictures that are not painted yet
  #context;

  constructor(number, from, {connection, pace, state, ghosts}) {
    Object.assign(this, {number, connection, pace, state, ghosts});
    this.shown = {from, as: "surface", hidden: true, ground: true, handles: true, orbit: null};
    this.size = this.room = [0, 0];  // of its picture, and of what it could fill: pixels
    this.#build();
    // Pixels that are painted must be those that are shown: no copy, no smoothing by the canvas.
    this.#context = this.canvas.getContext("2d", {alpha: false});
  }

  get context() { return this.#context; }
  get title() { return nameOf(kFroms, this.shown.from); }

  #build() {
    this.canvas = element("canvas", {width: 1, height: 1, "aria-hidden": "true"});
    this.layer = svg("g");
    this.overlay = svg("svg", {class: "handles", "aria-hidden": "true"}, this.layer);
    this.waiting = element("p", {class: "waiting"}, "Waiting for the first picture");
    this.tip = element("p", {class: "tip", hidden: true});
    this.picture = element("div", {class: "picture", tabindex: 0, role: "application", "data-key": `view-${this.number}`},
                           this.canvas, this.overlay, this.waiting, this.tip);
    this.titleButton = element("button", {class: "title", "data-view": this.number});
    this.maximiseButton = element("button", {class: "quiet icon maximise"}, icon("maximise"));
    this.root = element("section", {class: "view"}, this.picture,
                        element("div", {class: "bar"}, this.titleButton, this.maximiseButton));
    addMenu(this.titleButton, () => this.#menu());
    new ResizeObserver(([entry]) => this.#resized(entry)).observe(this.picture);
    this.#name();
  }

  // Changes what it shows.
  show(change, event) {
    Object.assign(this.shown, change);
    this.#name();
    this.ask(event);
    this.state.tell("shown");
  }

  // Says all there is to this view; also what a studio that has just started needs.
  ask(event) {
    if (!this.state.project) return;
    const [width, height] = this.size = this.#fitting();
    if (width === 0 || height === 0) return;
    const {from, orbit, as, hidden, ground, handles} = this.shown;
    const message = {do: "view", view: this.number, width, height, from, orbit, as, hidden, ground,
                     handles: handles ? this.state.tool : "none", axes: this.state.axes, ...this.#ofFilms()};
    this.pace.send(`view ${this.number}`, message, event ?? kNoEvent);
  }

  // The film's size may be another.
  refit() { if (this.size.join() !== this.#fitting().join()) this.ask(); }

  // What the film's camera sees has the film's shape: nothing is cut off.
  #fitting() {
    if (this.shown.from !== "camera" || !this.state.isFilm() || this.room.includes(0)) return this.room;
    const {size} = this.state.project, scale = Math.min(...size.map((side, axis) => this.room[axis] / side));
    return size.map((side) => Math.max(1, Math.round(side * scale)));
  }

  #ofFilms() { return this.state.isFilm() ? {ghosts: this.state.ghosts, marks: this.state.marks} : {}; }

  #putCamera(event) { this.pace.now({do: "put_camera", view: this.number}, event ?? kNoEvent); }

  // Pictures count from 1 again.
  forgetPictures() {
    this.#picture = 0;
    this.#handles.clear();
  }

  // Who turns the film's camera's view leaves it.
  takeOrbit({center, turn, height, distance}) {
    this.shown.orbit = {center, turn, height, distance};
    if (this.shown.from === "camera") {
      this.shown.from = "free";
      this.#name();
      this.refit();
    }
    this.state.tell("shown");
  }

  takeHandles({picture, shapes}) {
    if (picture > this.#picture) this.#handles.set(picture, shapes);
    else showHandles(this.layer, shapes);
  }

  // The painter's: this picture is painted now. One of another size is a full one.
  painting({picture, width, height}) {
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
      this.overlay.setAttribute("viewBox", `0 0 ${width} ${height}`);
    }
    this.waiting.hidden = true;
    this.#picture = picture;
    let newest = null;
    for (const [of, shapes] of this.#handles) {
      if (of > picture) continue;
      newest = shapes;
      this.#handles.delete(of);
    }
    if (newest) showHandles(this.layer, newest);
  }

  // Pixels of the view, of a mouse's event.
  spot({clientX, clientY}) {
    const at = this.picture.getBoundingClientRect();
    const [width, height] = this.size, scale = Math.max(width / at.width, height / at.height);
    return {x: Math.round((clientX - at.left - at.width / 2) * scale + width / 2), y: Math.round((clientY - at.top - at.height / 2) * scale + height / 2)};
  }

  showTip(text) {
    this.tip.hidden = !text;
    if (text) this.tip.textContent = text;
  }

  #resized(entry) {
    const device = entry.devicePixelContentBoxSize?.[0];
    const css = entry.contentBoxSize[0];
    const pixels = device ? [device.inlineSize, device.blockSize]
                          : [css.inlineSize, css.blockSize].map((side) => Math.round(side * devicePixelRatio));
    const size = pixels.map((side) => Math.min(side, kLargest));
    const hidden = size.some((side) => side === 0);
    if (hidden && this.room[0] !== 0) {
      this.connection.send({do: "unview", view: this.number});
      this.forgetPictures();
    }
    if (size.join() === this.room.join()) return;
    this.room = hidden ? [0, 0] : size;
    this.ask();
  }

  #name() {
    const display = nameOf(kDisplays, this.shown.as);
    this.titleButton.replaceChildren(element("strong", {}, this.title), element("span", {}, display), icon("chevron"));
    this.titleButton.setAttribute("aria-label", `${this.title}, ${display}: what this view shows`);
    this.titleButton.title = "Double click: maximise";
    this.maximiseButton.setAttribute("aria-label", `Maximise the view ${this.title}`);
    this.maximiseButton.title = `Maximise, and back (${keysOf("maximise")})`;
    this.picture.setAttribute("aria-label", `${this.title}: arrows orbit, shift and arrows pan, plus and minus zoom`);
    this.root.setAttribute("aria-label", `View ${this.number + 1}: ${this.title}`);
  }

  #menu() {
    const froms = kFroms.filter(([from]) => from !== "camera" || this.state.isFilm());
    const flip = (key) => (event) => this.show({[key]: !this.shown[key]}, event);
    const ofFilms = [{text: "Ghosts", keys: keysOf("ghosts"), checked: this.state.ghosts !== null, act: this.ghosts.flip},
                     {text: "Marks of camera and lights", keys: keysOf("marks"), checked: this.state.marks,
                      act: () => this.state.set("marks", !this.state.marks)}];
    return [
      {heading: "From"},
      ...froms.map(([from, text]) => ({text, chosen: this.shown.from === from,
                                       act: (event) => this.show({from, orbit: null}, event)})),
      {heading: "Show"},
      ...kDisplays.map(([as, text]) => ({text, chosen: this.shown.as === as, act: (event) => this.show({as}, event)})),
      {heading: "With"},
      {text: "Hidden lines left out", keys: keysOf("hidden"), checked: this.shown.hidden, act: flip("hidden")},
      {text: "Ground", keys: keysOf("ground"), checked: this.shown.ground, act: flip("ground")},
      {text: "Handles of the tool", checked: this.shown.handles, act: flip("handles")},
      ...(this.state.isFilm() ? ofFilms : []),
      {heading: "View"},
      {text: "Show all", keys: keysOf("showAll"), act: (event) => this.show({orbit: null}, event)},
      {text: "Show what is selected", keys: keysOf("showSelected"), act: (event) => this.root.dispatchEvent(new CustomEvent("showselected", {detail: event}))},
      ...(this.state.isFilm() && this.shown.from === "free" ? [{text: "Put the film's camera here", act: (event) => this.#putCamera(event)}] : []),
      {text: "Maximise, and back", keys: keysOf("maximise"), act: () => this.root.dispatchEvent(new Event("maximise"))},
    ];
  }
}
