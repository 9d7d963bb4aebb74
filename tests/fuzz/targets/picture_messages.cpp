// What comes over the socket on which pictures leave a host, at either end: the input says how sound messages are
// changed. The reader refuses them, or what they show can be painted to the last pixel.
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <optional>

#include "host/render/pictures/socket.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::picture_messages {
namespace {

using pictures::Kind;
using pictures::Peer;

constexpr std::uint32_t kWidth = 24, kHeight = 16;
constexpr std::size_t kLongest = 1 << 16;  // less than a socket holds

void append(Message& stream, pictures::Head head, const Message& body) {
  head.bytes = body.size();
  const Message message = pictures::joined(head, body);
  stream.insert(stream.end(), message.begin(), message.end());
}

Message begin(std::uint32_t frames) {
  std::array<wire::Hello, 2> hellos{};
  hellos[0].host = hellos[1].host = {"n0"};
  return *pictures::body_of_begin({kWidth, kHeight, 8, 1, frames, 0}, hellos);
}

Message picture(std::uint32_t lines) {
  pictures::Picture picture;
  picture.head.width = kWidth;
  picture.head.height = kHeight;
  picture.head.whole = 1;
  picture.rects = {{0, 0, 8, 16}, {16, 8, 8, 8}};
  picture.lines.resize(lines);
  picture.pixels.resize(pictures::pixels_in(picture.rects), 0xff123456u);
  return *pictures::body_of_picture(picture);
}

// Of a studio.
Message requests() {
  Message stream;
  append(stream, {Kind::film}, Message(64));
  append(stream, {Kind::scene, 1, 1}, Message(64));
  append(stream, {Kind::draw, 1, 2}, pictures::joined(pictures::DrawHead{0, 0}));
  append(stream, {Kind::close, 1}, {});
  return stream;
}

Message views() {
  Message stream;
  append(stream, {Kind::begin}, begin(0));
  append(stream, {Kind::picture, 1, 1}, picture(0));
  append(stream, {Kind::dropped, 1, 2}, {});
  append(stream, {Kind::refused}, Message(8));
  return stream;
}

Message rendering() {
  Message stream;
  append(stream, {Kind::begin}, begin(9));
  append(stream, {Kind::picture}, picture(kHeight));
  append(stream, {Kind::drawn}, pictures::joined(pictures::DrawnHead{.parts = 1}, std::array<pictures::Part, 1>{}));
  return stream;
}

// Of a player, for its window.
Message player() {
  Message stream;
  append(stream, {Kind::begin}, begin(0));
  append(stream, {Kind::picture}, picture(0));
  append(stream, {Kind::caption}, Message(8));
  return stream;
}

Message window() {
  Message stream;
  append(stream, {Kind::space}, pictures::joined(pictures::Space{kWidth, kHeight}));
  append(stream, {Kind::key}, pictures::joined(pictures::Key{pictures::SpecialKey::none, 'q'}));
  return stream;
}

Peer sender_of(std::size_t stream) { return stream == 0 ? Peer::studio : stream == 4 ? Peer::window : Peer::host; }

// As the studio does it.
class Screen {
 public:
  void take(const pictures::Message& message) {
    switch (message.head.kind) {
      case Kind::begin: begin_ = pictures::read_begin(message).begin; break;
      case Kind::picture: paint(pictures::read_picture(message, begin_)); break;
      case Kind::drawn: pictures::read_drawn(message); break;
      case Kind::caption: pictures::read_caption(message); break;
      case Kind::key: pictures::read_key(message); break;
      case Kind::space: pictures::read_space(message); break;
      default: break;
    }
  }

 private:
  static void paint(const pictures::Picture& picture) {
    if (std::uint64_t{picture.head.width} * picture.head.height > kLongest) return;
    std::vector<std::uint32_t> pixels(std::size_t{picture.head.width} * picture.head.height);
    pictures::paste(picture.pixels, picture.rects, picture.head.width, pixels);
    const auto cut = pictures::cut_opaque(pixels, picture.head.width, picture.rects);
    check(cut.size() == picture.pixels.size(), "what was painted is as large as what came");
  }

  std::optional<pictures::Begin> begin_;
};

void take_stream(const Message& stream, Peer peer) {
  std::array<int, 2> ends{};
  check(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0, "there are sockets");
  child::Descriptor sender(ends[0]);
  pictures::Socket socket(child::Descriptor(ends[1]), peer);
  check(::send(sender.number(), stream.data(), stream.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(stream.size()),
        "a socket holds a small stream");
  sender.close();
  Screen screen;
  while (socket.is_open())
    while (const auto message = socket.receive()) screen.take(*message);
}

}  // namespace

void take(std::string_view input) {
  static const std::array<Message, 5> sound{requests(), views(), rendering(), player(), window()};
  Script script(input);
  const std::size_t which = script.below(sound.size());
  Message stream = sound[which];
  while (!script.at_end()) edit(stream, script, kLongest);
  if (!stream.empty()) take_stream(stream, sender_of(which));
}

const Target target("picture_messages", Form::bytes, take);

}  // namespace mars::fuzz::picture_messages
