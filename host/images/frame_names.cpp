#include "host/images/frame_names.h"

#include <algorithm>
#include <regex>

#include "hal/failure/failure.h"
#include "hal/failure/plain_text.h"
#include "host/content/document/text.h"

namespace mars::images {
namespace {

constexpr const char* kDigits = "####";
constexpr std::size_t kLongestPattern = 100;  // bytes
constexpr std::size_t kMostDigits = 20;

// printf's %d, %04d and so on become #.
std::string with_hashes(const std::string& text) {
  static const std::regex kNumber("%(?:0([1-9][0-9]?))?d");
  std::string hashes;
  std::string rest = text;
  for (std::smatch match; std::regex_search(rest, match, kNumber); rest = match.suffix()) {
    const std::size_t digits = match[1].matched ? std::stoul(match[1]) : 1;
    hashes += std::string(match.prefix()) + std::string(digits, '#');
  }
  return hashes + rest;
}

struct Parts {
  std::string before, after;
  std::size_t digits;
};

Parts parts_of(const std::string& pattern) {
  const std::size_t first = pattern.find('#'), last = pattern.rfind('#');
  return {pattern.substr(0, first), pattern.substr(last + 1), last + 1 - first};
}

Parts parts_of(const FrameNames& names, std::uint32_t film_frames) {
  if (!names.pattern.empty()) return parts_of(names.pattern);
  const std::uint64_t last = std::uint64_t{names.first_number} + film_frames - 1;
  return {"frame-", "", std::max<std::size_t>(4, std::to_string(last).size())};
}

}  // namespace

bool has_number(const std::string& text) { return with_hashes(text).find('#') != std::string::npos; }

std::string frame_pattern(const std::string& text) {
  std::string pattern = with_hashes(text);
  const auto refuse = [&](const std::string& reason) {
    throw Failure(document::in_quotes(text) + " " + reason, "", "names are written like shot_#### or shot_%04d");
  };
  if (pattern.find('#') == std::string::npos) pattern += kDigits;
  if (pattern.find('/') != std::string::npos || pattern.front() == '.') refuse("is no name of files in a folder");
  if (pattern.find('%') != std::string::npos) refuse("has a % that is no number of a frame");
  if (pattern.size() > kLongestPattern || plain_line(pattern) != pattern)
    refuse("is longer than 100 bytes, or has control characters");
  const Parts parts = parts_of(pattern);
  if (std::ranges::count(text, '%') + (text.find('#') != std::string::npos ? 1 : 0) > 1 ||
      pattern.substr(parts.before.size(), parts.digits).find_first_not_of('#') != std::string::npos)
    refuse("has more than one number");
  if (parts.digits > kMostDigits) refuse("has a number of more than 20 digits");
  return pattern;
}

std::string frame_name(const FrameNames& names, std::uint32_t frame, std::uint32_t film_frames) {
  const Parts parts = parts_of(names, film_frames);
  const std::string number = std::to_string(std::uint64_t{names.first_number} + frame);
  return parts.before + std::string(parts.digits - std::min(parts.digits, number.size()), '0') + number + parts.after;
}

std::optional<std::uint32_t> frame_of_name(const FrameNames& names, const std::string& name,
                                           std::uint32_t film_frames) {
  const Parts parts = parts_of(names, film_frames);
  if (!name.starts_with(parts.before) || !name.ends_with(parts.after)) return std::nullopt;
  const std::size_t around = parts.before.size() + parts.after.size();
  if (name.size() <= around) return std::nullopt;
  const auto number = document::number_in<std::uint32_t>(name.substr(parts.before.size(), name.size() - around));
  if (!number || *number < names.first_number || *number - names.first_number >= film_frames) return std::nullopt;
  const std::uint32_t frame = *number - names.first_number;
  return frame_name(names, frame, film_frames) == name ? std::optional(frame) : std::nullopt;
}

}  // namespace mars::images
