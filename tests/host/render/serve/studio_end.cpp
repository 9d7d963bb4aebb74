#include "tests/host/render/serve/studio_end.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>

namespace mars::test {
namespace {

constexpr int kPatience = 20000;  // milliseconds

}  // namespace

child::Command serving_command(const std::string& socket, int nodes, bool mpi) {
  const std::string bin = MARS_BIN;
  if (!mpi) return {{}, {bin + "/mars-threads", "--serve", socket, "--nodes", std::to_string(nodes)}};
  return {{{"OMPI_ALLOW_RUN_AS_ROOT", "1"}, {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}},
          {MARS_MPIRUN, "--oversubscribe", "--bind-to", "none", "-n", "1", bin + "/mars-host", "--serve", socket, ":",
           "-n", std::to_string(nodes), bin + "/mars-node"}};
}

StudioEnd::StudioEnd() {
  signal(SIGPIPE, SIG_IGN);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = folder_ / "host";
  std::ranges::copy(path, address.sun_path);
  listening_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  EXPECT_EQ(bind(listening_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(listen(listening_, 1), 0);
}

StudioEnd::~StudioEnd() {
  close();
  ::close(listening_);
}

void StudioEnd::start(int nodes, bool mpi) {
  errors_ = child::file_in_memory();
  const child::Descriptor nothing = child::null_device();
  host_.emplace(serving_command(folder_ / "host", nodes, mpi),
                child::ProcessSetup{.streams = {{1, nothing.number()}, {2, errors_.number()}},
                                    .own_group = true,
                                    .signal_at_our_end = SIGKILL});
  pollfd waits{listening_, POLLIN, 0};
  ASSERT_EQ(poll(&waits, 1, kPatience), 1) << "no host: " << errors();
  socket_ = accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
}

std::string StudioEnd::errors() const { return child::content_of(errors_); }

std::optional<child::Ending> StudioEnd::ending() {
  for (int waited = 0; waited < kPatience; waited += 10) {
    if (const auto ending = host_->poll()) return ending;
    poll(nullptr, 0, 10);
  }
  return std::nullopt;
}

void StudioEnd::send(pictures::Kind kind, std::uint32_t view, std::uint32_t picture, std::span<const std::byte> body) {
  const pictures::Head head{kind, view, picture, 0, body.size()};
  send_bytes(std::as_bytes(std::span(&head, 1)));
  send_bytes(body);
}

void StudioEnd::send_bytes(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count <= 0) return;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void StudioEnd::send_draw(std::uint32_t view, std::uint32_t picture, std::span<const wire::MovedSegment> segments) {
  const pictures::DrawHead head{static_cast<std::uint32_t>(segments.size()), 0};
  send(pictures::Kind::draw, view, picture, pictures::joined(head, segments));
}

bool StudioEnd::has_answer(int milliseconds) const {
  pollfd waits{socket_, POLLIN, 0};
  return poll(&waits, 1, milliseconds) == 1;
}

bool StudioEnd::read_all(void* to, std::size_t bytes) {
  for (std::size_t read = 0; read < bytes;) {
    if (!has_answer(kPatience)) {
      ADD_FAILURE() << "the host says nothing";
      return false;
    }
    const ssize_t count = recv(socket_, static_cast<std::byte*>(to) + read, bytes - read, 0);
    if (count <= 0) return false;
    read += static_cast<std::size_t>(count);
  }
  return true;
}

std::optional<StudioEnd::Answer> StudioEnd::receive() {
  Answer answer;
  if (!read_all(&answer.head, sizeof answer.head)) return std::nullopt;
  answer.body.resize(answer.head.bytes);
  if (!read_all(answer.body.data(), answer.body.size())) return std::nullopt;
  if (answer.head.kind == pictures::Kind::picture) paint(answer);
  return answer;
}

void StudioEnd::paint(const Answer& answer) {
  const pictures::Picture picture = pictures::read_picture(answer, pictures::Begin{});
  std::vector<std::uint32_t>& canvas = canvases_[picture.view];
  canvas.resize(std::size_t{picture.head.width} * picture.head.height);
  pictures::paste(picture.pixels, picture.rects, picture.head.width, canvas);
  sent_[picture.view] = picture.pixels.size();
}

std::vector<std::uint32_t> StudioEnd::shown(std::uint32_t view) const {
  std::vector<std::uint32_t> pixels = canvases_.at(view);
  for (std::uint32_t& pixel : pixels) {
    EXPECT_EQ(pixel >> 24, 255u);
    pixel &= 0xffffff;
  }
  return pixels;
}

void StudioEnd::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

}  // namespace mars::test
