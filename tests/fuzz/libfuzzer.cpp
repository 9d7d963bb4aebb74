// Where clang is there: libFuzzer gives the program's one target inputs, and looks for those that reach further.
#include <algorithm>
#include <cstring>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

const mars::fuzz::Target& own_target() {
  static const mars::fuzz::Target& target = *mars::fuzz::all_targets().front();
  return target;
}

bool takes_text() { return own_target().form == mars::fuzz::Form::text; }

std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

std::size_t put(const std::string& text, std::uint8_t* to, std::size_t most) {
  const std::size_t size = std::min(text.size(), most);
  if (size > 0) std::memcpy(to, text.data(), size);
  return size;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  mars::fuzz::run(own_target(), text_of(data, size));
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  mars::fuzz::Mutation mutation(seed);
  if (!takes_text() || mutation.below(4) == 0) return LLVMFuzzerMutate(data, size, most);
  return put(mutation.of_text(text_of(data, size), text_of(data, size)), data, most);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                                 const std::uint8_t* data2, std::size_t size2, std::uint8_t* out,
                                                 std::size_t most, unsigned seed) {
  mars::fuzz::Mutation mutation(seed);
  const auto one = text_of(data1, size1), other = text_of(data2, size2);
  return put(takes_text() ? mutation.of_text(one, other) : mutation.of_bytes(one, other), out, most);
}
