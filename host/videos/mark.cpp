#include "host/videos/mark.h"

#include <nlohmann/json.hpp>

#include "host/content/film/frame_set.h"
#include "host/render/sinks/record.h"
#include "node/wire/film_parts.h"

namespace mars::videos {

using nlohmann::json;

namespace {

std::uint32_t side_of(const json& number) {
  constexpr std::uint64_t kMost = 1 << 16;
  const bool is_side = number.is_number_unsigned() && number.get<std::uint64_t>() - 1 < kMost;
  if (!is_side) sinks::refuse_value("size", number, "pixels of a side");
  return number.get<std::uint32_t>();
}

}  // namespace

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

bool is_mark(const std::string& text) {
  const json from = json::parse(text, nullptr, false);
  return from.is_object() && from.contains("mars");
}

std::optional<Mark> mark_of(const std::string& text) try {
  constexpr std::size_t kLongest = 1 << 16;
  const json from = sinks::parse_record(text);
  const sinks::Record record(from);
  if (record.value("mars") != 1) return std::nullopt;
  const json& size = record.list("size");
  Mark mark{record.text("film", kLongest),
            record.text("recipe", kLongest),
            {},
            static_cast<std::uint32_t>(record.whole_number("film_frames", 1, wire::kMostFrames)),
            record.positive_number("rate"),
            side_of(size.at(0)),
            side_of(size.at(1))};
  mark.frames = film::FrameSet(from.at("frames").get<std::string>()).of_film(mark.film_frames);
  return mark;
} catch (const std::exception&) {  // somebody else's
  return std::nullopt;
}

}  // namespace mars::videos
