#include "node/wire/commands.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "hal/collectives/group.h"
#include "hal/failure/failure.h"
#include "node/wire/greeting.h"

namespace mars::wire {
namespace {

void require(bool holds, const char* command, const char* rule) {
  if (!holds)
    throw Failure(std::string("the host's command ") + command + " does not make sense: " + rule, "",
                  "please report it");
}

// A struct and `count` items behind it, and nothing else.
bool has_size(std::span<const std::byte> message, std::size_t head, std::size_t count, std::size_t item) {
  return message.size() >= head && (message.size() - head) / item == count && (message.size() - head) % item == 0;
}

template <typename Item>
std::span<const Item> items_behind(std::span<const std::byte> message, std::size_t head) {
  return {reinterpret_cast<const Item*>(message.data() + head), (message.size() - head) / sizeof(Item)};
}

// Whether the node belongs to the group, and the group is one of those that the nodes form.
bool is_group_of(const Render& render, int node, int nodes, int groups) {
  for (int i = 0; i < groups; ++i) {
    const collectives::Group group = collectives::group_of(nodes, groups, i);
    if (node >= group.first && node < group.first + group.count)
      return render.group_first == group.first && render.group_count == group.count;
  }
  return false;
}

bool are_next(std::span<const std::uint32_t> frames, std::span<const std::uint32_t> left) {
  return frames.size() <= left.size() && std::ranges::equal(frames, left.first(frames.size()));
}

bool ascend_within(std::span<const std::uint32_t> frames, const Interval& interval) {
  const bool ascend = std::adjacent_find(frames.begin(), frames.end(), std::greater_equal<>()) == frames.end();
  return ascend && frames.front() >= interval.first_frame &&
         frames.back() - interval.first_frame < interval.frame_count;
}

}  // namespace

LoadCommand read_load(std::span<const std::byte> message, int nodes, const std::string& receiver) {
  check_stamp(message, "the host", receiver);
  constexpr auto kName = "Load";
  require(message.size() >= sizeof(Load), kName, "its size");
  const auto& load = *reinterpret_cast<const Load*>(message.data());
  require(load.orders <= message.size() - sizeof(Load), kName, "its size");
  const auto orders = message.last(load.orders);
  message = message.first(message.size() - load.orders);
  require(has_size(message, sizeof(Load), static_cast<std::size_t>(nodes), sizeof(std::int32_t)), kName, "its size");
  const auto machines = items_behind<std::int32_t>(message, sizeof(Load));
  require(load.film_bytes > 0, kName, "the film's size");
  require(load.credits >= 1 && load.credits <= kMaxCredits, kName, "credits");
  require(load.mapping <= Mapping::cost, kName, "the mapping");
  require(load.exchange <= Exchange::again, kName, "the exchange of triangles");
  require(load.groups >= 1 && load.groups <= nodes, kName, "the number of groups");
  require(load.traced <= 1, kName, "whether to trace");
  require(load.watched <= 1, kName, "whether it is watched");
  require(is_pixel_format(load.pixel_format, layered_samples_of(load.pixel_format)), kName, "the format of pixels");
  const bool plain = load.groups == 1 && load.traced == 0 && layers_of(load.pixel_format) == 0;
  require(load.live == 0 || (load.live == 1 && plain), kName, "whether views are live");
  for (std::int32_t node = 0; node < nodes; ++node) {
    const std::int32_t machine = machines[static_cast<std::size_t>(node)];
    require(machine >= 0 && machine <= node && machines[static_cast<std::size_t>(machine)] == machine, kName,
            "machines");
  }
  return {load, machines, orders};
}

void check_pixels(PixelFormat format, std::uint32_t samples) {
  require(is_pixel_format(format, samples), "Load", "the samples of pixels with layers");
}

void check_machines(std::span<const std::int32_t> machines, int node, int machine, int count) {
  require(machines[static_cast<std::size_t>(node)] == machine && std::ranges::count(machines, machine) == count, "Load",
          "machines");
}

RenderCommand read_render(std::span<const std::byte> message, const PackedFilm& film, const RenderReceiver& receiver,
                          std::vector<std::uint32_t>& frames) {
  constexpr auto kName = "Render";
  require(message.size() >= sizeof(Render), kName, "its size");
  const auto& render = *reinterpret_cast<const Render*>(message.data());
  require(render.listed <= 1, kName, "whether frames are listed");
  require(render.goes_on <= 1, kName, "whether it goes on");
  const std::size_t listed = render.listed == 1 ? render.frame_count : 0;
  require(has_size(message, sizeof render, listed + render.cycle, sizeof(std::uint32_t)), kName, "its size");
  require(render.interval < film.intervals().size(), kName, "the interval");
  require(is_group_of(render, receiver.node, receiver.nodes, receiver.groups), kName, "the group");
  require(render.contributors >= 1 && render.contributors <= render.group_count, kName, "the contributors");
  require(render.teams >= 0 && render.teams <= render.group_count, kName, "the teams");
  const Interval& interval = film.intervals()[render.interval];
  require(render.frame_count >= 1 && render.frame_count <= interval.frame_count, kName, "the frames");
  frames.resize(render.frame_count);
  std::iota(frames.begin(), frames.end(), render.first_frame);
  const auto all = render.listed == 1 ? items_behind<std::uint32_t>(message, sizeof render).first(listed)
                                      : std::span(std::as_const(frames));
  require(ascend_within(all, interval), kName, "the frames");
  require(render.drawn >= 1 && render.drawn <= render.frame_count, kName, "the frames that are drawn");
  require(render.goes_on == 0 || (render.drawn == render.frame_count && are_next(all, receiver.left)), kName,
          "with which frames it goes on");
  const auto cycle = items_behind<std::int32_t>(message, sizeof render + listed * sizeof(std::uint32_t));
  const std::int32_t teams = team_count({render.group_first, render.group_count}, render.teams);
  require(std::ranges::all_of(cycle, [&](auto team) { return team >= 0 && team < teams; }), kName, "the cycle");
  return {render, all, cycle};
}

BeginViewCommand read_begin_view(std::span<const std::byte> message) {
  constexpr auto kName = "BeginView";
  require(message.size() >= sizeof(BeginView), kName, "its size");
  const auto& view = *reinterpret_cast<const BeginView*>(message.data());
  require(view.view < kMostViews, kName, "the view");
  require(view.scene_bytes == message.size() - sizeof view, kName, "the scene's size");
  return {view, message.subspan(sizeof view)};
}

DrawCommand read_draw(std::span<const std::byte> message,
                      const std::function<const MovingParts*(std::uint32_t view)>& parts_of) {
  constexpr auto kName = "Draw";
  static_assert(sizeof(Draw) % 8 == 0 && sizeof(MovedSegment) % 8 == 0 && sizeof(MovedPatch) % 8 == 0);
  require(message.size() >= sizeof(Draw), kName, "its size");
  const auto& draw = *reinterpret_cast<const Draw*>(message.data());
  const std::size_t segment_bytes = std::size_t{draw.segments} * sizeof(MovedSegment);
  require(message.size() == sizeof draw + segment_bytes + std::size_t{draw.patches} * sizeof(MovedPatch), kName,
          "its size");
  const auto segments = items_behind<MovedSegment>(message.first(sizeof draw + segment_bytes), sizeof draw);
  const auto patches = items_behind<MovedPatch>(message, sizeof draw + segment_bytes);
  const MovingParts* const parts = draw.view < kMostViews ? parts_of(draw.view) : nullptr;
  require(parts != nullptr, kName, "the view");
  for (const MovedSegment& moved : segments) {
    require(parts->has_segment(moved.segment), kName, "a segment that does not move");
    require(moved.material < parts->materials(), kName, "a material");
    require(sound(moved.matrix), kName, "a matrix");
  }
  for (const MovedPatch& moved : patches) {
    require(parts->has_patch(moved.patch), kName, "a patch that does not move");
    require(sound(moved.points), kName, "a patch");
  }
  return {draw, segments, patches};
}

const CloseView& read_close_view(std::span<const std::byte> message) {
  constexpr auto kName = "CloseView";
  require(message.size() == sizeof(CloseView), kName, "its size");
  const auto& close = *reinterpret_cast<const CloseView*>(message.data());
  require(close.view < kMostViews, kName, "the view");
  return close;
}

const Credit& read_credit(std::span<const std::byte> message, std::uint32_t owned, std::size_t slots) {
  constexpr auto kName = "Credit";
  require(message.size() == sizeof(Credit), kName, "its size");
  const auto& credit = *reinterpret_cast<const Credit*>(message.data());
  require(credit.slot < slots && (owned >> credit.slot & 1) == 0, kName, "the slot");
  require(credit.by_message <= 1, kName, "how the strip goes");
  return credit;
}

const Beat& read_beat(std::span<const std::byte> message) {
  constexpr auto kName = "Beat";
  require(message.size() == sizeof(Beat), kName, "its size");
  const auto& beat = *reinterpret_cast<const Beat*>(message.data());
  require(beat.host.back() == '\0', kName, "the name of its machine");
  require(beat.traced <= 1, kName, "whether it is debugged");
  return beat;
}

void require_sense(bool holds, int sender, const char* what) {
  if (!holds)
    throw Failure("node " + std::to_string(sender) + " sent " + what + " that make no sense", "", "please report it");
}

void check_size(const char* command, std::size_t bytes, std::size_t expected) {
  require(bytes == expected, command, "its size");
}

}  // namespace mars::wire
