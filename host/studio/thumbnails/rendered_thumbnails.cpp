#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <chrono>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/studio/link/host_process.h"
#include "host/studio/thumbnails/thumbnail_film.h"
#include "host/studio/thumbnails/thumbnails.h"
#include "node/wire/pixel_version.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::uintmax_t kLargestPicture = 1 << 20;

// As RFC 4648 has it.
std::string base64_of(std::string_view bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 3; ++i) word = word << 8 | (at + i < bytes.size() ? std::uint8_t(bytes[at + i]) : 0);
    for (std::size_t i = 0; i < 4; ++i) text += at + i <= bytes.size() ? kDigits[word >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

class RenderedThumbnails final : public Thumbnails {
 public:
  RenderedThumbnails(asio::io_context& context, fs::path mars, fs::path cache)
      : context_(context), mars_(std::move(mars)), cache_(std::move(cache)) {}
  ~RenderedThumbnails() override { *alive_ = false; }

  void want(Take take) override {
    if (ready_) return give(take);
    waiting_.push_back(std::move(take));
    if (std::exchange(begun_, true)) return;
    if (!cache_.empty()) asio::post(worker_, [this] { prepare_apart(); });
  }

 private:
  struct Prepared {
    std::vector<std::string> names;
    fs::path folder;  // of its frames
    bool whole;       // they are there
  };

  // In the thread of its own. Without pictures the studio does as well.
  void prepare_apart() {
    try {
      asio::post(context_, [this, alive = alive_, prepared = prepare(cache_)] {
        if (*alive) render(prepared);
      });
    } catch (const std::exception&) {  // no room in the cache, most likely
    }
  }

  static fs::path frame_file(const fs::path& folder, std::size_t frame) {
    return folder / "frames" / document::formatted("frame-%04zu.png", frame);
  }

  // Another film, or other pixels, have a folder of their own.
  static Prepared prepare(const fs::path& cache) {
    const ThumbnailFilm film = thumbnail_film();
    const std::string word = document::checksum_of(std::as_bytes(std::span(film.text))).substr(0, 16);
    Prepared made{film.names, cache / ("thumbnails-" + std::to_string(wire::kPixelVersion) + "-" + word), true};
    for (std::size_t frame = 0; frame < film.names.size(); ++frame)
      made.whole = made.whole && document::file_exists(frame_file(made.folder, frame));
    std::error_code problem;
    fs::create_directories(made.folder, problem);
    if (!made.whole && !problem) document::write_whole_file(made.folder / "film.json", film.text);
    return made;
  }

  // At the lowest priority, where there is a program that gives it.
  void render(const Prepared& prepared) {
    names_ = prepared.names;
    folder_ = prepared.folder;
    if (prepared.whole) return tell();
    std::vector<std::string> words{
        mars_, "render", folder_ / "film.json", "-o", folder_ / "frames", "--backend", "threads", "--nodes",
        "1",   "--alpha"};
    if (const auto nice = child::find_program("nice", child::program_path(child::own_environment())))
      words.insert(words.begin(), {nice->string(), "-n", "19"});
    process_ = std::make_unique<HostProcess>(
        context_,
        [&](const child::ProcessSetup& setup) {
          return std::make_unique<child::Process>(child::Command{{}, words}, setup);
        },
        0s,
        HostProcess::Listener{[](const std::string&) {},
                              [this](const child::Ending& ending, const std::string&) {
                                asio::post(context_, [process = std::shared_ptr<HostProcess>(std::move(process_))] {});
                                if (ending.well()) tell();
                              }});
  }

  void tell() {
    ready_ = true;
    for (const Take& take : std::exchange(waiting_, {})) give(take);
  }

  void give(const Take& take) const {
    for (std::size_t frame = 0; frame < names_.size(); ++frame)
      if (const auto picture = document::read_file_if_there(frame_file(folder_, frame), kLargestPicture))
        take(names_[frame], base64_of(*picture));
  }

  asio::io_context& context_;
  const fs::path mars_, cache_;
  std::vector<Take> waiting_;
  std::vector<std::string> names_;
  fs::path folder_;
  bool begun_ = false, ready_ = false;
  std::unique_ptr<HostProcess> process_;
  const std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  asio::thread_pool worker_{1};  // ends before all else of this
};

}  // namespace

std::unique_ptr<Thumbnails> make_thumbnails(asio::io_context& context, const fs::path& mars, const fs::path& cache) {
  return std::make_unique<RenderedThumbnails>(context, mars, cache);
}

fs::path thumbnail_cache() {
  const child::Environment environment = child::own_environment();
  const auto cache = environment.value("XDG_CACHE_HOME"), home = environment.value("HOME");
  if (cache && !cache->empty()) return fs::path(*cache) / "mars";
  if (home && !home->empty()) return fs::path(*home) / ".cache" / "mars";
  return {};
}

}  // namespace mars::studio
