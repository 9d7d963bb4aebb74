// Paints pictures as they come, each in its view's order, all of an animation frame together, and tells the studio after
// the paint. What follows a frame's paint is the first task after it: a message to ourselves.

import {decode, paint, readPicture} from "./pictures.js";

export class Painter {
  #surfaces = new Map();  // view -> {surface, last: promise of the picture before}
  #ready = [];
  #afterPaint = new MessageChannel();
  #painted = [];

  constructor(connection, latencies) {
    this.connection = connection;
    this.latencies = latencies;
    connection.on("picture", (buffer) => this.#take(buffer));
    this.#afterPaint.port1.onmessage = () => this.#acknowledge();
  }

  // `surface` has `context`; its `painting(picture)` is called just before a picture is painted.
  add(view, surface) { this.#surfaces.set(view, {surface, last: null}); }

  #take(buffer) {
    const picture = readPicture(buffer);
    const target = picture && this.#surfaces.get(picture.view);
    if (!target) return;
    const decoded = decode(picture);
    if (!(decoded instanceof Promise) && target.last === null) return this.#add(target, decoded);
    const turn = Promise.all([decoded, target.last]).then(([ready]) => {
      this.#add(target, ready);
      if (target.last === turn) target.last = null;
    }, (failure) => {
      if (target.last === turn) target.last = null;
      this.#acknowledgeUnpainted(picture, failure);
    });
    target.last = turn;
  }

  #add(target, picture) {
    this.#ready.push({target, picture});
    if (this.#ready.length === 1) requestAnimationFrame(() => this.#paintAll());
  }

  #paintAll() {
    const ready = this.#ready;
    this.#ready = [];
    for (const {target, picture} of ready) {
      target.surface.painting(picture);
      paint(target.surface.context, picture);
      this.#painted.push(picture);
    }
    this.#afterPaint.port2.postMessage(0);
  }

  #acknowledge() {
    const now = performance.now();
    for (const {view, picture, edit} of this.#painted) {
      this.latencies.painted(view, edit, now);
      this.connection.send({do: "painted", view, picture});
    }
    this.#painted = [];
  }

  // A picture that cannot be decoded must not stop its view.
  #acknowledgeUnpainted({view, picture}, failure) {
    console.warn(`picture ${picture} of view ${view}: ${failure}`);
    this.connection.send({do: "painted", view, picture});
  }
}
