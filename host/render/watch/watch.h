// A rendering that somebody watches. The farm's thread says here what comes and what is composed, which costs it a copy
// of the pixels that changed; a thread of its own sends them to the watcher, whose slowness the farm does not feel: it
// gets the newest picture when it takes one. It may come and go while the rendering goes on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "host/render/pictures/socket.h"
#include "host/render/watch/display.h"
#include "host/render/watch/watched_picture.h"

namespace mars::watch {

// What is watched: frames of this film.
struct Shape {
  wire::PackedFilm film;
  std::uint32_t block;  // side of a flag's block, pixels
  wire::PixelFormat format;
  std::uint32_t groups;
  std::uint32_t frames;  // that are to be drawn
};

struct WholeFrame {
  const compositor::Frame& picture;
  std::uint32_t interval;
  wire::FrameKind kind;
  std::uint32_t group;
  double given;
  double seconds;
  std::int32_t first_node;
};

class Watch {
 public:
  // Throws Failure where no socket can have the name.
  explicit Watch(const std::string& socket);
  // Waits a second at most for a watcher that is slow with the rest.
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // Why nobody watches; "": somebody does.
  const std::string& absent() const { return absent_; }

  // All that follows is called from one thread, in this order. Seconds count from the first command to the nodes.

  // All nodes are there. The film outlives the watch.
  void begin(const Shape& shape, std::span<const wire::Hello> nodes);
  // A strip came, of any group.
  void receive(const wire::Strip& header, double seconds);
  // It is in the frame; of the group that has work and is the first of all that do.
  void paste(std::uint32_t group, const PastedStrip& strip, const compositor::Compositor& compositor,
             const compositor::Frame& frame, double seconds);
  // The group whose picture is shown.
  void follow(std::uint32_t group);
  // The frame is whole; the sinks do not have it yet.
  void compose(const WholeFrame& frame);

 private:
  struct Drawn {  // of a frame
    std::vector<pictures::Part> parts;
    double load_ratio = 1;
  };
  struct News {
    bool begins = false;
    std::deque<pictures::Body> drawn;
    std::optional<PictureUpdate> picture;
  };

  void note_drawn(const WholeFrame& frame);
  void work();
  void look_for_watcher();
  bool has_watcher() const { return socket_ && socket_->is_open(); }
  // Why there is no watcher; "": there is one.
  std::string connect();
  bool wait_for_news();
  bool has_news() const { return picture_->has_news() || !drawn_.empty(); }
  News take_news();
  void send(News news);

  const std::string name_;  // of the socket
  std::string absent_;
  std::optional<Shape> shape_;
  pictures::Body begin_;  // of the message

  // The thread's.
  std::optional<pictures::Socket> socket_;
  std::optional<Display> display_;
  bool is_new_ = false;  // the watcher

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::optional<WatchedPicture> picture_;
  std::map<std::uint32_t, Drawn> under_way_;                   // by frame
  std::deque<pictures::Body> drawn_;                           // of messages, the oldest first
  std::optional<std::chrono::steady_clock::time_point> last_;  // until which it may send when the run has ended
  std::thread thread_;
};

}  // namespace mars::watch
