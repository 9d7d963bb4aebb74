// Messages of pages about a rendering: its words are made, no process is started.
#include "tests/fuzz/studio_pages.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::page_rendering {
namespace {

constexpr const char* kSound = R"(
{"do": "render", "options": {"folder": "out", "nodes": 4, "backend": "threads", "frames": "0-4", "size": "64,48", "samples": "4", "mapping": "cyclic", "groups": 1, "format": "png", "intervals": "auto"}}
{"do": "render", "options": {"folder": "a/b", "hostfile": "hosts"}}
{"do": "render"}
{"do": "stop"}
{"do": "watch", "folder": "out"}
{"do": "scrub", "frame": 3}
{"do": "scrub", "frame": null}
)";
// A picture that there was, there never is one here.
constexpr const char* kOthers = R"({"do": "painted", "view": 255, "picture": 1})";

}  // namespace

void take(std::string_view input) {
  static StudioPages pages(small_film(), messages_of(kSound), messages_of(kOthers));
  pages.take(input);
}

const Target target("page_rendering", Form::bytes, take);

}  // namespace mars::fuzz::page_rendering
