// Which way triangles come to homes of their lines on other machines, by what it took in earlier keyframes: they are
// sent, or their homes make them again.
#pragma once

#include <algorithm>
#include <cstdint>

namespace mars::group {

// Nanoseconds of either way, of a node or of all nodes of a group. 0: not known.
struct ExchangeTimes {
  std::uint64_t sending = 0;
  std::uint64_t making = 0;
};

// By the times of all nodes of a group, so that they choose alike. Much sooner: in the time of sending nodes also wait
// for each other, as they will in any case.
constexpr bool is_sooner_again(const ExchangeTimes& all) { return 2 * all.making < all.sending; }

// A node's.
class ExchangeRecord {
 public:
  // `dicing`: seconds of own triangles. Until it is known, making others' is taken to need as much. In large groups it
  // needs more, for surfaces lie on lines of several homes; two keyframes show that, and then triangles are sent.
  ExchangeTimes expected(double dicing) const {
    return {sending_.last, making_.last > 0 ? making_.last : nanoseconds(dicing)};
  }

  void note(bool made_again, double seconds) { (made_again ? making_ : sending_).note(nanoseconds(seconds)); }

 private:
  // The first time does not count: connections are made then, and caches fill.
  struct Way {
    bool is_new = true;
    std::uint64_t last = 0;

    void note(std::uint64_t time) {
      if (!is_new) last = std::max<std::uint64_t>(time, 1);
      is_new = false;
    }
  };

  static std::uint64_t nanoseconds(double seconds) { return static_cast<std::uint64_t>(std::max(0.0, seconds) * 1e9); }

  Way sending_, making_;
};

}  // namespace mars::group
