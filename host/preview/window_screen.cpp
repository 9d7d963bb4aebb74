#include "host/preview/window_screen.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "host/render/compositor/rectangles.h"

namespace mars::preview {
namespace {

using pictures::Kind;
using pictures::SpecialKey;

constexpr std::uint32_t kBlock = 16;  // pixels, the side of a block that is sent if any of it changed
static_assert(static_cast<int>(SpecialKey::escape) == static_cast<int>(Special::escape), "the same keys");

KeyPress key_press(const pictures::Key& key) {
  return {static_cast<char>(key.character), static_cast<Special>(key.special)};
}

void flag_line(compositor::BlockFlags& flags, std::uint32_t line, const std::uint32_t* before,
               const std::uint32_t* after, std::uint32_t width) {
  for (std::uint32_t x = 0; x < width; x += kBlock) {
    const std::uint32_t count = std::min(kBlock, width - x);
    if (!std::equal(before + x, before + x + count, after + x)) flags.set_pixels(line, x, count);
  }
}

// A title has one line.
std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace

WindowScreen::WindowScreen(const std::filesystem::path& self, const std::string& title, images::PictureSize extent)
    : WindowScreen(self, title, extent, child::make_socket_pair()) {}

WindowScreen::WindowScreen(const std::filesystem::path& self, const std::string& title, images::PictureSize extent,
                           child::SocketPair pair)
    : title_(title),
      process_(self, window::Shows::player, title, pair.theirs),
      socket_(std::move(pair.ours), pictures::Peer::window),
      space_(extent) {
  pair.theirs.close();
  socket_.send({Kind::begin}, pictures::body_of_begin({extent.width, extent.height, kBlock, 1, 0, 0}, {}));
}

void WindowScreen::show(const SharedImage& image, const Words& words) {
  if (image) send_picture(*image);
  if (image) shown_ = image;
  if (words == words_) return;
  send_title(words);
  print(words);
  words_ = words;
}

void WindowScreen::send_picture(const images::Image& image) {
  pictures::Picture picture;
  picture.rects = changed(image);
  if (picture.rects.empty()) return;
  picture.head.width = image.width;
  picture.head.height = image.height;
  picture.head.whole = 1;
  picture.pixels = pictures::cut_opaque(image.pixels, image.width, picture.rects);
  socket_.send({Kind::picture}, pictures::body_of_picture(picture));
}

std::vector<compositor::Rect> WindowScreen::changed(const images::Image& image) const {
  compositor::BlockFlags flags(image.width, image.height, kBlock);
  if (!shown_ || shown_->width != image.width || shown_->height != image.height) {
    flags.set_all();
  } else {
    for (std::uint32_t line = 0; line < image.height; ++line) {
      const std::size_t at = std::size_t{line} * image.width;
      flag_line(flags, line, &shown_->pixels[at], &image.pixels[at], image.width);
    }
  }
  return compositor::rectangles_of(flags, image.width, image.height);
}

// What is wrong is first, then what a person does.
void WindowScreen::send_title(const Words& words) {
  const std::string& text = !words.trouble.empty() ? words.trouble : !words.note.empty() ? words.note : words.status;
  const std::string title = title_ + ":  " + one_line(text);
  socket_.send({Kind::caption}, std::make_shared<std::vector<std::byte>>(pictures::joined(title)));
}

// What is too long for a title is printed where the window was started.
void WindowScreen::print(const Words& words) {
  if (!words.keys.empty() && words.keys != words_.keys) std::cout << words.keys << std::endl;
  if (!words.trouble.empty() && words.trouble != words_.trouble) std::cerr << words.trouble << std::endl;
}

ScreenEvents WindowScreen::wait(std::chrono::nanoseconds time) {
  socket_.wait(std::chrono::ceil<std::chrono::milliseconds>(time));
  socket_.flush();
  ScreenEvents events;
  take_messages(events);
  events.closed = !socket_.is_open();
  return events;
}

void WindowScreen::take_messages(ScreenEvents& events) {
  while (const auto message = socket_.receive()) {
    if (message->head.kind == Kind::key) {
      events.keys.push_back(key_press(pictures::read_key(*message)));
    } else {
      const pictures::Space space = pictures::read_space(*message);
      events.redraw = events.redraw || images::PictureSize{space.width, space.height} != space_;
      space_ = {space.width, space.height};
    }
  }
}

}  // namespace mars::preview
