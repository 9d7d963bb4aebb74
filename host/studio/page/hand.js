// A hand in a view: mouse, pen, finger or keys become grabs, drags and orbits (docs/studio-protocol.md). A press on the
// left waits for the studio's word on what is there: a handle or limb is dragged, empty space turns the eye.

import {kNoEvent} from "./latencies.js";

const kPerKey = 14;          // pixels of a mouse, for one press of an arrow
const kPerLine = 16;         // of wheels that count lines
const kStill = 3;            // pixels: a press that moves less is a click
const kRestAfter = 160;      // ms without a wheel's or key's turn: the eye rests
const kPerE = 1 / 0.0015;    // pixels of a wheel that make the distance e times as long (host/studio/stage/eye.cpp)
const kPinched = kPerE / 100;  // of a trackpad, whose pinch by a factor e browsers call 100 pixels of a wheel with Ctrl

const keysHeld = (event) => ["shift", "ctrl", "alt"].filter((key) => event[`${key}Key`]);
const joinOrbits = (before, now) => before.how === now.how
  ? {...now, by: [before.by[0] + now.by[0], before.by[1] + now.by[1]]} : now;

export class Hand {
  #gesture = null;  // {kind: "asked" | "drag" | "orbit", how, empty, began, last, newest, up, spread: between two fingers}
  #fingers = new Map();  // of each pointer that is down its last event
  #rest = 0;

  constructor(view, {connection, pace, state, edits}) {
    Object.assign(this, {view, connection, pace, state, edits});
    const picture = view.picture;
    picture.addEventListener("pointerdown", (event) => this.#down(event));
    picture.addEventListener("pointermove", (event) => this.#move(event));
    picture.addEventListener("pointerup", (event) => this.#up(event));
    // Also after a release, whose grab may still wait for its answer.
    picture.addEventListener("lostpointercapture", ({pointerId}) => {
      this.#fingers.delete(pointerId);
      if (!this.#gesture?.up) this.letGo();
    });
    picture.addEventListener("pointerleave", () => view.showTip(""));
    picture.addEventListener("wheel", (event) => this.#wheel(event), {passive: false});
    picture.addEventListener("contextmenu", (event) => event.preventDefault());
    picture.addEventListener("focus", () => state.set("activeView", view.number));
  }

  get idle() { return this.#gesture === null; }

  // The studio's word on what the hand took.
  grabbed({actor = null, joint = null, handle = null, thing = null}) {
    const gesture = this.#gesture;
    if (gesture?.kind !== "asked") return;
    const empty = joint === null && handle === null && thing === null;
    const kind = handle !== null || thing !== null || this.#turns(actor, joint) ? "drag" : "orbit";
    Object.assign(gesture, {kind, how: "turn", empty});
    this.#look(kind === "orbit" ? "turn" : "drag");
    if (gesture.newest) this.#follow(gesture.newest);
    if (gesture.up) this.#end(gesture.up);
  }

  // Whether there was a gesture.
  letGo() {
    if (!this.#gesture) return false;
    const {kind} = this.#gesture;
    this.#gesture = null;
    this.#look("");
    this.pace.drop("drag");
    if (kind === "orbit") this.#restNow();
    else this.connection.send({do: "let_go"});
    return true;
  }

  // By keys: how many steps to the right and down.
  orbitBy(how, steps, event) {
    this.#orbit(how, steps.map((step) => step * kPerKey), event);
    this.#restSoon();
  }

  // From where the eye looks already.
  showSelected(event) {
    clearTimeout(this.#rest);
    this.pace.drop("orbit");
    this.pace.now({do: "orbit", view: this.view.number, how: "selected", moving: false}, event ?? kNoEvent);
  }

  // What cannot turn, nor any joint above it, is like empty space: the eye moves.
  #turns(actor, name) {
    const joint = this.state.joint(name, actor);
    return joint !== null && (joint.free.length > 0 || this.#turns(actor, joint.parent ?? null));
  }

  #down(event) {
    this.#fingers.set(event.pointerId, event);
    this.view.picture.setPointerCapture(event.pointerId);
    if (this.#fingers.size === 2) this.#pinch();
    if (this.#gesture) return;
    event.preventDefault();
    this.view.picture.focus({preventScroll: true});
    this.view.showTip("");
    const how = howToOrbit(event);
    this.#gesture = {kind: how ? "orbit" : "asked", how, began: event, last: event};
    this.#look(how ?? "");
    if (how) return;
    this.pace.now({do: "grab", view: this.view.number, ...this.view.spot(event), button: event.button, keys: keysHeld(event),
                   falloff: this.state.falloff}, event);
  }

  // The gesture of the first finger leaves no trace.
  #pinch() {
    this.letGo();
    this.#gesture = {kind: "orbit", spread: spreadOf(...this.#fingers.values())};
  }

  #move(event) {
    if (this.#fingers.has(event.pointerId)) this.#fingers.set(event.pointerId, event);
    if (!this.#gesture) return this.#hover(event);
    if (this.#gesture.kind === "asked") this.#gesture.newest = event;
    else this.#follow(event);
  }

  #follow(event) {
    const gesture = this.#gesture;
    if (gesture.kind === "drag") {
      this.pace.send("drag", {do: "drag", ...this.view.spot(event), keys: keysHeld(event)}, event);
      return;
    }
    if (gesture.spread) return this.#followFingers(gesture, event);
    const by = [event.clientX - gesture.last.clientX, event.clientY - gesture.last.clientY].map((part) => part * devicePixelRatio);
    gesture.last = event;
    if (by[0] !== 0 || by[1] !== 0) this.#orbit(gesture.how, by, event);
  }

  #followFingers(gesture, event) {
    const [one, other] = this.#fingers.values(), spread = spreadOf(one, other), before = gesture.spread;
    gesture.spread = spread;
    const middle = {clientX: (one.clientX + other.clientX) / 2, clientY: (one.clientY + other.clientY) / 2};
    this.#orbit("zoom", [0, kPerE * Math.log(before / spread)], event, this.view.spot(middle));
  }

  #up(event) {
    if (!this.#gesture) return;
    if (this.#gesture.kind === "asked") this.#gesture.up = event;
    else this.#end(event);
  }

  #end(event) {
    const {kind, empty, began} = this.#gesture;
    this.#gesture = null;
    this.#look("");
    if (empty && isClick(began, event)) return this.edits.select(null, null);
    if (kind === "orbit") return this.#restNow(event);
    this.pace.flush("drag", true);
    this.pace.now({do: "drop"}, event);
  }

  #hover(event) {
    if (event.buttons !== 0) return;
    this.pace.send("hover", {do: "hover", view: this.view.number, ...this.view.spot(event)});
  }

  #wheel(event) {
    event.preventDefault();
    this.state.set("activeView", this.view.number);
    const by = event.deltaY * [event.ctrlKey ? kPinched : 1, kPerLine, this.view.size[1]][event.deltaMode];
    this.#orbit("zoom", [0, by], event, this.view.spot(event));
    this.#restSoon();
  }

  #orbit(how, by, event, at = {}) {
    clearTimeout(this.#rest);
    this.pace.send("orbit", {do: "orbit", view: this.view.number, by, how, moving: true, ...at}, event, joinOrbits);
  }

  #restSoon() {
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => this.#restNow(), kRestAfter);
  }

  #restNow(event) {
    clearTimeout(this.#rest);
    this.pace.flush("orbit", true);
    this.pace.now({do: "orbit", view: this.view.number, by: [0, 0], how: "turn", moving: false},
                  event ?? kNoEvent);
  }

  #look(gesture) { this.view.picture.dataset.gesture = gesture; }
}

const spreadOf = (one, other) => Math.max(1, Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY));

const isClick = (from, to) => Math.hypot(to.clientX - from.clientX, to.clientY - from.clientY) < kStill;

// Null: the left button asks what is there.
function howToOrbit({button, altKey, shiftKey}) {
  if (button === 2 || (button === 0 && shiftKey)) return "pan";
  if (button === 1) return shiftKey ? "pan" : "turn";
  return altKey ? "turn" : null;
}
