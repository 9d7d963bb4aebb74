// In films: the frame that is shown, to scrub and to play, by the film's clock.

import {element} from "./dom.js";
import {fillTrack, numberField} from "./fields.js";
import {icon, setIcon} from "./icons.js";
import {clamped} from "./numbers.js";
import {keysOf} from "./shortcuts.js";

const kEvery = 500;  // ms between two counts of pictures

export class Frames {
  #playing = null;  // {from, began, counted}

  constructor(place, {state, edits, latencies}) {
    Object.assign(this, {place, state, edits, latencies});
    const button = (glyph, text, keys, act) =>
      element("button", {class: "quiet icon", "aria-label": text, title: `${text} (${keys})`, onclick: act}, icon(glyph));
    this.playButton = button("play", "Play", keysOf("play"), () => this.play());
    this.slider = element("input", {type: "range", min: 0, step: 1, "aria-label": "Frame"});
    this.slider.addEventListener("input", (event) => this.scrub(Number(this.slider.value), event));
    this.number = numberField({name: "Frame, as a number", step: 1, digits: 0, key: "frame", commit: (frame, event) => this.scrub(frame, event)});
    this.of = element("span", {class: "of"});
    this.rate = element("span", {class: "of rate", title: "Frames that show, of those that the film has in a second"});
    place.append(element("div", {class: "group"}, button("first", "First frame", "Home", (event) => this.end(false, event)),
                         button("before", "Frame before", ",", (event) => this.step(-1, event)), this.playButton,
                         button("next", "Next frame", ".", (event) => this.step(1, event)),
                         button("last", "Last frame", "End", (event) => this.end(true, event))),
                 this.number.root, this.of, this.rate, this.slider);
    state.on("project poses workspace", () => this.#show());
  }

  go(frame, event) {
    const {project} = this.state;
    const to = clamped(Math.round(frame), 0, project.frames - 1);
    if (to === project.frame) return;
    project.frame = to;
    this.edits.frame(to, event);
    this.#show();
    this.state.tell("frame");
  }

  scrub(frame, event) { this.#stop(); this.go(frame, event); }
  step(by, event) { this.scrub(this.state.project.frame + by, event); }
  end(last, event) { this.scrub(this.range()[last ? 1 : 0], event); }

  // Frames that play.
  range() {
    const last = (this.state.project?.frames ?? 1) - 1;
    const [from, to] = this.state.range ?? [0, last];
    return [Math.min(from, last), Math.min(to, last)];
  }

  setRange(first, last) {
    const most = this.state.project.frames - 1;
    const from = clamped(first, 0, most), to = clamped(last, from, most);
    this.state.set("range", from === 0 && to === most ? null : [from, to]);
  }

  beginRange() { this.setRange(this.state.project.frame, Math.max(this.state.project.frame, this.range()[1])); }
  endRange() { this.setRange(Math.min(this.state.project.frame, this.range()[0]), this.state.project.frame); }

  play() {
    if (this.#playing) return this.#stop();
    const {frame} = this.state.project, [first, last] = this.range(), began = performance.now();
    this.#playing = {from: frame < first || frame >= last ? first : frame, began, counted: began};
    setIcon(this.playButton, "pause");
    this.playButton.setAttribute("aria-label", "Pause");
    requestAnimationFrame((now) => this.#advance(now));
  }

  // By the clock: frames that come too late are left out.
  #advance(now) {
    if (!this.#playing) return;
    const {from, began} = this.#playing, [first, last] = this.range(), {rate = 24} = this.state.project;
    const frames = last - first + 1, went = Math.max(0, Math.floor((now - began) * rate / 1000));
    this.go(first + (Math.max(0, from - first) + went) % frames, {timeStamp: now});
    if (now - this.#playing.counted > kEvery) {
      this.#playing.counted = now;
      this.rate.textContent = `${Math.min(Math.round(rate), this.latencies.rateOf(this.state.activeView, now))} of ${rate}/s`;
    }
    requestAnimationFrame((next) => this.#advance(next));
  }

  #stop() {
    if (!this.#playing) return;
    this.#playing = null;
    this.rate.textContent = "";
    setIcon(this.playButton, "play");
    this.playButton.setAttribute("aria-label", "Play");
  }

  #show() {
    const {project} = this.state;
    this.place.hidden = !this.state.isFilm() || this.state.workspace !== "scene";
    if (!this.state.isFilm()) return;
    const last = project.frames - 1;
    this.slider.max = last;
    this.slider.value = project.frame;
    fillTrack(this.slider, project.frame / (last || 1));
    this.number.set(project.frame);
    this.of.textContent = `of ${last}`;
  }
}
