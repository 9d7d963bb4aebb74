// What hands do to keys as words of `mars animate` (docs/animating.md), as few as will do.
//
// `things`: [{thing, parts: [{name, frames, picked}]}], both sets of frames, with all that have keys, so that "all of it" can
// be said in short.

const has = ({picked}) => picked.size > 0;
const whole = (first, last) => first === last ? `${first}` : `${first}-${last}`;

// Runs of frames in which all keys of `parts` are picked; null where a frame has one that is and one that is not.
function runs(parts) {
  const frames = [...new Set(parts.flatMap((part) => [...part.frames]))].sort((one, other) => one - other);
  const found = [];
  let open = false;
  for (const frame of frames) {
    const there = parts.filter((part) => part.frames.has(frame));
    const picked = there.filter((part) => part.picked.has(frame)).length;
    if (picked !== 0 && picked !== there.length) return null;
    if (picked !== 0 && open) found.at(-1).last = frame;
    else if (picked !== 0) found.push({first: frame, last: frame});
    open = picked !== 0;
  }
  return found;
}

function rangesOf({thing, parts}) {
  const all = runs(parts);
  if (all) return all.map((run) => ({whose: [thing], ...run}));
  const some = parts.filter(has);
  const together = runs(some);
  if (together) return together.map((run) => ({whose: [thing, ...some.map(({name}) => name)], ...run}));
  const apart = new Map();
  for (const part of some) {
    for (const run of runs([part])) {
      const range = whole(run.first, run.last);
      if (!apart.has(range)) apart.set(range, {whose: [thing], ...run});
      apart.get(range).whose.push(part.name);
    }
  }
  return [...apart.values()];
}

// Ranges of frames and whose keys in them are all picked: [{whose: words, first, last}].
function ranges(things) {
  const some = things.filter(({parts}) => parts.some(has));
  const all = some.length > 1 ? runs(things.flatMap(({parts}) => parts)) : null;
  return all ? all.map((run) => ({whose: ["--all"], ...run})) : some.flatMap(rangesOf);
}

// Where ranges go over each other, the one ahead goes first.
function displaced(word, things, by) {
  return ranges(things).sort((one, other) => (one.first - other.first) * -Math.sign(by))
    .map(({whose, first, last}) => ["animate", word, ...whose, "--frame", whole(first, last), "--to", `${first + by}`]);
}

export const moved = (things, by) => displaced("move", things, by);
export const copied = (things, by) => displaced("copy", things, by);
export const deleted = (things) =>
  ranges(things).map(({whose, first, last}) => ["animate", "delete", ...whose, "--frame", whole(first, last)]);

const timed = (things, ...words) =>
  ranges(things).map(({whose, first, last}) => ["animate", "time", ...whose, "--frame", whole(first, last), ...words]);

export const eased = (things, ease) => timed(things, "--ease", ease);
export const swung = (things, back, beyond) => timed(things, "--anticipate", `${back}`, "--overshoot", `${beyond}`);

// Of each thing from its first selected key to its last.
export function stretched(things, factor) {
  return things.filter(({parts}) => parts.some(has)).map(({thing, parts}) => {
    const frames = parts.flatMap(({picked}) => [...picked]);
    return ["animate", "time", thing, "--frame", whole(Math.min(...frames), Math.max(...frames)), "--stretch", `${factor}`];
  });
}

// Fewer keys, with splines through them, of what can be reduced: an actor, the camera.
export const reduced = (things, degrees) => things.filter(({thing, parts}) => !thing.includes("/") && parts.some(has)).map(({thing, parts}) => {
  const some = parts.filter(has), frames = some.flatMap(({picked}) => [...picked]);
  return ["animate", "reduce", thing, ...(some.length < parts.length ? some.map(({name}) => name) : []), "--error", `${degrees}`,
          "--frame", whole(Math.min(...frames), Math.max(...frames))];
});

// `option`: hold or shift. Of all things that have a selected key, at `frame`.
export const retimed = (things, option, frame, by) => things.filter(({parts}) => parts.some(has))
  .map(({thing}) => ["animate", "time", thing, "--frame", `${frame}`, `--${option}`, `${by}`]);

export const keyed = (thing, parts, frame) => ["animate", "key", thing, ...parts, "--frame", `${frame}`];
