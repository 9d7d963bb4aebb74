// Files of other programs become actors; they can be dropped on the page, too. What is chosen here counts for both.

import {element} from "../../dom.js";
import {choice, line, part} from "../../fields.js";
import {read, written} from "../../numbers.js";

const kFronts = [["", "as is usual"], ...["x", "-x", "y", "-y", "z", "-z"].map((axis) => [axis, `the file's ${axis}`])];

export function importPart({importer}) {
  const {options} = importer;
  const take = () => {
    const number = read(height.value);
    if (number !== null) height.value = written(number, 6);
    options.height = height.value.trim();
  };
  const height = element("input", {type: "text", inputmode: "decimal", "aria-label": "Height of what is imported", "data-key": "import.height",
                                   placeholder: "as in the file", autocomplete: "off", onchange: take});
  height.value = options.height;
  const front = choice({name: "Where what is imported looks to", key: "import.front", options: kFronts,
                        commit: (value) => { options.front = value ?? ""; }});
  front.set(options.front);
  const tall = line("Height", height), facing = line("Looks to", front.root);
  tall.title = "Units from the lowest point to the highest. A man of the library has 5.1";
  facing.title = "The file's axis along which a figure looks; here that is x";
  return part("Import", element("p", {class: "hint"}, "GLB, glTF, FBX, COLLADA, OBJ, PLY, STL, POV, RIB, BVH, AMC: drop them on the page, or choose them."), tall, facing,
              element("div", {class: "actions"}, element("button", {"data-key": "import.choose", onclick: () => importer.choose()}, "Choose files")));
}
