#include "host/render/panorama/join_frames.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <mutex>
#include <numbers>
#include <string>

#include "hal/failure/failure.h"
#include "host/content/film/frame_content.h"
#include "host/content/film/panorama.h"
#include "host/images/picture_file.h"
#include "host/render/compositor/frame.h"
#include "host/render/panorama/join.h"
#include "host/render/sinks/manifest.h"

namespace mars::panorama {
namespace {

constexpr std::uint32_t kBlock = 16;  // side of a frame's flags, of which none is set

class Work {
 public:
  Work(const Joining& joining, const std::function<void(std::size_t)>& joined)
      : joining_(joining),
        joined_(joined),
        manifest_(sinks::read_manifest(joining.faces)),
        joiner_(joining.panorama.settings().width),
        content_(joining.panorama),
        sink_(joining.folder, [this](std::uint32_t frame) { return content_.checksum(frame); }) {}

  // Joins the next frame that is not being joined yet, until there is none; on several threads at once.
  void run() {
    compositor::Frame frame(joiner_.width(), joiner_.height(), kBlock, 0, pixels());
    for (std::size_t next = next_++; next < joining_.frames.size(); next = next_++) {
      frame.number = joining_.frames[next];
      join(frame);
      sink_.take(frame);
      const std::lock_guard lock(mutex_);
      joined_(++done_);
    }
  }
  // Others end after the frame that they join.
  void stop() { next_ = joining_.frames.size(); }

 private:
  wire::PixelFormat pixels() const { return images::facts_of(joining_.folder.format()).pixels; }

  void join(compositor::Frame& frame) const {
    const wire::PackedFilm& film = joining_.panorama;
    const color::Encoding encoding = color::encoding_of(film.settings(), film.camera_at(frame.number), pixels());
    joiner_.join(faces_of(frame.number), encoding, frame.pixels);
  }

  std::vector<Face> faces_of(std::uint32_t frame) const {
    const wire::FilmSettings& settings = joining_.panorama.settings();
    std::vector<Face> faces;
    for (const std::uint32_t number : film::face_frames({frame}, settings.frames))
      faces.emplace_back(picture_of(joining_.faces / sinks::frame_file_name(manifest_, number)));
    return faces;
  }

  images::Image picture_of(const std::filesystem::path& face) const try {
    images::Image picture = images::read_picture(manifest_.format, face);
    const std::uint32_t side = film::face_side(joining_.panorama.settings().width);
    if (picture.width != side || picture.height != side)
      throw Failure("has another size than a face of this panorama", face.string(), "remove it, and render again");
    return picture;
  } catch (const Failure& failure) {
    throw sinks::DamagedFrame(failure.problem, failure.where, failure.remedy);
  }

  const Joining& joining_;
  const std::function<void(std::size_t)>& joined_;
  const sinks::Manifest manifest_;
  const Joiner joiner_;
  const film::FrameContent content_;
  sinks::FileSink sink_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;  // guards what follows
  std::size_t done_ = 0;
};

std::size_t threads_of(const Joining& joining) {
  const std::uint32_t side = film::face_side(joining.panorama.settings().width);
  const std::uint64_t room = joining.memory / joining_bytes(side, images::facts_of(joining.folder.format()).pixels);
  const std::uint64_t most = std::min<std::uint64_t>(joining.processors, joining.frames.size());
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(room, 1, std::max<std::uint64_t>(most, 1)));
}

}  // namespace

// Faces as light, one as a file's pixels, and the frame with its file. A frame is as wide as four faces, by pi / 4.
std::uint64_t joining_bytes(std::uint32_t side, wire::PixelFormat pixels) {
  constexpr double kFacePixel = film::kFaces * sizeof(Light) + 16;
  constexpr double kFrame = std::numbers::pi * std::numbers::pi / 2;  // pixels of a frame, in those of a face
  return static_cast<std::uint64_t>(double(side) * side * (kFacePixel + kFrame * double(wire::pixel_bytes(pixels))));
}

void join_frames(const Joining& joining, const std::function<void(std::size_t)>& joined) {
  Work work(joining, joined);
  std::vector<std::future<void>> others;
  try {
    for (std::size_t thread = 1; thread < threads_of(joining); ++thread)
      others.push_back(std::async(std::launch::async, [&work] { work.run(); }));
    work.run();
    for (std::future<void>& other : others) other.get();
  } catch (...) {
    work.stop();  // the futures wait for their threads
    throw;
  }
}

}  // namespace mars::panorama
