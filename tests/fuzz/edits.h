// Inputs that are scripts: bytes that say how a sound message or file is changed before it is given to its reader. So
// the reader gets what is nearly sound, and corpora stay right when a format changes. The empty script changes nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace mars::fuzz {

using Message = std::vector<std::byte>;

// Takes a script's bytes one after another; zeros behind its end.
class Script {
 public:
  explicit Script(std::string_view bytes) : rest_(bytes) {}

  bool at_end() const { return rest_.empty(); }
  std::uint8_t byte();
  std::uint32_t word();  // two bytes
  // Below `bound`, which is above 0; of a larger bound two bytes.
  std::size_t below(std::size_t bound);
  // All that is left.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

// One change of some bytes, numbers, or the length, which becomes at most `longest`.
void edit(Message& message, Script& script, std::size_t longest);

// What the struct looks like in a message.
template <typename Struct>
Message message_of(const Struct& from) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(&from);
  return {bytes, bytes + sizeof from};
}

}  // namespace mars::fuzz
