#include "host/studio/rendering/render_words.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;

// Those of `mars render` that a page may set; the command checks their values.
constexpr std::array kTexts{"frames",  "every",  "name",   "backend",   "size",   "samples",
                            "mapping", "groups", "format", "intervals", "layers", "crop"};

std::string text_in(const Json& options, const char* name, const std::string& otherwise) {
  const auto found = options.find(name);
  if (found == options.end() || found->is_null()) return otherwise;
  if (found->is_number_integer()) return found->dump();
  const bool sound = found->is_string() && found->get_ref<const std::string&>().find('\0') == std::string::npos;
  if (!sound) throw Failure(std::string(name) + " is no text", "", "");
  return found->get<std::string>();
}

bool is_option(std::string_view name) {
  constexpr auto kOthers = std::to_array<std::string_view>({"folder", "video", "nodes", "hostfile", "alpha"});
  return std::ranges::find(kTexts, name, [](const char* each) { return std::string_view(each); }) != kTexts.end() ||
         std::ranges::find(kOthers, name) != kOthers.end();
}

void refuse_unknown(const Json& options) {
  if (!options.is_object()) throw Failure("a rendering's options are an object", "", "");
  for (const auto& [name, value] : options.items())
    if (!is_option(name))
      throw Failure("is no option of renderings by pages", document::in_quotes(document::printable(name)),
                    "see docs/studio-protocol.md");
}

}  // namespace

fs::path frames_folder(const Json& options, const fs::path& folder) {
  const fs::path path = document::path_below(folder, text_in(options, "folder", "out"));
  if (path == fs::weakly_canonical(folder)) throw Failure("frames need a folder of their own", "", "name one: out");
  return path;
}

std::vector<std::string> render_words(const RenderingSettings& settings, const Json& options,
                                      const std::string& socket) {
  refuse_unknown(options);
  std::vector<std::string> words{settings.mars.string(),
                                 "render",
                                 fs::absolute(settings.film).string(),
                                 "-o",
                                 frames_folder(options, settings.folder).string(),
                                 "--watch=" + socket};
  for (const char* name : kTexts)
    if (const std::string text = text_in(options, name, ""); !text.empty())
      words.push_back("--" + std::string(name) + "=" + text);
  if (const std::string video = text_in(options, "video", ""); !video.empty())
    words.insert(words.end(), {"-o", document::path_below(settings.folder, video).string()});
  if (const std::string nodes = text_in(options, "nodes", ""); !nodes.empty()) words.push_back("--nodes=" + nodes);
  if (const std::string file = text_in(options, "hostfile", ""); !file.empty())
    words.push_back("--hostfile=" + document::path_below(settings.folder, file).string());
  if (document::flag_in(options, "alpha", false)) words.push_back("--alpha");
  return words;
}

}  // namespace mars::studio
