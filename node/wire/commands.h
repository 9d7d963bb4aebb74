// The host's commands as they arrived, checked before anything of them is used: sizes against counts, counts and ranges
// against the film and the node's group; and what is common to checks of other nodes' messages. What does not fit is a
// Failure. What is returned lies within the message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/protocol.h"
#include "node/wire/scene.h"

namespace mars::wire {

struct LoadCommand {
  const Load& load;
  std::span<const std::int32_t> machines;  // each node's
  std::span<const std::byte> orders;       // for the frame writer; none: frames go to the host
};

struct RenderCommand {
  const Render& render;
  std::span<const std::uint32_t> frames;  // in the message, or in `frames` of read_render
  std::span<const std::int32_t> cycle;

  // Of the frames, the inbetweens that are drawn now, and those that are left.
  std::span<const std::uint32_t> inbetweens() const {
    return frames.first(render.drawn).subspan(render.goes_on == 1 ? 0 : 1);
  }
  std::span<const std::uint32_t> left() const { return frames.subspan(render.drawn); }
  collectives::Group group() const { return {render.group_first, render.group_count}; }
  // The nodes that draw inbetweens()[k], and the one that writes it.
  collectives::Group team(std::size_t k) const {
    return team_of_inbetween(render.first_inbetween + k, group(), render.teams, cycle);
  }
  std::int32_t writer(std::size_t k) const {
    return writer_of_inbetween(render.first_inbetween + k, group(), render.teams, team(k));
  }
};

// For one of `nodes` nodes; `receiver` names it in a failure: "n3 (node 17)".
LoadCommand read_load(std::span<const std::byte> message, int nodes, const std::string& receiver);

// Whether a film of `samples` a pixel may have pictures of Load's format.
void check_pixels(PixelFormat format, std::uint32_t samples);

// Of Load's machines, for node `node`, which shares memory with `count` nodes, itself among them, that are on
// `machine`.
void check_machines(std::span<const std::int32_t> machines, int node, int machine, int count);

// What a node knows of itself when a Render comes.
struct RenderReceiver {
  int node;
  int nodes;
  int groups;                           // that they form
  std::span<const std::uint32_t> left;  // inbetweens that Renders may go on with
};

// Frames that are not listed are put into `frames`.
RenderCommand read_render(std::span<const std::byte> message, const PackedFilm& film, const RenderReceiver& receiver,
                          std::vector<std::uint32_t>& frames);

// A view's, and its scene's block behind it.
struct BeginViewCommand {
  const BeginView& view;
  std::span<const std::byte> scene;
};

BeginViewCommand read_begin_view(std::span<const std::byte> message);

struct DrawCommand {
  const Draw& draw;
  std::span<const MovedSegment> segments;
  std::span<const MovedPatch> patches;
};

// `parts_of` a view that the node does not have is nullptr.
DrawCommand read_draw(std::span<const std::byte> message,
                      const std::function<const MovingParts*(std::uint32_t view)>& parts_of);

const CloseView& read_close_view(std::span<const std::byte> message);

// For a node that has the slots of `owned`, a bit for each, of `slots` in all.
const Credit& read_credit(std::span<const std::byte> message, std::uint32_t owned, std::size_t slots);

// The host's.
const Beat& read_beat(std::span<const std::byte> message);

// For what node `sender` sent, "triangles".
void require_sense(bool holds, int sender, const char* what);

// For commands of a fixed size, such as Stop and Clock, which are empty.
void check_size(const char* command, std::size_t bytes, std::size_t expected);

}  // namespace mars::wire
