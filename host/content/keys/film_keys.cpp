#include <iterator>

#include "host/content/keys/actor_keys.h"
#include "host/content/keys/objects.h"
#include "node/wire/film_parts.h"

namespace mars::keys {
namespace {

// In the order of the enumerations that they are read to.
constexpr std::string_view kColors[] = {"coded", "linear"}, kCurves[] = {"none", "filmic", "agx"},
                           kCuttings[] = {"auto", "keyframes"},
                           kProjections[] = {"perspective", "orthographic", "panorama"};
static_assert(std::size(kProjections) == static_cast<std::size_t>(wire::kLastProjection) + 1);

// Kinds of a film, and so of its camera, in the order of wire::ColorSpace.
constexpr Kind kColorSpaces[] = {{"coded", "Coded"}, {"linear", "Linear"}};
constexpr unsigned kOfLinear = 1u << static_cast<unsigned>(wire::ColorSpace::linear);

constexpr unsigned bit_of(wire::LightKind kind) { return 1u << static_cast<unsigned>(kind); }
constexpr unsigned kFar = bit_of(wire::LightKind::directional), kSpot = bit_of(wire::LightKind::spot),
                   kNear = bit_of(wire::LightKind::point) | kSpot;
constexpr std::string_view kNewSun[] = {"direction=1,-1,2"}, kNewBulb[] = {"place=0,-3,4"},
                           kNewSpot[] = {"place=0,-4,5", "at=0,0,1"};
// In the order of wire::LightKind.
constexpr Kind kLightKinds[] = {
    {"directional", "Sun", kNewSun}, {"point", "Bulb", kNewBulb}, {"spot", "Spot", kNewSpot}};
static_assert(std::size(kLightKinds) == static_cast<std::size_t>(wire::kLastLightKind) + 1);
constexpr Measure kLightSizes[] = {{{0, 90}, "degrees"}, {{0, kFarthest}}, {{0, kFarthest}}};
static_assert(std::size(kLightSizes) == std::size(kLightKinds));

constexpr std::string_view kSides[] = {"width", "height"}, kAngles[] = {"inner", "outer"}, kShifts[] = {"right", "up"};

constexpr Type kFilmTypes[] = {
    {"frame", R"({"type": "integer", "minimum": 0, "maximum": 1000000})", "24"},
    {"size",
     R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "integer", "minimum": 1, "maximum": 16384}})",
     "[960, 540]", "", kSides},
    {"samples", R"({"enum": [1, 2, 4, 8, 16]})", "4"},
    {"dice", R"({"anyOf": [{"const": "adaptive"}, {"type": "integer", "minimum": 1, "maximum": 256}]})", ""},
    {"color_or_ambient", R"({"anyOf": ["#color", "#ambient"]})", "[0.8, 0.9, 1]"},
    {"model_or_file", R"({"anyOf": [{"type": "string", "minLength": 1}, "#model"]})", R"("robot.json")"},
    {"ease",
     R"({"anyOf": [{"enum": ["linear", "in", "out", "both", "spline", "hold"]}, {"type": "array", "minItems": 4, "maxItems": 4,
         "prefixItems": [{"type": "number", "minimum": 0, "maximum": 1}, {"type": "number", "minimum": -10, "maximum": 10},
                         {"type": "number", "minimum": 0, "maximum": 1}, {"type": "number", "minimum": -10, "maximum": 10}],
         "items": {"type": "number", "minimum": -10, "maximum": 10}}]})",
     "[0.4, 0, 0.6, 1]"},
    {"numbers",
     R"({"anyOf": [{"type": "number"}, {"type": "array", "minItems": 2, "maxItems": 3, "items": {"type": "number"}}]})",
     ""},
    {"value", R"({"anyOf": ["#numbers", "#point"]})", ""},
    {"angles",
     R"({"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": -1e6, "maximum": 1e6}})",
     "[0, 90, 0]"},
    {"angles_or_part", R"({"anyOf": ["#angles", "#part"]})", "[0, 90, 0]"},
    {"angle", R"({"type": "number", "minimum": 0.01, "maximum": 180})", "40"},
    {"cone", R"({"anyOf": ["#angle", {"type": "array", "minItems": 2, "maxItems": 2, "items": "#angle"}]})", "[30, 40]",
     "", kAngles},
    {"shift",
     R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "number", "minimum": -1, "maximum": 1}})",
     "[0, 0.25]", "", kShifts},
    {"place_or_point", R"({"anyOf": ["#vector", "#point"]})", "[0, -9, 2]"},
    {"attach_or_null", R"({"anyOf": [{"type": "null"}, "#attach"]})", R"({"actor": "tom", "joint": "right-hand"})"},
    {"matrix",
     R"({"type": "array", "minItems": 3, "maxItems": 3,
         "items": {"type": "array", "minItems": 4, "maxItems": 4, "items": "#coordinate"}})",
     "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"},
};

Object film() {
  return {
      "film",
      "Camera, lights, materials, models and actors over frames that count from 0. World: right-handed, z up. Angles "
      "in degrees, colours 0 to 1.",
      {{.name = "version",
        .type = "whole",
        .meaning = "version of this format",
        .without = "keys of all versions are allowed",
        .range = {1, 2},
        .typed = false,
        .example = "2"},
       {.name = "frames",
        .type = "whole",
        .meaning = "number of frames",
        .range = {1, wire::kMostFrames},
        .required = true,
        .example = "48"},
       {.name = "rate", .meaning = "frames per second", .number = 24, .range = {0.001, 1000}},
       {.name = "audio",
        .type = "file",
        .meaning = "a file with the sound of videos, as seen from the film's folder",
        .see = "videos.md#sound",
        .without = "videos are silent",
        .example = R"("music.wav")"},
       {.name = "audio_delay",
        .meaning = "when the sound begins, after the first frame",
        .number = 0,
        .range = {-1e6, 1e6},
        .unit = "seconds",
        .label = "Audio delay",
        .rare = true},
       {.name = "size",
        .type = "size",
        .meaning = "`[width, height]`, each 1 to 16384",
        .json = "[960, 540]",
        .range = {1, 16384},
        .unit = "pixels"},
       {.name = "pixel_aspect",
        .meaning = "width of a pixel by its height: 2 for pictures that are shown twice as wide",
        .see = "cameras.md#pixels-that-are-not-square",
        .number = 1,
        .range = {0.0625, 16},
        .label = "Pixel aspect",
        .rare = true},
       {.name = "samples",
        .type = "samples",
        .meaning = "samples of a pixel, 1, 2, 4, 8 or 16: more make smoother edges and take longer",
        .json = "4"},
       {.name = "color",
        .type = "choice",
        .meaning = "`\"linear\"`: colours are light; `\"coded\"`: numbers as they are shown",
        .see = "light-and-materials.md#light-and-colour",
        .json = R"("linear")",
        .choices = kColors,
        .label = "Colours",
        .rare = true},
       {.name = "curve",
        .type = "choice",
        .meaning = "how light becomes what is shown; in linear films only",
        .json = R"("filmic")",
        .choices = kCurves,
        .of = kOfLinear,
        .rare = true},
       {.name = "background",
        .type = "color",
        .meaning = "colour of the background",
        .json = "[0, 0, 0]",
        .example = "[0.1, 0.2, 0.3]"},
       {.name = "ambient",
        .type = "color_or_ambient",
        .meaning = "light from all around: one colour, or `{\"sky\": COLOUR, \"ground\": COLOUR}` from above and below",
        .without = "`[1, 1, 1]`; without lights a little darker from below"},
       {.name = "fog",
        .type = "fog",
        .meaning = "surfaces take on its colour with distance",
        .see = "light-and-materials.md#fog",
        .without = "none",
        .typed = false,
        .example = R"({"start": 10, "end": 100})"},
       {.name = "intervals",
        .type = "choice",
        .meaning = "where render intervals are cut: where it saves work, or at keys",
        .see = "render-intervals.md#render-intervals",
        .json = R"("auto")",
        .choices = kCuttings,
        .rare = true},
       {.name = "dice",
        .type = "dice",
        .meaning = "`\"adaptive\"`, or N to dice every patch into N x N quads, 1 to 256",
        .json = R"("adaptive")",
        .rare = true},
       {.name = "camera",
        .type = "camera",
        .meaning = "where the camera stands and looks",
        .see = "#camera",
        .required = true,
        .typed = false,
        .example = R"({"eye": [0, -9, 2], "at": [0, 0, 1]})"},
       {.name = "lights",
        .type = "[light]",
        .meaning = "list of lights",
        .see = "light-and-materials.md#without-lights",
        .without = "three lights",
        .range = {0, 64},
        .typed = false,
        .example = R"([{"direction": [-0.4, -0.7, 0.8]}])"},
       {.name = "materials",
        .type = "{film_material}",
        .meaning = "object that maps names to materials",
        .without = "none",
        .typed = false,
        .example = R"({"oak": {"color": [0.7, 0.5, 0.3]}})"},
       {.name = "models",
        .type = "{model_or_file}",
        .meaning =
            "object that maps names to models: either a file name relative to the film's folder, or a model itself",
        .see = "model-format.md",
        .required = true,
        .typed = false,
        .example = R"({"robot": "robot.json"})"},
       {.name = "actors",
        .type = "[actor]",
        .meaning = "list of actors",
        .required = true,
        .typed = false,
        .example = R"([{"name": "anna", "model": "robot"}])"}}};
}

Object camera() {
  return {"camera",
          "",
          {{.name = "eye",
            .type = "place_or_point",
            .meaning = "position of the camera, `[x, y, z]` or a point of an actor; required here or in keys",
            .see = "#points-of-actors",
            .keyed = true},
           {.name = "at",
            .type = "place_or_point",
            .meaning = "point that the camera looks at, or a point of an actor",
            .json = "[0, 0, 0]",
            .keyed = true,
            .example = "[0, 0, 1]",
            .label = "Looks at"},
           {.name = "up",
            .type = "vector",
            .meaning = "direction that is up in the picture, of any length",
            .json = "[0, 0, 1]",
            .keyed = true,
            .rare = true},
           {.name = "projection",
            .type = "choice",
            .meaning = "`\"perspective\"`: what is farther is smaller; `\"orthographic\"`: rays are parallel; "
                       "`\"panorama\"`: all directions",
            .see = "cameras.md",
            .json = R"("perspective")",
            .choices = kProjections},
           {.name = "fov",
            .meaning = "vertical field of view of a perspective camera",
            .number = 40,
            .range = {0.01, 179},
            .unit = "degrees",
            .keyed = true,
            .label = "View angle"},
           {.name = "height",
            .meaning = "height that the picture of an orthographic camera shows",
            .number = 10,
            .range = {1e-5, kFarthest},
            .keyed = true,
            .label = "View height"},
           {.name = "shift",
            .type = "shift",
            .meaning = "lens shift, -1 to 1: `[right, up]`, in widths and heights of the picture",
            .see = "cameras.md",
            .json = "[0, 0]",
            .keyed = true,
            .rare = true},
           {.name = "exposure",
            .meaning = "each stop doubles the light; in linear films only",
            .number = 0,
            .range = {-16, 16},
            .unit = "stops",
            .keyed = true,
            .example = "0.5",
            .of = kOfLinear},
           {.name = "near",
            .meaning = "distance of the near plane: nothing nearer is drawn",
            .number = 0.1,
            .range = {1e-6, 1e9},
            .rare = true},
           {.name = "far",
            .meaning = "distance of the far plane: nothing farther is drawn",
            .number = 10000,
            .range = {1e-6, 1e10},
            .rare = true},
           {.name = "interaxial",
            .meaning = "distance between the two eyes of a stereo pair",
            .see = "cameras.md#stereo-pairs",
            .number = 0.065,
            .range = {0, kFarthest},
            .rare = true},
           {.name = "convergence",
            .meaning = "distance at which both eyes of a stereo pair see things in the same place of their pictures",
            .number = 5,
            .range = {1e-5, kFarthest},
            .rare = true},
           {.name = "keys",
            .type = "[camera_key]",
            .meaning = "list of keys",
            .without = "none",
            .typed = false,
            .example = R"([{"frame": 0}, {"frame": 24}])"}}};
}

Object light() {
  return {
      "light",
      "Far away with a direction, near with a place; a spot with a place and at. Here or in keys.",
      {{.name = "direction",
        .type = "vector",
        .meaning = "vector towards a far light, of any length",
        .keyed = true,
        .example = "[-0.4, -0.7, 0.8]",
        .of = kFar},
       {.name = "place",
        .type = "vector",
        .meaning = "position of a point light or a spot",
        .keyed = true,
        .of = kNear},
       {.name = "at",
        .type = "vector",
        .meaning = "point at which a spot aims",
        .keyed = true,
        .example = "[0, 0, 1]",
        .of = kSpot,
        .label = "Aims at"},
       {.name = "cone",
        .type = "cone",
        .meaning = "how wide a spot's cone opens, 0.01 to 180: `[inner, outer]`, fully lit within the inner cone and "
                   "dark outside the outer one; or the outer angle alone, the inner is then 0.8 of it",
        .json = "[32, 40]",
        .range = {0.01, 180},
        .unit = "degrees",
        .keyed = true,
        .example = "[30, 40]",
        .of = kSpot},
       {.name = "reach",
        .meaning = "distance from a point light or a spot at which it has half its brightness: at distance d it is 1 / "
                   "(1 + (d / reach)^2)",
        .without = "the same at all distances",
        .range = {1e-6, kFarthest},
        .keyed = true,
        .example = "5",
        .of = kNear},
       {.name = "color",
        .type = "color",
        .meaning = "colour of the light",
        .json = "[1, 1, 1]",
        .keyed = true,
        .label = "Colour"},
       {.name = "intensity",
        .meaning = "factor for the light of this colour",
        .number = 1,
        .range = {0, 1000},
        .keyed = true},
       {.name = "shadow",
        .type = "flag",
        .meaning = "whether what stands in its light casts a shadow",
        .see = "#shadows",
        .json = "false",
        .example = "true"},
       {.name = "size",
        .meaning =
            "how wide the light is, which makes edges of its shadows soft: of a far light the angle that it takes "
            "up in the sky, 90 degrees at most (the sun: 0.53), of others a length; 0: edges are sharp",
        .number = 0,
        .range = {0, kFarthest},
        .keyed = true,
        .example = "0.53",
        .measures = kLightSizes},
       {.name = "keys",
        .type = "[light_key]",
        .meaning = "list of keys",
        .without = "none",
        .typed = false,
        .example = R"([{"frame": 0}, {"frame": 24}])"}}};
}

Object ambient() {
  return {
      "ambient",
      "Light from all around.",
      {{.name = "sky", .type = "color", .meaning = "from above", .required = true, .example = "[0.8, 0.9, 1]"},
       {.name = "ground", .type = "color", .meaning = "from below", .required = true, .example = "[0.4, 0.3, 0.2]"}}};
}

Object fog() {
  return {"fog",
          "Surfaces take on its colour evenly from start to end, distances along the camera's view.",
          {{.name = "color", .type = "color", .meaning = "its colour", .without = "the background's"},
           {.name = "start",
            .meaning = "distance at which it begins",
            .number = 0,
            .range = {0, kFarthest},
            .example = "10"},
           {.name = "end",
            .meaning = "distance from which nothing else is seen, beyond start",
            .range = {0, kFarthest},
            .required = true,
            .example = "100"}}};
}

Object film_material() {
  Object material{.name = "film_material",
                  .meaning = "A model's material, with keys.",
                  .keys = material_keys(),
                  .example = kMaterialExample};
  material.keys.push_back({.name = "keys",
                           .type = "[material_key]",
                           .meaning = "list of keys",
                           .without = "none",
                           .typed = false,
                           .example = R"([{"frame": 0}, {"frame": 24}])"});
  return material;
}

Object of_kinds(std::span<const Kind> kinds, Object object) {
  object.kinds = kinds;
  return object;
}

// What keys of the object may have.
Object keys_of(const Object& object, std::string_view name) {
  Object keys{name, "", {}};
  keys.keys.push_back({.name = "frame",
                       .type = "frame",
                       .meaning = "from 0, ascending from key to key; may lie behind the film's last",
                       .required = true});
  for (Key key : object.keys) {
    if (!key.keyed) continue;
    if (!key.keyed_type.empty()) key.type = key.keyed_type;
    keys.keys.push_back(key);
  }
  keys.keys.push_back(
      {.name = "ease",
       .type = "ease",
       .meaning =
           "how values go from this key to the next: a name, or its timing as the curve [x1, y1, x2, y2], as in CSS",
       .json = R"("linear")",
       .example = "[0.4, 0, 0.6, 1]"});
  return keys;
}

}  // namespace

std::vector<Object> make_film_objects() {
  return {of_kinds(kColorSpaces, film()),
          of_kinds(kColorSpaces, camera()),
          keys_of(camera(), "camera_key"),
          of_kinds(kLightKinds, light()),
          keys_of(light(), "light_key"),
          ambient(),
          fog(),
          film_material(),
          keys_of(film_material(), "material_key"),
          actor(),
          keys_of(actor(), "actor_key"),
          matrices_key(),
          part(),
          point(),
          attach()};
}

std::span<const Type> film_types() { return kFilmTypes; }

}  // namespace mars::keys
