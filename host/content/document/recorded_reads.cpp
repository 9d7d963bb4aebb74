#include "host/content/document/recorded_reads.h"

#include <sys/stat.h>

#include "host/content/document/whole_file.h"

namespace mars::document {
namespace {

std::int64_t nanoseconds(const timespec& time) { return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec; }

}  // namespace

thread_local RecordedReads* RecordedReads::innermost_ = nullptr;

FileStamp stamp_of(const std::filesystem::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return {};
  return {true,
          status.st_dev,
          status.st_ino,
          status.st_mode,
          status.st_size,
          nanoseconds(status.st_mtim),
          nanoseconds(status.st_ctim)};
}

void RecordedReads::record(const std::filesystem::path& path) {
  for (RecordedReads* each = innermost_; each != nullptr; each = each->outer_)
    if (!each->stamps_.contains(path)) each->stamps_.emplace(path, stamp_of(path));
}

void RecordedReads::refuse_output(const std::filesystem::path& output) const {
  for (const auto& [path, stamp] : stamps_)
    if (stamp.exists) refuse_same_file(path, output);
}

}  // namespace mars::document
