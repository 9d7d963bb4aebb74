// A reload brings back what each view shows, and what is selected. The browser keeps both for each film and model, by
// the file's name.

export class Kept {
  #file = null;

  constructor(views, {state, edits}) {
    Object.assign(this, {views, state, edits});
    state.on("project", () => this.#bringBack());
    state.on("shown selected", () => this.#keep());
  }

  #keep() {
    if (this.#file === null) return;
    const {selected} = this.state, views = this.views.map(({shown}) => shown);
    localStorage.setItem(`kept ${this.#file}`, JSON.stringify({views, selected}));
  }

  #bringBack() {
    const {file} = this.state.project;
    if (file === this.#file) return;
    this.#file = file;
    const kept = JSON.parse(localStorage.getItem(`kept ${file}`));
    if (kept === null) return;
    this.views.forEach((view, at) => view.show(kept.views[at]));
    this.#select(kept.selected);
  }

  // Selects what is still there.
  #select({actor, joint, thing, more}) {
    if (actor !== null) this.edits.wanted = {actor, joint, more};
    else if (thing === "camera" || this.state.project.lights?.some((light) => light.thing === thing)) this.edits.selectThing(thing);
  }
}
