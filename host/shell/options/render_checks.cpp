#include "host/shell/options/render_checks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/images/exr_file.h"

namespace mars::options {
namespace {

bool ends_in(const std::filesystem::path& name, std::span<const std::string_view> endings) {
  std::string ending = name.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(endings, ending) != endings.end();
}

// A person who names a video or a picture expects that file, and would find a folder of this name.
void refuse_name_of_file(const RenderOptions& options) {
  constexpr auto kVideos = std::to_array<std::string_view>({".avi", ".mpg", ".mpeg", ".wmv", ".flv", ".ogv"});
  constexpr auto kPictures = std::to_array<std::string_view>(
      {".png", ".exr", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".ppm", ".tga", ".webp"});
  const std::filesystem::path name = options.folder;
  const bool video = ends_in(name, kVideos);
  if ((!video && !ends_in(name, kPictures)) || std::filesystem::is_directory(name)) return;
  const std::string folder = std::filesystem::path(name).replace_extension().string();
  const std::string remedy =
      "give -o " + document::shell_word(folder) + (name.extension() == ".exr" ? " --format exr" : "");
  throw Failure(document::in_quotes(options.folder) + " would be a folder: frames are files of their own", "",
                video ? "videos are " + videos::endings_text() : remedy);
}

// Options of files' names, and of which files are kept, mean nothing where there are none. -o is refused by mars alone,
// where a person gives it.
void refuse_words_of_no_files(const RenderOptions& options, Program program) {
  if (options.sink == SinkKind::files) return;
  const bool has_folder = program == Program::mars && !options.folder.empty() && !options.own_folder;
  const char* word = !options.name.empty()       ? "--name"
                     : options.first_number != 0 ? "--first-number"
                     : options.overwrite         ? "--overwrite"
                     : has_folder                ? "-o"
                                                 : nullptr;
  if (word != nullptr)
    throw Failure(std::string(word) + " is about files, of which --sink none writes none", "",
                  "leave out " + std::string(word) + ", or --sink none");
}

bool is_watched(const RenderOptions& options) { return options.window || !options.watch.empty(); }

void check_writing_nodes(const RenderOptions& options) {
  constexpr const char* kRemedy = "leave out --write nodes";
  const bool simulated = options.backend == Backend::simulated, files = options.sink == SinkKind::files;
  if (simulated && files)
    throw Failure("simulated nodes write no files", "", "use --sink none, which counts what files take");
  if (!simulated && !files) throw Failure("with --sink none there are no files to write", "", kRemedy);
  if (is_watched(options))
    throw Failure("frames that nodes write cannot be watched: the host has no pixels", "", "use --write host");
}

void check_videos(const RenderOptions& options) {
  if (options.sink == SinkKind::none || options.backend == Backend::simulated)
    throw Failure("a video needs frames, of which " +
                      std::string(options.sink == SinkKind::none ? "--sink none" : "--backend simulated") +
                      " writes none",
                  "", "leave it out, or -o " + options.videos.front());
  for (const std::string& video : options.videos) videos::form_of(video, options.video_form);
}

void refuse_forms_of_no_video(const RenderOptions& options) {
  if (options.video_form == videos::FormWish()) return;
  throw Failure("there is no video that " + std::string(options.video_form.codec.empty() ? "--quality" : "--codec") +
                    " could be of",
                "", "name one, as -o film.mp4, or leave it out");
}

// The later of two things that are written to one file would replace the other.
void refuse_same_outputs(const RenderOptions& options) {
  std::vector<std::string> files = options.videos;
  for (const std::string& file : {options.report, options.trace})
    if (!file.empty()) files.push_back(file);
  std::set<std::filesystem::path> places;
  for (const std::string& file : files) {
    if (!places.insert(document::place_of_file(file)).second)
      throw Failure("is named for two things that are written", file, "give each a file of its own");
    for (const std::string& read : {options.hostfile, options.platform, options.view.config})
      if (!read.empty()) document::refuse_same_file(read, file);
  }
}

void check_view(const RenderOptions& options) {
  const images::ViewWish& view = options.view;
  if (view.config.empty() && view != images::ViewWish())
    throw Failure("a view is one of an OpenColorIO config", "", "add --ocio CONFIG");
  if (view.config.empty()) return;
  if (options.format == images::PictureFormat::exr)
    throw Failure("EXR files hold light, which no view changes", "", "leave out --ocio, or --format exr");
  if (options.write == WriteWhere::nodes)
    throw Failure("nodes that write files have no OpenColorIO config", "", "use --write host, or leave out --ocio");
  if (is_watched(options))
    throw Failure("a rendering that is watched has no view of OpenColorIO", "",
                  "leave out --window, --watch, or --ocio");
  if (options.backend == Backend::simulated)
    throw Failure("simulated nodes draw nothing that a view could show", "", "leave out --ocio");
}

// PXR24 rounds floats to 24 bits.
void check_layers(const RenderOptions& options) {
  constexpr wire::LayerSet kFloats =
      wire::set_of(wire::Layer::depth) | wire::set_of(wire::Layer::motion) | wire::set_of(wire::Layer::surfaces);
  if (options.layers.kinds == 0) return;
  if (options.format != images::PictureFormat::exr)
    throw Failure("PNG files have no layers", "", "leave out --layers, or add --format exr");
  if (options.compression == images::Compression::pxr24 && (options.layers.kinds & kFloats) != 0)
    throw Failure("the compression pxr24 changes depth, motion and ids", "", "choose another, as --compression zip");
  if (options.faces && (options.layers.kinds & wire::set_of(wire::Layer::motion)) != 0)
    throw Failure("faces of a panorama show no motion: the frame before a face's first is another face's", "",
                  "name other layers: --layers depth,normal,unshadowed,ids");
}

}  // namespace

void check_compression(const RenderOptions& options, bool is_given) {
  if (is_given && options.format != images::PictureFormat::exr)
    throw Failure("PNG files have one compression", "", "leave out --compression, or add --format exr");
}

void check_pictures(const RenderOptions& options) {
  if (options.format == images::PictureFormat::exr) images::check_exr_is_built();
  check_view(options);
  check_layers(options);
}

void check_together(const RenderOptions& options, Program program) {
  if (options.serve.empty() == options.film.empty() && program != Program::repair && program != Program::studio) {
    if (options.film.empty()) throw Failure("FILM is required", "", "");
    throw Failure("a studio brings its own film", "", "leave out " + options.film + ", or --serve");
  }
  if (!options.serve.empty()) return;
  if (options.folder.empty() && options.sink == SinkKind::files && program != Program::studio) {
    const bool measures = program != Program::submit;
    throw Failure("no folder to put the frames in", "",
                  measures ? "add -o DIR, or --sink none to measure only" : "add -o DIR");
  }
  refuse_name_of_file(options);
  refuse_words_of_no_files(options, program);
  options.videos.empty() ? refuse_forms_of_no_video(options) : check_videos(options);
  refuse_same_outputs(options);
  if (options.backend == Backend::simulated && program == Program::studio)
    throw Failure("simulated nodes draw nothing that can be seen", "", "leave out --backend simulated");
  if (!options.hostfile.empty() && options.backend == Backend::threads) {
    throw Failure("threads are all on this machine", "", "leave out --hostfile, or --backend threads");
  }
  if (!options.hostfile.empty() && options.backend == Backend::simulated) {
    throw Failure("simulated nodes are on the machines of --platform", "",
                  "leave out --hostfile, or --backend simulated");
  }
  if (is_watched(options) && options.backend == Backend::simulated) {
    throw Failure("the time of simulated nodes is not that of who watches", "",
                  options.window ? "leave out --window" : "leave out --watch");
  }
  if (options.window && !options.watch.empty())
    throw Failure("one program can watch a rendering", "", "leave out --window, or --watch");
  if (options.write == WriteWhere::nodes && program != Program::plan) check_writing_nodes(options);
  if (!options.platform.empty() && options.backend != Backend::simulated) {
    throw Failure("a platform is for simulated nodes", "", "add --backend simulated, or leave out --platform");
  }
}

}  // namespace mars::options
