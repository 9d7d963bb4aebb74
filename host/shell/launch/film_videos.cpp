#include "host/shell/launch/film_videos.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/render/sinks/frame_folder.h"
#include "host/shell/job/film_of.h"
#include "host/shell/launch/film_audio.h"
#include "host/shell/launch/film_panorama.h"
#include "host/videos/folder_source.h"
#include "host/videos/mark.h"
#include "host/videos/pieces.h"
#include "host/videos/probe.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

void add(document::Checksum& sum, const std::string& text) {
  sum.add(std::as_bytes(std::span(text.c_str(), text.size() + 1)));
}

std::string bytes_text(std::uintmax_t bytes) {
  constexpr double kMegabyte = 1e6;
  return bytes < kMegabyte ? document::formatted("%.0f kB", static_cast<double>(bytes) / 1e3)
                           : document::formatted("%.1f MB", static_cast<double>(bytes) / kMegabyte);
}

// How far apart they are, where that is the same for all; else 1.
std::uint32_t step_of(const std::vector<std::uint32_t>& frames) {
  if (frames.size() < 2) return 1;
  const std::uint32_t step = frames[1] - frames[0];
  const auto is_other = [step](std::uint32_t one, std::uint32_t next) { return next - one != step; };
  return std::ranges::adjacent_find(frames, is_other) == frames.end() ? step : 1;
}

}  // namespace

FilmVideos::FilmVideos(const options::RenderOptions& options, Display& display) : options_(options), display_(display) {
  if (options.videos.empty()) return;
  if (document::file_exists(options.film)) audio_ = audio_of_film(options.film);
  for (const std::string& file : options.videos) {
    document::refuse_same_file(options.film, file);
    videos::check_order(order_of(file), options.size);
  }
  // All processes enter working folders in the order of the videos' places: no two wait for one another.
  std::map<fs::path, std::string> files;
  for (const std::string& file : options.videos) files.emplace(document::place_of_file(file), file);
  for (const auto& [place, file] : files)
    work_.try_emplace(place, file, document::WorkFolder::Use::alone,
                      [&] { display_.print(videos::waiting_text(order_of(file))); });
}

videos::Order FilmVideos::order_of(const std::string& file) const {
  videos::Order order{file, options_.video_form, audio_};
  order.overwrite = options_.overwrite;
  if (const auto work = work_.find(document::place_of_file(file)); work != work_.end()) order.work = &work->second;
  return order;
}

// A checksum of all that decides its content, but for the version of ffmpeg.
std::string FilmVideos::recipe_of(const std::string& file, const std::string& film, std::uint32_t film_frames) const {
  const videos::Form form = videos::form_of(file, options_.video_form);
  document::Checksum sum;
  for (const std::string_view encoder : form.codec->encoders)
    for (const std::string& word : videos::encoding_words(form, encoder)) add(sum, word);
  add(sum, std::string(form.kind->muxer));
  add(sum, film);
  add(sum, std::to_string(wire::kPixelVersion));
  const images::FrameForm frames = options::form_of(options_);
  add(sum, std::to_string(static_cast<int>(frames.format)));
  add(sum, frames.view.checksum);
  add(sum, film::FrameSet(options_.frames.of_film(film_frames)).text());
  if (audio_ && form.kind->has_audio) {
    add(sum, document::shown(audio_->delay));
    document::read_pieces(audio_->file, [&](std::string_view piece) { sum.add(std::as_bytes(std::span(piece))); });
  }
  return sum.digits();
}

bool FilmVideos::is_there(const std::string& file, const std::string& film, std::uint32_t film_frames) const {
  if (options_.overwrite || !document::file_exists(file)) return false;
  const auto mark = videos::mark_of(videos::comment_of(file));
  return mark && mark->recipe == recipe_of(file, film, film_frames);
}

bool FilmVideos::are_there() {
  if (!options_.own_folder || options_.overwrite || options::measures(options_)) return false;
  if (options_.kept_film && fs::exists(options_.folder)) return false;
  for (const std::string& file : options_.videos)
    if (!document::file_exists(file) || !videos::mark_of(videos::comment_of(file))) return false;
  const film::CompiledFilm film = job::load_film_of(options_, [](const std::string&) {});
  const std::string checksum = film.checksum();
  for (const std::string& file : options_.videos)
    if (!is_there(file, checksum, film.view().settings().frames)) return false;
  for (const std::string& file : options_.videos) display_.print(file + " is there already");
  empty_work_folders();
  return true;
}

void FilmVideos::make() {
  for (const std::string& file : options_.videos) make(file);
  empty_work_folders();
}

void FilmVideos::make(const std::string& file) {
  const auto started = Clock::now();
  const videos::FolderReader reader(options_.folder);
  const sinks::Manifest& manifest = reader.manifest();
  if (is_there(file, manifest.checksum, manifest.film_frames)) return display_.print(file + " is there already");
  videos::Order order = order_of(file);
  order.recipe = recipe_of(file, manifest.checksum, manifest.film_frames);
  const auto note = [this](const std::string& line) { display_.print(line); };
  const auto show = [&](std::size_t done, std::size_t of) {
    display_.show(file + ": frame " + std::to_string(done) + " of " + std::to_string(of));
  };
  videos::Source source = videos::source_of(reader, options_.frames.of_film(manifest.film_frames));
  source.rate /= step_of(source.frames);
  videos::write_video(source, order, {show, note, {note}});
  const std::chrono::duration<double> seconds = Clock::now() - started;
  display_.print(document::counted(source.frames.size(), "frame") + " in " + file + ", " +
                 bytes_text(fs::file_size(file)) + ", " + document::formatted("%.1f", seconds.count()) + " seconds");
}

// Removes also frames and pieces that killed processes have left, of whatever film: the videos are there.
void FilmVideos::empty_work_folders() {
  for (const auto& [place, work] : work_) {
    const fs::path frames = options::frames_in(work.path());
    remove_all_faces(frames);
    if (!sinks::remove_folder(frames) && fs::exists(frames)) display_.print("the frames stay in " + frames.string());
    videos::remove_pieces(work.path());
  }
}

}  // namespace mars::launch
