#include "host/render/sinks/restore.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "host/content/document/file.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/film_file.h"
#include "host/content/film/frame_content.h"
#include "host/images/picture_file.h"
#include "host/render/sinks/claim.h"
#include "host/render/sinks/frame_mark.h"
#include "host/render/sinks/record.h"
#include "host/render/sinks/runs_folder.h"

namespace mars::sinks {

namespace fs = std::filesystem;

namespace {

struct File {
  std::string name;
  FrameMark mark;
};

// What files with frames' names say of themselves.
struct Files {
  std::vector<File> marked;
  std::vector<std::string> unmarked;  // their names
  std::vector<std::string> empty;     // of what has a frame's name and is none
};

Files files_in(const fs::path& folder) {
  Files files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!is_named_as_frame(name, {}) && !images::is_picture_name(entry->path())) continue;
    const bool is_file = is_frame_file(entry->path());
    std::optional<FrameMark> mark = is_file ? read_mark(entry->path()) : std::nullopt;
    if (!is_named_as_frame(name, mark)) continue;
    if (mark)
      files.marked.push_back({name, std::move(*mark)});
    else
      (is_file ? files.unmarked : files.empty).push_back(name);
  }
  if (error && error != std::errc::no_such_file_or_directory)
    document::fail_file("list the folder", folder, error.value());
  std::ranges::sort(files.marked, {}, &File::name);
  return files;
}

Manifest manifest_of(const film::CompiledFilm& film) {
  const wire::PackedFilm view = film.view();
  const wire::FilmSettings& settings = view.settings();
  Manifest manifest;
  manifest.checksum = film.checksum();
  manifest.width = settings.width;
  manifest.height = settings.height;
  manifest.place = images::place_of(settings);
  manifest.rate = settings.rate;
  manifest.film_frames = settings.frames;
  return manifest;
}

bool is_of_very_film(const FrameMark& mark, const Manifest& manifest, std::uint32_t frame) {
  return mark == mark_in(manifest, frame, mark.pixel_hash, mark.content);
}

// Where film.mars is lost. None where the frames are not all of one film, or the first of them shows no picture.
std::optional<Manifest> manifest_of(const std::vector<File>& files, const fs::path& folder) try {
  if (files.empty()) return std::nullopt;
  const FrameMark& first = files.front().mark;
  if (!std::ranges::all_of(files, [&](const File& file) { return file.mark.film == first.film; })) return std::nullopt;
  const images::Image image = images::read_picture(first.form.format, folder / files.front().name);
  Manifest manifest;
  manifest.checksum = first.film;
  manifest.width = image.width;
  manifest.height = image.height;
  manifest.place = first.place;
  manifest.rate = first.rate;
  manifest.film_frames = first.film_frames;
  return manifest;
} catch (const Failure&) {
  return std::nullopt;
}

// Of the latest pixel version, in the form that most frames of it have.
void take_form(const std::vector<File>& files, Manifest& manifest) {
  using Form = std::pair<std::uint32_t, FrameForm>;
  std::map<Form, std::uint32_t> counts;
  for (const File& file : files) ++counts[{file.mark.pixel_version, file.mark.form}];
  if (counts.empty()) return;
  const std::uint32_t latest = counts.rbegin()->first.first;
  const auto count = [&](const auto& form) { return form.first.first == latest ? form.second : 0; };
  const Form form = std::ranges::max_element(counts, {}, count)->first;
  manifest.pixel_version = form.first;
  set_form(manifest, form.second);
}

class Restoring {
 public:
  Restoring(const fs::path& folder, const Manifest* known) : folder_(folder), files_(files_in(folder)) {
    if (known != nullptr) runs_.push_back(*known);
    for (const RunFiles& run : RunsFolder(folder, this_process()).runs())
      if (std::optional<Manifest> rendered = rendered_by(run)) runs_.push_back(std::move(*rendered));
    try {
      film_ = film::load_compiled_film(folder / kFilmName);
    } catch (const Failure&) {  // it is lost or damaged too
    }
  }

  std::optional<Restored> restore() {
    if (!begin()) return std::nullopt;
    std::map<std::uint32_t, std::string> hashes;
    std::vector<std::string> others = files_.empty;
    for (const File& file : files_.marked) {
      const auto frame = frame_of_file(manifest_, file.name);
      if (frame && is_of_it(file.mark, *frame))
        hashes[*frame] = file.mark.pixel_hash;
      else
        others.push_back(file.name);
    }
    const bool asked_is_known = !runs_.empty();
    const std::uint32_t unmarked = asked_is_known ? 0 : add_unknown(files_.unmarked, hashes);
    const std::uint32_t unlike = asked_is_known ? 0 : add_unknown(others, hashes);
    Manifest found = manifest_;
    found.frames.clear();
    found.pixel_hashes.clear();
    for (auto& [frame, hash] : hashes) {
      found.frames.push_back(frame);
      found.pixel_hashes.push_back(std::move(hash));
    }
    add_frames(manifest_, found);
    return Restored{std::move(manifest_), unmarked, unlike};
  }

 private:
  // With what runs know, or else what the film or the frames say.
  bool begin() {
    if (!runs_.empty()) {
      manifest_ = runs_.front();
      manifest_.pixel_hashes.resize(manifest_.frames.size());
      for (const Manifest& run : runs_)
        if (are_of_one_folder(run, manifest_)) add_frames(manifest_, run);
      return true;
    }
    std::optional<Manifest> begun = film_ ? manifest_of(*film_) : manifest_of(files_.marked, folder_);
    if (!begun) return false;
    manifest_ = std::move(*begun);
    manifest_.film = kFilmName;
    take_form(files_.marked, manifest_);
    return true;
  }

  // Frames that stayed through an edit were rendered of another film, which shows the same there.
  bool is_of_it(const FrameMark& mark, std::uint32_t frame) {
    if (mark.frame != frame || mark.form != form_of(manifest_) || mark.pixel_version != manifest_.pixel_version)
      return false;
    if (mark.film == manifest_.checksum) return true;
    if (mark.content.empty()) return false;
    if (!content_ && film_ && film_->checksum() != manifest_.checksum) film_.reset();
    if (!film_) return false;
    if (!content_) content_.emplace(film_->view(), manifest_.layers);
    return content_->checksum(frame) == mark.content;
  }

  // Frames without a hash. Returns how many there are.
  std::uint32_t add_unknown(const std::vector<std::string>& names, std::map<std::uint32_t, std::string>& hashes) const {
    std::uint32_t unknown = 0;
    for (const std::string& name : names)
      if (const auto frame = frame_of_file(manifest_, name)) unknown += hashes.try_emplace(*frame).second;
    return unknown;
  }

  const fs::path& folder_;
  const Files files_;
  std::vector<Manifest> runs_;  // what they know
  std::optional<film::CompiledFilm> film_;
  std::optional<film::FrameContent> content_;
  Manifest manifest_;
};

}  // namespace

std::optional<Restored> restore_manifest(const fs::path& folder, const Manifest* known) {
  return Restoring(folder, known).restore();
}

std::optional<Manifest> read_frames_json(const fs::path& folder) {
  const fs::path path = folder / kManifestName;
  std::error_code none;
  if (fs::exists(fs::symlink_status(path, none)) && !fs::is_regular_file(path, none))
    throw Failure("is not a regular file", path.string(), "remove it; " + repair_remedy(folder));
  const std::optional<std::string> text = document::read_file_if_there(path, kLargestRecord);
  if (!text) return std::nullopt;
  try {
    return manifest_of(parse_record(*text));
  } catch (const LaterManifest& failure) {
    throw Failure("cannot be read: " + failure.problem, path.string(), failure.remedy);
  } catch (const Failure& failure) {
    throw DamagedManifest("not a manifest of frames: " + failure.problem, path.string(), repair_remedy(folder));
  }
}

Found find_manifest(const fs::path& folder, const Manifest* known) {
  std::optional<DamagedManifest> damaged;
  try {
    if (std::optional<Manifest> there = read_frames_json(folder)) return {std::move(there), ""};
  } catch (const DamagedManifest& failure) {
    damaged = failure;
  }
  const bool may_be_new = !damaged && known == nullptr;
  std::error_code none;
  if (may_be_new && !fs::exists(folder / kFilmName, none)) return {};
  std::optional<Restored> restored = restore_manifest(folder, known);
  const bool known_whole = restored && (known != nullptr || restored->unmarked == 0);
  if (!known_whole && damaged) throw *damaged;
  if (!known_whole || (may_be_new && restored->manifest.frames.empty())) return {};
  return {std::move(restored->manifest), damaged ? damaged->problem : "it is gone"};
}

std::string repair_text(const std::string& problem) {
  return std::string(kManifestName) + " was lost or damaged (" + problem +
         "): it is made again from what runs and the frames say";
}

std::string repair_remedy(const fs::path& folder) {
  return "mars verify --repair " + document::shell_word(folder.string()) + " makes it again";
}

std::vector<std::string> others_files(const fs::path& folder, const Manifest& manifest) {
  std::vector<std::string> names;
  std::error_code none;
  for (fs::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none)) {
    std::string name = entry->path().filename().string();
    const auto frame = frame_of_file(manifest, name);
    if (frame && std::ranges::binary_search(manifest.frames, *frame) && is_frame_file(entry->path()) &&
        !read_mark(entry->path()))
      names.push_back(std::move(name));
  }
  std::ranges::sort(names);
  return names;
}

bool add_marked_frames(const fs::path& folder, Manifest& manifest) {
  const Files files = files_in(folder);
  bool some_of_it = false;
  for (const File& file : files.marked) {
    const auto frame = frame_of_file(manifest, file.name);
    const FrameMark& mark = file.mark;
    if (frame && hash_of(manifest, *frame).empty() && is_of_very_film(mark, manifest, *frame))
      set_hash(manifest, *frame, mark.pixel_hash);
    some_of_it = some_of_it || mark.film == manifest.checksum;
  }
  return !files.marked.empty() && !some_of_it;
}

std::uint32_t add_unrecorded_frames(const fs::path& folder, Manifest& manifest) {
  std::uint32_t there = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; entry != end; entry.increment(error)) {
    const auto frame = frame_of_file(manifest, entry->path().filename().string());
    if (!frame || !std::ranges::binary_search(manifest.frames, *frame)) continue;
    if (hash_of(manifest, *frame).empty() && is_frame_file(entry->path())) {
      const std::optional<FrameMark> mark = read_mark(entry->path());
      if (mark && is_of_very_film(*mark, manifest, *frame)) set_hash(manifest, *frame, mark->pixel_hash);
    }
    there += hash_of(manifest, *frame).empty() ? 0 : 1;
  }
  if (error) document::fail_file("list the folder", folder, error.value());
  return there;
}

bool is_own_name(const std::string& name) {
  return name == kManifestName || name == kFilmName || name == kRunsName || name.starts_with("frame-");
}

}  // namespace mars::sinks
