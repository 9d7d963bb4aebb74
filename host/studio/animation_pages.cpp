#include "host/studio/animation_pages.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::studio {
namespace {

constexpr std::string_view kDone[] = {"channels", "curves", "actions", "script", "scripts"};
constexpr std::size_t kMostNames = 2000;  // of things or parts that a page asks for

std::vector<std::string> names_in(const Json& message, const char* key) {
  const Json& list = message.at(key);
  if (!list.is_array() || list.size() > kMostNames) throw Failure("is no list of names", key, "");
  return list.get<std::vector<std::string>>();
}

std::uint32_t frame_in(const Json& message, const char* key) {
  const Json& frame = message.at(key);
  if (!frame.is_number_unsigned() || frame.get<std::uint64_t>() >= wire::kMostFrames)
    throw Failure(frame.dump() + " is no frame", "", "");
  return frame.get<std::uint32_t>();
}

std::optional<CurvesWanted> curves_in(const Json& message) {
  if (!message.contains("parts")) return std::nullopt;
  CurvesWanted wanted{message.at("thing").get<std::string>(), names_in(message, "parts"), frame_in(message, "first"),
                      frame_in(message, "last")};
  if (wanted.last < wanted.first) throw Failure("the last frame is before the first", "", "");
  return wanted;
}

}  // namespace

bool AnimationPages::is_for_it(const Json& message) {
  return std::ranges::find(kDone, message.at("do").get_ref<const std::string&>()) != std::end(kDone);
}

void AnimationPages::take(PageNumber page, const Json& message) {
  const std::string what = message.at("do");
  if (what == "actions") return tell_(page, actions());
  if (what == "scripts") return tell_(page, project_.scripts());
  if (what == "script") return tell_(page, project_.check_script(message.at("name"), message.at("text")));
  Wanted wanted = pages_[page];
  if (what == "channels") {
    wanted.things = names_in(message, "things");
    send_channels(page, wanted);
  } else {
    wanted.curves = curves_in(message);
    send_curves(page, wanted);
  }
  pages_[page] = std::move(wanted);  // a list that failed is not sent again at each change
}

void AnimationPages::send_channels(PageNumber page, const Wanted& wanted) {
  if (!wanted.things.empty()) tell_(page, project_.channels(wanted.things));
}

void AnimationPages::send_curves(PageNumber page, const Wanted& wanted) {
  if (wanted.curves) tell_(page, project_.curves(*wanted.curves));
}

void AnimationPages::keys_changed() {
  for (const auto& [page, wanted] : pages_) send_channels(page, wanted);
  values_changed();
}

void AnimationPages::values_changed() {
  for (const auto& [page, wanted] : pages_) send_curves(page, wanted);
}

}  // namespace mars::studio
