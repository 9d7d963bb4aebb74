// What a terminal sends when keys are pressed, however it is cut.
#include "hal/failure/failure.h"
#include "host/preview/key_press.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::key_bytes {

void take(std::string_view input) {
  std::string all(input), rest;
  auto whole = preview::take_keys(all);
  std::vector<preview::KeyPress> pieces;
  for (const char byte : input) {
    rest += byte;
    const auto keys = preview::take_keys(rest);
    pieces.insert(pieces.end(), keys.begin(), keys.end());
  }
  check(all.size() <= input.size() && all == rest && whole == pieces, "keys are the same however they come");
}

const Target target("key_bytes", Form::bytes, take);

}  // namespace mars::fuzz::key_bytes
