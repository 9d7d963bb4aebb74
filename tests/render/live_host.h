// A small host of live views, for tests: asks nodes for pictures and puts their strips together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/protocol.h"
#include "tests/render/film_run.h"

namespace mars::test {

// What a Draw changes of its view's scene.
struct Change {
  std::vector<wire::MovedSegment> segments;
  std::vector<wire::MovedPatch> patches;
};

struct LivePicture {
  std::uint32_t view = 0;
  Pixels pixels;                   // undefined where nodes cut it
  std::vector<wire::Strip> lasts;  // of each node that drew it
  bool cut() const;
};

class LiveHost {
 public:
  // Greets the nodes.
  LiveHost();
  // Stops them.
  ~LiveHost();
  LiveHost(const LiveHost&) = delete;
  LiveHost& operator=(const LiveHost&) = delete;

  int nodes() const { return nodes_; }
  void load(const wire::FilmData& film);

  // Asks; pictures are numbered from 1 on. Returns the number.
  std::uint32_t begin(std::uint32_t view, const wire::FilmData& scene,
                      std::uint64_t still_memory = std::uint64_t{64} << 20);
  std::uint32_t draw(std::uint32_t view, const Change& change, int node);
  void close(std::uint32_t view);
  // Waits until it is there.
  LivePicture finish(std::uint32_t picture);

 private:
  struct View {
    std::uint32_t width, height;
    std::uint32_t plain;
    Pixels background;  // of its interval
  };
  struct Asked {
    LivePicture picture;
    bool is_keyframe;
    std::size_t nodes_left;
    std::vector<std::vector<std::byte>> strips;
  };

  void send(long type, int node, std::span<const std::byte> message);
  void give_credit(int node, std::uint32_t slot);
  void take_strip();
  void paste(Asked& asked);

  const int nodes_;
  std::vector<wire::Hello> hellos_;
  std::map<std::uint32_t, View> views_;
  std::map<std::uint32_t, Asked> asked_;
  std::uint32_t last_picture_ = 0;
};

}  // namespace mars::test
