// A reload brings back what each view shows, and what is selected. The browser keeps both for each film and model, by
// the file's name.

import {ofBrowser} from "./stores.js";

const kRest = 250;  // ms without a change, after which what views show is kept: a drag changes it with each picture

export class Kept {
  #file = null;
  #timer = null;  // null: all is kept

  constructor(views, {state, edits}) {
    Object.assign(this, {views, state, edits});
    state.on("project", () => this.#bringBack());
    state.on("shown", () => {
      clearTimeout(this.#timer);
      this.#timer = setTimeout(() => this.#keep(), kRest);
    });
    state.on("selected", () => this.#keep());
    addEventListener("pagehide", () => { if (this.#timer !== null) this.#keep(); });
  }

  #keep() {
    clearTimeout(this.#timer);
    this.#timer = null;
    if (this.#file === null) return;
    const {selected} = this.state, views = this.views.map(({shown}) => shown);
    ofBrowser.set(`kept ${this.#file}`, JSON.stringify({views, selected}));
  }

  // A value that is damaged, or of another version, brings back nothing.
  #bringBack() {
    const {file} = this.state.project, before = this.views.map(({shown}) => ({...shown}));
    if (file === this.#file) return;
    this.#file = file;
    try {
      const kept = JSON.parse(ofBrowser.get(`kept ${file}`));
      if (kept === null) return;
      this.views.forEach((view, at) => view.show(kept.views[at]));
      this.#select(kept.selected);
    } catch {
      this.views.forEach((view, at) => view.show(before[at]));
    }
  }

  // Selects what is still there.
  #select({actor, joint, thing, more}) {
    const isThere = joint === null ? this.state.actor(actor) : this.state.joint(joint, actor);
    if (isThere) this.edits.wanted = {actor, joint, more};
    else if (thing === "camera" || this.state.project.lights?.some((light) => light.thing === thing)) this.edits.selectThing(thing);
  }
}
