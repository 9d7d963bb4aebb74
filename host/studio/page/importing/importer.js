// Figures, objects and motions of other programs: their files are dropped on the page or chosen, go to the studio, and
// are read there by `mars import` (docs/studio-protocol.md, "Importing"). Files that come together are one import.

import {element} from "../dom.js";
import {icon} from "../icons.js";
import {chosenFiles, droppedFiles} from "./dropped.js";
import {ImportPanel} from "./import_panel.js";

const listed = (files) => files.map(({file, name}) => ({name, size: file.size}));
const hasFiles = ({dataTransfer}) => dataTransfer?.types.includes("Files") ?? false;

export class Importer {
  #going = null;    // {files, name, number, sent, state}: the import under way; how many files are sent; what the studio does
  #request = null;  // that sends a file

  options = {height: "", front: ""};  // of `mars import`; "": as is usual

  // `came(actors)` hears which actors the film has now.
  constructor(place, {state, connection, models}, came) {
    Object.assign(this, {state, connection, came});
    this.panel = new ImportPanel(place, {models, stop: () => this.#stop(), choose: () => this.choose(), without: () => this.#send({do: "import_more", files: []})});
    this.input = element("input", {type: "file", multiple: true, hidden: true, "aria-label": "Files to import", "data-key": "import.files",
                                   onchange: () => this.#chosen()});
    this.target = element("div", {class: "drop-target", hidden: true}, icon("import"), element("strong", {}, "Drop to import"),
                          element("span", {}, "GLB, glTF, VRM, FBX, COLLADA, OBJ, PLY, STL, POV, RIB, BVH, ASF and AMC, with their companions"));
    document.body.append(this.input, this.target);
    this.#takeDrops();
    connection.on("import", (message) => this.#hear(message));
    connection.on("gone", () => this.#fail("The connection to the studio broke: import the files again"));
  }

  choose() { this.input.click(); }

  async take(files) {
    if (this.#going?.state === "waiting") return this.#takeMore(files);
    if (this.#going) return this.panel.remind();
    if (files.length === 0) return;
    this.#going = {files, name: files.length === 1 ? files[0].name : `${files.length} files`, number: null, sent: 0, state: ""};
    if (this.#send({do: "import", files: listed(files), options: this.options})) this.panel.sending(this.#going.name, 0);
  }

  // What the import waits for may come with files that are there already.
  #takeMore(files) {
    const there = new Set(this.#going.files.map(({name}) => name)), more = files.filter(({name}) => !there.has(name));
    if (more.length === 0) return this.panel.remind();
    this.#going.state = "";
    this.#going.files.push(...more);
    this.#send({do: "import_more", files: listed(more)});
  }

  #send(message) {
    const left = this.connection.send(message);
    if (!left) this.#fail("The studio does not answer");
    return left;
  }

  // Whether the refused message was of an import.
  refused({do: what, text}) {
    if (what !== "import" && what !== "import_more") return false;
    if (what === "import_more") this.connection.send({do: "stop_import"});
    this.#fail(text);
    return true;
  }

  #chosen() {
    const files = chosenFiles(this.input.files);
    this.input.value = "";  // so that the same file can be chosen again
    this.take(files);
  }

  #takeDrops() {
    const show = (on) => { this.target.hidden = !on; };
    addEventListener("dragover", (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = "copy";
      show(true);
    });
    addEventListener("dragleave", ({relatedTarget}) => { if (relatedTarget === null) show(false); });
    addEventListener("drop", async (event) => {
      show(false);
      if (!hasFiles(event)) return;
      event.preventDefault();
      this.take(await droppedFiles(event.dataTransfer));
    });
  }

  #hear({state, number, name, text, missing, seconds, ...made}) {
    if (!this.#going) return;
    if (state === "receiving") this.#going.number = number;
    else if (number !== this.#going.number) return;  // of an import that this page has stopped
    this.#going.state = state;
    if (state === "receiving") {
      this.#sendFiles();
    } else if (state === "waiting") {
      this.panel.waiting(missing, seconds);
    } else if (state === "reading") {
      this.panel.reading(name);
    } else {
      this.#end();
      if (state === "failed") this.panel.failed(text);
      else if (state === "stopped") this.panel.close();
      else this.#done(made);
    }
  }

  #done(made) {
    this.panel.done(made);
    if (made.actors.length > 0) this.came(made.actors);
  }

  // One file after the other.
  async #sendFiles() {
    const going = this.#going, {name, sent: first} = going, files = going.files.slice(first);
    const whole = Math.max(1, files.reduce((sum, {file}) => sum + file.size, 0));
    going.sent = going.files.length;
    let sent = 0;
    for (const [at, {file}] of files.entries()) {
      const progress = (bytes) => { if (going.state === "receiving") this.panel.sending(name, (sent + bytes) / whole); };  // it may come late
      const problem = await this.#sendFile(first + at, file, progress);
      if (this.#going !== going) return;
      if (problem !== null) return this.#stop(problem);
      sent += file.size;
    }
  }

  // Resolves with what went wrong, or null.
  #sendFile(at, file, progress) {
    return new Promise((done) => {
      const request = new XMLHttpRequest();
      this.#request = request;
      request.upload.onprogress = ({loaded}) => progress(loaded);
      request.onload = () => done(request.status === 200 ? null : request.responseText.trim());
      request.onerror = () => done("A file could not be sent: import it again");
      request.onabort = () => done(null);
      request.open("POST", this.connection.addressOf(`import/${this.#going.number}/${at}`));
      request.send(file);
    });
  }

  #stop(problem = "") {
    this.connection.send({do: "stop_import"});
    if (problem !== "") this.#fail(problem);
  }

  #fail(text) {
    if (!this.#going) return;
    this.#end();
    this.panel.failed(text);
  }

  #end() {
    this.#going = null;
    this.#request?.abort();
    this.#request = null;
  }
}
