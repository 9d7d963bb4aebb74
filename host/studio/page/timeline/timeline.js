// Below the views of a film: the frames' bar, and under it keys, curves and scripts.

import {element} from "../dom.js";
import {setIcon} from "../icons.js";
import {clamped} from "../numbers.js";
import {keysOf} from "../shortcuts.js";
import {ofTab} from "../stores.js";
import {Tabs} from "../tabs.js";
import {CommandLog} from "./command_log.js";
import {CurveData} from "./curve_data.js";
import {CurveHand} from "./curve_hand.js";
import {CurvePlot} from "./curve_plot.js";
import {FilmKeys} from "./film_keys.js";
import {KeyActions} from "./key_actions.js";
import {KeyBar} from "./key_bar.js";
import {KeySheet} from "./key_sheet.js";
import {KeyValues} from "./key_values.js";
import {giveUpDrag} from "./pointer_drag.js";
import {RowList} from "./row_list.js";
import {Rows} from "./rows.js";
import {Ruler} from "./ruler.js";
import {Scripts} from "./scripts.js";
import {SheetHand} from "./sheet_hand.js";
import {TimeAxis} from "./time_axis.js";

const kLeast = 96, kBefore = 214, kStep = 24;  // pixels of its height
const kTabs = [{name: "keys", text: "Keys"}, {name: "curves", text: "Curves"}, {name: "scripts", text: "Scripts"}];

export class Timeline {
  constructor(place, bar, parts, frames) {
    const {state, edits} = parts;
    Object.assign(this, {place, bar, state, edits, frames});
    this.axis = new TimeAxis();
    this.keys = new FilmKeys(parts);
    this.rows = new Rows(this.keys, state);
    this.acts = new KeyActions(parts, this.keys, this.rows);
    this.log = new CommandLog(parts);
    this.keyBar = new KeyBar(this.acts, this.keys, state);
    this.#makeBody(parts);
    this.#makeBar();
    this.setHeight(Number(ofTab.get("timeline") ?? kBefore));
    state.on("project workspace", () => this.#project());
    state.on("selected", () => this.#selected());
  }

  #makeBody(parts) {
    const {state, keys, rows, axis, acts} = this;
    const choose = (row, how, picks) => this.#choose(row, how, picks);
    const rowList = new RowList(rows, {state, choose});
    const hands = {keys, axis, rowList, acts, choose};
    this.data = new CurveData(parts, keys, rows, axis);
    this.sheet = new KeySheet(rows, rowList, keys, axis, state);
    this.plot = new CurvePlot(this.data, keys, axis, state);
    new SheetHand(this.sheet, hands);
    new CurveHand(this.plot, hands);
    this.#reachable(this.sheet.root, "Keys: arrows go from key to key");
    this.#reachable(this.plot.root, "Curves: arrows go from key to key");
    this.values = new KeyValues(acts, keys, state);
    this.body = element("div", {class: "timeline-body"}, legend(),
                        new Ruler({state, frames: this.frames}, axis).root, rowList.root);
    this.tabs = new Tabs(this.body, kTabs, "Timeline", (name) => this.#show(name));
    this.tabs.panel("keys").append(this.sheet.root);
    this.tabs.panel("curves").append(this.plot.root);
    this.scripts = new Scripts(this.tabs.panel("scripts"), parts);
    this.place.append(this.#splitter(), this.body);
  }

  #reachable(root, name) {
    for (const [key, value] of [["tabindex", 0], ["role", "application"], ["aria-label", name]]) root.setAttribute(key, value);
    root.addEventListener("keydown", (event) => this.#key(event));
  }

  #makeBar() {
    this.fold = element("button", {class: "quiet icon", "data-key": "timeline.fold", onclick: () => this.setOpen(this.place.hidden)});
    this.bar.append(this.tabs.bar, this.keyBar.root, this.values.root, this.log.root, this.fold);
    this.tabs.bar.addEventListener("click", ({target}) => { if (target.closest("[role=tab]")) this.setOpen(true); });
    this.open = ofTab.get("timeline shut") !== "yes";
  }

  setOpen(open) {
    this.open = open;
    ofTab.set("timeline shut", open ? "no" : "yes");
    this.#project();
  }

  #project() {
    const shown = this.state.isFilm() && this.state.workspace === "scene";
    this.place.hidden = !shown || !this.open;
    document.body.style.setProperty("--timeline", `${this.place.hidden ? 0 : this.height}px`);
    this.bar.classList.toggle("shut", !this.open);
    const text = `${this.open ? "Shut" : "Open"} the timeline (${keysOf("foldTimeline")})`;
    setIcon(this.fold, this.open ? "shut" : "unshut");
    this.fold.title = text;
    this.fold.setAttribute("aria-label", text);
    if (this.state.isFilm() && this.length !== this.state.project.frames) this.axis.setFrames(this.length = this.state.project.frames);
  }

  #show(name) {
    this.body?.setAttribute("data-shown", name);
    this.data.show(name === "curves");
    this.scripts?.show(name === "scripts");
  }

  // ---- rows and what is selected in the views

  #choose(row, how, picks = true) {
    this.choosing = true;
    this.rows.choose(row, how);
    if (picks) this.keys.pick(this.rows.list.filter(({id}) => this.rows.chosen.has(id)).flatMap((each) => this.rows.keysOf(each)));
    if (row.kind === "camera" || row.kind === "light") this.edits.selectThing(row.thing);
    else if (row.thing !== null && this.state.actor(row.thing)) this.edits.select(row.thing, this.state.joint(row.part, row.thing)?.name ?? null);
    this.choosing = false;
  }

  #selected() {
    const {actor, joint, thing} = this.state.selected;
    if (!this.choosing && (actor ?? thing) !== null) this.rows.reveal(thing ?? actor, joint);
  }

  // ---- keys

  // From key to key in the rows that are chosen; the frame follows.
  #key(event) {
    const by = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (by === undefined || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    if (event.altKey) return this.acts.nudge(by * (event.shiftKey ? 10 : 1), event);
    const row = this.rows.at(Math.max(0, this.rows.index(this.rows.active)));
    const marks = row ? this.rows.marks(row) : [], {frame} = this.state.project;
    const mark = by > 0 ? marks.find((each) => each.frame > frame) : marks.findLast((each) => each.frame < frame);
    if (!mark) return;
    this.keys.pick(mark.keys, event.shiftKey ? "add" : "only");
    this.frames.scrub(mark.frame, event);
    this.axis.reveal(mark.frame);
  }

  next() {
    const at = kTabs.findIndex(({name}) => name === this.tabs.shown);
    this.setOpen(true);
    this.tabs.show(kTabs[(at + 1) % kTabs.length].name);
  }

  showAll() { this.axis.showAll(); this.plot.showValues(); }

  letGo() {
    if (giveUpDrag()) return true;
    if (!this.place.contains(document.activeElement) || this.keys.picked().length === 0) return false;
    this.keys.pick([]);
    return true;
  }

  // ---- its height

  setHeight(height) {
    this.height = clamped(height, kLeast, Math.max(kLeast, innerHeight - 320));
    this.place.style.height = `${this.height}px`;
    document.body.style.setProperty("--timeline", `${this.height}px`);
    this.grip?.setAttribute("aria-valuenow", Math.round(this.height));
    ofTab.set("timeline", this.height);
  }

  #splitter() {
    this.grip = element("div", {class: "splitter", role: "separator", tabindex: 0, "aria-orientation": "horizontal", "aria-label": "Height of the timeline",
                                "aria-valuemin": kLeast, title: "Drag: the timeline's height"});
    let from = null;
    this.grip.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      this.grip.setPointerCapture(event.pointerId);
      from = event.clientY + this.height;
    });
    this.grip.addEventListener("pointermove", (event) => { if (from !== null) this.setHeight(from - event.clientY); });
    this.grip.addEventListener("lostpointercapture", () => { from = null; });
    this.grip.addEventListener("keydown", (event) => {
      const by = {ArrowUp: kStep, ArrowDown: -kStep}[event.key];
      if (by === undefined) return;
      event.preventDefault();
      this.setHeight(this.height + by);
    });
    return this.grip;
  }
}

function legend() {
  const looks = [["linear", "Linear"], ["eased", "Eased"], ["spline", "Spline"], ["hold", "Hold"]];
  return element("ul", {class: "looks", "aria-label": "Eases"}, looks.map(([look, text]) => element("li", {}, element("i", {class: look}), text)));
}
