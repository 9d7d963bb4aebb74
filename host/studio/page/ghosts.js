// Ghosts: the selected actor at neighbouring frames, and the way of its joint.

import {keysOf} from "./shortcuts.js";

const kFirst = {before: 2, after: 2, step: 4};
const kCounts = [[1, 1], [2, 2], [4, 4], [3, 0], [0, 3]];
const kSteps = [1, 2, 4, 8, 12];

export class Ghosts {
  #last = kFirst;

  constructor(state) { this.state = state; }

  flip = () => this.#set(this.state.ghosts === null ? this.#last : null);

  #set(ghosts) {
    if (ghosts) this.#last = ghosts;
    this.state.set("ghosts", ghosts);
  }

  menu() {
    const {before, after, step} = this.#last, on = this.state.ghosts !== null;
    const words = (one, other) => other === 0 ? `${one} before` : one === 0 ? `${other} after` : `${one} before, ${other} after`;
    return [
      {text: "Ghosts", checked: on, keys: keysOf("ghosts"), act: this.flip},
      {heading: "How many"},
      ...kCounts.map(([one, other]) => ({text: words(one, other), chosen: one === before && other === after,
                                         act: () => this.#set({...this.#last, before: one, after: other})})),
      {heading: "Apart"},
      ...kSteps.map((each) => ({text: each === 1 ? "Every frame" : `${each} frames`, chosen: each === step,
                                act: () => this.#set({...this.#last, step: each})})),
    ];
  }
}
