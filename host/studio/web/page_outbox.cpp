#include "host/studio/web/page_outbox.h"

#include <algorithm>
#include <utility>

namespace mars::web {
namespace {

using studio::ViewPicture;
using namespace std::chrono_literals;

constexpr std::size_t kMostUnpainted = 2;  // pictures of a view on the way
constexpr std::size_t kMostWaiting = 16;   // more, and somebody acknowledges what was never painted
constexpr std::size_t kMostTextBytes = 16 << 20;
constexpr auto kQuiet = 150ms;         // after which a hand is taken to rest
constexpr double kBandSeconds = 0.05;  // that a band takes, about
constexpr double kDeflatedTo = 0.3;    // of the bytes of pixels, about
constexpr std::uint32_t kFewestRows = 16;

bool replaces(const std::string& kind) {
  constexpr std::string_view kKinds[] = {"project", "poses", "state", "channels", "curves"};
  return std::ranges::find(kKinds, kind) != std::end(kKinds);
}

std::optional<std::uint32_t> number_in(const Json& message, const char* name) {
  const auto found = message.find(name);
  if (found == message.end() || !found->is_number_integer()) return {};
  const auto number = found->get<std::int64_t>();
  return number >= 0 && number <= UINT32_MAX ? std::optional(static_cast<std::uint32_t>(number)) : std::nullopt;
}

std::string text_of(const Json& message) { return message.dump(-1, ' ', false, Json::error_handler_t::replace); }

// The rectangles of `changes` over the whole picture.
void paste(ViewPicture& whole, ViewPicture changes) {
  pictures::paste(changes.pixels, changes.rects, whole.width, whole.pixels);
  changes.rects = std::move(whole.rects);
  changes.pixels = std::move(whole.pixels);
  whole = std::move(changes);
}

}  // namespace

// Messages go before pictures: handles that are sent now are newer than those of pictures that wait.
void PageOutbox::drop_handles_of_waiting(const Json& message) {
  const auto number = number_in(message, "view");
  if (const auto view = number ? views_.find(*number) : views_.end(); view != views_.end())
    for (ViewPicture& picture : view->second.waiting) picture.handles = nullptr;
}

void PageOutbox::tell(const Json& message) {
  std::string kind = message.value("is", "");
  if (kind == "handles") drop_handles_of_waiting(message);
  std::string text = text_of(message);
  text_bytes_ += text.size();
  const auto same = std::ranges::find(texts_, kind, &Text::kind);
  if (!replaces(kind) || same == texts_.end()) {
    texts_.push_back({std::move(kind), std::move(text)});
    return;
  }
  text_bytes_ -= same->text.size();
  same->text = std::move(text);
}

void PageOutbox::show(ViewPicture picture, Time now) {
  View& view = views_[picture.view];
  if (view.lossy) view.lossy->due = now + kQuiet;
  view.waiting.push_back(std::move(picture));
}

bool PageOutbox::hear(const Json& message, Time now) {
  const auto what = message.find("do");
  const auto number = number_in(message, "view");
  if (!number) return true;
  if (*what == "unview") views_.erase(*number);
  if (*what != "painted") return true;
  const auto picture = number_in(message, "picture");
  return !picture || painted(*number, *picture, now);
}

// A page may acknowledge several at once.
bool PageOutbox::painted(std::uint32_t number, std::uint32_t picture, Time now) {
  const auto view = views_.find(number);
  if (view == views_.end()) return false;
  std::deque<Sent>& sent = view->second.sent;
  const auto last = std::ranges::find(sent, picture, &Sent::picture);
  if (last == sent.end()) return false;
  const bool of_stage = std::any_of(sent.begin(), last + 1, [](const Sent& each) { return !each.again; });
  const Time since = std::max(last->since, painted_at_);
  speed_.acknowledged(last->bytes, std::chrono::duration<double>(now - since).count());
  painted_at_ = now;
  sent.erase(sent.begin(), last + 1);
  return of_stage;
}

PageOutbox::Outgoing PageOutbox::encode(View& view, const ViewPicture& picture, Encoding encoding, Time now,
                                        bool again) {
  Outgoing outgoing{false, picture_message(picture, encoding)};
  view.sent.push_back({picture.picture, outgoing.bytes.size(), now, again});
  return outgoing;
}

// First its handles, where it has some.
PageOutbox::Outgoing PageOutbox::send_picture(View& view, Time now) {
  if (Json handles = std::exchange(view.waiting.front().handles, nullptr); !handles.is_null()) {
    const ViewPicture& of = view.waiting.front();
    const Json message{{"is", "handles"}, {"view", of.view}, {"picture", of.picture}, {"shapes", std::move(handles)}};
    return {true, text_of(message)};
  }
  ViewPicture picture = std::move(view.waiting.front());
  view.waiting.pop_front();
  const bool whole = is_whole(picture), exact = picture.exact;
  const Encoding encoding = speed_.best_for(picture.pixels.size() * sizeof(std::uint32_t), whole && !picture.rests);
  const bool other_size =
      view.lossy && (view.lossy->last.width != picture.width || view.lossy->last.height != picture.height);
  if (other_size || (whole && encoding != Encoding::jpeg)) view.lossy.reset();
  if (view.lossy && encoding != Encoding::jpeg) picture.exact = false;  // what is around its rectangles is not
  Outgoing outgoing = encode(view, picture, encoding, now, false);
  if (encoding == Encoding::jpeg) {
    view.lossy = Lossy{std::move(picture), 0, now + kQuiet};
  } else if (view.lossy) {
    picture.exact = exact;
    paste(view.lossy->last, std::move(picture));
    view.lossy->due = view.lossy->last.rests ? now : now + kQuiet;
  }
  return outgoing;
}

PageOutbox::Outgoing PageOutbox::send_band(View& view, Time now) {
  Lossy& lossy = *view.lossy;
  const ViewPicture& whole = lossy.last;
  const double row = whole.width * sizeof(std::uint32_t) * kDeflatedTo;
  const auto fits = static_cast<std::uint32_t>(std::min(65535.0, speed_.bytes_a_second() * kBandSeconds / row));
  const std::uint32_t rows = std::min(std::max(fits, kFewestRows), whole.height - lossy.exact_rows);
  ViewPicture band{
      .page = whole.page,
      .view = whole.view,
      .picture = whole.picture,
      .edit = whole.edit,
      .width = whole.width,
      .height = whole.height,
      .rests = whole.rests,
      .exact = false,
      .rects = {{0, static_cast<std::uint16_t>(lossy.exact_rows), whole.width, static_cast<std::uint16_t>(rows)}},
      .pixels = {},
      .handles = {}};
  const auto first = whole.pixels.begin() + static_cast<std::ptrdiff_t>(lossy.exact_rows) * whole.width;
  band.pixels.assign(first, first + static_cast<std::ptrdiff_t>(rows) * whole.width);
  lossy.exact_rows += rows;
  if (lossy.exact_rows == whole.height) {
    band.exact = whole.exact;
    view.lossy.reset();
  }
  return encode(view, band, Encoding::deflate, now, true);
}

std::optional<PageOutbox::Outgoing> PageOutbox::next(Time now) {
  if (!texts_.empty()) {
    Outgoing outgoing{true, std::move(texts_.front().text)};
    texts_.pop_front();
    text_bytes_ -= outgoing.bytes.size();
    return outgoing;
  }
  for (std::size_t i = 0; i < views_.size(); ++i) {
    auto at = views_.upper_bound(turn_);
    if (at == views_.end()) at = views_.begin();
    turn_ = at->first;
    View& view = at->second;
    if (view.sent.size() >= kMostUnpainted) continue;
    if (!view.waiting.empty()) return send_picture(view, now);
    if (view.lossy && view.lossy->due <= now) return send_band(view, now);
  }
  return {};
}

std::optional<PageOutbox::Time> PageOutbox::due() const {
  std::optional<Time> first;
  for (const auto& [number, view] : views_)
    if (view.lossy && view.sent.size() < kMostUnpainted && (!first || view.lossy->due < *first))
      first = view.lossy->due;
  return first;
}

bool PageOutbox::overflows() const {
  return text_bytes_ > kMostTextBytes ||
         std::ranges::any_of(views_, [](const auto& each) { return each.second.waiting.size() > kMostWaiting; });
}

}  // namespace mars::web
