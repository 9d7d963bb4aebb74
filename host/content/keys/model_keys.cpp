#include "host/content/keys/material_keys.h"
#include "host/content/keys/objects.h"
#include "host/content/keys/shape_options.h"

#include <initializer_list>
#include <utility>

namespace mars::keys {
namespace {

constexpr std::string_view kSplineEnds[] = {"clamped", "open", "periodic"};
constexpr std::string_view kBlends[] = {"linear", "dual-quaternions"};  // as wire::Blend counts them

constexpr Type kModelTypes[] = {
    {"name", R"({"type": "string", "minLength": 1, "maxLength": 100, "pattern": "^[^/]*$"})", R"("anna")"},
    {"coordinate", R"({"type": "number", "minimum": -1e9, "maximum": 1e9})", "1"},
    {"vector", R"({"type": "array", "minItems": 3, "maxItems": 3, "items": "#coordinate"})", "[1, 0, 0.5]", "X Y Z"},
    {"unit_vector",
     R"({"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": 0, "maximum": 1}})",
     "[0, 0.5, 1]"},
    {"color",
     R"({"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": 0, "maximum": 1}})",
     "[0.8, 0.4, 0.2]", "R G B"},
    {"patch", R"({"type": "array", "minItems": 16, "maxItems": 16, "items": "#unit_vector"})", ""},
    {"shapes",
     R"({"type": "object", "propertyNames": {"allOf": ["#name", {"not": "#library"}]},
         "additionalProperties": {"if": {"type": "array"}, "then": {"minItems": 1, "items": "#patch"}, "else": "#surface"}})",
     ""},
    {"points",
     R"({"type": "array", "minItems": 2, "items": {"type": "array", "minItems": 2, "items": "#unit_vector"}})", ""},
    {"knots", R"({"type": "array", "minItems": 3, "items": "#coordinate"})", ""},
    {"vertices", R"({"type": "array", "minItems": 3, "items": "#unit_vector"})", ""},
    {"faces",
     R"({"type": "array", "minItems": 1, "items": {"type": "array", "minItems": 3, "maxItems": 4096,
         "items": {"type": "integer", "minimum": 0}}})",
     ""},
    {"normals",
     R"({"type": "array", "minItems": 3, "items": {"type": "array", "minItems": 3, "maxItems": 3,
         "items": {"type": "number", "minimum": -1e6, "maximum": 1e6}}})",
     ""},
    {"uv",
     R"({"type": "array", "minItems": 1, "items": {"type": "array", "minItems": 2, "maxItems": 2, "items": "#coordinate"}})",
     ""},
    {"vertex_colors",
     R"({"type": "array", "minItems": 1, "items": {"type": "array", "minItems": 3, "maxItems": 4,
         "items": {"type": "number", "minimum": 0, "maximum": 1}}})",
     ""},
    {"vertex_bones",
     R"({"type": "array", "minItems": 3, "items": {"type": "array", "minItems": 2, "maxItems": 8,
         "items": {"type": "number", "minimum": 0}}})",
     ""},
    {"point_bones",
     R"({"type": "array", "minItems": 2, "items": {"type": "array", "minItems": 2, "items": {"type": "array",
         "minItems": 2, "maxItems": 8, "items": {"type": "number", "minimum": 0}}}})",
     ""},
    {"binds",
     R"({"type": "array", "minItems": 1, "items": {"type": "array", "minItems": 12, "maxItems": 12, "items": "#coordinate"}})",
     ""},
    {"factors",
     R"({"anyOf": [{"type": "number", "minimum": 0.001, "maximum": 1000}, {"type": "array", "minItems": 3, "maxItems": 3,
         "items": {"type": "number", "minimum": 0.001, "maximum": 1000}}]})",
     "[1, 1, 1.2]"},
    {"limit",
     R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "number", "minimum": -1e6, "maximum": 1e6}})",
     "[-30, 30]"},
    {"sbb", R"({"type": "array", "minItems": 2, "maxItems": 2, "items": "#vector"})", "[[0, 0, 0], [1, 1, 1]]",
     "X Y Z X Y Z"},
    {"library_or_name", R"({"anyOf": ["#library", "#name"]})", R"("box")"},
    {"edge",
     R"({"anyOf": [{"type": "number", "minimum": 0.001, "maximum": 0.5}, {"type": "array", "minItems": 3, "maxItems": 3,
         "items": {"type": "number", "minimum": 0.001, "maximum": 0.5}}]})",
     "0.1"},
    {"sides", R"({"enum": [1, 2]})", "2", "1|2"},
};

Object model() {
  return {"model",
          "A tree of joints with base segments. Lengths are in the world's unit, angles in degrees, colours 0 to 1.",
          {{.name = "joints",
            .type = "[joint]",
            .meaning = "list of joints, in any order",
            .without = "required, unless there is `from`",
            .range = {1, kFarthest},
            .example = R"([{"name": "foot"}, {"name": "knee", "parent": "foot"}])"},
           {.name = "shapes",
            .type = "shapes",
            .meaning =
                "object that maps a name to a list of patches, or to an object with `bspline`, `subdivision` or `mesh`",
            .see = "shapes.md#shapes-of-your-own",
            .without = "none"},
           {.name = "limbs",
            .type = "limbs",
            .meaning = "object that names the joints that are the figure's limbs",
            .see = "#limbs",
            .without = "none"},
           {.name = "from",
            .type = "file",
            .meaning = "replaces `joints`: path of another model file, relative to this file's folder",
            .see = "#other-proportions",
            .without = "none",
            .example = R"("human.json")"},
           {.name = "proportions",
            .type = "proportions",
            .meaning = "only with `from`: how this figure differs from the one in that file",
            .see = "#other-proportions",
            .without = "none",
            .example = R"({"scale": 1.1})"},
           {.name = "materials",
            .type = "{material}",
            .meaning = "object that maps names to materials, with the keys of a film's, except `keys`",
            .see = "light-and-materials.md#materials",
            .without = "none",
            .example = R"({"oak": {"color": [0.7, 0.5, 0.3]}})"}},
          R"({"oneOf": [{"required": ["joints"]}, {"required": ["from", "proportions"]}]})"};
}

Object joint() {
  return {
      "joint",
      "",
      {{.name = "name",
        .type = "name",
        .meaning = "unique among the model's joints, 1 to 100 bytes without `/`",
        .required = true,
        .typed = false,
        .example = R"("anna")"},
       {.name = "parent",
        .type = "text",
        .meaning = "the joint from which this one hangs",
        .without = "none: the model's frame",
        .example = R"("foot")"},
       {.name = "place",
        .type = "vector",
        .meaning = "position in the parent's frame",
        .json = "[0, 0, 0]",
        .example = "[1, 0, 0.5]"},
       {.name = "x_axis",
        .type = "vector",
        .meaning = "direction of the x axis in the parent's frame, of any length",
        .json = "[1, 0, 0]",
        .example = "[1, 1, 0]"},
       {.name = "y_axis",
        .type = "vector",
        .meaning =
            "direction of the y axis in the parent's frame; need not be perpendicular to `x_axis`. z is x cross y",
        .json = "[0, 1, 0]",
        .example = "[0.5, 1, 0]"},
       {.name = "limits",
        .type = "limits",
        .meaning =
            "object that maps `x`, `y`, `z` to `[lower, upper]`; the joint cannot turn about an axis that is left out",
        .without = "-180 to 180 about each axis",
        .unit = "degrees",
        .typed = false,
        .example = R"({"x": [-30, 30]})"},
       {.name = "segment",
        .type = "segment",
        .meaning = "the base segment",
        .without = "none",
        .typed = false,
        .example = R"({"shape": "box"})"}}};
}

Object limits() {
  Object limits{"limits", "Lower and upper limit of the turn about each axis. An axis left out cannot turn.", {}};
  for (const std::string_view axis : {"x", "y", "z"})
    limits.keys.push_back({.name = axis,
                           .type = "limit",
                           .meaning = "`[lower, upper]`",
                           .json = "[0, 0]",
                           .unit = "degrees",
                           .example = "[-30, 30]"});
  return limits;
}

Object segment() {
  Object segment{"segment",
                 "",
                 {{.name = "shape",
                   .type = "library_or_name",
                   .meaning = "a shape of the library, or one of the model's `shapes`",
                   .see = "shapes.md#the-library-of-shapes",
                   .required = true,
                   .example = R"("box")"},
                  {.name = "sbb",
                   .type = "sbb",
                   .meaning = "minimum and maximum corner of the segment bounding box, in the joint's frame",
                   .json = "[[0, 0, 0], [1, 1, 1]]",
                   .example = "[[-0.1, -0.1, -0.5], [0.1, 0.1, 0]]"},
                  {.name = "material",
                   .type = "text",
                   .meaning = "a material of the model or of the film",
                   .without = "grey",
                   .example = R"("oak")"},
                  {.name = "skin",
                   .type = "skin",
                   .meaning = "joints that the points of a shape with `bones` follow",
                   .see = "#skins",
                   .without = "none: the segment is rigid",
                   .typed = false}}};
  for (Key key : shape_options().keys) {
    key.typed = false;  // but in `--with`
    segment.keys.push_back(key);
  }
  return segment;
}

Object limb_object(std::string_view name, std::string_view meaning,
                   std::initializer_list<std::pair<std::string_view, std::string_view>> limbs) {
  Object object{name, meaning, {}};
  for (const auto& [limb, function] : limbs)
    object.keys.push_back({.name = limb, .type = "text", .meaning = function, .without = "none"});
  return object;
}

Object limbs() {
  Object limbs =
      limb_object("limbs", "Names of joints, from the body outwards; a limb that is left out cannot be driven.",
                  {{"pelvis", "carries the legs and the spine"},
                   {"spine", "bends and turns the waist"},
                   {"chest", "carries arms and neck"},
                   {"neck", "turns the neck"},
                   {"head", "turns the head"}});
  for (const std::string_view side : {"left", "right"})
    limbs.keys.push_back({.name = side,
                          .type = "side",
                          .meaning = "object with the limbs of this side: the keys below",
                          .without = "none"});
  return limbs;
}

Object side() {
  return limb_object("side", "Limbs of one side.",
                     {{"hip", "turns the thigh"},
                      {"knee", "turns the shin"},
                      {"ankle", "turns the foot"},
                      {"toes", "bends the foot at its ball"},
                      {"shoulder", "turns the upper arm"},
                      {"elbow", "turns the forearm"},
                      {"wrist", "turns the hand; on four legs, the lower foreleg"},
                      {"fingers", "bends the hand; on four legs, the front paw or hoof"}});
}

Object surface() {
  return {"surface",
          "",
          {{.name = "bspline", .type = "bspline", .meaning = "a B-spline surface"},
           {.name = "subdivision", .type = "subdivision", .meaning = "a Catmull-Clark surface"},
           {.name = "mesh", .type = "mesh", .meaning = "a polygon mesh"}},
          R"({"minProperties": 1, "maxProperties": 1})"};
}

Object bspline() {
  Object bspline{"bspline",
                 "The outside is where d/du x d/dv points.",
                 {{.name = "points",
                   .type = "points",
                   .meaning = "control points `[x, y, z]` within 0 to 1: a list of rows along v, each with the same "
                              "number of points along u",
                   .required = true}}};
  bspline.keys.push_back({.name = "bones",
                          .type = "point_bones",
                          .meaning =
                              "of a skin: for each control point, in such rows, 1 to 4 pairs `[bone, weight, ...]` "
                              "as a mesh has them for its vertices",
                          .see = "model-format.md#skins",
                          .without = "none: the surface is rigid"});
  for (const std::string_view way : {"u", "v"})
    bspline.keys.push_back({.name = way,
                            .type = "direction",
                            .meaning = "one of the surface's two directions, an object with the keys below",
                            .json = "{}",
                            .without = "cubic, clamped, uniform",
                            .example = R"({"degree": 2})"});
  return bspline;
}

Object direction() {
  return {"direction",
          "",
          {{.name = "degree",
            .type = "whole",
            .meaning = "1 linear, 2 quadratic, 3 cubic; a direction has at least degree + 1 points",
            .number = 3,
            .range = {1, 3}},
           {.name = "ends",
            .type = "choice",
            .meaning = "`clamped`: the surface begins and ends at the outermost points; `open`: it ends before them; "
                       "`periodic`: it closes",
            .json = R"("clamped")",
            .choices = kSplineEnds},
           {.name = "knots",
            .type = "knots",
            .meaning = "numbers that never decrease; with `knots`, leave `ends` out or make it `periodic`",
            .without = "1 apart"}}};
}

Object subdivision() {
  return {"subdivision",
          "",
          {{.name = "points",
            .type = "vertices",
            .meaning = "the cage's points `[x, y, z]` within 0 to 1",
            .required = true},
           {.name = "faces",
            .type = "faces",
            .meaning = "lists of 3 to 64 numbers of different points, counted from 0, counter-clockwise as seen from "
                       "outside, best quads; an edge belongs to one face or two, a point to 64 faces at most",
            .required = true},
           {.name = "level",
            .type = "whole",
            .meaning = "how often each face is divided before a patch is made of each part; 0 for quads alone",
            .number = 1,
            .range = {0, 3}},
           {.name = "bones",
            .type = "vertex_bones",
            .meaning = "of a skin: for each point 1 to 4 pairs `[bone, weight, ...]`, as a mesh has them",
            .see = "model-format.md#skins",
            .without = "none: the surface is rigid"}}};
}

Object mesh() {
  return {
      "mesh",
      "",
      {{.name = "vertices", .type = "vertices", .meaning = "positions `[x, y, z]` within 0 to 1", .required = true},
       {.name = "faces",
        .type = "faces",
        .meaning = "lists of 3 to 4096 vertex numbers, counted from 0, counter-clockwise as seen from outside",
        .required = true},
       {.name = "crease",
        .meaning = "an edge is sharp if its two faces meet at more than this angle. With 0 every face is flat; "
                   "with 180 all edges are smooth",
        .number = 30,
        .range = {0, 180},
        .unit = "degrees"},
       {.name = "normals",
        .type = "normals",
        .meaning = "instead of `crease`: one outward vector `[x, y, z]` for each vertex, of any length",
        .without = "from faces and crease"},
       {.name = "bones",
        .type = "vertex_bones",
        .meaning = "of a skin: for each vertex 1 to 4 pairs `[bone, weight, ...]`. A bone is a number in the list of "
                   "the skin's joints, counted from 0; weights count relative to their sum",
        .see = "model-format.md#skins",
        .without = "none: the mesh is rigid"},
       {.name = "uv",
        .type = "uv",
        .meaning = "kept, not shown: for each vertex its place `[u, v]` in images, from 0 to 1 rightward and upward "
                   "from an image's lower left corner, beyond that in copies of it",
        .see = "importing-materials.md#what-is-kept",
        .without = "none"},
       {.name = "colors",
        .type = "vertex_colors",
        .meaning = "kept, not shown: for each vertex its colour, `[red, green, blue]` as materials have it, or with "
                   "its alpha",
        .see = "importing-materials.md#what-is-kept",
        .without = "none"},
       {.name = "paint_faces",
        .type = "faces",
        .meaning = "where vertices have several of them: for each face, for each of its corners a number of a row of "
                   "`uv` and of `colors`, counted from 0",
        .see = "importing-materials.md#what-is-kept",
        .without = "the numbers in `faces`"}}};
}

// What a material's images show.
Object images() {
  Object images{"images", "Files of images, as seen from the folder of the file that names them.", {}};
  for (const auto& [name, meaning] : {std::pair<std::string_view, std::string_view>{"color", "the surface's colour"},
                                      {"normal", "its normals in the axes of u, v and the surface, from 0 to 1"},
                                      {"surface", "in green its roughness, in blue its metal"},
                                      {"glow", "the light that it gives off"}})
    images.keys.push_back({.name = name, .type = "file", .meaning = meaning, .without = "none"});
  return images;
}

Object skin() {
  return {
      "skin",
      "The joints that the points of a shape follow.",
      {{.name = "joints",
        .type = "[name]",
        .meaning = "names of joints in the model's order, parents before children",
        .range = {1, 65536},
        .required = true},
       {.name = "bind",
        .type = "binds",
        .meaning = "for each of the joints 12 numbers, a matrix of 3 rows: it leads from the frame of the segment's "
                   "joint, as the shape was made, to the frame of this joint",
        .without = "the shape was made for the model at rest"},
       {.name = "blend",
        .type = "choice",
        .meaning = "between its bones a point goes straight, by the sum of their matrices (`linear`), or round an "
                   "arc (`dual-quaternions`), so that limbs that bend far stay full",
        .json = R"("linear")",
        .choices = kBlends}}};
}

Object proportions() {
  return {
      "proportions",
      "Factors of joints along their own axes. They move a joint's sbb and the places of the joints it carries alike.",
      {{.name = "joints",
        .type = "{factors}",
        .meaning = "object that maps a joint's name, in which `*` matches any text, to factors: one number, or `[x, y, "
                   "z]`, each 0.001 to 1000",
        .without = "none",
        .example = R"({"thigh": [1, 1, 1.2]})"},
       {.name = "branches",
        .type = "{factors}",
        .meaning = "the same for a joint and all joints below it",
        .without = "none",
        .example = R"({"leg-*": 1.1})"},
       {.name = "scale",
        .type = "factors",
        .meaning = "factors for all joints",
        .json = "1",
        .range = {1e-3, 1e3},
        .example = "[1, 1, 1.2]"},
       {.name = "height",
        .meaning = "height at rest, from the lowest to the highest point; the whole figure is scaled evenly to it",
        .without = "the resulting height",
        .range = {1e-6, kFarthest},
        .example = "1.8"},
       {.name = "ground",
        .type = "flag",
        .meaning = "whether the lowest point at rest keeps the height that it has in the other file",
        .json = "true"}}};
}

}  // namespace

std::vector<Key> material_keys() {
  std::vector<Key> keys{{.name = "color",
                         .type = "color",
                         .meaning = "colour of the surface",
                         .json = "[0.8, 0.8, 0.8]",
                         .keyed = true,
                         .example = "[0.8, 0.4, 0.2]"}};
  for (const MaterialNumber& number : kMaterialNumbers) keys.push_back(number.key);
  keys.push_back({.name = "reflection",
                  .type = "choice",
                  .meaning = "how the surface reflects light",
                  .json = R"("phong")",
                  .choices = kReflections,
                  .example = R"("blinn-phong")"});
  keys.push_back({.name = "interpolation",
                  .type = "choice",
                  .meaning = "what is interpolated over a triangle: its normal (phong), the colours of its corners "
                             "(gouraud), or nothing (flat)",
                  .json = R"("phong")",
                  .choices = kInterpolations,
                  .example = R"("flat")"});
  keys.push_back({.name = "sides",
                  .type = "sides",
                  .meaning = "1: visible from outside only; 2: from both sides",
                  .json = "2",
                  .example = "1"});
  for (const MaterialFlag& flag : kMaterialFlags) keys.push_back(flag.key);
  keys.push_back({.name = "images",
                  .type = "images",
                  .meaning = "kept, not shown: images of the surface, which `uv` of a mesh places",
                  .see = "importing-materials.md#what-is-kept",
                  .without = "none",
                  .typed = false,
                  .example = R"({"color": "rock-images/stone.png"})"});
  return keys;
}

Object shape_options() {
  Object shape{"shape", "What may be varied in shapes of the library: keys of segments.", {}};
  for (const Key* option : kShapeOptions) shape.keys.push_back(*option);
  return shape;
}

std::vector<Object> make_model_objects() {
  Object material{.name = "material",
                  .meaning = "How a surface looks. A number that its reflection does not use is an error.",
                  .keys = material_keys(),
                  .example = kMaterialExample};
  return {model(),   joint(),     limits(),      segment(), skin(),        limbs(),  side(),  surface(),
          bspline(), direction(), subdivision(), mesh(),    proportions(), material, images()};
}

std::span<const Type> model_types() { return kModelTypes; }

}  // namespace mars::keys
