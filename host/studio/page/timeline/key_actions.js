// What may be done to the selected keys, as steps of commands. Commands that are none take a preview back.

import {copied, deleted, eased, keyed, moved, reduced, retimed, stretched, swung} from "./key_commands.js";

export class KeyActions {
  #copied = [];  // [{thing, part, frame}]

  constructor({state, edits}, keys, rows) { Object.assign(this, {state, edits, keys, rows}); }

  tryOut(commands, event) {
    if (commands.length) this.edits.preview({commands}, event);
    else this.edits.cancel();
  }

  commit(commands, event) {
    if (commands.length) this.edits.commit({commands}, event);
    else this.edits.cancel();
  }

  cancel() { this.edits.cancel(); }

  remove(event) { this.commit(deleted(this.keys.chosen()), event); }
  ease(ease, event) { this.commit(eased(this.keys.chosen(), ease), event); }
  swing(back, beyond, event) { this.commit(swung(this.keys.chosen(), back, beyond), event); }
  reduce(degrees, event) { this.commit(reduced(this.keys.chosen(), degrees), event); }
  stretch(factor, event) { this.commit(stretched(this.keys.chosen(), factor), event); }
  retime(option, by, event) { this.commit(retimed(this.keys.chosen(), option, this.state.project.frame, by), event); }

  nudge(by, event) {
    if (by !== 0 && this.keys.picked().every(({key}) => key.frame + by >= 0)) this.#displace(moved, by, event);
  }

  #displace(words, by, event) {
    this.commit(words(this.keys.chosen(), by), event);
    this.keys.whenAnswered((taken) => { if (taken) this.keys.moved(by); });
  }

  copy() { this.#copied = this.keys.picked().map(({thing, part, key}) => ({thing, part: part.name, frame: key.frame})); }

  // The first of the copied keys comes to the frame that shows.
  paste(event) {
    if (this.#copied.length === 0) return;
    this.keys.pick(this.#copied);
    const by = this.state.project.frame - Math.min(...this.#copied.map(({frame}) => frame));
    if (by !== 0) this.#displace(copied, by, event);
  }

  // Of the rows that are chosen, else of what is selected in the views.
  insert(event) {
    const whose = this.#whose();
    if (whose) this.commit([keyed(...whose, this.state.project.frame)], event);
  }

  #whose() {
    const {actor, joint, thing} = this.state.selected;
    const {thing: row, parts} = this.rows.named();
    if (row !== null && (row === (thing ?? actor) || (thing ?? actor) === null)) return [row, parts];
    if (thing !== null) return [thing, []];
    return actor === null ? null : [actor, joint === null ? [] : [joint]];
  }
}
