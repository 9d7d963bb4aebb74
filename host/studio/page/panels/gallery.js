// Pictures of the library's models, to choose one from. MARS renders them in the background; until they are there, their
// names do.

import {element} from "../dom.js";

const kPixels = 128;  // a side

export class Gallery {
  #pictures = new Map();  // by names: elements that stay when the panel is made again
  #asked = false;

  constructor(connection) {
    this.connection = connection;
    connection.on("thumbnail", ({model, picture}) => this.#paint(model, picture));
    connection.on("gone", () => { this.#asked = false; });
  }

  // Buttons of [{name, what}]; `act(name, event)`.
  buttons(models, act) {
    if (!this.#asked) this.#asked = this.connection.send({do: "thumbnails"});
    const one = ({name, what}) => element("button", {class: "model", title: what, "data-model": name, onclick: (event) => act(name, event)},
                                          this.#picture(name), element("span", {}, name));
    return element("div", {class: "gallery"}, models.map(one));
  }

  #picture(name) {
    if (!this.#pictures.has(name)) this.#pictures.set(name, element("canvas", {width: kPixels, height: kPixels}));
    return this.#pictures.get(name);
  }

  // `picture`: a PNG file in base64.
  async #paint(name, picture) {
    const bytes = Uint8Array.from(atob(picture), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], {type: "image/png"}));
    this.#picture(name).getContext("2d").drawImage(image, 0, 0, kPixels, kPixels);
    this.#picture(name).dataset.painted = "";
    image.close();
  }
}
