// What a person does on the page, as steps of words of the commands that do the same.

// A name that begins with a dash would be read as an option.
const option = (name, value) => `${value}`.startsWith("-") && typeof value === "string" ? [`${name}=${value}`] : [name, `${value}`];
const numbers = (name, values) => [name, ...values.flat().map(String)];

function command(verb, names, options) {
  const dash = names.some((name) => name.startsWith("-"));
  return {commands: [[...verb, ...(dash ? [...options, "--", ...names] : [...names, ...options])]]};
}

const setting = (part, value) => `${part === "place" || part === "turn" || part.startsWith("-") ? "/" : ""}${part}=${[value].flat().join(",")}`;

// Joints of a film's actor, {name: [x, y, z]}.
export const poseStep = (actor, pose, frame, falloff) =>
  command(["animate", "pose"], [actor, ...Object.entries(pose).map(([joint, angles]) => setting(joint, angles))], [...blended(falloff), "--frame", `${frame}`, "--clamp"]);

// A pose's options that blend it over frames to both sides; 0: none.
export const blended = (falloff) => falloff > 0 ? ["--falloff", `${falloff}`] : [];

// How each part of a joint's change is written.
const kJointOptions = {
  name: (value) => option("--name", value),
  parent: (value) => option("--parent", value),
  place: (value) => numbers("--place", value),
  x_axis: (value) => numbers("--x-axis", value),
  y_axis: (value) => numbers("--y-axis", value),
  freedom: (value) => [`--${value}`],
  limits: (value) => Object.entries(value).flatMap(([axis, range]) => ["--limits", axis, ...range.map(String)]),
  shape: (value) => option("--shape", value),
  options: (value) => Object.entries(value).flatMap(([key, number]) => ["--with", `${key}=${[number].flat().join(",")}`]),
  sbb: (value) => numbers("--sbb", value),
  material: (value) => option("--material", value),
  limb: (value) => option("--limb", value),
  reset: (value) => value.flatMap((what) => ["--reset", what]),
};

// "add" or "set".
export const jointStep = (verb, joint, change) =>
  command(["model", verb], [joint], Object.entries(change).flatMap(([part, value]) => kJointOptions[part](value)));

export const removeJointStep = (joint) => command(["model", "remove"], [joint], ["--branch"]);

export const materialStep = (verb, material, change) =>
  command(["model", verb], [], [...option("--material", material), ...Object.entries(change).flatMap(
    ([key, value]) => Array.isArray(value) ? numbers(`--${key}`, value) : option(`--${key}`, value))]);

export const removeMaterialStep = (material) => command(["model", "remove"], [], option("--material", material));

export const mirrorStep = (side, joint) => command(["model", "mirror"], [side, ...(joint ? [joint] : [])], []);

export const bodyStep = (name) => command(["model", "new"], [], ["--figure", name, "--replace"]);
