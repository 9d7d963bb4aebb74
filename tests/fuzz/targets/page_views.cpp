// Messages of pages about views, hands and what they show of the film's animation.
#include "tests/fuzz/studio_pages.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::page_views {
namespace {

constexpr const char* kSound = R"(
{"do": "view", "edit": 1, "view": 0, "width": 64, "height": 48, "from": "free", "as": "stick", "handles": "turn", "marks": true}
{"do": "view", "edit": 1, "view": 1, "width": 64, "height": 48, "from": "camera", "as": "surface"}
{"do": "select", "actor": "pip", "joint": "left-leg"}
{"do": "view", "edit": 2, "view": 0, "width": 64, "height": 48, "from": "free", "orbit": {"center": [0, 0, 1], "turn": 30, "height": 20, "distance": 5}, "as": "prisms", "hidden": true, "ground": false, "handles": "turn", "ghosts": {"before": 2, "after": 2, "step": 1}, "marks": true}
{"do": "view", "edit": 3, "view": 1, "width": 96, "height": 48, "from": "side", "orbit": null, "as": "surface", "handles": "reach"}
{"do": "view", "edit": 3, "view": 2, "width": 64, "height": 64, "from": "top", "as": "vertices", "handles": "points"}
{"do": "view", "edit": 3, "view": 0, "width": 64, "height": 48, "from": "free", "as": "stick", "handles": "move"}
{"do": "orbit", "edit": 4, "view": 0, "by": [30, -10], "how": "turn", "moving": true}
{"do": "orbit", "edit": 5, "view": 0, "by": [3, 4], "how": "pan", "moving": false}
{"do": "orbit", "edit": 6, "view": 1, "how": "selected", "moving": false}
{"do": "orbit", "edit": 6, "view": 1, "by": [0, 120], "how": "zoom", "x": 10, "y": 20, "moving": true}
{"do": "put_camera", "edit": 6, "view": 0}
{"do": "undo"}
{"do": "painted", "view": 0, "picture": 1}
{"do": "hover", "view": 0, "x": 32, "y": 24}
{"do": "select", "actor": "pip", "joint": "head", "more": ["left-leg"]}
{"do": "select", "actor": null, "joint": null}
{"do": "grab", "edit": 7, "view": 0, "x": 32, "y": 24, "button": 0, "keys": ["shift"]}
{"do": "grab", "edit": 7, "view": 0, "x": 32, "y": 24, "button": 0, "keys": ["shift"], "falloff": 8}
{"do": "drag", "edit": 8, "x": 40, "y": 20, "keys": ["shift"]}
{"do": "drag", "edit": 9, "x": 10, "y": 40, "keys": []}
{"do": "drop", "edit": 10}
{"do": "grab", "edit": 11, "view": 0, "x": 32, "y": 24, "button": 0, "keys": []}
{"do": "let_go"}
{"do": "pin", "actor": "pip", "joint": "left-leg", "pinned": true}
{"do": "frame", "edit": 12, "frame": 4}
{"do": "cancel"}
{"do": "undo"}
{"do": "redo"}
{"do": "channels", "things": ["*"]}
{"do": "channels", "things": ["pip", "camera", "light/1"]}
{"do": "curves", "thing": "pip", "parts": ["place", "head"], "first": 0, "last": 8}
{"do": "curves"}
{"do": "actions"}
{"do": "script", "text": "at 0 pip spin degrees 90 until 5", "name": "play.script"}
{"do": "scripts"}
{"do": "preview", "edit": 13, "step": {"commands": [["animate", "bounce", "pip", "--velocity", "1", "0", "2"]]}}
{"do": "preview", "edit": 14, "step": {"commands": [["animate", "pose", "pip", "left-leg=10,0,0", "--frame", "0", "--clamp"]]}}
{"do": "preview", "edit": 15, "step": {"commands": [["film", "remove", "pip"]]}}
{"do": "unview", "view": 2}
{"do": "select", "thing": "camera"}
{"do": "select", "thing": "light/2"}
{"do": "preview", "edit": 16, "step": {"commands": [["animate", "pose", "light/2", "place=0,0,2", "--frame", "0"], ["film", "remove", "pip"]]}}
)";

}  // namespace

void take(std::string_view input) {
  static StudioPages pages(small_film(), messages_of(kSound));
  pages.take(input);
}

const Target target("page_views", Form::bytes, take);

}  // namespace mars::fuzz::page_views
