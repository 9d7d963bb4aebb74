// A small form that a button opens over the page; Escape and a click elsewhere shut it.

import {element} from "./dom.js";
import {numberField} from "./fields.js";
import {besides} from "./menu.js";

export function openPopover(anchor, name, ...children) {
  const root = element("div", {class: "popover", popover: "auto", role: "dialog", "aria-label": name}, children);
  document.body.append(root);
  root.addEventListener("toggle", ({newState}) => {
    if (newState !== "closed") return;
    root.remove();
    if (document.activeElement === document.body) anchor.focus({preventScroll: true});
  });
  root.showPopover();
  besides(root, anchor);
  return root;
}

// Asks before what is more than a small step; `act(event)` where the person agrees.
export function askFirst(anchor, title, text, yes, act) {
  const agree = element("button", {class: "primary", "data-key": "ask.yes", onclick: (event) => {
    root.hidePopover();
    act(event);
  }}, yes);
  const root = openPopover(anchor, title, element("h3", {}, title), element("p", {class: "hint"}, text), agree);
  agree.focus();
}

// Asks for numbers: [{name, value, ...of numberField}]; `apply(values, event)`.
export function askNumbers(anchor, title, hint, numbers, apply) {
  const values = numbers.map(({value}) => value);
  const fields = numbers.map(({name, value, ...rest}, i) => {
    const field = numberField({name, ...rest, preview: (number) => { values[i] = number; }, commit: (number) => { values[i] = number; }});
    field.set(value);
    return element("label", {class: "line"}, element("span", {class: "label"}, name), field.root);
  });
  const done = (event) => {
    root.hidePopover();
    apply(values, event);
  };
  const form = element("form", {}, element("h3", {}, title), hint && element("p", {class: "hint"}, hint), fields,
                       element("button", {class: "primary"}, "Apply"));
  form.addEventListener("submit", (event) => { event.preventDefault(); done(event); });
  form.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || !event.target.matches("input")) return;
    event.stopPropagation();
    event.preventDefault();
    if (form.reportValidity()) done(event);
  }, true);  // before the number that has the focus
  const root = openPopover(anchor, title, form);
  root.querySelector("input").focus();
}
