#include "host/content/keys/actor_keys.h"

namespace mars::keys {
namespace {

constexpr std::string_view kAxes[] = {"world", "joint"};  // of a point's offset, in the order that they are read to

}  // namespace

Object actor() {
  return {
      "actor",
      "",
      {{.name = "name", .type = "name", .meaning = "unique among the actors", .required = true, .example = R"("anna")"},
       {.name = "model",
        .type = "text",
        .meaning = "one of the film's models",
        .required = true,
        .example = R"("robot")"},
       {.name = "place",
        .type = "vector",
        .meaning = "position of the model's frame in the world",
        .json = "[0, 0, 0]",
        .keyed = true,
        .example = "[1, 0, 0.5]"},
       {.name = "turn",
        .type = "angles",
        .meaning = "rotation of the model's frame: about x, then about the turned y, then about the turned z",
        .json = "[0, 0, 0]",
        .unit = "degrees",
        .keyed = true,
        .example = "[0, 0, 90]"},
       {.name = "pose",
        .type = "{angles}",
        .meaning = "object that maps a joint to its three rotations, in the same order",
        .without = "each as near to 0 as its limits allow",
        .unit = "degrees",
        .keyed = true,
        .keyed_type = "{angles_or_part}",
        .example = R"({"elbow": [0, 90, 0]})"},
       {.name = "material",
        .type = "text",
        .meaning = "a material of the film for all segments",
        .without = "the model's materials",
        .example = R"("oak")"},
       {.name = "materials",
        .type = "{text}",
        .meaning = "object that maps a material of the model to a material of the film that replaces it",
        .without = "none",
        .example = R"({"skin": "oak"})"},
       {.name = "keys",
        .type = "[actor_key]",
        .meaning = "list of keys",
        .without = "none",
        .example = R"([{"frame": 0}, {"frame": 24}])"},
       {.name = "attach",
        .type = "attach_or_null",
        .meaning = "what carries the actor, or `null` for nothing",
        .see = "#attached-actors",
        .json = "null",
        .keyed = true,
        .keyed_type = "attach_or_null"},
       {.name = "matrices",
        .type = "[matrices_key]",
        .meaning = "replaces place, turn, pose, attach and keys",
        .see = "#matrices-of-another-animation-tool",
        .without = "none",
        .range = {1, kFarthest},
        .example = R"([{"frame": 0, "segments": {"hand": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}}])"}}};
}

Object part() {
  return {
      "part",
      "A part of a key with more than its value.",
      {{.name = "value",
        .type = "value",
        .meaning = "the part's value, written as it would be without the object",
        .required = true},
       {.name = "ease",
        .type = "ease",
        .meaning = "ease from this key to the next key that has the part",
        .without = "the key's `ease`"},
       {.name = "in",
        .type = "numbers",
        .meaning = "slope with which a spline reaches the key: change of the value per frame, written as the value is",
        .without = "from the neighbouring keys"},
       {.name = "out",
        .type = "numbers",
        .meaning = "slope with which a spline leaves the key",
        .without = "from the neighbouring keys"}}};
}

Object point() {
  return {
      "point",
      "A point that goes along with an actor.",
      {{.name = "actor",
        .type = "name",
        .meaning = "an actor that keys move, not matrices",
        .required = true,
        .example = R"("tom")"},
       {.name = "joint",
        .type = "name",
        .meaning = "a joint of its model",
        .without = "the actor's own frame",
        .example = R"("right-hand")"},
       {.name = "offset",
        .type = "vector",
        .meaning = "vector from the joint, or from the place of the actor, to the point",
        .json = "[0, 0, 0]",
        .example = "[0, 0, 0.2]"},
       {.name = "axes",
        .type = "choice",
        .meaning =
            "the offset is along the axes of the `\"world\"`, or of the `\"joint\"` (without a joint, of the actor)",
        .json = R"("world")",
        .choices = kAxes,
        .example = R"("joint")"},
       {.name = "level",
        .type = "flag",
        .meaning = "`true`: the point's height is the z of `offset` alone, so that steps do not shake the camera",
        .json = "false",
        .example = "true"}}};
}

Object attach() {
  return {"attach",
          "What carries an actor; it stands in the frame of the joint.",
          {{.name = "actor",
            .type = "name",
            .meaning = "the actor that carries it; it may stand later in the list",
            .required = true,
            .example = R"("tom")"},
           {.name = "joint",
            .type = "name",
            .meaning = "a joint of that actor's model",
            .without = "the actor's own frame",
            .example = R"("right-hand")"},
           {.name = "place",
            .type = "vector",
            .meaning = "position of this actor's frame in the frame that carries it",
            .json = "[0, 0, 0]",
            .example = "[1, 0, 0.5]"},
           {.name = "turn",
            .type = "angles",
            .meaning = "rotation of this actor's frame in the frame that carries it, as an actor's `turn`",
            .json = "[0, 0, 0]",
            .unit = "degrees",
            .example = "[0, 0, 90]"}}};
}

Object matrices_key() {
  return {"matrices_key",
          "",
          {{.name = "frame", .type = "frame", .meaning = "the frame", .required = true},
           {.name = "segments",
            .type = "{matrix}",
            .meaning = "joints by name, and the matrices of their segments, or of bones: three rows `[xx, xy, xz, tx]` "
                       "from the sbb to the world, held until the next",
            .required = true,
            .example = R"({"hand": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]})"}}};
}

}  // namespace mars::keys
