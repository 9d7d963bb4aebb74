// Where the pictures of a film come from, for the player and the writers of files: drawn, rendered, or read from a
// folder. Only renew() changes their number, rate and size.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/images/picture_size.h"
#include "host/images/png_file.h"
#include "host/preview/key_press.h"

namespace mars::preview {

using SharedImage = std::shared_ptr<const images::Image>;

class Pictures {
 public:
  virtual ~Pictures() = default;

  virtual std::uint32_t frames() const = 0;
  virtual double rate() const = 0;                 // frames a second
  virtual images::PictureSize extent() const = 0;  // the film's own

  // The frame at another size, of about the same shape. nullptr: it is not ready yet.
  virtual SharedImage picture(std::uint32_t frame, images::PictureSize extent) = 0;

  // Whether nothing of the last picture is still to come.
  virtual bool complete() const { return true; }

  // Follows what they are made from. True: they are others now.
  virtual bool renew() { return false; }
  // Why they cannot follow it now, in one line; "": they do.
  virtual std::string trouble() const { return ""; }

  // Handles a key that is pressed at a frame: true if it changes the picture or the text.
  virtual bool handle_key(const KeyPress&, std::uint32_t) { return false; }
  // Whether time is to stand still: a person tries something at the frame.
  virtual bool holds() const { return false; }
  // What is to be shown at a frame above the status line; "": nothing.
  virtual std::string note(std::uint32_t) const { return ""; }
  virtual std::string state() const { return ""; }  // in a few words, for a status line
  virtual std::string keys() const { return ""; }   // what handle_key() knows, in lines of 80 characters at most
};

// The film's picture as large as fits into `space`, at least one pixel each way.
images::PictureSize fitted(images::PictureSize film, images::PictureSize space);

// By the mean of the pixels under each new one, or the nearest where it grows.
images::Image scaled(const images::Image& image, images::PictureSize extent);

}  // namespace mars::preview
