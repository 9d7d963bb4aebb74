#include "host/content/importer/texture_means.h"

#include <cstring>
#include <span>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/apart.h"

namespace mars::importer {
namespace {

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
  const auto found = textures_.find(texture);
  if (!found) {
    if (!texture.starts_with('*'))
      not_read_.push_back("texture " + document::printable(texture) + " (no such file beside the mesh)");
    return std::nullopt;
  }
  if (found->from.empty()) return mean_of_bytes(found->bytes, found->name);
  companions_.push_back(found->from);
  return mean_of_bytes(document::read_file(found->from, kLargestPicture), found->name);
}

std::optional<images::PictureMean> TextureMeans::mean_of_bytes(std::string_view bytes, const std::string& name) {
  const auto work = [&] {
    const auto mean = images::picture_mean(std::as_bytes(std::span(bytes)), name);
    return std::vector{mean ? bytes_of(*mean) : std::string()};
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
