// A studio's end of the socket, scripted by a test, and the serving host that it starts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/child/command.h"
#include "host/child/descriptor.h"
#include "host/child/process.h"
#include "host/render/pictures/reading.h"
#include "node/wire/protocol.h"
#include "tests/temporary_folder.h"

namespace mars::test {

// mars-threads, or with `mpi` mpirun with mars-host and mars-node, at this socket.
child::Command serving_command(const std::string& socket, int nodes, bool mpi = false);

class StudioEnd {
 public:
  StudioEnd();
  ~StudioEnd();
  StudioEnd(const StudioEnd&) = delete;
  StudioEnd& operator=(const StudioEnd&) = delete;

  // Starts the host and waits until it has connected.
  void start(int nodes, bool mpi = false);
  child::Process& host() { return *host_; }
  // The host's standard error, once it has ended.
  std::string errors() const;
  // How the host ended; none: it has not within 20 s.
  std::optional<child::Ending> ending();

  void send(pictures::Kind kind, std::uint32_t view, std::uint32_t picture, std::span<const std::byte> body = {});
  void send_bytes(std::span<const std::byte> bytes);
  void send_draw(std::uint32_t view, std::uint32_t picture, std::span<const wire::MovedSegment> segments);

  using Answer = pictures::Message;
  // The next one; of a picture its pixels are put on the view's canvas. None: the host has closed the socket. Fails
  // the test after 20 s without.
  std::optional<Answer> receive();
  // Whether an answer can be read within `milliseconds`.
  bool has_answer(int milliseconds) const;
  void close();

  // What a page would show of the view: pixels as film_run has them, that is without opacity.
  std::vector<std::uint32_t> shown(std::uint32_t view) const;
  // Of the view's last picture.
  std::uint64_t pixels_sent(std::uint32_t view) const { return sent_.at(view); }

 private:
  bool read_all(void* to, std::size_t bytes);
  void paint(const Answer& answer);

  const TemporaryFolder folder_;
  int listening_ = -1;
  int socket_ = -1;
  child::Descriptor errors_;
  std::optional<child::Process> host_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> canvases_;
  std::map<std::uint32_t, std::uint64_t> sent_;
};

}  // namespace mars::test
