#include "host/studio/link/host_connection.h"

#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <cstring>
#include <deque>
#include <filesystem>
#include <system_error>
#include <utility>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "node/wire/film_parts.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
using Local = asio::local::stream_protocol;
using Error = boost::system::error_code;

constexpr int kSocketBuffer = 4 << 20;       // bytes, as far as the system gives them
constexpr std::size_t kMostWords = 1 << 16;  // bytes of a host's last words

// Its names must fit a socket's address.
std::filesystem::path sockets_folder() {
  const child::Environment environment = child::own_environment();
  const std::string usual = child::temporary_folder(environment);
  const std::string own = environment.value("XDG_RUNTIME_DIR").value_or("");
  constexpr std::size_t kOurs = sizeof "/mars-studio-XXXXXX/host";
  std::error_code ignored;
  for (const std::string& folder : {own, usual})
    if (!folder.empty() && folder.size() + kOurs < sizeof sockaddr_un::sun_path &&
        std::filesystem::is_directory(folder, ignored))
      return folder;
  return "/tmp";
}

// A folder that only this user may enter, gone at its end.
class PrivateFolder {
 public:
  PrivateFolder() : path_(sockets_folder() / "mars-studio-XXXXXX") {
    std::string name = path_.string();
    if (mkdtemp(name.data()) == nullptr)
      throw Failure(std::string("no folder can be made: ") + std::strerror(errno), path_.string(),
                    "set TMPDIR to a folder that can be written");
    path_ = name;
  }
  ~PrivateFolder() { remove(); }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void remove() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

 private:
  std::filesystem::path path_;
};

bool is_sound(const serve::Head& head) {
  switch (head.kind) {
    case serve::Kind::ready: return head.bytes == sizeof(serve::Ready);
    case serve::Kind::picture: return head.bytes >= sizeof(serve::PictureHead);
    case serve::Kind::dropped: return head.bytes == 0;
    case serve::Kind::refused: return head.bytes <= kMostWords;
    default: return false;
  }
}

// Rectangles are no more than the picture has pixels.
bool is_sound(const serve::Head& head, const serve::PictureHead& picture) {
  if (picture.width == 0 || picture.height == 0 || picture.width > wire::kMaxSide || picture.height > wire::kMaxSide)
    return false;
  return picture.rects <= std::uint64_t{picture.width} * picture.height &&
         head.bytes >= sizeof picture + std::uint64_t{picture.rects} * sizeof(serve::Rect);
}

bool is_sound(const serve::Head& head, const SurfacePicture& picture) {
  std::uint64_t pixels = 0;
  for (const serve::Rect& rect : picture.rects) {
    if (rect.x + rect.width > picture.head.width || rect.y + rect.height > picture.head.height) return false;
    pixels += std::uint64_t{rect.width} * rect.height;
  }
  return pixels <= std::uint64_t{picture.head.width} * picture.head.height &&
         head.bytes ==
             sizeof picture.head + picture.rects.size() * sizeof(serve::Rect) + pixels * sizeof(std::uint32_t);
}

}  // namespace

class HostConnection::Wire : public std::enable_shared_from_this<Wire> {
 public:
  Wire(asio::io_context& context, Listener listener)
      : listener_(std::move(listener)),
        acceptor_(context, Local::endpoint((folder_.path() / "host").string())),
        socket_(context) {}

  std::string path() const { return (folder_.path() / "host").string(); }

  void accept() {
    acceptor_.async_accept(socket_, [self = shared_from_this()](Error error) {
      if (self->closed_) return;
      if (error) return self->fail();
      self->begin();
    });
  }

  void send(const serve::Head& head, Body body) {
    out_.push_back({head, std::move(body)});
    if (out_.size() == 1) write();
  }

  // What is being written goes on.
  std::vector<std::uint32_t> take_back(std::uint32_t view, bool scenes) {
    std::vector<std::uint32_t> pictures;
    if (out_.empty()) return pictures;
    const auto old = [&](const Outgoing& each) {
      const bool matches = each.head.view == view &&
                           (each.head.kind == serve::Kind::draw || (scenes && each.head.kind == serve::Kind::view));
      if (matches) pictures.push_back(each.head.picture);
      return matches;
    };
    out_.erase(std::remove_if(out_.begin() + 1, out_.end(), old), out_.end());
    return pictures;
  }

  void close() {
    closed_ = true;
    Error ignored;
    acceptor_.close(ignored);
    socket_.close(ignored);
  }

 private:
  struct Outgoing {
    serve::Head head;
    Body body;
  };

  // The socket's name is of no use any more.
  void begin() {
    Error ignored;
    acceptor_.close(ignored);
    folder_.remove();
    socket_.set_option(asio::socket_base::send_buffer_size(kSocketBuffer), ignored);
    read_head();
    listener_.connected();
  }

  void fail() {
    if (closed_) return;
    close();
    listener_.closed();
  }

  void write() {
    const Outgoing& next = out_.front();
    const std::array<asio::const_buffer, 2> parts{asio::buffer(&next.head, sizeof next.head),
                                                  next.body ? asio::buffer(*next.body) : asio::const_buffer()};
    asio::async_write(socket_, parts, [self = shared_from_this()](Error error, std::size_t) {
      if (self->closed_) return;
      if (error) return self->fail();
      self->out_.pop_front();
      if (!self->out_.empty()) self->write();
    });
  }

  // Reads `bytes` bytes, then does `next`.
  template <typename Next>
  void read(void* to, std::size_t bytes, Next next) {
    asio::async_read(socket_, asio::buffer(to, bytes), [self = shared_from_this(), next](Error error, std::size_t) {
      if (self->closed_) return;
      if (error) return self->fail();
      next(*self);
    });
  }

  void read_head() {
    read(&head_, sizeof head_, [](Wire& wire) { wire.read_body(); });
  }

  void read_body() {
    if (!is_sound(head_)) return fail();
    switch (head_.kind) {
      case serve::Kind::ready:
        return read(&ready_, sizeof ready_, [](Wire& wire) {
          wire.read_head();
          wire.listener_.ready(wire.ready_);
        });
      case serve::Kind::picture: return read_picture();
      case serve::Kind::dropped: {
        const serve::Head head = head_;
        read_head();
        return listener_.dropped(head.view, head.picture);
      }
      default:  // why it ends is known when its job has ended
        words_.resize(head_.bytes);
        return read(words_.data(), words_.size(), [](Wire& wire) { wire.read_head(); });
    }
  }

  void read_picture() {
    picture_ = {head_.view, head_.picture, {}, {}, {}};
    read(&picture_.head, sizeof picture_.head, [](Wire& wire) {
      if (!is_sound(wire.head_, wire.picture_.head)) return wire.fail();
      std::vector<serve::Rect>& rects = wire.picture_.rects;
      rects.resize(wire.picture_.head.rects);
      wire.read(rects.data(), rects.size() * sizeof(serve::Rect), [](Wire& same) { same.read_pixels(); });
    });
  }

  void read_pixels() {
    if (!is_sound(head_, picture_)) return fail();
    std::vector<std::uint32_t>& pixels = picture_.pixels;
    const std::size_t bytes = head_.bytes - sizeof picture_.head - picture_.rects.size() * sizeof(serve::Rect);
    pixels.resize(bytes / sizeof(std::uint32_t));
    read(pixels.data(), bytes, [](Wire& wire) {
      SurfacePicture picture = std::move(wire.picture_);
      wire.read_head();
      wire.listener_.picture(std::move(picture));
    });
  }

  PrivateFolder folder_;
  const Listener listener_;
  Local::acceptor acceptor_;
  Local::socket socket_;
  bool closed_ = false;
  std::deque<Outgoing> out_;  // the first is being written
  serve::Head head_{};
  serve::Ready ready_{};
  SurfacePicture picture_;
  std::vector<char> words_;
};

HostConnection::HostConnection(asio::io_context& context, Listener listener)
    : wire_(std::make_shared<Wire>(context, std::move(listener))) {
  wire_->accept();
}

HostConnection::~HostConnection() { wire_->close(); }

std::string HostConnection::path() const { return wire_->path(); }

void HostConnection::send(serve::Kind kind, std::uint32_t view, std::uint32_t picture, Body body) {
  const std::uint64_t bytes = body ? body->size() : 0;
  wire_->send({kind, view, picture, 0, bytes}, std::move(body));
}

std::vector<std::uint32_t> HostConnection::take_back(std::uint32_t view, bool scenes) {
  return wire_->take_back(view, scenes);
}

}  // namespace mars::studio
