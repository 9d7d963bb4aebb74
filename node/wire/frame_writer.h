// What puts a film's pictures together where they are drawn, and writes their files. The node's main program hands one
// to the firmware, which opens no file; it knows no messages, the node brings it what other nodes have. All calls come
// from the node's one thread, and none waits for a file: a thread of the writer's own does.
//
// Pictures are cut into bands of lines. In a keyframe each node composes its home lines; the band that two homes share
// is composed by the node that has its first line, which gets the other's lines as an edge. Of each of its bands it
// has then a record: what a file needs of the band, and a hash. The records of the stationary parts' bands, with the
// pixels that inbetweens may show, lie once on each machine in memory that the group's nodes there share. Nodes that
// draw an inbetween, each whole bands of it, compose the bands that moving parts touch; the one that writes its file
// gets the others' records, and takes those of all other bands from that memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::wire {

// Files of a writer that wait or are being written.
inline constexpr std::size_t kMostFilesUnderWay = 2;

// Lines [first, end) of a picture.
struct LineSpan {
  std::uint32_t first = 0;
  std::uint32_t end = 0;

  bool operator==(const LineSpan&) const = default;
};

class FrameWriter {
 public:
  virtual ~FrameWriter() = default;

  // Whether the caller sees the folder of frames as the host does.
  virtual bool sees_folder() const = 0;
  // Of all bands but the last, which may have fewer.
  virtual std::uint32_t lines_of_band() const = 0;
  // That the group's nodes on a machine share, and where it is; the system gives pages as they are first touched.
  virtual std::size_t shared_bytes() const = 0;
  virtual void share(std::span<std::byte> memory) = 0;

  // The keyframe of an interval, of which the caller draws `home`; `background`: the pixel where nothing is drawn;
  // `touched`: lines on which inbetweens may draw; `has_inbetweens`: no machine needs what stands still.
  struct Keyframe {
    std::uint32_t frame;
    std::uint32_t interval;
    LineSpan home;
    std::uint64_t background;
    LineSpan touched;
    bool has_inbetweens;
  };
  virtual void begin_keyframe(const Keyframe& keyframe) = 0;
  // Of the interval whose background is there, of which the caller draws `home`, whole bands.
  virtual void begin_inbetween(std::uint32_t frame, const LineSpan& home) = 0;
  // Pixels of lines [strip.first_line, strip.last_line) of the frame, which come from the top; runs and words of pixels
  // as in Strip.
  virtual void paste(const Strip& strip, std::span<const Run> runs, std::span<const std::uint32_t> pixels) = 0;

  // When the caller's part of a keyframe is pasted, or, for picture() and add_picture(), of any frame. Each result is
  // valid until the next frame begins; what comes from another node is checked, and throws Failure where it makes no
  // sense.

  // The lines of a band that begins in another's home; empty: none.
  virtual std::span<const std::byte> edge() = 0;
  virtual void add_edge(std::span<const std::byte> edge) = 0;
  // Once all edges of own bands are there: these bands, in memory that is shared.
  virtual void finish_bands() = 0;
  // For other machines: whether any are left; the next of them, as many as `bytes` hold, but one at least, which has no
  // more than most_band_bytes().
  virtual bool has_background() const = 0;
  virtual std::span<const std::byte> next_background(std::size_t bytes) = 0;
  virtual std::size_t most_band_bytes() const = 0;
  virtual void add_background(std::span<const std::byte> background) = 0;
  // For the node that writes the frame.
  virtual std::span<const std::byte> picture() = 0;
  virtual void add_picture(std::span<const std::byte> picture) = 0;

  // The frame that was begun is whole here: its file is written from now on. Not while is_full().
  virtual void write() = 0;
  virtual bool is_full() = 0;
  // Whether files are being written, or were and have not been taken.
  virtual bool is_busy() = 0;
  // A file that is under its name, whole; none: not yet. Where there is none, throws Failure where one cannot be
  // written, or storage has given no answer for too long.
  virtual std::optional<Written> take_written() = 0;
  // Whether there is one; quick.
  virtual bool has_written() = 0;
  // What a person should know of storage that keeps files waiting; none: nothing new.
  virtual std::optional<std::string> take_warning() = 0;
};

// For a film, and `orders`, which the host has sent with it: they say where files go, and what they say of themselves.
// Throws Failure where they make no sense.
using MakeFrameWriter =
    std::function<std::unique_ptr<FrameWriter>(const PackedFilm& film, std::span<const std::byte> orders)>;

}  // namespace mars::wire
