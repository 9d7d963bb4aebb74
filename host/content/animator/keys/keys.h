// Changes of a film file's keys by its parts: keys made, moved, copied, deleted, and their timing. All take the
// film's JSON and what read_film made of it, change the JSON or throw (it is then as it was), and know no file.
// They return remarks for the person, mostly none: what was left as it is, what goes another way.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "host/content/animator/keys/frame_range.h"
#include "host/content/animator/keys/things.h"
#include "host/content/animator/keys/tracks.h"
#include "host/content/animator/pose/within_limits.h"

namespace mars::animator {

// Puts a key on the way between two others, with the value that `value_at` gives for its frame; the way stays as it is.
// Where neither its ease nor its spline can be split, all its frames get keys: gives the first and the last of them.
using ValueAt = std::function<document::Json(std::uint32_t frame)>;
std::optional<FrameRange> split_way(Track& track, std::uint32_t frame, const ValueAt& value_at);
// "camera, eye: has a key at each of the frames 11 to 59, ..."
std::string remark_of_split(const std::string& thing, const KeyedPart& part, FrameRange keyed);

// Makes the tracks the keys of a thing of which some parts were to change; remarks what side_effects() finds.
Remarks put(const Chosen& chosen, const Tracks& tracks);

// Keys of the chosen parts as they are at the frame. Without an ease the film moves as before: the ease of the
// way there is split. No keys for joints without freedom, nor where all is chosen for camera, lights and materials
// without keys.
Remarks make_keys(document::Json& film, const Film& meaning, const Choice& choice, std::uint32_t frame,
                  const std::optional<Ease>& ease, Beyond beyond);

// The keys in the range go, or go also, to where its first frame is `to`; keys that stand there give way.
// From the frame on the chosen parts may be elsewhere at once: before it all moves as it did, and what is then set
// there is a jump. Keys at the frame, and before it ones that hold.
Remarks cut(document::Json& film, const Film& meaning, const Choice& choice, std::uint32_t frame);

Remarks move_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, std::uint32_t to);
Remarks copy_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, std::uint32_t to);
// A part without any key left is what it is without keys.
Remarks delete_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range);

// Timing: of a thing, of some of its parts, or of all in the film.

// The ease from the keys in the range, each to the next.
Remarks ease_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, const Ease& ease);
// From `frame` on all stands still for `frames` frames; later keys move by as many.
Remarks hold(document::Json& film, const Film& meaning, const Choice& choice, std::uint32_t frame,
             std::uint32_t frames);
// The range takes `factor` times as long, to whole frames; what follows is that much later or earlier.
Remarks stretch(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, double factor);
// Keys at `frame` and later are `by` frames later or, if none are passed, earlier.
Remarks shift(document::Json& film, const Film& meaning, const Choice& choice, std::uint32_t frame, std::int64_t by);

// The last frame at which anything but matrices has a key; 0 if nothing has.
std::uint32_t last_key(const document::Json& film);

}  // namespace mars::animator
