// What a forecast is made for, beside what the film's frames hold.
#pragma once

#include <cstdint>
#include <vector>

#include "host/experiments/platform.h"
#include "host/images/layers.h"
#include "host/images/picture_format.h"
#include "host/render/farm/host_memory.h"
#include "host/render/farm/node_memory.h"
#include "host/render/walls/even.h"
#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::forecast {

enum class Writers { host, nodes };

// Frames of a task, at most: no interval is cut.
inline constexpr std::uint32_t kUncut = 0xffffffff;

// Work that is divided more evenly than it can be, to find what unevenness costs (explain.h).
struct Even {
  bool keyframes = false;            // nodes of a group do equal parts of a keyframe
  std::vector<walls::Pace> paces{};  // by node; empty: each does its own
};

struct Setting {
  const wire::PackedFilm& film;
  const experiments::Platform& platform;
  wire::Mapping mapping = wire::Mapping::cost;
  images::PictureFormat picture = images::PictureFormat::png;
  wire::LayerSet layers = 0;
  bool files = true;  // else frames go nowhere
  Writers writers = Writers::host;
  wire::Exchange exchange = wire::Exchange::send;
  std::int32_t sharers = 0;       // of an inbetween, as in farm::Plan; 0: as it is fastest
  std::uint32_t most_frames = 0;  // of a task, as in farm::make_tasks; 0: as it is fastest
  std::uint32_t sink_threads = 2;
  std::uint64_t host_budget = std::uint64_t{1} << 30;  // bytes, as share_host_memory takes it

  Even even{};

  wire::PixelFormat pixels() const { return images::pixels_of(picture, layers, film.settings().samples); }
  bool has_layers() const { return layers != 0; }
  bool nodes_write() const { return files && writers == Writers::nodes; }
};

}  // namespace mars::forecast
