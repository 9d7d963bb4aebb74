// Scripts: texts that say who does what and when (docs/motion.md, "Scripts"). They are checked while they are written;
// what is wrong shows at its line.

import {element} from "../dom.js";
import {choice, textField, toggle} from "../fields.js";

const kPause = 300;  // ms without a key, before the text is checked

export class Scripts {
  #timer = 0;
  #known = new Map();  // name -> text as it is stored
  #name = "";
  #line = 0;           // that is wrong; 0: none
  #lengthens = true;   // the film, where the script ends later

  constructor(place, {connection, state, edits}) {
    Object.assign(this, {connection, state, edits, shown: false});
    this.files = choice({name: "Script", options: [], key: "script.file", commit: (name) => this.#open(name ?? "")});
    this.nameField = textField({name: "Name of the script", key: "script.name", hint: "new.script", commit: (name) => { this.#name = name; this.#check(); }});
    this.lengthen = toggle({name: "Lengthen the film", text: "May lengthen the film", key: "script.lengthen", commit: (on) => { this.#lengthens = on; }});
    this.lengthen.set(true);
    this.apply = element("button", {class: "primary", "data-key": "script.apply", onclick: (event) => this.#apply(event)}, "Apply");
    this.numbers = element("ol", {class: "line-numbers", "aria-hidden": "true"});
    this.text = element("textarea", {"aria-label": "Text of the script", "data-key": "script.text", spellcheck: "false", wrap: "off", autocapitalize: "off",
                                     placeholder: "at 0  tom walk to 2 0\nthen  tom wave hand left"});
    this.problem = element("p", {class: "script-problem", role: "status"});
    this.text.addEventListener("input", () => { this.#show(); this.#checkSoon(); });
    this.text.addEventListener("scroll", () => { this.numbers.scrollTop = this.text.scrollTop; });
    place.classList.add("scripts");
    place.append(element("div", {class: "script-bar"}, this.files.root, this.nameField.root, this.problem, this.lengthen.root, this.apply),
                 element("div", {class: "script-text"}, this.numbers, this.text));
    connection.on("scripts", ({scripts}) => this.#scripts(scripts));
    connection.on("script", (message) => this.#checked(message));
    connection.on("connected", () => this.show(this.shown));
    this.#show();
  }

  show(on) {
    this.shown = on;
    if (on && this.state.isFilm()) this.connection.send({do: "scripts"});
  }

  #scripts(scripts) {
    this.#known = new Map(scripts.map(({name, text}) => [name, text]));
    this.files.fill([[null, "New script"], ...scripts.map(({name}) => [name, name])]);
    if (this.#name === "" && this.text.value === "" && scripts.length) this.#open(scripts[0].name);
    else this.files.set(this.#known.has(this.#name) ? this.#name : null);
  }

  #open(name) {
    this.#name = name;
    this.files.set(name);
    this.nameField.set(name);
    this.text.value = this.#known.get(name) ?? "";
    this.#check();
  }

  #checkSoon() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#check(), kPause);
  }

  #check() {
    clearTimeout(this.#timer);
    this.#line = 0;
    this.#say("");
    if (this.text.value.trim() !== "") this.connection.send({do: "script", text: this.text.value, name: this.#named()});
    this.#show();
  }

  #checked({problem, report}) {
    this.#line = problem?.line ?? 0;
    this.#say(problem ? (problem.line ? `Line ${problem.line}: ${problem.text}` : problem.text) : report?.at(-1) ?? "", Boolean(problem));
    this.#show();
  }

  #say(text, bad = false) {
    this.problem.textContent = text;
    this.problem.title = text;
    this.problem.classList.toggle("bad", bad);
    this.text.setAttribute("aria-invalid", String(bad));
    this.apply.disabled = bad || this.text.value.trim() === "";
  }

  #show() {
    const count = this.text.value.split("\n").length;
    if (this.numbers.children.length !== count) this.numbers.replaceChildren(...Array.from({length: count}, (_, i) => element("li", {}, i + 1)));
    [...this.numbers.children].forEach((item, i) => item.classList.toggle("bad", i + 1 === this.#line));
    this.numbers.scrollTop = this.text.scrollTop;
  }

  #named() { return this.#name || this.nameField.input.value.trim() || "new.script"; }

  #apply(event) {
    this.#name = this.#named();
    this.nameField.set(this.#name);
    this.edits.commit({script: {name: this.#name, text: this.text.value, lengthen: this.#lengthens}}, event);
    this.connection.send({do: "scripts"});
  }
}
