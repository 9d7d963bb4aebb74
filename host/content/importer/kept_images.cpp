#include "host/content/importer/kept_images.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

namespace mars::importer {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kMostOfName = 60;

// ".png" or ".jpg", by the first bytes; "": neither.
std::string_view ending_of(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n"sv) ? ".png" : bytes.starts_with("\xff\xd8\xff"sv) ? ".jpg" : "";
}

std::string first_bytes(const std::filesystem::path& file) {
  std::string bytes(8, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

// A name that any file system takes, without the ending: "Stone wall.png" becomes "Stone-wall".
std::string plain_name(const std::string& name) {
  std::string plain = std::filesystem::path(name).stem().string().substr(0, kMostOfName);
  std::ranges::replace_if(
      plain, [](unsigned char c) { return !(std::isalnum(c) && c < 128) && c != '_' && c != '-'; }, '-');
  const std::size_t first = plain.find_first_not_of('-');
  return first == plain.npos ? "image" : plain.substr(first);
}

}  // namespace

std::optional<std::string> KeptImages::keep(const std::string& texture) {
  const auto known = files_.find(texture);
  return known != files_.end() ? known->second : files_[texture] = read(texture);
}

bool KeptImages::has(const std::string& texture) const {
  const auto known = files_.find(texture);
  return known != files_.end() && known->second.has_value();
}

std::optional<std::string> KeptImages::read(const std::string& texture) {
  const auto found = textures_.find(texture);
  if (!found) return std::nullopt;
  const std::string_view ending = ending_of(found->from.empty() ? found->bytes : first_bytes(found->from));
  if (ending.empty()) return std::nullopt;
  const std::string file = folder_ + "/" + unused_name(plain_name(found->file_name), std::string(ending));
  images_.push_back({file, std::string(found->bytes), found->from});
  return file;
}

// Some file systems take capitals for small letters.
std::string KeptImages::unused_name(const std::string& wanted, const std::string& ending) {
  for (std::size_t number = 1;; ++number) {
    const std::string name = wanted + (number == 1 ? "" : "-" + std::to_string(number)) + ending;
    std::string small = name;
    std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
    if (names_.insert(small).second) return name;
  }
}

}  // namespace mars::importer
