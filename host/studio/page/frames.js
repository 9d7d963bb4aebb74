// In films: the frame that is shown, to scrub and to play.

import {element} from "./dom.js";
import {fillTrack, numberField} from "./fields.js";
import {icon, setIcon} from "./icons.js";
import {clamped} from "./numbers.js";
import {keysOf} from "./shortcuts.js";

export class Frames {
  #playing = null;  // {from, began}

  constructor(place, {state, edits}) {
    Object.assign(this, {place, state, edits});
    const button = (glyph, text, keys, act) =>
      element("button", {class: "quiet icon", "aria-label": text, title: `${text} (${keys})`, onclick: act}, icon(glyph));
    this.playButton = button("play", "Play", keysOf("play"), () => this.play());
    this.range = element("input", {type: "range", min: 0, step: 1, "aria-label": "Frame"});
    this.range.addEventListener("input", (event) => { this.#stop(); this.go(Number(this.range.value), event); });
    this.number = numberField({name: "Frame, as a number", step: 1, digits: 0, key: "frame", commit: (frame, event) => this.go(frame, event)});
    this.of = element("span", {class: "of"});
    place.append(element("div", {class: "group"}, button("before", "Frame before", ",", (event) => this.step(-1, event)), this.playButton,
                         button("next", "Next frame", ".", (event) => this.step(1, event))),
                 this.range, this.number.root, this.of);
    state.on("project poses workspace", () => this.#show());
  }

  go(frame, event) {
    const {project} = this.state;
    const to = clamped(Math.round(frame), 0, project.frames - 1);
    project.frame = to;
    this.edits.frame(to, event);
    this.#show();
  }

  step(by, event) { this.#stop(); this.go(this.state.project.frame + by, event); }
  end(last, event) { this.#stop(); this.go(last ? this.state.project.frames - 1 : 0, event); }

  play() {
    if (this.#playing) return this.#stop();
    const {frame, frames} = this.state.project;
    this.#playing = {from: frame === frames - 1 ? 0 : frame, began: performance.now()};
    setIcon(this.playButton, "pause");
    this.playButton.setAttribute("aria-label", "Pause");
    requestAnimationFrame((now) => this.#advance(now));
  }

  // By the clock: frames that come too late are left out.
  #advance(now) {
    if (!this.#playing) return;
    const {rate = 24, frames, frame} = this.state.project;
    const due = (this.#playing.from + Math.max(0, Math.floor((now - this.#playing.began) * rate / 1000))) % frames;
    if (due !== frame) this.go(due, {timeStamp: now});
    requestAnimationFrame((next) => this.#advance(next));
  }

  #stop() {
    this.#playing = null;
    setIcon(this.playButton, "play");
    this.playButton.setAttribute("aria-label", "Play");
  }

  #show() {
    const {project} = this.state;
    this.place.hidden = !this.state.isFilm() || this.state.workspace !== "scene";
    if (!this.state.isFilm()) return;
    const last = project.frames - 1;
    this.range.max = last;
    this.range.value = project.frame;
    fillTrack(this.range, project.frame / (last || 1));
    this.number.set(project.frame);
    this.of.textContent = `of ${last}`;
  }
}
