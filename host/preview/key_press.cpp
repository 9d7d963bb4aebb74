#include "host/preview/key_press.h"

namespace mars::preview {
namespace {

// ESC [ A, or ESC O A of terminals in another mode.
Special special_of(char last) {
  switch (last) {
    case 'A': return Special::up;
    case 'B': return Special::down;
    case 'C': return Special::right;
    case 'D': return Special::left;
    case 'H': return Special::home;
    case 'F': return Special::end;
    case 'Z': return Special::back_tab;
    default: return Special::none;
  }
}

}  // namespace

std::vector<KeyPress> take_keys(std::string& bytes) {
  std::vector<KeyPress> keys;
  std::size_t at = 0;
  while (at < bytes.size()) {
    if (bytes[at] != '\x1b') {
      keys.push_back({bytes[at++], Special::none});
      continue;
    }
    if (at + 1 < bytes.size() && bytes[at + 1] == '\x1b') {
      keys.push_back({0, Special::escape});
      ++at;
      continue;
    }
    const bool sequence = at + 1 < bytes.size() && (bytes[at + 1] == '[' || bytes[at + 1] == 'O');
    std::size_t last = at + (sequence ? 2 : 1);
    while (sequence && last < bytes.size() && (bytes[last] < '@' || bytes[last] > '~')) ++last;
    if (last >= bytes.size()) break;  // the rest is still to come
    if (sequence && last == at + 2 && special_of(bytes[last]) != Special::none)
      keys.push_back({0, special_of(bytes[last])});
    at = last + 1;
  }
  bytes.erase(0, at);
  return keys;
}

}  // namespace mars::preview
