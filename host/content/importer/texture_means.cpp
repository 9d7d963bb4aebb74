#include "host/content/importer/texture_means.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/apart.h"
#include "host/content/importer/companion.h"
#include "host/content/importer/gltf/gltf_json.h"

namespace mars::importer {
namespace {

constexpr std::uintmax_t kLargestPicture = std::uintmax_t{1} << 28;

std::string bytes_of(const images::PictureMean& mean) { return {reinterpret_cast<const char*>(&mean), sizeof mean}; }

images::PictureMean mean_in(const std::string& bytes) {
  images::PictureMean mean{};
  check(bytes.size() == sizeof mean, "a picture's mean comes whole");
  std::memcpy(&mean, bytes.data(), sizeof mean);
  return mean;
}

}  // namespace

const std::optional<images::PictureMean>& TextureMeans::mean_of(const std::string& texture) {
  const auto known = means_.find(texture);
  return known != means_.end() ? known->second : means_.emplace(texture, read(texture)).first->second;
}

bool TextureMeans::has(const std::string& texture) const {
  const auto known = means_.find(texture);
  return known != means_.end() && known->second.has_value();
}

std::optional<images::PictureMean> TextureMeans::read(const std::string& texture) {
  const auto [picture, number] = scene_.GetEmbeddedTextureAndIndex(texture.c_str());
  if (picture != nullptr && picture->mHeight == 0)
    return mean_of_bytes({reinterpret_cast<const char*>(picture->pcData), picture->mWidth},
                         "picture " + std::to_string(number + 1));
  if (texture.starts_with('*')) return std::nullopt;
  const auto path = file_of(texture);
  if (!path) {
    not_read_.push_back("texture " + document::printable(texture) + " (no such file beside the mesh)");
    return std::nullopt;
  }
  companions_.push_back(*path);
  return mean_of_bytes(document::read_file(*path, kLargestPicture), document::printable(texture));
}

// FBX and COLLADA name files as they were where they were written, such as "C:\\work\\skin.png"; these may lie beside
// the mesh now.
std::optional<std::filesystem::path> TextureMeans::file_of(const std::string& texture) const {
  std::string name = is_gltf(kind_) ? percent_decoded(texture) : texture;
  std::vector<std::filesystem::path> names{name};
  if (has_nodes(kind_) && !is_gltf(kind_)) {
    std::ranges::replace(name, '\\', '/');
    names = {name, std::filesystem::path(name).filename()};
  }
  for (const std::filesystem::path& each : names) {
    std::error_code none;
    const std::filesystem::path path = mesh_.parent_path() / each;
    if (stays_inside(each) && std::filesystem::is_regular_file(path, none)) return path;
  }
  return std::nullopt;
}

std::optional<images::PictureMean> TextureMeans::mean_of_bytes(std::string_view bytes, const std::string& name) {
  const auto work = [&] {
    const auto mean = images::picture_mean(std::as_bytes(std::span(bytes)), name);
    return mean ? bytes_of(*mean) : std::string();
  };
  try {
    const std::string answer = run_apart(work, limits_for(bytes.size()), name, "");
    if (!answer.empty()) return mean_in(answer);
    not_read_.push_back("texture " + name + " (neither PNG nor JPEG)");
  } catch (const Failure& failure) {
    not_read_.push_back("texture " + name + " (" + failure.problem + ")");
  }
  return std::nullopt;
}

}  // namespace mars::importer
