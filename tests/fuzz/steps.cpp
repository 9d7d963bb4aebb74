#include "tests/fuzz/steps.h"

namespace mars::fuzz {

Messages with_steps(const Messages& steps) {
  Messages messages{Json::parse(
      R"({"do": "view", "edit": 1, "view": 0, "width": 64, "height": 48, "from": "free", "as": "surface", "handles": "turn"})")};
  for (const Json& step : steps)
    for (const char* what : {"preview", "commit"}) messages.push_back({{"do", what}, {"edit", 1}, {"step", step}});
  return messages;
}

}  // namespace mars::fuzz
