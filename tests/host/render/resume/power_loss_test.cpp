// A machine loses its power while it renders. Every call by which this process changes files is recorded; then, for
// each point in time, the folder is made as a disk may hold it afterwards: directories as they were at that time, as
// journalling file systems keep them, but of each file only what was brought to the disk (fsync), and of what was not,
// nothing, half or all.
#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/content/document/checksum.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/compile.h"
#include "host/images/picture_file.h"
#include "host/render/resume/resume.h"
#include "host/render/sinks/pixel_hash.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

namespace mars::resume {
namespace {

namespace fs = std::filesystem;

struct Operation {
  enum Kind { make_file, write, sync, rename, remove, make_folder } kind;
  std::string path;
  std::string more;  // written bytes; the new name
};

// While it lives, all that is done below `folder`.
class Recording {
 public:
  explicit Recording(std::string folder) : folder_(std::move(folder)) { active_ = this; }
  ~Recording() { active_ = nullptr; }

  static void opened(int number, const char* path, int flags) {
    if (active_ == nullptr || number < 0 || !active_->concerns(path)) return;
    const std::lock_guard lock(active_->mutex_);
    active_->files_[number] = path;
    if ((flags & O_CREAT) != 0) active_->operations_.push_back({Operation::make_file, path, ""});
  }
  static void closed(int number) {
    if (active_ == nullptr) return;
    const std::lock_guard lock(active_->mutex_);
    active_->files_.erase(number);
  }
  // On the file of this number.
  static void done(Operation::Kind kind, int number, const std::string& more = "") {
    if (active_ == nullptr) return;
    const std::lock_guard lock(active_->mutex_);
    const auto found = active_->files_.find(number);
    if (found != active_->files_.end()) active_->operations_.push_back({kind, found->second, more});
  }
  static void done(Operation::Kind kind, const std::string& path, const std::string& more = "") {
    if (active_ == nullptr || !active_->concerns(path)) return;
    const std::lock_guard lock(active_->mutex_);
    active_->operations_.push_back({kind, path, more});
  }

  const std::vector<Operation>& operations() const { return operations_; }

 private:
  bool concerns(const std::string& path) const { return path.starts_with(folder_); }

  static Recording* active_;
  std::string folder_;
  std::mutex mutex_;
  std::map<int, std::string> files_;
  std::vector<Operation> operations_;
};

Recording* Recording::active_ = nullptr;

template <typename Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace
}  // namespace mars::resume

// In place of the C library's.
extern "C" {

using mars::resume::Operation;
using mars::resume::Recording;

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  const int number = mars::resume::real<int (*)(const char*, int, mode_t)>("open")(path, flags, mode);
  Recording::opened(number, path, flags);
  return number;
}

ssize_t write(int number, const void* bytes, size_t count) {
  const ssize_t done = mars::resume::real<ssize_t (*)(int, const void*, size_t)>("write")(number, bytes, count);
  if (done > 0)
    Recording::done(Operation::write, number, {static_cast<const char*>(bytes), static_cast<std::size_t>(done)});
  return done;
}

int fsync(int number) {
  const int result = mars::resume::real<int (*)(int)>("fsync")(number);
  if (result == 0) Recording::done(Operation::sync, number);
  return result;
}

int close(int number) {
  Recording::closed(number);
  return mars::resume::real<int (*)(int)>("close")(number);
}

int rename(const char* from, const char* to) noexcept {
  const int result = mars::resume::real<int (*)(const char*, const char*)>("rename")(from, to);
  if (result == 0) Recording::done(Operation::rename, from, to);
  return result;
}

int unlink(const char* path) noexcept {
  const int result = mars::resume::real<int (*)(const char*)>("unlink")(path);
  if (result == 0) Recording::done(Operation::remove, path);
  return result;
}

int remove(const char* path) noexcept {
  const int result = mars::resume::real<int (*)(const char*)>("remove")(path);
  if (result == 0) Recording::done(Operation::remove, path);
  return result;
}

int mkdir(const char* path, mode_t mode) noexcept {
  const int result = mars::resume::real<int (*)(const char*, mode_t)>("mkdir")(path, mode);
  if (result == 0) Recording::done(Operation::make_folder, path);
  return result;
}
}

namespace mars::resume {
namespace {

enum class Unsynced { nothing, half, all };

// What a disk holds.
class Disk {
 public:
  void apply(const Operation& operation) {
    switch (operation.kind) {
      case Operation::make_folder: folders_.insert(operation.path); break;
      case Operation::make_file: files_.try_emplace(operation.path); break;
      case Operation::write: files_[operation.path].content += operation.more; break;
      case Operation::sync:
        if (const auto file = files_.find(operation.path); file != files_.end())
          file->second.synced = file->second.content.size();
        break;
      case Operation::rename:
        files_[operation.more] = files_[operation.path];
        files_.erase(operation.path);
        break;
      case Operation::remove:
        files_.erase(operation.path);
        folders_.erase(operation.path);
        break;
    }
  }

  // Below `to`, with paths as they were below `from`, and times long ago: a reboot takes its time.
  void write_to(const std::string& from, const fs::path& to, Unsynced unsynced) const {
    fs::remove_all(to);
    fs::create_directories(to);
    for (const std::string& folder : folders_) fs::create_directories(to / fs::path(folder).lexically_relative(from));
    for (const auto& [path, file] : files_) {
      const fs::path name = to / fs::path(path).lexically_relative(from);
      const std::size_t lost = file.content.size() - file.synced;
      const std::size_t left = unsynced == Unsynced::nothing ? 0 : unsynced == Unsynced::half ? lost / 2 : lost;
      std::string content = file.content.substr(0, file.synced + left);
      // The machine has been started again since.
      if (const std::size_t at = content.find(boot_); !boot_.empty() && at != std::string::npos) content[at] ^= 1;
      document::create_file(name, content);
      fs::last_write_time(name, fs::file_time_type::clock::now() - std::chrono::minutes(5));
    }
  }

 private:
  struct File {
    std::string content;
    std::size_t synced = 0;
  };

  const std::string boot_ = sinks::this_process().boot;
  std::set<std::string> folders_;
  std::map<std::string, File> files_;
};

constexpr const char* kFilm = R"({"frames": 4, "size": [16, 8], "camera": {"eye": [0, -6, 3], "at": [0, 0, 0]},
    "models": {"box": {"joints": [{"name": "side", "segment": {"shape": "box",
                                  "sbb": [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]]}}]}},
    "actors": [{"name": "a", "model": "box",
                "keys": [{"frame": 0, "place": [0, 0, 0]}, {"frame": 3, "place": [%, 0, 0]}]}]})";

constexpr std::uint32_t kFirst = 1000, kSecond = 2000;  // of each film's frames

std::string film_text(const std::string& place) {
  std::string text = kFilm;
  return text.replace(text.find('%'), 1, place);
}

// A film whose frames are all rendered, then edited, then rendered again, while all is recorded.
class PowerLoss : public testing::Test {
 protected:
  Wish wish(const fs::path& out) const {
    return {out, folder_ / "film.json", {}, {images::PictureFormat::png}, {}, false};
  }

  Opened open(const fs::path& out) const {
    return resume::open(wish(out), [&] { return film::load_film(folder_ / "film.json"); });
  }

  static void render(Opened& opened, std::uint32_t color) {
    sinks::Manifest manifest;
    manifest.width = 16;
    manifest.height = 8;
    manifest.frames = opened.frames;
    sinks::put_frames(*opened.folder, manifest, color);
    opened.folder->finish();
  }

  // No file under a frame's name is torn, and those that count as there have the pixels of their film.
  void expect_sound(const fs::path& out, const std::map<std::string, std::uint32_t>& colors) const {
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
      const fs::path file = out / ("frame-000" + std::to_string(frame) + ".png");
      if (!fs::exists(file)) continue;
      EXPECT_EQ(images::read_picture(images::PictureFormat::png, file).width, 16u) << file;
    }
    if (!fs::exists(out / "frames.json")) return;
    const sinks::Manifest manifest = sinks::read_manifest(out);
    const std::vector<std::uint32_t> missing = sinks::missing_frames(out, manifest, {0, 1, 2, 3});
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
      if (std::ranges::find(missing, frame) != missing.end()) continue;
      const auto pixels =
          images::read_picture(images::PictureFormat::png, out / sinks::frame_file_name(manifest, frame)).pixels;
      const std::uint32_t color = frame == 0 ? kFirst : colors.at(manifest.checksum);  // both films begin alike
      EXPECT_EQ(pixels[0] & 0xffffff, color + frame) << "frame " << frame;
      const std::string hash = sinks::hash_of(manifest, frame);
      const images::PictureBands bands(images::PictureFormat::png, manifest.width, manifest.height);
      EXPECT_EQ(sinks::pixel_hash_like(hash, bands, pixels), hash);
    }
  }

  const test::TemporaryFolder folder_;
};

TEST_F(PowerLoss, LeavesNoTornFrameAndWhatIsNotRecordedIsRenderedAgain) {
  const fs::path out = folder_ / "out", after = folder_ / "after";
  std::map<std::string, std::uint32_t> colors;  // of the films' frames, by their checksums
  std::vector<Operation> operations;
  {
    const Recording recording(out);
    for (const std::uint32_t color : {kFirst, kSecond}) {
      document::write_whole_file(folder_ / "film.json", film_text(std::to_string(color)));
      Opened opened = open(out);
      render(opened, color);
      colors[document::checksum_of(opened.film.block())] = color;
    }
    operations = recording.operations();
  }
  ASSERT_EQ(colors.size(), 2u);
  Disk disk;
  int looks = 0, opened = 0;
  for (std::size_t i = 0; i < operations.size(); ++i) {
    disk.apply(operations[i]);
    for (const Unsynced unsynced : {Unsynced::nothing, Unsynced::half, Unsynced::all}) {
      SCOPED_TRACE("operation " + std::to_string(i) + " on " + operations[i].path);
      disk.write_to(out, after, unsynced);
      expect_sound(after, colors);
      if (++looks % 8 != 0 || !fs::exists(after / "frames.json")) continue;
      EXPECT_NO_THROW(open(after)) << "the same command goes on";
      ++opened;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(looks, 300);
  EXPECT_GT(opened, 20);
}

}  // namespace
}  // namespace mars::resume
