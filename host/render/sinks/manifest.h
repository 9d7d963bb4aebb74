// What a folder of frames says of itself, in its file frames.json: which frames of which film belong there, and the
// hash of each one's pixels (docs/frame-folders.md).
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/images/frame_form.h"
#include "host/images/picture_bands.h"
#include "host/images/picture_format.h"
#include "host/images/picture_place.h"
#include "host/render/sinks/usage.h"
#include "node/wire/pixel_version.h"

namespace mars::sinks {

class Record;

// Of the file. 1, which files without the key have: they have no key but those known then. 2: with a sum over all other
// keys, and a pixel version. 3: frames may have hashes of bands (pixel_hash.h). 4, written only where it is needed:
// files may have other names, or another compression. 5, where that is needed: files may have a part of the picture,
// pixels that are not square, a view of OpenColorIO, or layers.
inline constexpr std::uint32_t kManifestVersion = 5;

// A file that was read to compile a film.
struct Source {
  std::string path;      // absolute
  std::string checksum;  // of its content: 32 hexadecimal digits; "" where there was no such file

  bool operator==(const Source&) const = default;
};

struct Manifest {
  std::string film;      // its file's name, as the person gave it
  std::string checksum;  // of the compiled film: 32 hexadecimal digits (checksum.h)
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  images::PictureFormat format = images::PictureFormat::png;
  double rate = 0;                    // frames a second
  std::uint32_t film_frames = 0;      // of the whole film
  std::vector<std::uint32_t> frames;  // asked for, by one run or several, ascending
  // Of each of `frames`, "" where it is not known to have been rendered; none at all: nobody has recorded any.
  std::vector<std::string> pixel_hashes;
  // What the film was compiled from, the film's own file first; none: that is not known.
  std::vector<Source> sources;
  std::vector<std::string> options;  // with which it was compiled, as on a command line: "--size", "640x360"
  std::uint32_t pixel_version = wire::kPixelVersion;  // of the program that rendered the frames
  images::FrameNames names = {};
  images::Compression compression = images::Compression::zip;
  images::PicturePlace place = {};  // of width x height
  images::ViewName view = {};
  wire::LayerSet layers = 0;  // of EXR files
  Usage usage = {};           // of all runs that have ended
  std::string more = {};      // keys that this program does not know, as the text of an object; "": none

  bool operator==(const Manifest&) const = default;
};

// Whether both are of the same compiled film, in the same form and of the same pixel version: then their frames are
// those of one folder.
bool are_of_one_folder(const Manifest& a, const Manifest& b);

// Adds the frames of another manifest of the same folder, with the hashes it has. Frames of a manifest without hashes
// have unknown ones from then on.
void add_frames(Manifest& manifest, const Manifest& more);

// Where the frame is one of the manifest's, which has as many hashes as frames.
void set_hash(Manifest& manifest, std::uint32_t frame, const std::string& hash);

// The hash of one of the manifest's frames; "" where it has none, or is none of them.
std::string hash_of(const Manifest& manifest, std::uint32_t frame);

// The film's name on one line of a terminal, also where another program wrote it; of a long path the end, which says
// more.
std::string film_text(const Manifest& manifest);

// Of a version that this program does not know: nothing is wrong with it.
class LaterManifest : public Failure {
 public:
  using Failure::Failure;
};

nlohmann::json to_json(const Manifest& manifest);
// The checksum of all other keys, which a manifest has as "sum": a changed bit may leave a text that can be read. The
// same for the same values, whatever stands between them.
std::string sum_of(nlohmann::json manifest);
// Throws LaterManifest; and Failure, without a place, where it is none, has keys of another kind, or another sum.
Manifest manifest_of(const nlohmann::json& from);

using images::FrameForm;
FrameForm form_of(const Manifest& manifest);
void set_form(Manifest& manifest, const FrameForm& form);
images::PictureBands bands_of(const Manifest& manifest);
// As options of mars render: "--format", "exr"; none for what is as by default.
std::vector<std::string> words_of(const FrameForm& form);

// As keys of a manifest and of what a frame's file says; those that are as by default are left out, but for the format.
void add_form(const FrameForm& form, nlohmann::json& text);
// The format is PNG where there is none, as of frames that were rendered before there were others.
FrameForm form_of(const Record& record);
// The keys window and pixel_aspect, where they are not as by default.
void add_place(const images::PicturePlace& place, nlohmann::json& text);
images::PicturePlace place_of(const Record& record);

std::string frame_file_name(const Manifest& manifest, std::uint32_t frame);
// Whose file has this name; none where no frame's has.
std::optional<std::uint32_t> frame_of_file(const Manifest& manifest, const std::string& name);

}  // namespace mars::sinks
