// Fields of the keys of film files, made from the table of keys that comes with a film (`project.keys`, by
// host/content/keys): a key's type decides its control; its label, unit, range, default and meaning decide the rest. A
// new key of a type that is known here has a field without a line of this page.

import {choice, colorField, line, more, numberField, severalField, textField, toggle, vectorField} from "../../fields.js";
import {written} from "../../numbers.js";

const kUnits = {degrees: "°"};

// What a type's values are changed by. What has choices or parts needs none of its own; others are written as text.
const kControls = {
  number: numberField, whole: (options) => numberField({...options, digits: 0}), color: colorField, vector: vectorField,
  flag: (options) => toggle({...options, text: ""}),
  // Of a point that goes along with an actor, the place; of light from above and below, what is from above.
  place_or_point: vectorField,
  color_or_ambient: (options) => {
    const made = colorField(options);
    return {...made, set: (value) => made.set(value?.sky ?? value)};
  },
};

const titled = (name) => name[0].toUpperCase() + name.slice(1).replaceAll("_", " ");

const textOf = (value) => [value].flat().map((each) => typeof each === "number" ? written(each, 6) : each).join(",");

// A tenth of the power of ten below what is usual: 1 for 40, 0.1 for 1.
function stepOf({type, default: usual}) {
  const size = Math.abs([usual].flat()[0]);
  if (type === "whole") return 1;
  return size > 0 ? 10 ** (Math.floor(Math.log10(size)) - 1) : 0.1;
}

function meaningOf({meaning, unit, least, most, without, default: usual}) {
  const range = Math.abs(most) < 1e9 && least !== undefined ? ` (${least} to ${most}${unit ? ` ${unit}` : ""})` : "";
  const otherwise = without ?? (usual === undefined ? "" : textOf(usual));
  const text = `${titled(meaning)}${range}.${otherwise === "" ? "" : ` Default: ${otherwise}.`}`;
  return text.replaceAll("`", "");
}

function writtenField(options) {
  const made = textField(options);
  return {...made, set: (value) => made.set(value === null ? "" : textOf(value))};
}

function controlOf({type, choices, parts}) {
  if (choices) return (options) => choice({...options, options: choices.map((each) => [each, titled(`${each}`)])});
  if (parts) return (options) => severalField({...options, parts});
  return kControls[type] ?? writtenField;
}

// `of`: the table's object; `kind`: which of its kinds; `now()`: values by names; `words(name, key, text)`: of the
// command that sets one. Keys that are seldom changed stand in a part that is shut at first.
export function keyFields(controls, {of, kind, now, words}) {
  const field = ([name, key]) => {
    const label = key.label ?? titled(name);
    const made = controlOf(key)({
      name: `${titled(of)}, ${label.toLowerCase()}`, key: `${of}.${name}`, unit: kUnits[key.unit], least: key.least, most: key.most,
      step: stepOf(key), hint: key.without?.replaceAll("`", ""), ...controls.gestures((value) => words(name, key, textOf(value))),
    });
    controls.whenSet(() => made.set(now()?.[name] ?? null));
    const shown = line(label, made.root);
    shown.title = meaningOf(key);
    return shown;
  };
  const keys = Object.entries(controls.project.keys[of]).filter(([, key]) => !key.of || key.of.includes(kind))
    .map(([name, key]) => [name, {...key, ...key.measures?.[kind]}]);
  const rare = keys.filter(([, key]) => key.rare);
  return [keys.filter(([, key]) => !key.rare).map(field), rare.length > 0 && more(titled(of), rare.map(field))];
}
