#include "host/render/resume/edit.h"

#include <algorithm>
#include <iterator>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/film/changed_frames.h"
#include "host/content/film/crop.h"
#include "host/content/film/frame_set.h"

namespace mars::resume {
namespace {

using Numbers = std::vector<std::uint32_t>;

std::string picture_text(const wire::FilmSettings& settings) {
  std::string text = film::size_text(settings) + " with " + document::counted(settings.samples, "sample") + " a pixel";
  if (settings.pixel_aspect != 1)
    text += document::formatted(" that is %g times as wide as high", double{settings.pixel_aspect});
  return text;
}

// Of a long list only where it begins and ends: "frames 3-5,7", "412 frames from 3 to 900".
std::string list_text(const Numbers& numbers, const std::string& one) {
  constexpr std::size_t kLongestList = 40;
  const std::string list = film::FrameSet(numbers).text();
  if (numbers.size() == 1) return one + " " + list;
  if (list.size() <= kLongestList) return one + "s " + list;
  return document::counted(numbers.size(), one) + " from " + std::to_string(numbers.front()) + " to " +
         std::to_string(numbers.back());
}

// Counted from 1, as the progress line counts them.
Numbers intervals_of(const Numbers& frames, const wire::PackedFilm& film) {
  Numbers numbers;
  std::size_t at = 0;
  for (const std::uint32_t frame : frames) {
    while (frame - film.intervals()[at].first_frame >= film.intervals()[at].frame_count) ++at;
    const auto number = static_cast<std::uint32_t>(at + 1);
    if (numbers.empty() || numbers.back() != number) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

Edit edit_of(const film::CompiledFilm& before, const film::CompiledFilm& now, const std::string& folder,
             wire::LayerSet layers) {
  const wire::PackedFilm was = before.view(), is = now.view();
  const wire::FilmSettings &a = was.settings(), &b = is.settings();
  if (a.width != b.width || a.height != b.height || a.samples != b.samples || a.window != b.window ||
      a.pixel_aspect != b.pixel_aspect)
    throw Failure("the frames in this folder are " + picture_text(a) + ", not " + picture_text(b), folder,
                  "give another folder with -o, or replace them with --overwrite");
  Edit edit{film::changed_frames(was, is, layers)};
  const std::uint32_t both = std::min(a.frames, b.frames);
  edit.keeps_none = std::ranges::lower_bound(edit.frames, both) - edit.frames.begin() == both;
  return edit;
}

void add_kept_frames(const sinks::Manifest& there, const Edit& edit, sinks::Manifest& all) {
  sinks::Manifest kept = there;
  kept.frames.clear();
  kept.pixel_hashes.clear();
  for (const std::uint32_t frame : there.frames) {
    if (frame >= all.film_frames) break;
    kept.frames.push_back(frame);
    const bool changed = std::ranges::binary_search(edit.frames, frame);
    kept.pixel_hashes.push_back(changed ? "" : sinks::hash_of(there, frame));
  }
  sinks::add_frames(all, kept);
}

std::string edit_text(const sinks::Manifest& there, const Edit& edit, const film::CompiledFilm& now,
                      const std::string& what) {
  const wire::PackedFilm view = now.view();
  Numbers again;
  std::ranges::copy_if(edit.frames, std::back_inserter(again),
                       [&](std::uint32_t frame) { return !sinks::hash_of(there, frame).empty(); });
  std::string text = what + ": ";
  if (again.empty()) {
    text += "all frames that are there stay";
  } else {
    text += list_text(again, "frame") + (again.size() == 1 ? " is" : " are") + " to be rendered again (" +
            list_text(intervals_of(again, view), "interval") + " of " + std::to_string(view.intervals().size()) + ")";
  }
  const std::uint32_t frames = view.settings().frames;
  if (!there.frames.empty() && there.frames.back() >= frames)
    text += "; the film ends before frame " + std::to_string(frames) + " now, files of later frames stay";
  return text;
}

std::string unlisted_text(const sinks::Manifest& there, const sinks::Manifest& now) {
  Numbers gone;
  std::ranges::set_difference(there.frames, now.frames, std::back_inserter(gone));
  if (gone.empty()) return "";
  return "frames.json lists no more " + list_text(gone, "frame") + " of " + sinks::film_text(there) +
         ", whose files stay";
}

}  // namespace mars::resume
