// Puts the page together: one state, one connection, and parts that listen to them.

import {Connection} from "./connection.js";
import {Edits} from "./edits.js";
import {Frames} from "./frames.js";
import {Ghosts} from "./ghosts.js";
import {Header} from "./header.js";
import {Help} from "./help.js";
import {Importer} from "./importing/importer.js";
import {Keys} from "./keys.js";
import {Latencies} from "./latencies.js";
import {Rendering} from "./live/rendering.js";
import {closeMenu} from "./menu.js";
import {Models} from "./models.js";
import {Notices} from "./notices.js";
import {Pace} from "./pace.js";
import {Painter} from "./painter.js";
import {JointPanel} from "./panels/joint_panel.js";
import {MaterialsPanel} from "./panels/materials_panel.js";
import {MotionsPanel} from "./panels/motions_panel.js";
import {ScenePanel} from "./panels/scene_panel.js";
import {kRingAxes, State} from "./state.js";
import {Status} from "./status.js";
import {Tabs} from "./tabs.js";
import {Theme} from "./theme.js";
import {Timeline} from "./timeline/timeline.js";
import {Tree} from "./tree.js";
import {Views} from "./views.js";

const kPatience = 3;  // attempts to connect, before the banner says what a person can do
const kNewSteps = new Set(["commit", "drag", "undo", "redo"]);  // after these, a message of the step before is out of date

const place = (id) => document.getElementById(id);
const state = new State();
const connection = new Connection();
const latencies = new Latencies();
const pace = new Pace(connection, latencies);
const painter = new Painter(connection, latencies);
const edits = new Edits(connection, pace, state);
const ghosts = new Ghosts(state);
const models = new Models(connection);
const importer = new Importer(place("import"), {state, connection, models}, showImported);
const parts = {state, connection, latencies, pace, painter, edits, ghosts, importer, models};

const notices = new Notices();
const help = new Help(state);
const header = new Header(place("header"), parts, {help: () => help.toggle(), theme: () => theme.toggle(), ghosts: () => ghosts.menu(), importFiles: () => importer.choose()});
const theme = new Theme(header.theme);
const tree = new Tree(place("tree"), {...parts, rename: () => rename()});
const views = new Views(place("views"), parts, painter);
const tabs = new Tabs(place("panels"), [{name: "joint", text: "Joint"}, {name: "materials", text: "Materials"},
                                        {name: "scene", text: "Bodies"}, {name: "motions", text: "Motions"}, {name: "rendering", text: "Rendering"}]);
const jointPanel = new JointPanel(tabs.panel("joint"), parts);
new MaterialsPanel(tabs.panel("materials"), parts);
new ScenePanel(tabs.panel("scene"), parts);
const motions = new MotionsPanel(tabs.panel("motions"), parts);
new Rendering(place("rendering"), tabs.panel("rendering"), parts);
const frames = new Frames(place("frames"), parts);
const timeline = new Timeline(place("timeline"), place("frames"), parts, frames);
const status = new Status(place("status"), parts);

let tabOfScene = tabs.shown;  // to come back to

function showWorkspace() {
  const rendering = state.workspace === "rendering";
  if (rendering) tabOfScene = tabs.shown;
  place("rendering").hidden = !rendering;
  for (const id of ["views", "tree"]) place(id).hidden = rendering;
  for (const name of ["joint", "scene", "rendering"]) tabs.available(name, (name === "rendering") === rendering);
  tabs.available("materials", !rendering && !state.isFilm());
  tabs.available("motions", !rendering && state.isFilm());
  tabs.show(rendering ? "rendering" : tabOfScene);
  document.body.dataset.workspace = state.workspace;
}

const inModel = (act) => (keys, event) => state.project && !state.isFilm() ? act(keys, event) : false;

const rename = inModel(() => {
  tabs.show("joint");
  jointPanel.rename();
});

function showProblem() {
  const {problem, file} = state.project;
  const isPlaceNamed = !problem?.line || problem.text.includes(`:${problem.line}:`);
  const detail = `${isPlaceNamed ? "" : `${file}, line ${problem.line}. `}The last good state stays.`;
  notices.banner("file", problem?.text ?? "", {detail, kind: "error"});
}

// The panel follows what is selected, between a joint and a film's actor.
function showSelected() {
  const {actor, joint, thing} = state.selected;
  if (joint !== null && tabs.shown === "scene") tabs.show("joint");
  else if (state.isFilm() && joint === null && (actor ?? thing) !== null && tabs.shown === "joint") tabs.show("scene");
}

// The last of them, wherever it stands.
function showImported(actors) {
  edits.wanted = {actor: actors.at(-1), joint: null, isShown: true};
  if (edits.selectWanted()) views.showSelectedInAll();
}

state.on("workspace", () => {
  showWorkspace();
  notices.settle();
});
state.on("selected", showSelected);
state.on("project", () => {
  tabs.rename("scene", state.isFilm() ? "Scene" : "Bodies");
  tabs.available("materials", state.workspace === "scene" && !state.isFilm());
  tabs.available("motions", state.workspace === "scene" && state.isFilm());
  document.body.dataset.kind = state.project.kind;
  showProblem();
  if (edits.selectWanted()?.isShown) views.showSelectedInAll();
});

connection.on("project", (project) => state.setProject(edits.unanswered.over(project)));
connection.on("poses", (poses) => state.setPoses(poses));
connection.on("selected", ({actor = null, joint = null, thing = null, more = []}) => state.select(actor, joint, thing, more));
connection.on("state", (message) => {
  state.renderer = message;
  state.tell("renderer");
  notices.banner("renderer", message.renderer, {detail: "Pictures come again as soon as it is back."});
});
connection.on("refused", (message) => {
  const {text, line} = message;
  edits.unanswered.forget();
  if (motions.refused(message) || importer.refused(message)) return;
  notices.message(line ? `${text} (line ${line})` : text);
});
connection.on("sent", ({do: what}) => { if (kNewSteps.has(what)) notices.settle(); });
connection.on("remark", ({text}) => notices.message(text, "info"));
connection.on("pinned", ({pins}) => state.set("pins", pins));
connection.on("connected", () => {
  edits.unanswered.forget();
  status.connected = true;
  status.showRenderer();
  notices.banner("connection", "");
  state.set("pins", []);
  const {actor, joint, thing, more} = state.selected;
  if (thing !== null) connection.send({do: "select", thing});
  else if (actor !== null) connection.send({do: "select", actor, joint, more});
});
connection.on("gone", ({failures, strange}) => {
  status.connected = false;
  status.showRenderer();
  if (strange) return notices.banner("connection", "The studio was started again, with another link.", {detail: "Open the link that it has printed, and close this page. What you did is stored."});
  const detail = failures < kPatience ? "Connecting again. Nothing on this page is lost."
    : "Connecting again. If mars studio has ended, start it again and open the link that it prints.";
  notices.banner("connection", "The studio does not answer.", {detail});
});

const kRegions = ["header", "tree", "views", "rendering", "panels", "frames", "timeline"];

// The next part of the page that shows, at what it had in focus or its first control.
function goToRegion(by) {
  const shown = kRegions.filter((id) => !place(id).hidden);
  const at = shown.findIndex((id) => place(id).contains(document.activeElement));
  const region = shown[(at + by + shown.length) % shown.length];
  if (region === "views") return views.go(state.activeView);
  place(region).querySelector('button:not(:disabled, [tabindex="-1"], [hidden]), [tabindex="0"], input, select, summary')?.focus();
}

const kSteps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1], "+": [0, -6], "-": [0, 6]};
const stepsOf = (keys) => kSteps[keys.replace("Shift+", "")];

new Keys({
  undo: () => edits.undo(),
  redo: () => edits.redo(),
  letGo: () => {
    closeMenu();
    if (!views.letGo() && !timeline.letGo()) edits.cancel();
  },
  rename: () => rename(),
  addJoint: inModel(() => edits.addJoint()),
  removeJoint: inModel(() => edits.removeJoint()),
  find: () => tree.find.focus(),
  rest: (_, event) => jointPanel.rest(event),
  toolNone: () => state.set("tool", "none"),
  toolTurn: () => state.set("tool", "turn"),
  toolMove: () => state.set("tool", "move"),
  toolBox: inModel(() => state.set("tool", "box")),
  toolPoints: inModel(() => state.set("tool", "points")),
  nextAxes: () => state.set("axes", kRingAxes[(kRingAxes.findIndex(([axes]) => axes === state.axes) + 1) % kRingAxes.length][0]),
  toolReach: () => state.set("tool", "reach"),
  pin: () => edits.pin(),
  goToView: (keys) => views.go(Number(keys) - 1),
  maximise: () => views.maximise(),
  showAll: (_, event) => views.showAll(event),
  showSelected: (_, event) => views.showSelected(event),
  nextDisplay: (_, event) => views.nextDisplay(event),
  hidden: (_, event) => views.flip("hidden", event),
  ground: (_, event) => views.flip("ground", event),
  ghosts: ghosts.flip,
  marks: () => state.set("marks", !state.marks),
  orbitBy: (keys, event) => views.orbitBy("turn", stepsOf(keys), event),
  panBy: (keys, event) => views.orbitBy("pan", stepsOf(keys), event),
  zoomBy: (keys, event) => views.orbitBy("zoom", stepsOf(keys), event),
  play: () => frames.play(),
  stepFrame: (keys, event) => frames.step(keys === "." ? 1 : -1, event),
  endFrame: (keys, event) => frames.end(keys === "End", event),
  range: (keys) => keys === "B" ? frames.beginRange() : frames.endRange(),
  insertKeys: (_, event) => timeline.acts.insert(event),
  foldTimeline: () => timeline.setOpen(!timeline.open),
  nextTimeline: () => timeline.next(),
  pickAll: () => timeline.keys.pickAll(),
  copyKeys: () => timeline.acts.copy(),
  pasteKeys: (_, event) => timeline.acts.paste(event),
  removeKeys: (_, event) => timeline.acts.remove(event),
  easeKeys: () => timeline.keyBar.openEases(),
  timeKeys: () => timeline.keyBar.openTimes(),
  showAllKeys: () => timeline.showAll(),
  nextRegion: (keys) => goToRegion(keys === "F6" ? 1 : -1),
  workspace: () => state.set("workspace", state.workspace === "scene" ? "rendering" : "scene"),
  theme: () => theme.toggle(),
  help: () => help.toggle(),
}, state);

showWorkspace();
connection.open();
