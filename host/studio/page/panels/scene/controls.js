// Controls of a film's scene: each shows a value of the project and changes it by a step, most by one command.

import {element} from "../../dom.js";
import {colorField, line, longChoice, vectorField} from "../../fields.js";
import {written} from "../../numbers.js";
import {blended} from "../../words.js";

export const joined = (numbers) => numbers.map((number) => written(number, 4)).join(",");

// {actor, joint} as commands name it; null: nobody.
const targetOf = (bound) => bound ? [bound.actor, bound.joint].filter(Boolean).join("/") : null;

const shownTarget = (target) => target?.replace("/", " \u203a ") ?? "Nobody";

export class Controls {
  #fields = [];

  constructor({state, edits, importer, models}) { Object.assign(this, {state, edits, importer, models}); }

  get project() { return this.state.project; }

  clear() { this.#fields = []; }
  set() { for (const field of this.#fields) field(); }

  // `show` is done whenever values change.
  whenSet(show) { this.#fields.push(show); }

  // A control that shows what `of` gives; gives its element.
  field(made, of) {
    this.whenSet(() => { const value = of(); if (value !== undefined && value !== null) made.set(value); });
    return made.root;
  }

  // `stepOf(value)` gives a step, or the words of its one command.
  gestures(stepOf) {
    const step = (value) => {
      const made = stepOf(value);
      return Array.isArray(made) ? {commands: [made]} : made;
    };
    return {
      preview: (value, event) => this.edits.preview(step(value), event),
      commit: (value, event) => this.edits.commit(step(value), event),
      cancel: () => this.edits.cancel(),
    };
  }

  atFrame() { return ["--frame", `${this.project.frame}`]; }
  posed(thing, text) { return ["animate", "pose", thing, text, ...blended(this.state.falloff), ...this.atFrame()]; }
  // The camera or a light: what has keys gets one at the frame, all else is changed for the whole film.
  changed(thing, {animated}, name, text) {
    if (animated.includes(name)) return this.posed(thing, `${name}=${text}`);
    return ["film", ...(thing === "camera" ? [thing] : ["light", "set", thing.split("/")[1]]), `${name}=${text}`];
  }
  commit(words, event) { this.edits.commit({commands: [words]}, event); }

  // `words()` gives those of the command.
  button(text, key, words) {
    return element("button", {"data-key": key, onclick: (event) => this.commit(words(), event)}, text);
  }

  vector(label, name, key, step, stepOf, of) {
    return line(label, this.field(vectorField({name, key, step, ...this.gestures(stepOf)}), of));
  }

  color(label, name, key, stepOf, of) {
    return line(label, this.field(colorField({name, key, ...this.gestures(stepOf)}), of));
  }

  // Which actor, or joint of one, as commands name it: `of` gives {actor, joint} or nothing. Not `without`.
  target(label, name, key, commit, of, without = null) {
    const made = longChoice({name, key, commit, textOf: shownTarget, options: () => [[null, shownTarget(null)], ...this.#targets(without)]});
    this.whenSet(() => made.set(targetOf(of())));
    return line(label, made.root);
  }

  #targets(without) {
    const names = this.project.actors.filter(({name}) => name !== without)
      .flatMap(({name, joints}) => [name, ...joints.map((joint) => `${name}/${joint.name}`)]);
    return names.map((name) => [name, shownTarget(name)]);
  }
}
