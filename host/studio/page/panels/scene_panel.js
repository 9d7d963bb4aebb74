// What is not of one joint. A model: bodies of other proportions, made of the same segments. A film: film_scene.js.

import {element, keepingFocus} from "../dom.js";
import {part} from "../fields.js";
import {FilmScene} from "./film_scene.js";

export class ScenePanel {
  #built = "";

  constructor(place, {state, edits}) {
    Object.assign(this, {place, state, edits});
    this.film = new FilmScene({state, edits});
    state.on("project selected", () => this.#update());
    state.on("poses", () => this.film.set());
  }

  #update() {
    const film = this.state.isFilm();
    const built = JSON.stringify(film ? this.film.shape() : [this.state.project?.bodies]);
    if (built !== this.#built) {
      this.#built = built;
      keepingFocus(this.place, () => this.place.replaceChildren(...(film ? this.film.parts() : this.#bodies())));
    }
    if (film) this.film.set();
  }

  #bodies() {
    const bodies = this.state.project?.bodies ?? [];
    if (bodies.length === 0) return [element("p", {class: "nothing"}, "This model has no other bodies.")];
    const button = ({name, what}) => element("button", {title: what, onclick: (event) => this.edits.commit({body: name}, event)}, name);
    return [part("Bodies", element("p", {class: "hint"}, "The same segments with other proportions."),
                 element("div", {class: "actions"}, bodies.map(button)))];
  }
}
