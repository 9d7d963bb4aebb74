// The picture that a watcher is to have: what one group of nodes drew last, whole frames and the lines of a keyframe
// that are there so far, with a mark at each pixel and, of each line, who drew it. It knows which blocks the watcher
// does not have yet. It follows one group at a time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "host/render/compositor/compositor.h"
#include "host/render/pictures/reading.h"

namespace mars::watch {

using pictures::Line;
using pictures::Mark;

// A strip that was pasted into a frame just now.
struct PastedStrip {
  const wire::Strip& header;
  std::span<const wire::Run> constant;
  std::span<const wire::Run> moving;
  std::span<const std::uint32_t> edge_boxes;  // of each of its lines
};

// What is sent, once its pixels are shown ones: they are words of the frames' format here.
struct PictureUpdate {
  pictures::Picture picture;
  std::vector<Mark> marks;
};

class WatchedPicture {
 public:
  WatchedPicture(std::uint32_t width, std::uint32_t height, std::uint32_t block, wire::PixelFormat format);

  // What is pasted and finished from now on is of this group.
  void follow(std::uint32_t group);
  std::uint32_t group() const { return group_; }

  // A strip that is in `frame` now. Of a keyframe its lines are shown at once, of an inbetween when it is finished.
  void paste(const PastedStrip& strip, const compositor::Compositor& compositor, const compositor::Frame& frame,
             double seconds);
  // A frame that the compositor has finished.
  void finish(const compositor::Frame& frame, std::uint32_t interval, wire::FrameKind kind, std::int32_t first_node,
              double seconds);

  // The watcher has nothing of it.
  void forget_sent();
  // Whether there is something that was not taken.
  bool has_news() const { return news_; }
  std::uint32_t frame() const { return head_.frame; }
  // What the watcher does not have; from now on it has that.
  PictureUpdate take();

 private:
  struct Inbetween {  // under way
    std::vector<wire::Run> moving;
    std::vector<std::uint32_t> edge_boxes;  // of each line
    std::uint32_t lines = 0;                // that are there
  };

  void begin_frame(std::uint32_t frame, std::uint32_t interval, wire::FrameKind kind);
  void begin_keyframe(const wire::Strip& header);
  void mark_lines(const PastedStrip& strip);
  void put_line(std::uint32_t line, std::span<const std::uint32_t> words, std::span<const Mark> marks);
  void put_blocks(const compositor::Frame& frame, const compositor::BlockFlags& blocks);
  void finish_inbetween(const compositor::Frame& frame, std::uint32_t interval, std::int32_t node);
  void put_whole(const compositor::Frame& frame);
  bool follows(const compositor::Frame& frame, std::uint32_t interval) const;

  const std::uint32_t width_, height_;
  const std::size_t pixel_words_;
  std::uint32_t group_ = 0;  // that is followed
  pictures::PictureHead head_{};
  bool news_ = false;
  bool in_step_ = true;               // it is of the group that is followed
  bool begun_ = false;                // it shows something
  std::uint32_t keyframe_lines_ = 0;  // that are there, of head_.frame where it is a keyframe that is not whole
  std::vector<std::uint32_t> words_;
  std::vector<Mark> marks_;
  std::vector<Mark> still_;  // as in the interval's keyframe without moving parts
  std::vector<Line> lines_;
  compositor::BlockFlags pending_;  // that the watcher does not have
  std::map<std::uint32_t, Inbetween> inbetweens_;
  std::vector<std::uint32_t> line_words_;  // of one line
  std::vector<Mark> line_marks_;           // of the lines of one strip
};

}  // namespace mars::watch
