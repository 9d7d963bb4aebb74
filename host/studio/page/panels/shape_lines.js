// The options of a segment's shape, as the library has them: {key, what, count, default, range: [least, most]}.

import {line, sliderField, vectorField} from "../fields.js";

const kStep = 0.01;

// `field` registers a control with what it shows of a joint; `changes` makes its gestures.
export function shapeLines(joint, library, field, changes) {
  const options = library.find(({name}) => name === joint.shape)?.options ?? [];
  return options.map((option) => option.count > 1 ? several(option, field, changes) : one(option, field, changes));
}

function one({key, default: otherwise = 0, range = [0, 1]}, field, changes) {
  return line(title(key), field(sliderField({
    name: title(key), key: `option.${key}`, least: range[0], most: range[1], step: kStep, digits: 4, ...changes((value) => ({options: {[key]: value}})),
  }), ({options}) => first(options?.[key] ?? otherwise)));
}

function several({key, default: otherwise = 0, range = [0, 1]}, field, changes) {
  return line(title(key), field(vectorField({
    name: title(key), key: `option.${key}`, least: range[0], most: range[1], step: kStep, ...changes((value) => ({options: {[key]: value}})),
  }), ({options}) => three(options?.[key] ?? otherwise)));
}

const title = (key) => key[0].toUpperCase() + key.slice(1);
const first = (value) => Array.isArray(value) ? value[0] : value;
const three = (value) => Array.isArray(value) && value.length === 3 ? value : Array(3).fill(first(value));
