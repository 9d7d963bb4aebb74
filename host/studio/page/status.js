// The last line: what is selected, how the renderer is, how fast pictures come.

import {element} from "./dom.js";

const kEvery = 500;  // ms

export class Status {
  constructor(place, {state, latencies}) {
    Object.assign(this, {state, latencies});
    this.selection = element("span", {class: "selection"});
    this.renderer = element("span", {class: "renderer"}, element("i", {class: "lamp"}), element("span", {}));
    this.nodes = element("span", {});
    this.rate = element("span", {class: "count"});
    this.latency = element("span", {class: "count", title: "From a hand's move to its picture: 95 of 100 come within this time"});
    place.prepend(this.selection);  // messages have what room there is
    place.append(this.rate, this.latency, this.nodes, this.renderer);
    state.on("project selected", () => this.#selected());
    state.on("renderer", () => this.showRenderer());
    setInterval(() => this.#measured(), kEvery);
    this.connected = false;
    this.showRenderer();
    this.#measured();
  }

  showRenderer() {
    const {renderer, nodes, machines} = this.state.renderer;
    const good = this.connected && renderer === "";
    this.renderer.classList.toggle("good", good);
    this.renderer.lastChild.textContent = !this.connected ? "Not connected" : good ? "Renderer ready" : "Renderer away";
    this.nodes.textContent = nodes ? `${counted(nodes, "node")}${machines > 1 ? ` on ${counted(machines, "machine")}` : ""}` : "";
  }

  #selected() {
    const {actor, joint, more} = this.state.selected;
    const names = this.state.isFilm() ? [actor, joint] : [joint];
    const first = names.filter((name) => name !== null).join(" \u203a ") || "Nothing selected";
    this.selection.textContent = [first, ...more].join(", ");
  }

  #measured() {
    const latency = this.latencies.percentile95();
    this.rate.textContent = `${this.latencies.rate(performance.now())} pictures/s`;
    this.latency.textContent = latency === null ? "" : `${Math.round(latency)} ms to a picture`;
  }
}

const counted = (number, what) => `${number} ${what}${number === 1 ? "" : "s"}`;
