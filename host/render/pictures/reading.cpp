#include "host/render/pictures/reading.h"

#include <algorithm>
#include <cstring>

namespace mars::pictures {
namespace {

constexpr std::uint32_t kOpaque = 0xff000000;

// Bytes of a body.
constexpr std::uint64_t kMostInput = std::uint64_t{1} << 40;   // a film or a scene
constexpr std::uint64_t kMostOutput = std::uint64_t{2} << 30;  // a picture is at most half of it
constexpr std::uint64_t kMostWords = 1 << 16;                  // why a host ends, or a window's title

struct Sizes {
  std::uint64_t least, most;
};

Sizes sizes_of(Kind kind) {
  switch (kind) {
    case Kind::film:
    case Kind::scene: return {1, kMostInput};
    case Kind::draw: return {sizeof(DrawHead), kMostInput};
    case Kind::begin: return {sizeof(Begin), kMostOutput};
    case Kind::picture: return {sizeof(PictureHead), kMostOutput};
    case Kind::drawn: return {sizeof(DrawnHead), kMostOutput};
    case Kind::refused:
    case Kind::caption: return {0, kMostWords};
    case Kind::key: return {sizeof(Key), sizeof(Key)};
    case Kind::space: return {sizeof(Space), sizeof(Space)};
    default: return {0, 0};
  }
}

// Takes structs from the front of a message.
class Reader {
 public:
  Reader(const Message& message, Kind kind, Sender sender = Sender::host) : sender_(sender), rest_(message.body) {
    expect(message.head.kind == kind, "no such kind");
  }

  void expect(bool holds, const char* otherwise) const {
    if (!holds) throw Malformed(sender_, otherwise);
  }
  template <typename T>
  T take() {
    T item;
    copy(&item, sizeof item);
    return item;
  }
  template <typename T>
  std::vector<T> take(std::uint64_t count) {
    expect(count <= rest_.size() / sizeof(T), kSize);
    std::vector<T> items(count);
    copy(items.data(), count * sizeof(T));
    return items;
  }
  void expect_end() const { expect(rest_.empty(), kSize); }

 private:
  static constexpr const char* kSize = "a message of an impossible size";

  void copy(void* to, std::size_t bytes) {
    expect(rest_.size() >= bytes, kSize);
    if (bytes > 0) std::memcpy(to, rest_.data(), bytes);
    rest_ = rest_.subspan(bytes);
  }

  Sender sender_;
  std::span<const std::byte> rest_;
};

bool is_of(Sender sender, Kind kind) {
  switch (sender) {
    case Sender::studio: return kind >= Kind::film && kind <= Kind::close;
    case Sender::host: return kind >= Kind::begin && kind <= Kind::caption;
    case Sender::window: break;
  }
  return kind == Kind::key || kind == Kind::space;
}

const char* name_of(Sender sender) {
  return sender == Sender::studio ? "studio" : sender == Sender::host ? "host" : "window";
}

bool is_side(std::uint32_t pixels) { return pixels >= 1 && pixels <= wire::kMaxSide; }

bool is_kind(wire::FrameKind kind) { return kind == wire::FrameKind::keyframe || kind == wire::FrameKind::inbetween; }

bool lies_within(const Rect& rect, const PictureHead& head) {
  return rect.width > 0 && rect.height > 0 && std::uint32_t{rect.x} + rect.width <= head.width &&
         std::uint32_t{rect.y} + rect.height <= head.height;
}

// Views have sizes of their own.
bool is_picture_of(const Begin& begin, const PictureHead& head) {
  if (begin.frames == 0) return head.lines == 0;
  return head.width == begin.width && head.height == begin.height && head.lines == begin.height;
}

}  // namespace

Malformed::Malformed(Sender sender, const std::string& what)
    : Failure("the " + std::string(name_of(sender)) + " sends " + what, "", "run programs of the same version") {}

void check_head(const Head& head, Sender sender) {
  const auto refuse = [sender](const char* what) { throw Malformed(sender, what); };
  if (!is_of(sender, head.kind)) refuse("a message of no known kind");
  const Sizes sizes = sizes_of(head.kind);
  if (head.bytes < sizes.least || head.bytes > sizes.most) refuse("a message of an impossible size");
  if (head.view >= wire::kMostViews) refuse("a view whose number is too large");
  const bool numbered = head.kind == Kind::scene || head.kind == Kind::draw || head.kind == Kind::dropped;
  if (head.kind != Kind::picture && numbered != (head.picture > 0)) refuse("a picture's number that makes no sense");
}

BeginMessage read_begin(const Message& message) {
  Reader reader(message, Kind::begin);
  BeginMessage read{reader.take<Begin>(), {}};
  const Begin& begin = read.begin;
  reader.expect(is_side(begin.width) && is_side(begin.height) && is_side(begin.block), "an impossible film");
  read.nodes = reader.take<Node>(begin.nodes);
  reader.expect_end();
  for (Node& node : read.nodes) node.host.back() = 0;
  return read;
}

Picture read_picture(const Message& message, const std::optional<Begin>& begin) {
  Reader reader(message, Kind::picture);
  Picture read{message.head.view, message.head.picture, reader.take<PictureHead>(), {}, {}, {}};
  const PictureHead& head = read.head;
  reader.expect(begin.has_value(), "a picture before it has begun");
  reader.expect(is_side(head.width) && is_side(head.height) && is_kind(head.kind), "an impossible picture");
  reader.expect(is_picture_of(*begin, head), "a picture that is not of its film");
  read.rects = reader.take<Rect>(head.rects);
  read.lines = reader.take<Line>(head.lines);
  reader.expect(std::ranges::all_of(read.rects, [&](const Rect& rect) { return lies_within(rect, head); }),
                "pixels outside of a picture");
  const std::size_t pixels = pixels_in(read.rects);
  reader.expect(pixels <= std::size_t{head.width} * head.height, "more pixels than a picture has");
  read.pixels = reader.take<std::uint32_t>(pixels);
  reader.expect_end();
  return read;
}

DrawnMessage read_drawn(const Message& message) {
  Reader reader(message, Kind::drawn);
  DrawnMessage read{reader.take<DrawnHead>(), {}};
  reader.expect(is_kind(read.head.kind), "an impossible frame");
  read.parts = reader.take<Part>(read.head.parts);
  reader.expect_end();
  return read;
}

std::string read_caption(const Message& message) {
  const Reader of_caption(message, Kind::caption);
  return {reinterpret_cast<const char*>(message.body.data()), message.body.size()};
}

Key read_key(const Message& message) {
  Reader reader(message, Kind::key, Sender::window);
  const Key key = reader.take<Key>();
  reader.expect(key.special <= SpecialKey::escape && key.character < 128, "no key");
  reader.expect((key.special == SpecialKey::none) == (key.character > 0), "no key");
  return key;
}

Space read_space(const Message& message) {
  Reader reader(message, Kind::space, Sender::window);
  const Space space = reader.take<Space>();
  reader.expect(is_side(space.width) && is_side(space.height), "an impossible size");
  return space;
}

Body body_of_begin(Begin begin, std::span<const wire::Hello> hellos) {
  std::vector<Node> nodes;
  for (const wire::Hello& hello : hellos) nodes.push_back({hello.machine, hello.host});
  begin.nodes = static_cast<std::uint32_t>(nodes.size());
  return body_of(begin, nodes);
}

Body body_of_picture(const Picture& picture) {
  PictureHead head = picture.head;
  head.rects = static_cast<std::uint32_t>(picture.rects.size());
  head.lines = static_cast<std::uint32_t>(picture.lines.size());
  return body_of(head, picture.rects, picture.lines, picture.pixels);
}

std::size_t pixels_in(std::span<const Rect> rects) {
  std::size_t pixels = 0;
  for (const Rect& rect : rects) pixels += std::size_t{rect.width} * rect.height;
  return pixels;
}

std::vector<std::uint32_t> cut_opaque(std::span<const std::uint32_t> whole, std::uint32_t width,
                                      std::span<const Rect> rects) {
  std::vector<std::uint32_t> pixels(pixels_in(rects));
  auto to = pixels.begin();
  for_rows(rects, width, [&](std::size_t at, std::size_t count) {
    to = std::ranges::transform(whole.subspan(at, count), to, [](std::uint32_t pixel) { return pixel | kOpaque; }).out;
  });
  return pixels;
}

void paste(std::span<const std::uint32_t> pixels, std::span<const Rect> rects, std::uint32_t width,
           std::span<std::uint32_t> whole) {
  for_rows(rects, width, [&](std::size_t at, std::size_t count) {
    std::ranges::copy(pixels.first(count), whole.begin() + static_cast<std::ptrdiff_t>(at));
    pixels = pixels.subspan(count);
  });
}

}  // namespace mars::pictures
