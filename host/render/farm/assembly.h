// Frames of one task put together from the strips of its group's nodes, whatever the order of their arrival.
// A strip is pasted as soon as its frame has a buffer, and inbetweens when the keyframe is there, whose CFB
// they show.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "host/render/compositor/compositor.h"
#include "host/render/farm/assignments.h"
#include "host/render/farm/node_slots.h"
#include "host/render/farm/plan.h"
#include "host/render/farm/strip_message.h"
#include "host/render/sinks/sink_pool.h"
#include "node/wire/film.h"

namespace mars::farm {

// Of a strip that is in its frame now.
using PasteListener = std::function<void(const StripMessage& strip, const compositor::Compositor& compositor,
                                         const compositor::Frame& frame)>;

// The pixel of the film's frames where nothing is drawn, in this interval.
std::uint64_t background_pixel(const wire::PackedFilm& film, const wire::Interval& interval, wire::PixelFormat format);
// A strip's pixels in a picture that was begun. `alone`: its interval has no other picture, and no saved background.
void paste_strip(const StripMessage& strip, compositor::Frame& picture, compositor::Compositor& compositor, bool alone);

class Assembly {
 public:
  // `group` draws the task, its first nodes the keyframe, which is given to them.
  Assembly(const Task& task, const collectives::Group& group, const Division& division, Assignments& assignments);

  std::uint32_t interval() const { return interval_; }
  // These inbetweens are given to nodes.
  void give(const Task& task, const Portion& portion, Assignments& assignments);

  // Whether it is a frame of the task that is not finished.
  bool has(std::uint32_t frame) const { return parts_.contains(frame); }
  // A strip of such a frame, of a node that was given it.
  void receive(StripMessage strip);

  // Where nodes write files. A part of a frame that it waits for is drawn; a frame's file is there. What the frame is,
  // once both are true of all of it; `whole` is nullptr.
  bool awaits_file(std::uint32_t frame) const;
  struct Pasted {
    std::uint32_t number;
    wire::FrameKind kind;
    compositor::Frame* whole;    // the finished frame; nullptr while strips of it are to come
    std::vector<NodeSlot> free;  // slots of strips that were pasted now
    std::int32_t first_node;     // the first of `nodes` that draw it
    std::int32_t nodes;
  };
  std::optional<Pasted> note_drawn(std::uint32_t frame);
  std::optional<Pasted> note_written(std::uint32_t frame);

  // From here on it has the group's compositor, whose interval has begun and which nobody else uses until all
  // is done. Buffers come from `sinks`.

  // The frame that begins next gets its buffer before its strips come, if there are enough; whether it did.
  bool prepare(const compositor::Compositor& compositor, sinks::SinkPool& sinks);

  // Pastes the strips that came of one frame, if there are any and it has a buffer or gets one; their memory
  // goes to `store`. `listener` may be none.
  std::optional<Pasted> paste(compositor::Compositor& compositor, sinks::SinkPool& sinks, StripStore& store,
                              const PasteListener& listener = {});

  bool done() const { return parts_.empty(); }

 private:
  // What is there of a frame.
  struct Parts {
    collectives::Group nodes{0, 0};        // that draw it; none: it is not given yet
    int nodes_left = 0;                    // whose last strip is to come
    std::vector<StripMessage> strips;      // to be pasted
    compositor::Frame* picture = nullptr;  // where they go; begun
    bool is_written = false;
  };

  bool background_there() const { return !parts_.contains(keyframe_); }
  Pasted describe(std::uint32_t number, const Parts& parts) const;
  std::optional<Pasted> finish_written(std::uint32_t number);
  bool begin(Parts& parts, const compositor::Compositor& compositor, sinks::SinkPool& sinks);

  collectives::Group group_;
  std::int32_t teams_;
  std::uint32_t interval_;
  std::uint32_t keyframe_;
  bool alone_;                             // the keyframe has no inbetweens: nobody needs its saved background
  std::map<std::uint32_t, Parts> parts_;   // of frames that are not finished
  std::deque<std::uint32_t> waiting_;      // those with strips to be pasted, as they came
  std::size_t not_begun_;                  // those without a picture
  compositor::Frame* prepared_ = nullptr;  // begun for the next frame
};

}  // namespace mars::farm
