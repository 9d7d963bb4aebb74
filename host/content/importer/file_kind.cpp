#include "host/content/importer/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "hal/failure/failure.h"

namespace mars::importer {
namespace {

struct Known {
  std::string_view ending;
  FileKind kind;
};

constexpr Known kKnown[] = {{".obj", FileKind::obj},   {".stl", FileKind::stl},     {".ply", FileKind::ply},
                            {".gltf", FileKind::gltf}, {".glb", FileKind::glb},     {".vrm", FileKind::glb},
                            {".fbx", FileKind::fbx},   {".dae", FileKind::collada}, {".bpt", FileKind::patches},
                            {".pov", FileKind::pov},   {".rib", FileKind::rib},     {".bvh", FileKind::bvh},
                            {".asf", FileKind::asf},   {".amc", FileKind::amc}};

constexpr const char* kReadable =
    "mesh files end in .obj, .stl, .ply, .gltf, .glb, .vrm, .fbx or .dae, patch files in .bpt, .pov or .rib, "
    "motions in .bvh or .amc, skeletons in .asf";

struct Foreign {
  std::string_view ending;
  const char* what;
  const char* remedy;
};

constexpr const char* kByBlender = "open it in Blender and export glTF";
constexpr Foreign kForeign[] = {
    {".blend", "a Blender scene", kByBlender}, {".3ds", "a 3D Studio scene", kByBlender},
    {".usd", "a USD scene", kByBlender},       {".usda", "a USD scene", kByBlender},
    {".usdc", "a USD scene", kByBlender},      {".usdz", "a USD scene", kByBlender},
};

struct Beginning {
  std::string_view bytes;
  FileKind kind;
  const char* what;
};

// Only kinds that say what they are: an OBJ may begin with any word, a binary STL with any byte.
constexpr Beginning kBeginnings[] = {
    {"glTF", FileKind::glb, "GLB"}, {"ply\n", FileKind::ply, "PLY"}, {"ply\r", FileKind::ply, "PLY"}};

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

std::string_view ending_for(FileKind kind) {
  return std::find_if(std::begin(kKnown), std::end(kKnown), [&](const Known& known) { return known.kind == kind; })
      ->ending;
}

}  // namespace

bool same_ending(const std::filesystem::path& path, std::string_view ending) { return ending_of(path) == ending; }

std::optional<FileKind> known_kind(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  for (const Known& known : kKnown)
    if (known.ending == ending) return known.kind;
  return std::nullopt;
}

FileKind kind_of_name(const std::filesystem::path& path) {
  if (const auto kind = known_kind(path)) return *kind;
  const std::string ending = ending_of(path);
  for (const Foreign& foreign : kForeign)
    if (foreign.ending == ending)
      throw Failure(std::string("is ") + foreign.what + ", which cannot be imported", path.string(), foreign.remedy);
  throw Failure(ending.empty() ? "has no ending that says what it is" : "has an ending that is not known, " + ending,
                path.string(), kReadable);
}

void check_first_bytes(const std::filesystem::path& path, FileKind kind) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return;  // a pipe would wait; its reader refuses it
  if (std::filesystem::file_size(path, none) == 0) throw Failure("is empty", path.string(), "export it again");
  std::array<char, 4> first{};
  std::ifstream(path, std::ios::binary).read(first.data(), first.size());
  const std::string_view begins(first.data(), first.size());
  for (const Beginning& other : kBeginnings)
    if (begins == other.bytes && kind != other.kind)
      throw Failure(std::string("is ") + other.what + ", though its name does not say so", path.string(),
                    "let its name end in " + std::string(ending_for(other.kind)));
  if (kind == FileKind::glb && begins[0] == '{')
    throw Failure("is glTF in text, though its name does not say so", path.string(), "let its name end in .gltf");
}

}  // namespace mars::importer
