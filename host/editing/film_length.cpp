#include "host/editing/film_length.h"

#include "host/content/document/text.h"

namespace mars::editing {

std::string fit_length(document::Json& film, std::uint32_t last, bool lengthen) {
  const auto frames = film.at("frames").get<std::uint32_t>();
  if (last < frames) return "";
  if (!lengthen) return "the film shows only its " + document::counted(frames, "frame");
  film["frames"] = last + 1;
  return "the film has " + document::counted(last + 1, "frame") + " now, not " + std::to_string(frames);
}

}  // namespace mars::editing
