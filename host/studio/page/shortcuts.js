// All shortcuts, in one table: keys.js acts on it, help.js lists it, menus and tips name its keys.
//
// `at`: where they hold: "page" (not while text is written), "always" (also then), "view" (a view has the focus, or nothing has),
// "timeline" (it has the focus; before those of the page), "tree". Letters at "page" leave alone lists of choices, where
// letters find an entry. `film`: in films only.

export const kShortcuts = [
  {group: "Edit", keys: ["Ctrl+Z"], name: "undo", text: "Undo", at: "always"},
  {group: "Edit", keys: ["Ctrl+Shift+Z", "Ctrl+Y"], name: "redo", text: "Redo", at: "always"},
  {group: "Edit", keys: ["Escape"], name: "letGo", text: "Let go: the gesture leaves no trace", at: "page"},
  {group: "Edit", keys: ["F2"], name: "rename", text: "Rename the selected joint", at: "page"},
  {group: "Edit", keys: ["Shift+A", "Insert"], name: "addJoint", text: "Add a joint below the selected one", at: "page"},
  {group: "Edit", keys: ["Delete"], name: "removeJoint", text: "Remove the selected joint and those below it", at: "page"},
  {group: "Edit", keys: ["0"], name: "rest", text: "Put the selected joint at rest", at: "page"},

  {group: "Tools", keys: ["Q"], name: "toolNone", text: "Select only", at: "page"},
  {group: "Tools", keys: ["W"], name: "toolTurn", text: "Turn joints: rings that stop at limits", at: "page"},
  {group: "Tools", keys: ["E"], name: "toolMove", text: "Move joints: arrows", at: "page"},
  {group: "Tools", keys: ["R"], name: "toolBox", text: "Pull the sides of the bounding box", at: "page"},
  {group: "Tools", keys: ["T"], name: "toolPoints", text: "Pull control points", at: "page"},
  {group: "Tools", keys: ["Y"], name: "toolReach", text: "Reach: a pull at a hand or foot turns its whole limb", at: "page", film: true},
  {group: "Tools", keys: ["X"], name: "nextAxes", text: "Rings about the joint's numbers, its own axes, its parent's, the world's in turn", at: "page"},
  {group: "Tools", keys: ["P"], name: "pin", text: "Pin the selected hand or foot: it stays while others are pulled", at: "page", film: true},

  {group: "Views", keys: ["1", "2", "3", "4"], name: "goToView", text: "Go to a view", at: "page"},
  {group: "Views", keys: ["F"], name: "maximise", text: "Maximise the view, and back", at: "page"},
  {group: "Views", keys: ["A"], name: "showAll", text: "Show the whole scene in the view", at: "page"},
  {group: "Views", keys: ["Z"], name: "showSelected", text: "Show what is selected in the view", at: "page"},
  {group: "Views", keys: ["S"], name: "nextDisplay", text: "Surface, control vertices, prisms, stick in turn", at: "page"},
  {group: "Views", keys: ["H"], name: "hidden", text: "Hidden lines on and off", at: "page"},
  {group: "Views", keys: ["G"], name: "ground", text: "Ground on and off", at: "page"},
  {group: "Views", keys: ["O"], name: "ghosts", text: "Ghosts: the figure at neighbouring frames", at: "page", film: true},
  {group: "Views", keys: ["M"], name: "marks", text: "Marks of the camera and of lights", at: "page", film: true},

  {group: "In a view", keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"], name: "orbitBy", text: "Orbit", at: "view"},
  {group: "In a view", keys: ["Shift+ArrowLeft", "Shift+ArrowRight", "Shift+ArrowUp", "Shift+ArrowDown"], name: "panBy",
   text: "Pan", at: "view"},
  {group: "In a view", keys: ["+", "-"], name: "zoomBy", text: "Zoom", at: "view"},

  {group: "Frames", keys: ["Space"], name: "play", text: "Play and pause", at: "page", film: true},
  {group: "Frames", keys: [",", "."], name: "stepFrame", text: "Frame before, next frame", at: "page", film: true},
  {group: "Frames", keys: ["Home", "End"], name: "endFrame", text: "First frame, last frame", at: "page", film: true},
  {group: "Frames", keys: ["B", "N"], name: "range", text: "The frames that play begin here, end here", at: "page", film: true},
  {group: "Frames", keys: ["I"], name: "insertKeys", text: "Insert keys at the frame", at: "page", film: true},
  {group: "Frames", keys: ["D"], name: "foldTimeline", text: "Open and shut the timeline", at: "page", film: true},
  {group: "Frames", keys: ["K"], name: "nextTimeline", text: "Keys, curves, scripts in turn", at: "page", film: true},

  {group: "Timeline", keys: ["ArrowLeft", "ArrowRight"], text: "Key before, next key; with Shift also those", at: "timeline", film: true},
  {group: "Timeline", keys: ["Alt+ArrowLeft", "Alt+ArrowRight"], text: "Selected keys a frame earlier, later; with Shift ten", at: "timeline", film: true},
  {group: "Timeline", keys: ["Ctrl+A"], name: "pickAll", text: "Select all keys", at: "timeline", film: true},
  {group: "Timeline", keys: ["Ctrl+C"], name: "copyKeys", text: "Copy the selected keys", at: "timeline", film: true},
  {group: "Timeline", keys: ["Ctrl+V"], name: "pasteKeys", text: "Put the copies at the frame", at: "timeline", film: true},
  {group: "Timeline", keys: ["Delete"], name: "removeKeys", text: "Delete the selected keys", at: "timeline", film: true},
  {group: "Timeline", keys: ["E"], name: "easeKeys", text: "Ease of the selected keys", at: "timeline", film: true},
  {group: "Timeline", keys: ["T"], name: "timeKeys", text: "Timing of the selected keys", at: "timeline", film: true},
  {group: "Timeline", keys: ["A"], name: "showAllKeys", text: "Show all frames, all of the curves", at: "timeline", film: true},

  {group: "Page", keys: ["F6", "Shift+F6"], name: "nextRegion", text: "Next part of the page, the one before", at: "always"},
  {group: "Page", keys: ["F9"], name: "workspace", text: "Scene or rendering", at: "always"},
  {group: "Page", keys: ["L"], name: "theme", text: "Light or dark", at: "page"},
  {group: "Page", keys: ["?", "F1"], name: "help", text: "This sheet", at: "page"},

  {group: "Tree of joints", keys: ["ArrowUp", "ArrowDown"], text: "Joint before, next joint; with Shift also this one", at: "tree"},
  {group: "Tree of joints", keys: ["ArrowRight", "ArrowLeft"], text: "Open or go in, close or go out", at: "tree"},
  {group: "Tree of joints", keys: ["Home", "End"], text: "First joint, last joint", at: "tree"},
  {group: "Tree of joints", keys: ["/"], name: "find", text: "Find by the first letters", at: "page"},

  {group: "Numbers", keys: ["ArrowUp", "ArrowDown"], text: "One step; with Shift ten, with Alt a tenth", at: "number"},
  {group: "Numbers", keys: ["Enter"], text: "Done: keys are the view's again", at: "number"},
  {group: "Numbers", keys: ["Escape"], text: "As it was: keys are the view's again", at: "number"},
];

// What mice do; in the help sheet only.
export const kHands = [
  {group: "Mouse in a view", keys: ["Left drag"], text: "On a handle: pull it. On a limb: select and drag it. On empty space: orbit"},
  {group: "Mouse in a view", keys: ["Right drag", "Shift+Left drag"], text: "Pan"},
  {group: "Mouse in a view", keys: ["Middle drag", "Alt+Left drag"], text: "Orbit, whatever is there"},
  {group: "Mouse in a view", keys: ["Shift+Middle drag"], text: "Pan"},
  {group: "Mouse in a view", keys: ["Wheel", "Pinch"], text: "Zoom at the mouse, between the fingers"},
  {group: "Mouse in a view", keys: ["Double click"], text: "On a view's title: maximise it, and back. On a model's joint in the tree: rename it"},
  {group: "Mouse in a view", keys: ["Drag"], text: "On the letter before a number: change it"},

  {group: "Mouse in the tree", keys: ["Click", "Shift+Click"], text: "Select a joint; also this one, which rings then turn, too"},

  {group: "Mouse in the timeline", keys: ["Click", "Shift+Click"], text: "Select a key, a row; also this one", film: true},
  {group: "Mouse in the timeline", keys: ["Drag"], text: "On a key: move what is selected. On empty space: select in a box", film: true},
  {group: "Mouse in the timeline", keys: ["Alt+Drag"], text: "Keys: copies of them. A spline's slope: of this side alone", film: true},
  {group: "Mouse in the timeline", keys: ["Shift+Drag"], text: "In curves: in time alone, or in value alone", film: true},
  {group: "Mouse in the timeline", keys: ["Wheel", "Ctrl+Wheel"], text: "Scroll the rows, zoom the curves; zoom in time", film: true},
  {group: "Mouse in the timeline", keys: ["Shift+Wheel", "Middle drag"], text: "Pan", film: true},
];

const kSigns = {ArrowLeft: "\u2190", ArrowRight: "\u2192", ArrowUp: "\u2191", ArrowDown: "\u2193", Escape: "Esc", Delete: "Del"};

export const shownKeys = (keys) => keys.split("+").map((key) => kSigns[key] ?? key).filter((key) => key !== "").join("+") || "+";

// The first keys of a command, as menus and tips show them.
export function keysOf(name) {
  const shortcut = kShortcuts.find((each) => each.name === name);
  return shortcut ? shownKeys(shortcut.keys[0]) : "";
}
