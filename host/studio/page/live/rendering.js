// The workspace of a rendering: how it is started and how it goes, the frame that nodes draw at the moment, who works on
// what (docs/studio-protocol.md, "Rendering").

import {element} from "../dom.js";
import {fillTrack} from "../fields.js";
import {DrawnFrame} from "./drawn_frame.js";
import {LoadTimeline} from "./load_timeline.js";
import {RenderForm} from "./render_form.js";

export class Rendering {
  constructor(place, formPlace, {connection, state, painter}) {
    this.frame = new DrawnFrame(painter);
    this.timeline = new LoadTimeline();
    this.form = new RenderForm(formPlace, {connection, state});
    this.caption = element("p", {class: "caption", "aria-live": "polite"});
    place.append(element("div", {class: "stage-bar"}, this.caption, this.frame.switches), this.frame.root, this.timeline.root,
                 this.#scrubber(connection));
    connection.on("rendering", (message) => this.#rendering(message));
    connection.on("drawn", (message) => this.#drawn(message));
  }

  #scrubber(connection) {
    this.scrub = element("input", {type: "range", min: 0, max: 0, step: 1, "aria-label": "Finished frames"});
    this.live = element("button", {"aria-pressed": "true"}, "Live");
    this.scrub.addEventListener("input", () => {
      this.live.setAttribute("aria-pressed", "false");
      connection.send({do: "scrub", frame: Number(this.scrub.value)});
    });
    this.live.addEventListener("click", () => {
      this.live.setAttribute("aria-pressed", "true");
      connection.send({do: "scrub", frame: null});
    });
    this.bar = element("div", {class: "scrub", hidden: true}, this.scrub, this.live);
    return this.bar;
  }

  #rendering(message) {
    this.form.show(message);
    this.timeline.setNodes(message.nodes ?? []);
    this.bar.hidden = !(message.of > 0);
    this.scrub.max = Math.max(0, (message.of ?? 1) - 1);
    if (message.state === "starting") this.timeline.clear();
  }

  #drawn(message) {
    const {frame, kind, interval, whole} = message;
    this.caption.replaceChildren(element("strong", {}, `Frame ${frame}`), ` ${kind} of interval ${interval}${whole ? "" : ", being drawn"}`);
    if (this.live.getAttribute("aria-pressed") === "true") this.scrub.value = frame;
    fillTrack(this.scrub, this.scrub.value / (Number(this.scrub.max) || 1));
    this.frame.describe(message);
    if (message.whole && message.nodes?.some(({seconds}) => seconds)) this.timeline.add(message);
  }
}
