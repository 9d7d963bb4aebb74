// State of the page: the project as the studio sent it, and what is selected here. Others listen to what concerns
// them: "project", "poses", "selected", "tool", "axes", "view" (the active one), "shown" (by a view), "renderer", "workspace"; of films "frame", "range", "keys", "rows",
// "curves", "ghosts", "marks", "falloff", "pins".

import {ofBrowser} from "./stores.js";

// Axes about which rings turn, and how people read them.
export const kRingAxes = [["numbers", "The joint's three numbers, within their limits"], ["joint", "The joint's own axes, as they stand"],
                          ["parent", "The axes of its parent"], ["world", "The axes of the world"]];

export class State {
  #listeners = new Map();
  project = null;
  // thing: the camera or a light, instead of the others; more: joints beside `joint`, which rings turn, too
  selected = {actor: null, joint: null, thing: null, more: []};
  tool = "turn";
  axes = kRingAxes.find(([axes]) => axes === ofBrowser.get("axes"))?.[0] ?? "numbers";  // of rings; kept
  activeView = 0;
  workspace = "scene";  // or "rendering"
  range = null;         // [first, last] frames that play; null: all
  ghosts = null;        // {before, after, step} as views are asked for them
  marks = false;        // camera and lights show in views
  falloff = 0;          // frames to both sides into which a film's pose is blended
  pins = [];            // [{actor, joint}]
  renderer = {renderer: "", nodes: 0, machines: 0};

  on(what, listener) {
    for (const each of what.split(" ")) {
      if (!this.#listeners.has(each)) this.#listeners.set(each, []);
      this.#listeners.get(each).push(listener);
    }
  }

  tell(what) { for (const listener of this.#listeners.get(what) ?? []) listener(); }

  setProject(project) {
    this.project = project;
    const {actor, joint, more} = this.selected;
    if (joint !== null && !this.joint(joint, actor))
      this.selected = {actor: this.actor(actor) ? actor : null, joint: null, thing: null, more: []};
    else
      this.selected.more = more.filter((name) => this.joint(name, actor));
    this.tell("project");
  }

  // Poses, places and turns during gestures.
  setPoses({frame, actors, camera, lights}) {
    if (!this.project) return;
    this.project.frame = frame;
    if (camera) Object.assign(this.project.camera, camera);
    for (const light of lights ?? []) Object.assign(this.project.lights.find(({thing}) => thing === light.thing) ?? {}, light);
    for (const moved of actors) {
      const actor = this.actor(moved.name);
      if (!actor) continue;
      Object.assign(actor, {place: moved.place ?? actor.place, turn: moved.turn ?? actor.turn});
      moved.joints?.forEach((pose, i) => { if (actor.joints[i]) actor.joints[i].pose = pose; });
    }
    this.tell("poses");
  }

  select(actor, joint, thing = null, more = []) {
    const wanted = {actor, joint, thing, more};
    if (JSON.stringify(wanted) === JSON.stringify(this.selected)) return;
    this.selected = wanted;
    this.tell("selected");
  }

  set(what, value) {
    if (this[what] === value) return;
    this[what] = value;
    if (what === "axes") ofBrowser.set("axes", value);
    this.tell(what === "activeView" ? "view" : what);
  }

  isFilm() { return this.project?.kind === "film"; }
  actor(name = this.selected.actor) { return this.project?.actors.find((actor) => actor.name === name) ?? null; }
  joint(name = this.selected.joint, actor = this.selected.actor) {
    return this.actor(actor)?.joints.find((joint) => joint.name === name) ?? null;
  }
}
