#include "host/content/importer/import_file.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/document/document.h"
#include "host/content/document/json_file.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/content/importer/apart.h"
#include "host/content/importer/file_kind.h"
#include "host/content/importer/gltf/gltf_json.h"
#include "host/content/importer/image_writer.h"
#include "host/content/importer/import_gltf_film.h"
#include "host/content/importer/import_mesh.h"
#include "host/content/importer/import_motion.h"
#include "host/content/importer/import_report.h"
#include "host/content/importer/import_patches.h"
#include "host/content/importer/joint_names.h"
#include "host/content/importer/orientation.h"
#include "host/content/modeler/read_model.h"

namespace mars::importer {
namespace {

// y up is glTF's rule, into which FBX and COLLADA are turned, and the custom of OBJ, POV-Ray, RIB and motions.
std::string usual_up(FileKind kind) {
  return kind == FileKind::obj || kind == FileKind::pov || kind == FileKind::rib || has_nodes(kind) || is_skeleton(kind)
             ? "y"
             : "z";
}

// Captured figures look along z.
std::string usual_front(FileKind kind, const std::string& up) {
  return is_skeleton(kind) && up.back() != 'z' ? "z" : "";
}

// A library does not come back from every damaged file.
std::string read_apart(const std::filesystem::path& path, const std::vector<std::filesystem::path>& more, FileKind kind,
                       const std::function<std::vector<std::string>()>& read) {
  constexpr const char* kRemedy = "the file may be damaged: export it again";
  std::error_code error;
  std::uint64_t bytes = std::filesystem::file_size(path, error);
  if (error) bytes = 0;
  for (const std::filesystem::path& each : more)
    if (const std::uintmax_t size = std::filesystem::file_size(each, error); !error) bytes += size;
  if (is_gltf(kind))
    bytes += std::stoull(run_apart([&] { return std::vector{std::to_string(bytes_of_buffers(path))}; },
                                   limits_for(bytes), path.string(), kRemedy));
  return run_apart(read, limits_for(bytes), path.string(), kRemedy);
}

// What files of this kind become without --as.
ImportAs usual_form(FileKind kind) {
  return kind == FileKind::bvh || kind == FileKind::amc ? ImportAs::film : ImportAs::model;
}

void erase_images(document::Json& owner) {
  if (const auto materials = owner.find("materials"); materials != owner.end())
    for (document::Json& material : *materials) material.erase("images");
  if (const auto models = owner.find("models"); models != owner.end())
    for (document::Json& model : *models) erase_images(model);
}

// Images are written after the check, beside the model.
std::string without_images(const std::string& text) {
  document::Json json = document::Json::parse(text, nullptr, false);
  if (json.is_discarded()) return text;
  erase_images(json);
  return json.dump();
}

// Of strange files, films and models may be beyond what MARS takes. Large meshes stand in brief.
void check_text(const document::LongText& text, const ImportOptions& options) {
  const std::string file = options.from.string();
  const bool is_film = options.as == ImportAs::film;
  try {
    const document::Document document(without_images(document::brief_of(text)), file);
    if (is_film)
      animator::read_film(document.root(), options.to.parent_path());
    else
      modeler::read_model(document.root());
  } catch (const Failure& failure) {
    const std::size_t element = failure.where.find(": ", std::min(file.size(), failure.where.size()));
    throw Failure(std::string("makes a ") + (is_film ? "film" : "model") + " that MARS refuses: " +
                      (element == std::string::npos ? "" : failure.where.substr(element + 2) + " ") + failure.problem,
                  file, failure.remedy + "; --scale makes it larger or smaller");
  }
}

// The report, images, the model or film, as read_answer() takes them apart.
std::vector<std::string> run(const ImportOptions& options, FileKind kind, const Stance& stance) {
  const bool film = options.as == ImportAs::film;
  ImportedText imported = is_skeleton(kind)  ? import_motion(options, kind, stance.up, stance.upright)
                          : is_patches(kind) ? import_patches(options, kind, stance)
                          : film             ? import_gltf_film(options, kind, stance)
                                             : import_mesh(options, kind, stance);
  check_text(imported.text, options);
  std::vector<std::string> parts{text_of(imported.report, options.to.string()) + '\0'};
  for (KeptImage& image : imported.images) {
    parts.push_back(image.file + '\0' + image.from.string() + '\0' + std::to_string(image.bytes.size()) + '\0');
    parts.push_back(std::move(image.bytes));
  }
  parts.emplace_back(1, '\0');
  for (document::TextPart& part : imported.text) parts.push_back(std::move(part.text));
  return parts;
}

std::string_view take_until_zero(std::string_view& text) {
  const std::string_view part = text.substr(0, text.find('\0'));
  text.remove_prefix(part.size() + 1);
  return part;
}

struct Answer {
  std::string_view report;
  std::vector<ImageToWrite> images;
  std::string_view text;
};

Answer read_answer(std::string_view answer) {
  Answer read{take_until_zero(answer), {}, {}};
  for (std::string_view file = take_until_zero(answer); !file.empty(); file = take_until_zero(answer)) {
    const std::filesystem::path from = take_until_zero(answer);
    const std::size_t size = std::stoull(std::string(take_until_zero(answer)));
    read.images.push_back({file, answer.substr(0, size), from});
    answer.remove_prefix(size);
  }
  read.text = answer;
  return read;
}

// `given` is the name that a person gave; "": the joint is named as the file.
void check_joint(const std::string& joint, const std::string& given, const std::filesystem::path& from) {
  const bool plain = !joint.empty() && joint.size() <= kLongestJointName && joint.find('/') == std::string::npos &&
                     std::none_of(joint.begin(), joint.end(), [](unsigned char c) { return std::iscntrl(c); }) &&
                     document::in_utf8(joint) == joint;
  if (plain) return;
  const std::string name = "'" + document::printable(joint) + "'";
  constexpr const char* kNames = "of 1 to 90 bytes of UTF-8, without '/' and control characters";
  if (given.empty())
    throw Failure("its name, " + name + ", cannot name a joint", document::printable(from.string()),
                  std::string("give the joint a name with --joint: one ") + kNames);
  throw Failure("cannot name a joint", "--joint " + name, std::string("choose a name ") + kNames);
}

void check_target(const ImportOptions& options) {
  document::refuse_same_file(options.from, options.to);
  for (const std::filesystem::path& more : options.more) document::refuse_same_file(more, options.to);
  if (!options.skeleton.empty()) document::refuse_same_file(options.skeleton, options.to);
  if (known_kind(options.to))
    throw Failure("has the ending of another program's file", options.to.string(),
                  "end its name in .json: MARS writes models and films as JSON");
  std::error_code none;
  if (!options.force && std::filesystem::exists(options.to, none))
    throw Failure("is there already", options.to.string(), "choose another name, or replace it with --force");
  document::check_can_write(options.to);
}

// Options that a kind of file cannot follow.
void check_options(const ImportOptions& options, FileKind kind) {
  const auto refuse = [&](const char* option, const char* remedy) {
    throw Failure(std::string("cannot be imported with ") + option, options.from.string(), remedy);
  };
  if (is_skeleton(kind) && options.crease) refuse("--crease", "leave it out: it is for meshes");
  if (kind != FileKind::amc && !options.skeleton.empty()) refuse("--skeleton", "leave it out: it is for AMC files");
  if (kind != FileKind::amc && !options.more.empty())
    refuse("further files", "import each file by itself: only AMC files can follow each other");
  for (const std::filesystem::path& more : options.more)
    if (kind_of_name(more) != FileKind::amc)
      throw Failure("is no AMC file, and only such can follow another", more.string(), "import it by itself");
  const bool film = options.as == ImportAs::film;
  if (film && !is_skeleton(kind) && !has_nodes(kind))
    refuse("--as film", "import it as a model, and show that in a film: mars film FILM add");
  if (film && kind == FileKind::asf) refuse("--as film", "import its motion, an .amc file");
  if (options.file_rate && !is_skeleton(kind)) refuse("--file-rate", "leave it out: it is for captured motions");
  if (options.rate && !is_skeleton(kind) && !(film && has_nodes(kind)))
    refuse("--rate", has_nodes(kind) ? "add --as film, or leave it out" : "leave it out: it is for motions");
  if ((!options.animation.empty() || options.motion) && !(film && has_nodes(kind)))
    refuse("--animation or --motion",
           has_nodes(kind) ? "add --as film, or leave it out" : "leave it out: it is for scenes");
}

}  // namespace

std::string import_model(const ImportOptions& given) {
  ImportOptions options = given;
  const FileKind kind = kind_of_name(options.from);
  if (options.joint.empty()) options.joint = options.from.stem().string();
  check_joint(options.joint, given.joint, given.from);
  if (!options.as) options.as = usual_form(kind);
  check_first_bytes(options.from, kind);
  check_options(options, kind);
  check_target(options);
  const std::string up = options.up.empty() ? usual_up(kind) : options.up;
  const Stance stance{up, orientation(up, options.front.empty() ? usual_front(kind, up) : options.front)};
  const std::string answer = read_apart(options.from, options.more, kind, [&] { return run(options, kind, stance); });
  const Answer read = read_answer(answer);
  ImageWriter images(options.to, options.force);
  for (const ImageToWrite& image : read.images) images.write(image);
  document::write_whole_file(options.to, read.text);
  images.keep();
  return std::string(read.report);
}

}  // namespace mars::importer
