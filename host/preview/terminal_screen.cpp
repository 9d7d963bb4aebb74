#include "host/preview/terminal_screen.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "host/content/document/text.h"
#include "host/content/document/text_lines.h"

namespace mars::preview {
namespace {

constexpr images::PictureSize kLargest{1280, 720};  // pixels, of terminals that have many
constexpr std::string_view kTroubleColor = "\x1b[1;31m";
constexpr std::string_view kNoteColor = "\x1b[1m";
constexpr std::uint32_t kNoteLines = 2;

images::Image upper_part(const images::Image& image, std::uint32_t height) {
  const auto end = image.pixels.begin() + static_cast<std::ptrdiff_t>(std::size_t{height} * image.width);
  return {image.width, height, {image.pixels.begin(), end}};
}

}  // namespace

TerminalScreen::TerminalScreen(Terminal& terminal)
    : terminal_(terminal), picture_(make_terminal_picture(terminal.graphics())) {}

// A line is left for the status; what would be behind more lines is left out.
images::PictureSize TerminalScreen::space() const {
  const images::PictureSize space = picture_->space(terminal_, 1);
  return {std::min(space.width, kLargest.width), std::min(space.height, kLargest.height)};
}

void TerminalScreen::show(const SharedImage& image, const Words& words) {
  std::vector<std::string> notes = notes_of(words);
  for (std::size_t above = notes.size(); above < notes_.size(); ++above) write_line(above + 1, "");
  if (image) show_picture(image, notes.size());
  if (notes != notes_)
    for (std::size_t i = 0; i < notes.size(); ++i) write_line(notes.size() - i, notes[i]);
  notes_ = std::move(notes);
  write_line(0, document::cut_to(words.status, terminal_.cells().width));
}

void TerminalScreen::show_picture(SharedImage image, std::size_t notes) {
  if (images::PictureSize{image->width, image->height} != extent_) {
    terminal_.write("\x1b[2J");
    forget();
    extent_ = {image->width, image->height};
  }
  const std::uint32_t height = picture_->space(terminal_, 1 + static_cast<std::uint32_t>(notes)).height;
  if (image->height > height) image = std::make_shared<const images::Image>(upper_part(*image, height));
  terminal_.write(picture_->shown(*image));
}

// What stands between the picture and the status.
std::vector<std::string> TerminalScreen::notes_of(const Words& words) const {
  const images::PictureSize cells = terminal_.cells();
  std::vector<std::string> notes;
  std::istringstream keys(words.keys);
  for (std::string line; std::getline(keys, line);) notes.push_back(document::cut_to(line, cells.width));
  for (const std::string& line : document::wrapped(words.note, cells.width - 1, kNoteLines))
    notes.push_back(std::string(kNoteColor) + " " + line);
  for (const std::string& line : document::wrapped(words.trouble, cells.width, std::max(cells.height / 3, 1u)))
    notes.push_back(std::string(kTroubleColor) + line);
  return notes;
}

// `above`: lines above the lowest one.
void TerminalScreen::write_line(std::size_t above, const std::string& text) {
  const std::uint32_t lines = terminal_.cells().height;
  if (above < lines) terminal_.write("\x1b[" + std::to_string(lines - above) + ";1H\x1b[0m" + text + "\x1b[0m\x1b[K");
}

void TerminalScreen::forget() {
  picture_->forget();
  notes_.clear();
}

ScreenEvents TerminalScreen::wait(std::chrono::nanoseconds time) {
  TerminalEvents events = terminal_.wait(time);
  if (events.redraw) forget();
  return {std::move(events.keys), events.redraw, events.ended_by};
}

}  // namespace mars::preview
