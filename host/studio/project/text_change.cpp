#include "host/studio/project/text_change.h"

#include <algorithm>

namespace mars::studio {
namespace {

bool is_inside_character(std::string_view text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
}

std::optional<std::string> exchanged(std::string_view text, std::size_t at, std::string_view old,
                                     std::string_view with) {
  if (at > text.size() || text.substr(at, old.size()) != old) return std::nullopt;
  std::string changed;
  changed.reserve(text.size() - old.size() + with.size());
  return changed.append(text.substr(0, at)).append(with).append(text.substr(at + old.size()));
}

}  // namespace

std::optional<std::string> TextChange::done(std::string_view text) const { return exchanged(text, at, before, after); }
std::optional<std::string> TextChange::undone(std::string_view text) const {
  return exchanged(text, at, after, before);
}

TextChange change_between(std::string_view before, std::string_view after) {
  const std::size_t shorter = std::min(before.size(), after.size());
  std::size_t same = 0, same_end = 0;
  while (same < shorter && before[same] == after[same]) ++same;
  while (same > 0 && (is_inside_character(before, same) || is_inside_character(after, same))) --same;
  while (same_end < shorter - same && before[before.size() - 1 - same_end] == after[after.size() - 1 - same_end])
    ++same_end;
  while (same_end > 0 &&
         (is_inside_character(before, before.size() - same_end) || is_inside_character(after, after.size() - same_end)))
    --same_end;
  return {same, std::string(before.substr(same, before.size() - same_end - same)),
          std::string(after.substr(same, after.size() - same_end - same))};
}

}  // namespace mars::studio
