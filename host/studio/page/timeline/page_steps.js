// The commands of this page's steps that are done: those that were undone are left out until somebody redoes them. Pages
// share one history, of which the studio sends only the names of the steps that undo and redo would change. A step of
// another page that has the same name as one of this page counts as that one.

const kKept = 100;  // steps

export class PageSteps {
  #steps = [];   // {name, lines}, in their order
  #done = 0;     // how many of them
  #sent = null;  // the names that the studio sent last; null while an undo or redo is not answered

  get lines() { return this.#steps.slice(0, this.#done).flatMap(({lines}) => lines); }

  // A new step; its name comes with the next project.
  add(lines) {
    this.#steps = [...this.#steps.slice(0, this.#done), {lines}].slice(-kKept);
    this.#done = this.#steps.length;
  }

  // The page has asked for "undo" or "redo".
  ask(where) {
    const step = this.#steps[where === "undo" ? this.#done - 1 : this.#done];
    if (!step || (this.#sent && this.#sent[where] !== step.name)) return;
    this.#done += where === "undo" ? -1 : 1;
    this.#sent = null;
  }

  follow({undo, redo}) {
    for (const step of this.#steps) step.name ??= undo;
    if (redo !== null) this.#done = this.#placeBetween(undo, redo);
    else if (this.#steps.at(-1)?.name === undo) this.#done = this.#steps.length;
    this.#sent = {undo, redo};
  }

  // The number of done steps that fits the names best, and is nearest to the number so far.
  #placeBetween(undo, redo) {
    const fit = (at) => (this.#steps[at - 1]?.name === undo) + (this.#steps[at]?.name === redo);
    const away = (at) => Math.abs(at - this.#done);
    const places = [...Array(this.#steps.length + 1).keys()];
    return places.sort((one, other) => fit(other) - fit(one) || away(one) - away(other))[0];
  }
}
