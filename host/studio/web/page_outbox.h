// What is to be sent to one page. Nothing piles up: of texts that replace one another (the project, its poses, its
// channels and curves, the renderer's state) only the newest is kept, and a view's picture is encoded only once the
// page has painted all but one of those before. What a view got with losses it gets without as soon as nothing newer
// comes, in bands that a newer picture need not wait long for. Knows no network; `now` is given.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/studio/web/link_speed.h"
#include "host/studio/web/pages.h"

namespace mars::web {

class PageOutbox {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Outgoing {
    bool is_text;
    std::string bytes;
  };

  void tell(const Json& message);
  void show(studio::ViewPicture picture, Time now);
  // A page's message; false: it concerns the outbox alone (a picture painted that the stage knows nothing of).
  bool hear(const Json& message, Time now);

  // To be sent now.
  std::optional<Outgoing> next(Time now);
  // When next() may have something though nothing else happens.
  std::optional<Time> due() const;
  // The page takes less than it asks for: it is not worth keeping.
  bool overflows() const;

  const LinkSpeed& speed() const { return speed_; }

 private:
  void drop_handles_of_waiting(const Json& message);

  struct Text {
    std::string kind, text;
  };
  struct Sent {
    std::uint32_t picture;
    std::size_t bytes;
    Time since;
    bool again;  // without losses, for the second time
  };
  // Of a view whose picture at the page has losses.
  struct Lossy {
    studio::ViewPicture last;  // whole: what it should be
    std::uint32_t exact_rows = 0;
    Time due;
  };
  struct View {
    std::deque<studio::ViewPicture> waiting;
    std::deque<Sent> sent;
    std::optional<Lossy> lossy;
  };

  bool painted(std::uint32_t view, std::uint32_t picture, Time now);
  Outgoing encode(View& view, const studio::ViewPicture& picture, Encoding encoding, Time now, bool again);
  Outgoing send_picture(View& view, Time now);
  Outgoing send_band(View& view, Time now);

  std::deque<Text> texts_;
  std::size_t text_bytes_ = 0;
  std::map<std::uint32_t, View> views_;
  std::uint32_t turn_ = 0;  // the view that is looked at first: each in its turn
  LinkSpeed speed_;
  Time painted_at_{};
};

}  // namespace mars::web
