// Controls of panels. Each changes a value in gestures: `preview(value, event)` while it changes, `commit(value, event)`
// when it is done, `cancel()` when it is given up. Each has `root`, and `set(value)`, which leaves alone what a hand
// holds at that moment.

import {element, newId} from "./dom.js";
import {clamped, colorOf, hexOf, read, written} from "./numbers.js";
import {ofTab} from "./stores.js";

const kSettled = 400;      // ms after the last key: a change by keys is done
const kAllDigits = 6;
const kPixelsPerStep = 4;  // of a drag on a number's letter
const kNoNumber = "Write a number or an expression, such as 12.5+3*2, or a change of what was there, such as +=10.";

// Keys make many small changes: they are one gesture until they pause.
class Settling {
  #timer = 0;
  #commit = null;
  later(commit) {
    clearTimeout(this.#timer);
    this.#commit = commit;
    this.#timer = setTimeout(() => this.now(), kSettled);
  }
  now() {
    clearTimeout(this.#timer);
    const commit = this.#commit;
    this.#commit = null;
    commit?.();
  }
  drop() { clearTimeout(this.#timer); this.#commit = null; }
  get waits() { return this.#commit !== null; }
}

// A number to write, to step with arrows, to drag by its letter. `name` is for screen readers, `letter` is shown. All its
// digits show only while somebody writes it. Without a number (null) it shows the hint. Enter and Escape leave it: keys are
// the page's again.
export function numberField({name, letter = "", axis = letter, unit = "", step = 0.1, least, most, digits = 3, hint, key, preview, commit, cancel}) {
  const input = element("input", {type: "text", inputmode: "decimal", placeholder: hint, role: "spinbutton", "aria-label": name, autocomplete: "off",
                                  spellcheck: "false", "data-key": key, "aria-valuemin": least, "aria-valuemax": most});
  const handle = element("span", {class: `letter axis-${axis}`, "aria-hidden": "true"}, letter);
  const root = element("span", {class: "number"}, handle, input, unit && element("span", {class: "unit", "aria-hidden": "true"}, unit));
  const settling = new Settling();
  let value = 0, held = null;

  const textOf = (number, places) => number === null ? "" : written(number, places);
  const isWrong = () => input.validity.customError;
  const judge = (isNumber) => {
    input.setAttribute("aria-invalid", String(!isNumber));
    input.setCustomValidity(isNumber ? "" : kNoNumber);
  };
  const show = (number) => {
    judge(true);
    input.value = textOf(number, document.activeElement === input ? kAllDigits : digits);
    input.setAttribute("aria-valuenow", input.value);
  };
  const change = (number, event) => {
    held = clamped(Number(number.toFixed(6)), least, most);
    show(held);
    preview?.(held, event);
  };
  const done = (event) => {
    settling.drop();
    const changed = held;
    held = null;
    if (changed === null || changed === value) return;
    value = changed;
    commit(changed, event);
  };
  const giveUp = () => {
    settling.drop();
    if (held !== null) cancel?.();
    held = null;
    show(value);
  };

  input.addEventListener("focus", () => {
    show(value);
    input.select();
  });
  input.addEventListener("input", (event) => {
    if (value === null && input.value.trim() === "") return giveUp();
    const number = read(input.value, value);
    judge(number !== null);
    settling.drop();
    if (number === null) return;
    held = clamped(number, least, most);
    preview?.(held, event);
  });
  input.addEventListener("blur", (event) => {
    if (isWrong()) giveUp();
    else done(event);
    judge(true);
    input.value = textOf(value, digits);
  });
  input.addEventListener("keydown", (event) => {
    const direction = {ArrowUp: 1, ArrowDown: -1}[event.key];
    if (event.key === "Enter") {
      if (input.reportValidity()) input.blur();
    } else if (event.key === "Escape") {
      const isChanged = isHeld() || isWrong();
      giveUp();
      input.blur();
      if (!isChanged) return;
    } else if (direction) {
      change((held ?? value) + direction * step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1), event);
      settling.later(done);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  });
  dragged(handle, {
    by: (pixels, event) => change(value + Math.round(pixels / kPixelsPerStep) * step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1), event),
    done, giveUp,
  });

  const isHeld = () => held !== null;
  return {root, input, isHeld, set: (number) => {
    if (isHeld()) return;
    value = number;
    if (document.activeElement !== input || read(input.value) !== null) show(number);
  }};
}

// `handle` is dragged to the left and right.
function dragged(handle, {by, done, giveUp}) {
  let from = null;
  handle.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    event.preventDefault();
    handle.setPointerCapture(event.pointerId);
    from = event.clientX;
  });
  handle.addEventListener("pointermove", (event) => { if (from !== null) by(event.clientX - from, event); });
  handle.addEventListener("pointerup", (event) => { if (from !== null) { from = null; done(event); } });
  handle.addEventListener("lostpointercapture", () => { if (from !== null) { from = null; giveUp(); } });
}

// Numbers in a row; `parts` says what each is. With `letters` each shows that.
export function severalField({name, key, parts, letters = false, preview, commit, ...rest}) {
  let values = parts.map(() => 0);
  const changed = (at, number) => values.map((each, i) => i === at ? number : each);
  const fields = parts.map((part, at) => numberField({
    ...rest, name: `${name} ${part}`, letter: letters ? part : "", key: `${key}.${part}`,
    preview: preview && ((number, event) => preview(changed(at, number), event)),
    commit: (number, event) => { values = changed(at, number); commit(values, event); },
  }));
  return {
    root: element("div", {class: letters ? "vector" : "several", role: "group", "aria-label": name}, fields.map(({root}) => root)),
    set: (list) => {
      if (fields.some((field) => field.isHeld())) return;
      if (list) values = [...list];
      fields.forEach((field, at) => field.set(list?.[at] ?? null));
    },
  };
}

export const vectorField = (options) => severalField({...options, parts: [..."xyz"], letters: true});

// A slider and its number, which may lie beyond the slider's ends, within `bounds`.
export function sliderField({name, title = "", letter = "", label = "", axis = letter, unit = "", least, most, bounds = [least, most], step = 1, key, digits = 2, preview, commit, cancel}) {
  const range = element("input", {type: "range", min: least, max: most, step: "any", "aria-label": name, title, "data-key": key});
  const settling = new Settling();
  let value = 0, byPointer = false, held = false;
  const shareOf = (number) => (clamped(number, least, most) - least) / (most - least || 1);

  const show = (number) => {
    range.value = number;
    range.setAttribute("aria-valuetext", `${written(number, digits)}${unit}`);
    fillTrack(range, shareOf(number), shareOf(0));
  };
  const number = numberField({
    name: `${name}, as a number`, letter, axis, unit, least: bounds[0], most: bounds[1], step, digits, key: `${key}.number`, cancel,
    preview: (changed, event) => { show(changed); preview?.(changed, event); },
    commit: (changed, event) => { value = changed; commit(changed, event); },
  });
  const done = (event) => {
    settling.drop();
    const now = Number(Number(range.value).toFixed(digits));
    if (held && now !== value) {
      value = now;
      commit(now, event);
    }
    held = false;
  };
  const change = (to, event) => {
    held = true;
    const now = Number(clamped(to, least, most).toFixed(digits));
    show(now);
    number.set(now);
    preview?.(now, event);
  };

  range.addEventListener("pointerdown", () => { byPointer = true; });
  range.addEventListener("input", (event) => { if (byPointer || !held) change(Number(range.value), event); });
  range.addEventListener("change", (event) => { byPointer = false; done(event); });
  range.addEventListener("blur", (event) => { byPointer = false; done(event); });
  range.addEventListener("keydown", (event) => {
    const steps = {ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10}[event.key];
    const ends = {Home: least, End: most}[event.key];
    if (event.key === "Escape" && held) {
      held = byPointer = false;
      settling.drop();
      cancel?.();
      show(value);
      number.set(value);
    } else if (steps !== undefined) {
      change(Number(range.value) + steps * step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1), event);
      settling.later(done);
    } else if (ends !== undefined) {
      change(ends, event);
      settling.later(done);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  });

  return {
    root: element("div", {class: "slider"}, label && element("span", {class: "label", "aria-hidden": "true"}, label), range, number.root),
    set: (now) => {
      if (held) return;
      value = now;
      show(now);
      number.set(now);
    },
  };
}

// A slider's track shows how far it is from `zero`; both are shares of its length.
export function fillTrack(range, filled, zero = 0) {
  range.style.setProperty("--filled", filled);
  range.style.setProperty("--zero", zero);
}

// `options`: [value, text]; null as a value is "".
export function choice({name, options, key, commit}) {
  const select = element("select", {"aria-label": name, "data-key": key});
  const fill = (list) => select.replaceChildren(...list.map(([value, text]) => element("option", {value: value ?? ""}, text)));
  fill(options);
  select.addEventListener("change", (event) => commit(select.value === "" ? null : select.value, event));
  return {root: element("span", {class: "choice"}, select), fill, set: (value) => { select.value = value ?? ""; }};
}

// The same for many options, which are made when somebody uses it; `textOf(value)`: how a value shows until then.
export function longChoice({options, textOf, ...rest}) {
  const made = choice({...rest, options: [[null, textOf(null)]]});
  const select = made.root.querySelector("select");
  let whole = false;
  const show = (value) => {
    if (!whole && select.value !== (value ?? "")) made.fill([[value, textOf(value)]]);
    made.set(value);
  };
  const fill = () => {
    if (whole) return;
    whole = true;
    const {value} = select;
    made.fill(options());
    select.value = value;
  };
  for (const use of ["pointerdown", "focus"]) select.addEventListener(use, fill);
  return {root: made.root, set: show};
}

export function toggle({name, text, key, commit}) {
  const box = element("input", {type: "checkbox", "aria-label": name, "data-key": key});
  box.addEventListener("change", (event) => commit(box.checked, event));
  return {root: element("label", {class: "check"}, box, text), set: (on) => { box.checked = on; }};
}

export function textField({name, key, hint = "", commit}) {
  const input = element("input", {type: "text", "aria-label": name, "data-key": key, placeholder: hint, autocomplete: "off", spellcheck: "false"});
  let value = "";
  const done = (event) => {
    const text = input.value.trim();
    if (text === value || text === "") { input.value = value; return; }
    value = text;
    commit(text, event);
  };
  input.addEventListener("blur", done);
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") done(event);
    else if (event.key === "Escape") input.value = value;
    else return;
    event.stopPropagation();
    input.blur();
  });
  return {root: input, input, set: (text) => {
    value = text;
    if (document.activeElement !== input) input.value = text;
  }};
}

// Without a colour (null) it is white and says so.
export function colorField({name, key, preview, commit}) {
  const input = element("input", {type: "color", "aria-label": name, "data-key": key});
  const hex = element("output", {class: "hex"});
  let held = false;
  const show = () => { hex.textContent = input.value.toUpperCase(); };
  input.addEventListener("input", (event) => { held = true; show(); preview?.(colorOf(input.value), event); });
  input.addEventListener("change", (event) => { held = false; show(); commit(colorOf(input.value), event); });
  return {root: element("label", {class: "color"}, input, hex), set: (color) => {
    if (held) return;
    input.value = hexOf(color ?? [1, 1, 1]);
    show();
    if (!color) hex.textContent = "default";
  }};
}

// A line of a panel: its label and its control.
export const line = (label, ...controls) =>
  element("div", {class: "line"}, element("span", {class: "label", "aria-hidden": "true"}, label), element("div", {class: "controls"}, controls));

// A part of a panel that shuts. Which are shut is kept in this tab.
export const part = (title, ...children) => folded({kept: `part ${title}`, title, heading: "h3", usually: "open"}, children);

// Controls that are seldom needed within a part, shut at first. `of`: the part.
export const more = (of, ...children) => folded({kept: `more ${of}`, title: "More", heading: "h4", usually: "shut"}, children);

function folded({kept, title, heading, usually}, children) {
  const id = newId("part");
  const summary = element("summary", {id, "data-key": kept}, element(heading, {}, title));
  const details = element("details", {class: heading === "h4" ? "part more" : "part", open: (ofTab.get(kept) ?? usually) === "open"}, summary,
                          element("div", {class: "body", role: "group", "aria-labelledby": id}, children));
  details.addEventListener("toggle", () => ofTab.set(kept, details.open ? "open" : "shut"));
  return details;
}
