#include "host/studio/web/page_message.h"

#include <cmath>

#include "hal/failure/failure.h"

namespace mars::web {
namespace {

using document::Json;

constexpr int kDeepest = 16;

[[noreturn]] void refuse(const char* problem) {
  throw Failure(problem, "a page's message", "see docs/studio-protocol.md");
}

Json parse(std::string_view text) {
  bool too_deep = false;
  const auto limit = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > kDeepest;
    return !too_deep;
  };
  Json message = Json::parse(text, limit, false);
  if (too_deep) refuse("it is nested too deep");
  if (message.is_discarded()) refuse("it is not JSON");
  return message;
}

}  // namespace

Json read_page_message(std::string_view text) {
  if (text.size() > kMostMessage) refuse("it is too long");
  Json message = parse(text);
  if (!message.is_object()) refuse("it is no object");
  const auto what = message.find("do");
  if (what == message.end() || !what->is_string()) refuse("it has no text \"do\"");
  return message;
}

}  // namespace mars::web
