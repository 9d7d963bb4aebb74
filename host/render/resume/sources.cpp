#include "host/render/resume/sources.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"

namespace mars::resume {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;  // of paths and checksums: a manifest has room for them

// "" where there is no such file.
std::string checksum_of_file(const std::string& path) {
  const std::optional<std::string> content = document::read_file_if_there(path, document::kLargestFileRead);
  return content ? document::checksum_of(std::as_bytes(std::span(*content))) : "";
}

}  // namespace

std::string source_path(const std::string& file) { return std::filesystem::absolute(file).lexically_normal(); }

std::vector<sinks::Source> sources_of(const std::string& film, const document::FileStamps& reads) {
  std::vector<sinks::Source> sources{{source_path(film), ""}};
  std::size_t bytes = 0;
  try {
    for (const auto& [path, stamp] : reads) {
      sinks::Source source{source_path(path), checksum_of_file(path)};
      bytes += source.path.size() + source.checksum.size();
      if (document::stamp_of(path) != stamp || bytes > kMostBytes) return {};
      if (source.path == sources.front().path)
        sources.front() = std::move(source);
      else
        sources.push_back(std::move(source));
    }
  } catch (const Failure&) {  // what is read in vain, such as a folder
    return {};
  }
  return sources;
}

bool are_unchanged(const std::vector<sinks::Source>& sources) try {
  return !sources.empty() && std::ranges::all_of(sources, [](const sinks::Source& source) {
    return checksum_of_file(source.path) == source.checksum;
  });
} catch (const Failure&) {
  return false;
}

}  // namespace mars::resume
