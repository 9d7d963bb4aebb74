#include "host/videos/mark.h"

#include <nlohmann/json.hpp>

#include "host/content/film/frame_set.h"
#include "node/wire/film_parts.h"

namespace mars::videos {

using nlohmann::json;

std::string text_of(const Mark& mark) {
  const json text{{"mars", 1},
                  {"film", mark.film},
                  {"recipe", mark.recipe},
                  {"frames", film::FrameSet(mark.frames).text()},
                  {"film_frames", mark.film_frames},
                  {"rate", mark.rate},
                  {"size", {mark.width, mark.height}}};
  return text.dump(-1, ' ', true, json::error_handler_t::replace);
}

std::optional<Mark> mark_of(const std::string& text) try {
  const json from = json::parse(text);
  if (from.at("mars") != 1) return std::nullopt;
  Mark mark{from.at("film").get<std::string>(),
            from.at("recipe").get<std::string>(),
            {},
            from.at("film_frames").get<std::uint32_t>(),
            from.at("rate").get<double>(),
            from.at("size").at(0).get<std::uint32_t>(),
            from.at("size").at(1).get<std::uint32_t>()};
  if (mark.film_frames == 0 || mark.film_frames > wire::kMostFrames) return std::nullopt;
  mark.frames = film::FrameSet(from.at("frames").get<std::string>()).of_film(mark.film_frames);
  return mark;
} catch (const std::exception&) {  // somebody else's
  return std::nullopt;
}

}  // namespace mars::videos
