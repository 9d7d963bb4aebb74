#include "host/studio/importing/companions.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/file_kind.h"
#include "host/content/importer/gltf/gltf_json.h"
#include "host/content/importer/sources/companion.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;
using importer::FileKind;
using importer::Tree;

constexpr std::uintmax_t kLongestLookedAt = 1 << 20;  // bytes
constexpr const char* kAnySkeleton = "*.asf";

std::string start_of(const fs::path& file) {
  std::error_code problem;
  const std::uintmax_t size = fs::file_size(file, problem);
  return problem || size > kLongestLookedAt ? "" : document::read_start(file, kLongestLookedAt);
}

void add_uri(const Tree& named, const std::string& of, bool needed, std::vector<Companion>& companions) {
  const Tree& uri = importer::at(named, "uri");
  if (!uri.is_string()) return;
  const std::string name = uri.get<std::string>();
  if (!name.starts_with("data:")) companions.push_back({importer::percent_decoded(name), of, needed});
}

void add_of_gltf(const Tree& gltf, const std::string& of, std::vector<Companion>& companions) {
  const Tree &buffers = importer::at(gltf, "buffers"), &materials = importer::at(gltf, "materials");
  for (const Tree& buffer : buffers) add_uri(buffer, of, true, companions);
  for (const Tree& material : materials) {
    const Tree& color = importer::at(importer::at(material, "pbrMetallicRoughness"), "baseColorTexture");
    const Tree& texture = importer::item(importer::at(gltf, "textures"), importer::at(color, "index"));
    add_uri(importer::item(importer::at(gltf, "images"), importer::at(texture, "source")), of, false, companions);
  }
}

void add_of_obj(std::string_view text, const std::string& of, std::vector<Companion>& companions) {
  constexpr std::string_view kWord = "mtllib ";
  for (std::size_t at = text.find(kWord); at != text.npos; at = text.find(kWord, at + 1)) {
    if (at > 0 && text[at - 1] != '\n') continue;
    std::string_view name = text.substr(at + kWord.size());
    name = name.substr(0, name.find_first_of("\r\n"));
    name = name.substr(0, name.find_last_not_of(" \t") + 1);
    companions.push_back({std::string(name), of, false});
  }
}

// In the folder of the file that names them.
std::vector<Companion> companions_of(const UploadFolder& folder, const std::string& file) {
  std::vector<Companion> companions;
  switch (importer::kind_of_name(file)) {
    case FileKind::gltf: add_of_gltf(importer::gltf_json(start_of(folder.uploaded(file))), file, companions); break;
    case FileKind::obj: add_of_obj(start_of(folder.uploaded(file)), file, companions); break;
    case FileKind::amc: companions.push_back({kAnySkeleton, file, true}); break;
    default: break;
  }
  return companions;
}

bool fits(const fs::path& file, const fs::path& wanted) {
  return wanted.filename() == kAnySkeleton ? importer::same_ending(file, ".asf") : file.filename() == wanted.filename();
}

// Whether it is there, or can be put there.
bool is_there(const UploadFolder& folder, const ImportRequest& request, const fs::path& wanted) {
  std::error_code problem;
  if (fs::exists(folder.uploaded(wanted.string()), problem)) return true;
  for (const ImportedFile& each : request.files) {
    if (!fits(each.name, wanted)) continue;
    const fs::path to = folder.uploaded((wanted.parent_path() / fs::path(each.name).filename()).string());
    if (fs::exists(to, problem)) return true;
    fs::create_directories(to.parent_path(), problem);
    fs::create_hard_link(folder.uploaded(each.name), to, problem);
    if (!problem) return true;
  }
  return false;
}

}  // namespace

std::vector<Companion> missing_companions(const UploadFolder& folder, const ImportRequest& request,
                                          const std::vector<ImportJob>& jobs) {
  std::vector<Companion> missing;
  for (const ImportJob& job : jobs)
    for (Companion& each : companions_of(folder, job.main)) {
      const fs::path wanted = fs::path(job.main).parent_path() / each.name;
      const bool is_known = std::ranges::find(missing, wanted.string(), &Companion::name) != missing.end();
      if (!importer::stays_inside(each.name) || is_known || is_there(folder, request, wanted)) continue;
      if (missing.size() == kMostImportedFiles)
        throw Failure("names over " + std::to_string(kMostImportedFiles) + " files that did not come",
                      document::printable(job.main), "import them together, in one folder");
      each.name = wanted.string();
      missing.push_back(std::move(each));
    }
  return missing;
}

std::string names_of(const std::vector<Companion>& companions) {
  std::string names;
  for (std::size_t i = 0; i < companions.size(); ++i) {
    if (i > 0) names += i + 1 == companions.size() ? " and " : ", ";
    const fs::path name = companions[i].name;
    names += name.filename() == kAnySkeleton ? "a skeleton (.asf)" : document::printable(name.string());
  }
  return names;
}

}  // namespace mars::studio
