// What is not of one joint. A model: bodies of the library, to begin with. A film: its actors, camera, lights, materials
// and settings, by the commands of `mars film` and `mars animate`.

import {element, keepingFocus} from "../dom.js";
import {part} from "../fields.js";
import {askFirst} from "../popover.js";
import {bodyStep} from "../words.js";
import {actorPart, castPart} from "./scene/actors.js";
import {cameraPart} from "./scene/camera.js";
import {Controls} from "./scene/controls.js";
import {filmPart, materialsPart} from "./scene/film.js";
import {importPart} from "./scene/imports.js";
import {lightsPart} from "./scene/lights.js";
import {modelCards} from "./scene/model_cards.js";

export class ScenePanel {
  #built = "";

  constructor(place, {state, edits, importer, models}) {
    Object.assign(this, {place, state, edits, models});
    this.controls = new Controls({state, edits, importer, models});
    state.on("project selected", () => this.#update());
    state.on("poses", () => this.controls.set());
    models.whenListed(() => this.state.project && this.#update());
  }

  #update() {
    const film = this.state.isFilm();
    const built = JSON.stringify(film ? this.#shape() : [this.state.project?.bodies, this.models.list.length]);
    if (built !== this.#built) {
      this.#built = built;
      this.controls.clear();
      keepingFocus(this.place, () => this.place.replaceChildren(...(film ? this.#film() : this.#bodies())));
    }
    this.controls.set();
  }

  #bodies() {
    const bodies = this.state.project?.bodies ?? [];
    if (bodies.length === 0) return [element("p", {class: "nothing"}, "This model has no other bodies.")];
    const cards = modelCards(this.models, {list: bodies, label: "Bodies", choose: (name, event) => this.#begin(name, event)});
    return [part("Bodies", element("p", {class: "hint"}, "A figure of the library, in place of this model."),
                 cards.root)];
  }

  // What somebody has made goes only where he agrees.
  #begin(body, event) {
    const {actors: [{joints}], undo} = this.state.project, act = (agreed) => this.edits.commit(bodyStep(body), agreed);
    if (joints.length === 1 && undo === null) return act(event);
    askFirst(event.currentTarget, "Replace this model?", `Its ${joints.length} joints go, and ${body} takes their place. Undo brings them back.`, "Replace", act);
  }

  // What decides which controls there are.
  #shape() {
    const {project, selected} = this.state;
    return [selected.actor, selected.thing, Boolean(project.camera), project.settings.color, project.actors.map(({name, place}) => [name, Boolean(place)]),
            this.models.list.map(({name}) => name), (project.lights ?? []).map(({thing, kind}) => [thing, kind]),
            (project.materials ?? []).map(({name}) => name)];
  }

  // What is selected comes first.
  #film() {
    const {controls} = this, lit = this.state.selected.thing?.startsWith("light/");
    const made = [actorPart(controls), ...(lit ? [lightsPart(controls), cameraPart(controls)] : [cameraPart(controls), lightsPart(controls)]),
                  castPart(controls), importPart(controls), materialsPart(controls), filmPart(controls)];
    return made.filter(Boolean);
  }
}
