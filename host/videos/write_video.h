// Pictures into a video, which appears whole or not at all. Where it is known what decides each picture, they are
// encoded in pieces, kept in the file's working folder until the video is there: whoever makes it again,
// also of frames of which some have changed, encodes only the pieces that are not there yet. Pieces are then joined
// without being encoded again.
#pragma once

#include <optional>

#include "host/images/picture_size.h"
#include "host/videos/order.h"
#include "host/videos/source.h"

namespace mars::videos {

// What can be known before there is a picture, of `size` where that is known: throws Failure where the form makes no
// sense, ffmpeg is missing or lacks the encoder, the file cannot be written, is the audio's, or is there and not made
// by MARS, or the audio has no sound.
void check_order(const Order& order, const std::optional<images::PictureSize>& size = std::nullopt);

// The line for who waits for another process that makes the file.
std::string waiting_text(const Order& order);

// Replaces a file that is there: check_order() refuses others' files. Throws Failure where the form makes no sense, or
// ffmpeg is missing, lacks the encoder or fails; then the file is as it was.
void write_video(const Source& source, const Order& order, const Listener& listener);

}  // namespace mars::videos
