// The four views: front, side, top, free, in a grid; one of them may have all the room.

import {Hand} from "./hand.js";
import {setIcon} from "./icons.js";
import {Kept} from "./kept.js";
import {kDisplays, View} from "./view.js";

const kFroms = ["front", "side", "top", "free"];

export class Views {
  #maximised = null;

  constructor(place, parts, painter) {
    Object.assign(this, {place, state: parts.state});
    this.views = kFroms.map((from, number) => new View(number, from, parts));
    this.hands = this.views.map((view) => new Hand(view, parts));
    for (const view of this.views) this.#add(view, painter);
    this.#listen(parts);
    new Kept(this.views, parts);  // brings back what views show before they ask for it
    this.state.on("view", () => this.#showActive());
    this.state.on("project", () => this.views.forEach((view) => view.refit()));
    this.state.on("tool axes ghosts marks", () => this.views.forEach((view) => view.ask()));
    this.#showActive();
  }

  get active() { return this.views[this.state.activeView]; }

  #add(view, painter) {
    painter.add(view.number, view);
    const maximise = () => this.maximise(view);
    view.titleButton.addEventListener("dblclick", maximise);
    view.maximiseButton.addEventListener("click", maximise);
    view.root.addEventListener("maximise", maximise);
    view.root.addEventListener("showselected", ({detail}) => this.hands[view.number].showSelected(detail));
    view.root.addEventListener("focusin", () => this.state.set("activeView", view.number));
    this.place.append(view.root);
  }

  #listen({connection}) {
    const to = (act) => (message) => { if (this.views[message.view]) act(this.views[message.view], message); };
    connection.on("handles", to((view, message) => view.takeHandles(message)));
    connection.on("orbit", to((view, message) => view.takeOrbit(message)));
    connection.on("hovered", to((view, {text, handle, joint}) => {
      view.showTip(this.hands[view.number].idle ? text ?? joint ?? "" : "");
      view.picture.dataset.over = handle ? "handle" : joint ? "limb" : "";
    }));
    connection.on("grabbed", (message) => this.hands.forEach((hand, number) => {
      if (message.view === undefined || message.view === number) hand.grabbed(message);
    }));
    // A hand whose grab was refused would wait for ever.
    connection.on("refused", (message) => { if (message.do === "grab") this.hands.forEach((hand) => hand.grabbed({})); });
    connection.on("connected", () => this.views.forEach((view) => { view.forgetPictures(); view.ask(); }));
    connection.on("gone", () => this.hands.forEach((hand) => hand.letGo()));
  }

  // Of four views one fills the grid; again: all four.
  maximise(view = this.active) {
    this.#maximised = this.#maximised === view ? null : view;
    for (const each of this.views) {
      each.root.hidden = this.#maximised !== null && each !== this.#maximised;
      setIcon(each.maximiseButton, this.#maximised ? "restore" : "maximise");
    }
    this.place.classList.toggle("one", this.#maximised !== null);
    this.go(view.number);
  }

  go(number) {
    if (this.#maximised && this.#maximised !== this.views[number]) this.maximise(this.views[number]);
    this.views[number].picture.focus({preventScroll: true});
    this.state.set("activeView", number);
  }

  nextDisplay(event) {
    const at = kDisplays.findIndex(([as]) => as === this.active.shown.as);
    this.active.show({as: kDisplays[(at + 1) % kDisplays.length][0]}, event);
  }

  flip(key, event) { this.active.show({[key]: !this.active.shown[key]}, event); }
  showAll(event) { this.active.show({orbit: null}, event); }
  showSelected(event) { this.hands[this.state.activeView].showSelected(event); }
  // The film's camera is left as it is.
  showSelectedInAll() {
    for (const {number, shown, size} of this.views) if (shown.from !== "camera" && size[0] > 0) this.hands[number].showSelected();
  }
  orbitBy(how, steps, event) { this.hands[this.state.activeView].orbitBy(how, steps, event); }

  // Whether a hand held something.
  letGo() { return this.hands.map((hand) => hand.letGo()).includes(true); }

  #showActive() {
    for (const view of this.views) view.root.classList.toggle("active", view.number === this.state.activeView);
  }
}
