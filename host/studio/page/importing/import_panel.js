// How an import goes, and what came of it. It stays over a corner of the views until somebody closes it.

import {element} from "../dom.js";
import {icon} from "../icons.js";

const kTick = 250;      // ms
const kTitle = 13;      // characters in a line of a report before its text
const kMissing = "not read";

export class ImportPanel {
  #timer = 0;
  #since = 0;

  constructor(place, {models, stop, choose, without}) {
    Object.assign(this, {place, models, choose, without});
    this.stop = element("button", {"data-key": "import.stop", onclick: stop}, "Stop");
    this.bar = element("progress", {max: 1, "aria-label": "How much is sent"});
    this.text = element("p", {class: "hint", role: "status"});
  }

  // `share` of the bytes are sent.
  sending(name, share) {
    this.#going(name);
    this.bar.value = share;
    this.text.textContent = share < 1 ? `Sending, ${Math.floor(share * 100)} %` : "Sent";
  }

  reading(name) {
    this.#going(name);
    this.bar.removeAttribute("value");
    this.#since = performance.now();
    const show = () => { this.text.textContent = `mars import reads it, ${Math.floor((performance.now() - this.#since) / 1000)} s`; };
    show();
    this.#timer = setInterval(show, kTick);
  }

  // For files that others name: [{name, of, needed}]. What is not needed can be left out.
  waiting(missing, seconds) {
    const end = performance.now() + seconds * 1000, canGoOn = missing.every(({needed}) => !needed);
    const left = element("span", {class: "hint", role: "timer"});
    const show = () => { left.textContent = `Waits ${clock(Math.max(0, end - performance.now()))}`; };
    const buttons = [element("button", {class: "primary", "data-key": "import.rest", onclick: this.choose}, "Choose files"),
                     canGoOn && element("button", {"data-key": "import.without", onclick: this.without}, "Import without"), this.stop];
    this.#show("waiting", "import", "Files are missing", element("ul", {}, missing.map(({name, of}) => element("li", {}, element("strong", {}, shown(name)), ` of ${of}`))),
               element("p", {class: "remedy", role: "status"}, canGoOn ? "Drop them on the page, too, or import without them." : "Drop them on the page, too."),
               element("div", {class: "way"}, left, element("div", {class: "several"}, buttons.filter(Boolean))));
    show();
    this.#timer = setInterval(show, kTick);
  }

  done({files, actors, reports}) {
    const open = actors.length === 0 && element("p", {class: "hint"}, `Open it with mars studio ${files.join(" ")}`);
    this.#show("done", "check", "Imported", reports.map((report, i) => this.#made(files[i], report)), open);
  }

  // The remedy stands in parentheses at the end.
  failed(text) {
    const [, problem, remedy] = /^([^]*?)(?: \(([^]*)\))?$/.exec(text);
    this.#show("failed", "error", "Not imported", element("p", {class: "problem"}, problem), remedy && element("p", {class: "remedy"}, sentence(remedy)));
  }

  close() {
    clearInterval(this.#timer);
    this.place.hidden = true;
    this.place.replaceChildren();
    delete this.place.dataset.state;
  }

  // That one import is under way already.
  remind() { this.place.animate([{transform: "none"}, {transform: "translateY(-6px)"}, {transform: "none"}], 250); }

  #made(file, report) {
    const [name, what, rows] = reportParts(report);
    const picture = what.textContent.startsWith("Model") && this.models.picture(file);  // a motion is a film
    return element("section", {class: "made"}, element("div", {class: "model"}, picture, element("div", {}, name, what)), rows);
  }

  #going(name) {
    clearInterval(this.#timer);
    if (this.place.dataset.state === "going" && this.place.dataset.name === name) return;
    this.place.dataset.name = name;
    this.#show("going", "import", name, this.bar, element("div", {class: "way"}, this.text, this.stop));
  }

  #show(state, glyph, title, ...children) {
    clearInterval(this.#timer);
    const close = element("button", {class: "quiet icon", "aria-label": "Close", title: "Close", "data-key": "import.close", onclick: () => this.close()}, icon("close"));
    this.place.dataset.state = state;
    this.place.replaceChildren(element("header", {}, icon(glyph), element("h2", {}, title), state !== "going" && state !== "waiting" && close),
                               ...[children].flat(Infinity).filter(Boolean));
    this.place.hidden = false;
  }
}

const clock = (ms) => `${Math.floor(ms / 60000)}:${String(Math.floor(ms / 1000) % 60).padStart(2, "0")}`;
const shown = (name) => name.endsWith("*.asf") ? "The skeleton (.asf)" : name;
const sentence = (text) => text[0].toUpperCase() + text.slice(1);

// Of lines like "rock.json: model of one joint 'rock'" and "  read       8 vertices, 12 faces": see mars import.
function reportParts(report) {
  const [first, ...lines] = report.trimEnd().split("\n");
  const at = first.indexOf(": ");
  const rows = [];
  for (const line of lines) {
    const title = line.slice(0, kTitle).trim(), text = line.slice(kTitle);
    if (title !== "") rows.push({title, texts: [text]});
    else rows.at(-1)?.texts.push(text);
  }
  return [element("h3", {}, first.slice(0, at)), element("p", {class: "what"}, sentence(first.slice(at + 2))),
          element("dl", {}, rows.map(row))];
}

function row({title, texts}) {
  const missing = title === kMissing && !texts[0].startsWith("nothing");
  return element("div", {class: missing ? "missing" : null}, element("dt", {}, sentence(title)),
                 element("dd", {}, texts.map((text) => element("p", {}, text))));
}
