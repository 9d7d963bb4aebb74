#include "host/content/film/crop.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::film {
namespace {

std::string sides(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

bool is_within(std::uint32_t first, std::uint32_t size, std::uint32_t whole) {
  return std::uint64_t{first} + size <= whole;
}

void check_margin(std::uint32_t margin, const wire::FilmSettings& settings, const Crop& crop,
                  const std::string& source) {
  const std::uint32_t most = std::min({wire::kMostMargin, std::max(settings.width, settings.height),
                                       (wire::kMaxSide - std::max(crop.width, crop.height)) / 2});
  if (margin > most)
    throw Failure("cannot have a margin of " + document::counted(margin, "pixel") + " around its picture of " +
                      sides(crop.width, crop.height),
                  source, "give --margin 0 to " + std::to_string(most));
}

}  // namespace

Crop read_crop(const std::string& text) {
  std::array<std::uint32_t, 4> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t end = i == 3 ? rest.size() : std::min(rest.find(i == 2 ? 'x' : ','), rest.size());
    const auto number = document::number_in<std::uint32_t>(rest.substr(0, end));
    if (!number)
      throw Failure("'" + text + "' is no part of a picture", "", "write left,top,size like 480,270,960x540");
    numbers[i] = *number;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  const auto [left, top, width, height] = numbers;
  if (width < 1 || height < 1) throw Failure("'" + text + "' is empty: it has no pixels", "", "give at least 1x1");
  return {left, top, width, height};
}

std::string text_of(const Crop& crop) {
  return std::to_string(crop.left) + "," + std::to_string(crop.top) + "," + sides(crop.width, crop.height);
}

void set_window(const std::optional<Crop>& crop, std::uint32_t margin, const std::string& source,
                wire::FilmSettings& settings) {
  const Crop part = crop.value_or(Crop{0, 0, settings.width, settings.height});
  if (!is_within(part.left, part.width, settings.width) || !is_within(part.top, part.height, settings.height))
    throw Failure("cannot be cropped to " + text_of(part) + ": its picture has " +
                      sides(settings.width, settings.height) + " pixels",
                  source, "give --crop a part of them");
  check_margin(margin, settings, part, source);
  const auto before = [margin](std::uint32_t first) {
    return static_cast<std::int32_t>(first) - static_cast<std::int32_t>(margin);
  };
  const wire::PictureWindow window{before(part.left), before(part.top), settings.width, settings.height};
  const std::uint32_t width = part.width + 2 * margin, height = part.height + 2 * margin;
  if (width == settings.width && height == settings.height && margin == 0) return;
  settings.window = window;
  settings.width = width;
  settings.height = height;
}

std::string size_text(const wire::FilmSettings& settings) {
  const wire::PictureWindow& window = settings.window;
  std::string text = sides(settings.width, settings.height);
  if (!window.is_whole())
    text += " from " + std::to_string(window.left) + "," + std::to_string(window.top) + " of " +
            sides(window.whole_width, window.whole_height);
  return text;
}

}  // namespace mars::film
