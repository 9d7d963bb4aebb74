#include "host/shell/launch/film_panorama.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/film/film_file.h"
#include "host/content/film/panorama.h"
#include "host/images/picture_format.h"
#include "host/render/panorama/join_frames.h"
#include "host/render/session/session.h"
#include "host/render/sinks/restore.h"
#include "host/shell/job/film_of.h"
#include "topology/memory_limit.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPanorama = "panorama";
constexpr std::uint64_t kMuch = std::uint64_t{1} << 30;  // bytes, worth a line

void warn(const std::string& line) { std::cerr << "mars: warning: " << line << '\n'; }

// Large films are read in pieces, and seldom have the word.
bool has_word(const std::string& file, std::string_view word) {
  std::string text;
  bool found = false;
  document::read_pieces(file, [&](std::string_view piece) {
    text.append(piece);
    found = found || text.find(word) != std::string::npos;
    text.erase(0, text.size() - std::min(text.size(), word.size()));
  });
  return found;
}

bool is_panorama_file(const std::string& file) {
  if (film::is_compiled_film(file)) return film::is_panorama(film::load_compiled_film(file).view());
  if (!has_word(file, kPanorama)) return false;
  const document::Document document = document::read_document(file);
  const document::Fields film(document.root(), keys::object("film"));
  const auto camera = film.find("camera");
  if (!camera) return false;
  return document::Fields(*camera, keys::object("camera")).choice("projection") ==
         static_cast<std::size_t>(wire::Projection::panorama);
}

std::string kept_film(const options::RenderOptions& options) {
  return (fs::path(options.folder) / sinks::kFilmName).string();
}

fs::path faces_in(const fs::path& work) { return work / "faces"; }

// Pictures are joined of light alone, and whole.
void refuse_parts(const options::RenderOptions& options) {
  const auto refuse = [&](const std::string& problem, const std::string& remedy) {
    throw Failure(problem, options.film, remedy);
  };
  if (options.layers.kinds != 0) refuse("a panorama has no layers", "leave out --layers, or render its --faces");
  if (options.crop || options.margin != 0) refuse("a panorama is joined whole", "leave out --crop and --margin");
  if (!options.view.config.empty())
    refuse("a panorama is not shown by a view of OpenColorIO",
           "leave out --ocio; or render with --format exr, and then mars play --ocio");
}

resume::Opened open_folder_of(const options::RenderOptions& options) {
  refuse_parts(options);
  return resume::open({options.folder, options.film, options::film_arguments(options), options::form_of(options),
                       options.frames, options.overwrite, options.kept_film},
                      [&] { return job::load_film_of(options, warn); }, {.warn = warn});
}

}  // namespace

bool is_panorama(const options::RenderOptions& options) try {
  if (options.faces) return false;
  const std::string kept = kept_film(options);
  const bool is_kept = options.kept_film && !options.folder.empty() && fs::exists(kept);
  return is_panorama_file(is_kept ? kept : options.film);
} catch (const Failure&) {
  return false;
}

options::RenderOptions faces_of(options::RenderOptions options) {
  job::load_drawn_film_of(options, [](const std::string&) {});
  return options;
}

void remove_left_faces(const fs::path& frames) try {
  if (!document::has_work_folder(frames)) return;
  const document::WorkFolder work(frames, document::WorkFolder::Use::shared);
  const fs::path faces = faces_in(work.path());
  const sinks::Manifest joined = sinks::read_manifest(frames);
  const std::vector<std::uint32_t> missing = sinks::missing_frames(frames, joined, joined.frames);
  std::vector<std::uint32_t> there;
  std::ranges::set_difference(joined.frames, missing, std::back_inserter(there));
  std::error_code none;
  if (const auto drawn = sinks::read_frames_json(faces)) {
    for (const std::uint32_t face : film::face_frames(there, joined.film_frames))
      fs::remove(faces / sinks::frame_file_name(*drawn, face), none);
    if (sinks::has_frames(faces)) return;
  }
  sinks::remove_folder(faces);
} catch (const Failure&) {  // the frames are there: what stays, another command removes
}

void remove_all_faces(const fs::path& frames) try {
  if (!document::has_work_folder(frames)) return;
  const document::WorkFolder work(frames, document::WorkFolder::Use::shared);
  sinks::remove_folder(faces_in(work.path()));
} catch (const Failure&) {  // the videos are there
}

FilmPanorama::FilmPanorama(const options::RenderOptions& options, Display& display)
    : options_(options),
      display_(display),
      opened_(open_folder_of(options)),
      work_(options.folder, document::WorkFolder::Use::shared) {
  check_memory();
  const auto left = static_cast<std::uint32_t>(opened_.frames.size());
  if (left < opened_.asked || !opened_.changed.empty())
    display_.print(resumed_text({opened_.asked - left, opened_.asked, opened_.changed}));
}

// Before the faces are drawn, which may take hours.
void FilmPanorama::check_memory() const {
  const std::uint64_t bytes = panorama::joining_bytes(film::face_side(opened_.film.view().settings().width),
                                                      images::facts_of(options_.format).pixels);
  const std::string needed = "joining each frame of its faces takes " + topology::gigabytes(bytes) + " of memory";
  if (const std::uint64_t here = topology::usable_memory(); !opened_.frames.empty() && bytes > here)
    throw Failure(needed + ", where there are " + topology::gigabytes(here), options_.film,
                  "render a smaller panorama (--size), or join it on a machine with more memory");
  if (!opened_.frames.empty() && bytes >= kMuch) display_.print(needed);
}

// They name the film that the folder keeps, which the other options have made.
options::RenderOptions FilmPanorama::faces() const {
  options::RenderOptions faces = options_;
  faces.frames = film::FrameSet(opened_.frames);
  faces = job::faces_of(faces, opened_.film.view().settings().frames);
  faces.film = kept_film(options_);
  faces.folder = faces_in(work_.path()).string();
  faces.size = {};
  faces.samples = {};
  faces.eye = film::Eye::middle;
  faces.intervals = options::Intervals::automatic;
  faces.kept_film = false;
  return faces;
}

void FilmPanorama::join() {
  const auto started = std::chrono::steady_clock::now();
  const session::HostMachine machine = session::host_machine({});
  const wire::PackedFilm film = opened_.film.view();
  const std::size_t count = opened_.frames.size();
  panorama::join_frames({film, faces_in(work_.path()), *opened_.folder, opened_.frames,
                         static_cast<std::uint32_t>(machine.processors), machine.memory},
                        [&](std::size_t done) {
                          display_.show("joined frame " + std::to_string(done) + " of " + std::to_string(count));
                        });
  opened_.folder->note_used(sinks::read_manifest(faces_in(work_.path())).usage);
  opened_.folder->finish(&opened_.film);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - started;
  display_.print(document::counted(count, "frame") + " joined in " + options_.folder + ", " +
                 document::formatted("%.1f", seconds.count()) + " seconds");
  remove_left_faces(options_.folder);
}

}  // namespace mars::launch
