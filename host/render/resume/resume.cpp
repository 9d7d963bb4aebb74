#include "host/render/resume/resume.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/content/film/film_file.h"
#include "host/render/resume/edit.h"
#include "host/render/resume/sources.h"

namespace mars::resume {
namespace {

namespace fs = std::filesystem;
using sinks::Manifest;

// Another run has changed the folder since it was looked at: look again.
struct FolderChanged {};

fs::path kept_film(const std::string& folder) { return fs::path(folder) / sinks::kFilmName; }

// Whether the film asked for is the one that the folder keeps, by its name there.
bool asks_for_kept_film(const Wish& wish) {
  std::error_code none;
  return fs::equivalent(wish.film, kept_film(wish.folder), none);
}

// Whether the film of the folder is the one asked for, as far as can be seen without compiling it.
bool is_asked_for(const Manifest& there, const Wish& wish) {
  if (wish.kept_film) return true;
  if (wish.overwrite) return false;
  if (asks_for_kept_film(wish)) return wish.options.empty();
  return there.options == wish.options && !there.sources.empty() &&
         there.sources.front().path == source_path(wish.film) && are_unchanged(there.sources);
}

// The film that the folder keeps, if it is the one that its manifest names.
std::optional<film::CompiledFilm> load_kept_film(const std::string& folder, const Manifest& there,
                                                 const film::FrameSet& frames = {}) try {
  film::CompiledFilm film = film::load_compiled_film(kept_film(folder), frames.is_small_part(there.film_frames));
  if (film.checksum() != there.checksum) return std::nullopt;
  return film;
} catch (const Failure&) {
  return std::nullopt;
}

bool is_sound_film(const fs::path& file) try {
  film::load_compiled_film(file);
  return true;
} catch (const Failure&) {
  return false;
}

bool are_of_one_folder(const std::optional<Manifest>& a, const std::optional<Manifest>& b) {
  return a.has_value() == b.has_value() && (!a || sinks::are_of_one_folder(*a, *b));
}

std::string format_name(images::PictureFormat format) { return images::facts_of(format).name; }

std::string words_text(const sinks::FrameForm& form) {
  std::string text;
  for (const std::string& word : sinks::words_of(form)) text += " " + document::shell_word(word);
  return text;
}

// The same view by name that computes something else.
bool has_changed_config(const sinks::FrameForm& there, const sinks::FrameForm& wish) {
  images::ViewName before = wish.view;
  before.checksum = there.view.checksum;
  return there.view != wish.view && there.view == before;
}

// How a person sees the form of what is there, where that is not what is asked for.
std::string difference(const sinks::FrameForm& there, const sinks::FrameForm& wish) {
  if (there.format != wish.format) return "are " + format_name(there.format) + ", not " + format_name(wish.format);
  if (there.compression != wish.compression)
    return std::string("have the compression ") + images::name_of(there.compression) + ", not " +
           images::name_of(wish.compression);
  if (there.view != wish.view) {
    const auto shown = [](const images::ViewName& view) {
      return view.empty() ? std::string("the film's curve") : images::text_of(view);
    };
    return "are shown by " + shown(there.view) +
           (has_changed_config(there, wish) ? " as it was before" : ", not by " + shown(wish.view));
  }
  const auto layers = [](wire::LayerSet kinds) {
    return kinds == 0 ? "no layers" : "the layers " + images::text_of(kinds);
  };
  if (there.layers != wish.layers) return "have " + layers(there.layers) + ", not " + layers(wish.layers);
  const auto name = [](const sinks::FrameForm& form) {
    return document::in_quotes(images::frame_name(form.names, 0, 1));
  };
  return "have other names: their first is " + name(there) + ", not " + name(wish);
}

std::string remedy_of(const sinks::FrameForm& there, const sinks::FrameForm& wish) {
  if (has_changed_config(there, wish)) return "";
  if (const std::string words = words_text(there); !words.empty()) return "add" + words + ", ";
  return images::without_alpha(there.format) != images::without_alpha(wish.format)
             ? "add --format " + format_name(there.format) + ", "
             : "leave out" + words_text(wish) + ", ";
}

void refuse_other_form(const Manifest& manifest, const Wish& wish) {
  const sinks::FrameForm there = form_of(manifest);
  if (there == wish.form) return;
  throw Failure("the frames in this folder " + difference(there, wish.form), wish.folder,
                remedy_of(there, wish.form) + "give another folder with -o, or replace them with --overwrite");
}

void refuse_other_film(const Manifest& there, const Wish& wish) {
  throw Failure("the frames in this folder are of another film, " + film_text(there), wish.folder,
                "give another folder with -o, or replace them with --overwrite");
}

bool has_no_frames(const Manifest& there) { return std::ranges::all_of(there.pixel_hashes, &std::string::empty); }

Failure other_pixels(const Manifest& there, const Wish& wish) {
  return Failure("the frames in this folder were rendered by a MARS that draws other pixels: their pixel version is " +
                     std::to_string(there.pixel_version) + ", not " + std::to_string(wire::kPixelVersion),
                 wish.folder, "give another folder with -o, or replace them with --overwrite");
}

// It cannot be compared.
void refuse_unknown_film(const Manifest& there, const Wish& wish) {
  if (is_sound_film(kept_film(wish.folder)))
    throw Failure("frames.json is of another film than film.mars is, " + film_text(there), wish.folder,
                  "if it is another folder's, remove it: mars verify --repair " + document::shell_word(wish.folder) +
                      " makes it again from film.mars and the frames; else give another folder with -o, or replace "
                      "all with --overwrite");
  throw Failure(
      "the frames in this folder are of another film, or of another version of it, " + film_text(there) +
          ", and film.mars, which would tell, is not there or not sound",
      wish.folder,
      (there.options == wish.options
           ? ""
           : "they were rendered by: " + command_for(wish.folder, there, film::FrameSet(there.frames)) + "; else ") +
          std::string("give another folder with -o, or replace them with --overwrite"));
}

// They would be lost.
Failure unlisted_frames(const Wish& wish) {
  return Failure(
      "the frames in this folder say that they are of another film, or of another version of it; it has no frames.json",
      wish.folder, "give another folder with -o, or replace them with --overwrite");
}

Failure others_files(const std::vector<std::string>& names, const Wish& wish) {
  return Failure("MARS has not made " + document::shell_word(names.front()) +
                     (names.size() > 1 ? " and " + document::counted(names.size() - 1, "other file") : "") +
                     " in this folder, which frames would replace",
                 wish.folder, "give another folder with -o, or replace them with --overwrite");
}

// A folder that is entered twice may fail in the same way twice.
std::function<void(const std::string&)> warning_once(const std::function<void(const std::string&)>& warn) {
  return [warn, last = std::make_shared<std::string>()](const std::string& line) {
    if (std::exchange(*last, line) != line) warn(line);
  };
}

class Opening {
 public:
  Opening(const Wish& wish, const std::function<film::CompiledFilm()>& compile, const sinks::Patience::Bounds& bounds)
      : wish_(wish), compile_(compile), bounds_(bounds) {
    if (bounds.warn) bounds_.warn = warning_once(bounds.warn);
  }

  Opened open() {
    for (;;) {
      look();
      try {
        return enter();
      } catch (const FolderChanged&) {
      }
    }
  }

  film::CompiledFilm look_only() {
    look();
    if (refusal_) throw *refusal_;
    return std::move(kept_ ? *kept_ : *compiled_);
  }

 private:
  // At the folder as it is now; and takes the film that it keeps, or compiles it.
  void look() {
    auto [seen, repaired] = sinks::find_manifest(wish_.folder);
    seen_ = std::move(seen);
    is_sound_ = repaired.empty();
    if (seen_ && !wish_.overwrite) refuse_other_form(*seen_, wish_);
    kept_.reset();
    edit_.reset();
    refusal_.reset();
    if (seen_ && is_asked_for(*seen_, wish_)) kept_ = load_kept_film(wish_.folder, *seen_, wish_.frames);
    if (kept_) return;
    compile();
    if (seen_ && compiled_->checksum() != seen_->checksum) compare();
  }

  // With what the folder's frames show.
  void compare() try {
    if (has_no_frames(*seen_)) return;
    const auto before = load_kept_film(wish_.folder, *seen_);
    if (!before) refuse_unknown_film(*seen_, wish_);
    refuse_other_form(*seen_, wish_);
    edit_ = edit_of(*before, *compiled_, wish_.folder, wish_.form.layers);
    const bool same_file = !seen_->sources.empty() && seen_->sources.front().path == source_path(wish_.film);
    if (edit_->keeps_none && !same_file) refuse_other_film(*seen_, wish_);
  } catch (const Failure& failure) {
    edit_.reset();
    if (!wish_.overwrite) refusal_ = failure;
  }

  void compile() try {
    if (compiled_) return;
    document::RecordedReads reads;
    compiled_ = compile_();
    sources_ = sources_of(wish_.film, reads.stamps());
  } catch (const Failure& failure) {
    if (!wish_.kept_film) throw;
    throw Failure(failure.problem + "; and the folder " + wish_.folder + " keeps no film.mars of its frames",
                  failure.where, failure.remedy);
  }

  const film::CompiledFilm& film() const { return kept_ ? *kept_ : *compiled_; }

  // Of all frames asked for.
  Manifest wanted() const {
    const wire::PackedFilm view = film().view();
    const wire::FilmSettings& settings = view.settings();
    Manifest manifest{wish_.film,
                      film().checksum(),
                      settings.width,
                      settings.height,
                      wish_.form.format,
                      settings.rate,
                      settings.frames,
                      wish_.frames.of_film(settings.frames),
                      {},
                      sources_,
                      wish_.options};
    set_form(manifest, wish_.form);
    manifest.place = images::place_of(settings);
    const bool is_kept_film = seen_ && seen_->checksum == manifest.checksum;
    if (is_kept_film && !wish_.overwrite && sinks::missing_frames(wish_.folder, *seen_, manifest.frames).empty())
      manifest.pixel_version = seen_->pixel_version;                          // nothing is rendered
    const bool known = is_kept_film && (kept_ || asks_for_kept_film(wish_));  // what it was made of
    if (known) {
      manifest.film = seen_->film;
      manifest.sources = seen_->sources;
      manifest.options = seen_->options;
    }
    return manifest;
  }

  Opened enter() {
    const Manifest wanted = this->wanted();
    const auto asked = static_cast<std::uint32_t>(wanted.frames.size());
    // Needs no right to write there.
    if (!wish_.overwrite && seen_ && wanted.pixel_version != seen_->pixel_version && !has_no_frames(*seen_))
      refusal_ = other_pixels(*seen_, wish_);
    if (kept_ && is_sound_ && !wish_.overwrite && sinks::missing_frames(wish_.folder, *seen_, wanted.frames).empty())
      return {std::move(*kept_), nullptr, asked, {}, ""};
    auto folder = std::make_unique<sinks::FrameFolder>(
        wish_.folder, wanted, [&](const std::optional<Manifest>& there) { return go_on(there, wanted); }, bounds_);
    std::vector<std::uint32_t> frames = folder->frames();
    if (frames.empty()) folder.reset();
    std::string changed = changed_text(wanted);
    return {std::move(kept_ ? *kept_ : *compiled_), std::move(folder), asked, std::move(frames), std::move(changed)};
  }

  // A line about what becomes of frames that are there; "": nothing that is not asked for.
  std::string changed_text(const Manifest& wanted) const {
    if (!seen_) return "";
    if (!wish_.overwrite) return edit_ ? edit_text(*seen_, *edit_, film(), what_differs()) : "";
    Manifest listed = wanted;
    listed.pixel_hashes.assign(listed.frames.size(), "");
    keep_frames(*seen_, listed);
    return unlisted_text(*seen_, listed);
  }

  std::string what_differs() const {
    const bool only_options = seen_->options != wish_.options && are_unchanged(seen_->sources);
    return wish_.film + (only_options ? " is asked for with other options" : " has changed");
  }

  sinks::Continuation go_on(const std::optional<Manifest>& there, const Manifest& wanted) const {
    if (!are_of_one_folder(there, seen_)) throw FolderChanged();
    Manifest all = wanted;
    all.pixel_hashes.assign(all.frames.size(), "");
    if (there) keep_frames(*there, all);
    std::optional<Failure> refusal = refusal_;
    if (!there && !wish_.overwrite) {
      if (sinks::add_marked_frames(wish_.folder, all)) refusal = unlisted_frames(wish_);
      const auto others = sinks::others_files(wish_.folder, wanted);
      if (!others.empty() && !sinks::has_frames(wish_.folder)) refusal = others_files(others, wish_);
    }
    return {std::move(all), kept_ ? nullptr : &film(), std::move(refusal), wish_.renders};
  }

  void keep_frames(const Manifest& there, Manifest& all) const {
    const bool same = sinks::are_of_one_folder(there, all);
    if (!same && (!edit_ || there.pixel_version != all.pixel_version)) return;
    all.more = there.more;
    all.usage = there.usage;
    Manifest kept = there;
    kept.pixel_hashes.resize(kept.frames.size());
    if (wish_.overwrite)
      for (const std::uint32_t frame : all.frames) sinks::set_hash(kept, frame, "");
    add_kept_frames(kept, same ? Edit() : *edit_, all);
  }

  const Wish& wish_;
  const std::function<film::CompiledFilm()>& compile_;
  sinks::Patience::Bounds bounds_;
  std::optional<Manifest> seen_;
  bool is_sound_ = true;  // frames.json; no: seen_ stands in for it
  std::optional<film::CompiledFilm> kept_, compiled_;
  std::optional<Edit> edit_;            // from the folder's film to compiled_; none: they are the same, or all goes
  std::optional<Failure> refusal_;      // why the folder may not become compiled_'s
  std::vector<sinks::Source> sources_;  // of compiled_
};

}  // namespace

std::optional<std::uint32_t> count_if_complete(const Wish& wish) try {
  if (wish.overwrite || !sinks::read_frames_json(wish.folder)) return std::nullopt;
  const Manifest there = sinks::read_manifest(wish.folder);
  if (form_of(there) != wish.form || !is_asked_for(there, wish)) return std::nullopt;
  const std::vector<std::uint32_t> asked = wish.frames.of_film(there.film_frames);
  if (!sinks::missing_frames(wish.folder, there, asked).empty()) return std::nullopt;
  return static_cast<std::uint32_t>(asked.size());
} catch (const Failure&) {  // the host says what is wrong
  return std::nullopt;
}

std::string command_for(const std::string& folder, const Manifest& there, const film::FrameSet& frames) {
  std::string line = "mars render " + document::shell_word(there.sources.empty() ? there.film : there.sources[0].path);
  for (const std::string& option : there.options) line += " " + document::shell_word(option);
  line += words_text(form_of(there));
  if (frames.of_film(there.film_frames).size() < there.film_frames) line += " --frames " + frames.text();
  return line + " -o " + document::shell_word(folder);
}

void require_kept_film(const std::string& folder, const Manifest& there, const film::FrameSet& frames) {
  if (load_kept_film(folder, there)) return;
  const std::string remedy = "render them from its file: " + command_for(folder, there, frames);
  if (!is_sound_film(kept_film(folder)))
    throw Failure(fs::exists(kept_film(folder)) ? "its film.mars is damaged, so that no frame can be rendered from it"
                                                : "has no film.mars, from which frames can be rendered again",
                  folder, remedy);
  throw Failure("frames.json is of another film than film.mars is, " + film_text(there), folder,
                "if it is another folder's, remove it: --repair makes it again from film.mars and the frames; else " +
                    remedy);
}

Opened open(const Wish& wish, const std::function<film::CompiledFilm()>& compile,
            const sinks::Patience::Bounds& bounds) {
  return Opening(wish, compile, bounds).open();
}

film::CompiledFilm film_for(const Wish& wish, const std::function<film::CompiledFilm()>& compile) {
  return Opening(wish, compile, {}).look_only();
}

}  // namespace mars::resume
