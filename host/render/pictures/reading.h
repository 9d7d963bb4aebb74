// Messages (messages.h) as bytes, and read again: every size, count and place is checked, and memory is made only for
// what has come. One that makes no sense throws a Malformed.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/render/pictures/messages.h"

namespace mars::pictures {

// Who sends a message: only some kinds are theirs.
enum class Sender { studio, host, window };

class Malformed : public Failure {
 public:
  Malformed(Sender sender, const std::string& what);
};

// One that came. The body lies at a multiple of 16 bytes.
struct Message {
  Head head{};
  std::vector<std::byte> body;
};

struct Picture {
  std::uint32_t view = 0;     // 0 of a rendering
  std::uint32_t picture = 0;  // the studio's number; 0 of a rendering
  PictureHead head{};
  std::vector<Rect> rects;
  std::vector<Line> lines;
  std::vector<std::uint32_t> pixels;
};

struct BeginMessage {
  Begin begin;
  std::vector<Node> nodes;
};

struct DrawnMessage {
  DrawnHead head;
  std::vector<Part> parts;
};

// Before its body has come.
void check_head(const Head& head, Sender sender);

BeginMessage read_begin(const Message& message);
// `begin`: the last that this host sent; none: it has not sent one.
Picture read_picture(const Message& message, const std::optional<Begin>& begin);
DrawnMessage read_drawn(const Message& message);
std::string read_caption(const Message& message);
Key read_key(const Message& message);
Space read_space(const Message& message);

// A body that is to be sent; nullptr: an empty one.
using Body = std::shared_ptr<const std::vector<std::byte>>;

template <typename Part>
std::span<const std::byte> bytes_of(const Part& part) {
  if constexpr (std::ranges::contiguous_range<Part>)
    return std::as_bytes(std::span(part));
  else
    return std::as_bytes(std::span(&part, 1));
}
template <typename Part>
std::span<const std::byte> bytes_of(const Part&&) = delete;

// Structs, and vectors of structs, one after another.
template <typename... Parts>
std::vector<std::byte> joined(const Parts&... parts) {
  std::vector<std::byte> bytes;
  bytes.reserve((bytes_of(parts).size() + ...));
  (bytes.insert(bytes.end(), bytes_of(parts).begin(), bytes_of(parts).end()), ...);
  return bytes;
}

template <typename... Parts>
Body body_of(const Parts&... parts) {
  return std::make_shared<std::vector<std::byte>>(joined(parts...));
}
Body body_of_begin(Begin begin, std::span<const wire::Hello> nodes);
// Its head says how many rectangles and lines there are.
Body body_of_picture(const Picture& picture);

// Calls visit(at, count) for each row of rectangle after rectangle: `count` pixels from pixel `at` of a picture that is
// `width` pixels wide.
template <typename Visit>
void for_rows(std::span<const Rect> rects, std::uint32_t width, Visit visit) {
  for (const Rect& rect : rects)
    for (std::uint32_t line = rect.y; line < std::uint32_t{rect.y} + rect.height; ++line)
      visit(std::size_t{line} * width + rect.x, std::size_t{rect.width});
}

std::size_t pixels_in(std::span<const Rect> rects);

// Pixels of rectangles, cut from a whole picture, with 255 in their highest bytes.
std::vector<std::uint32_t> cut_opaque(std::span<const std::uint32_t> whole, std::uint32_t width,
                                      std::span<const Rect> rects);
// Puts pixels of rectangles into a whole picture.
void paste(std::span<const std::uint32_t> pixels, std::span<const Rect> rects, std::uint32_t width,
           std::span<std::uint32_t> whole);

}  // namespace mars::pictures
