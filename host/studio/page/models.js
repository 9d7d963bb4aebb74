// The models that can be put into a film, and their pictures (docs/studio-protocol.md, "Models"). The studio draws a
// picture when it is asked for, which is when its place comes into sight.

import {element} from "./dom.js";
import {icon} from "./icons.js";

const kMargin = 0.08;  // around a figure, of its larger side
const kPixels = 168;   // of a picture's sides

export class Models {
  #pictures = new Map();   // name -> {version, bitmap, problem}; while it is awaited {version}
  #places = new Set();     // of pictures on the page
  #sight = new IntersectionObserver((entries) => entries.filter(({isIntersecting}) => isIntersecting).forEach(({target}) => this.#ask(target.dataset.model)));
  #listeners = [];
  list = [];  // {name, what, kind, version}

  constructor(connection) {
    this.connection = connection;
    connection.on("connected", () => {
      for (const [name, {bitmap, problem}] of this.#pictures) if (!bitmap && !problem) this.#pictures.delete(name);
      connection.send({do: "models"});
    });
    connection.on("models", ({models}) => this.#take(models));
    connection.on("thumbnail", (message) => this.#paint(message));
  }

  whenListed(listener) { this.#listeners.push(listener); }

  // An element with the picture of the model, or of what will be one.
  picture(name) {
    const place = element("span", {class: "thumbnail", "data-model": name});
    this.#places.add(place);
    this.#show(place);
    this.#sight.observe(place);
    return place;
  }

  #take(models) {
    this.list = models;
    for (const listener of this.#listeners) listener();
    this.#inSightAgain();
  }

  // Pictures of files that have changed are asked for again, where somebody sees them.
  #inSightAgain() {
    for (const place of this.#placesThere()) {
      this.#sight.unobserve(place);
      this.#sight.observe(place);
    }
  }

  #placesThere() {
    for (const place of this.#places) {
      if (place.isConnected) continue;
      this.#sight.unobserve(place);
      this.#places.delete(place);
    }
    return this.#places;
  }

  #ask(name) {
    const version = this.list.find((each) => each.name === name)?.version, known = this.#pictures.get(name);
    if (known && known.version === version) return;
    if (this.connection.send({do: "thumbnail", model: name})) this.#pictures.set(name, {...known, version});
  }

  async #paint({model, version, png, problem}) {
    const bitmap = png && await createImageBitmap(new Blob([Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0))], {type: "image/png"}));
    this.#pictures.set(model, {version, bitmap, problem});
    for (const place of this.#placesThere()) if (place.dataset.model === model) this.#show(place);
  }

  #show(place) {
    const name = place.dataset.model, {bitmap, problem} = this.#pictures.get(name) ?? {};
    place.dataset.state = problem ? "problem" : bitmap ? "there" : "awaited";
    if (problem) place.replaceChildren(icon("warning"), element("span", {class: "why", title: problem}, problem));
    else if (bitmap) place.replaceChildren(painted(bitmap, name));
    else place.replaceChildren(element("span", {class: "awaited", role: "img", "aria-label": name}, icon("actor")));
  }
}

// The figure alone, as large as its place, on the picture's own ground.
function painted(bitmap, name) {
  const canvas = element("canvas", {role: "img", "aria-label": name, width: kPixels, height: kPixels});
  const paper = canvas.getContext("2d");
  const {ground, x, y, side} = figureOf(bitmap);
  paper.fillStyle = ground;
  paper.fillRect(0, 0, kPixels, kPixels);
  paper.imageSmoothingQuality = "high";
  paper.drawImage(bitmap, x, y, side, side, 0, 0, kPixels, kPixels);
  return canvas;
}

// The square round all that is not of the colour of the picture's corner.
function figureOf(bitmap) {
  const {width, height} = bitmap, paper = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
  paper.drawImage(bitmap, 0, 0);
  const {data} = paper.getImageData(0, 0, width, height), pixels = new Uint32Array(data.buffer);
  const ground = `rgb(${data[0]} ${data[1]} ${data[2]})`;
  let left = width, right = -1, top = height, bottom = -1;
  for (let at = 0; at < pixels.length; ++at) {
    if (pixels[at] === pixels[0]) continue;
    const column = at % width, row = (at - column) / width;
    left = Math.min(left, column);
    right = Math.max(right, column);
    top = Math.min(top, row);
    bottom = row;
  }
  if (right < 0) return {ground, x: 0, y: 0, side: width};
  const side = Math.max(right - left + 1, bottom - top + 1) * (1 + 2 * kMargin);
  return {ground, x: (left + right + 1 - side) / 2, y: (top + bottom + 1 - side) / 2, side};
}
