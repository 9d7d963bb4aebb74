#include "host/content/document/recorded_reads.h"

#include <sys/stat.h>

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
  if (innermost_ != nullptr && !innermost_->stamps_.contains(path)) innermost_->stamps_.emplace(path, stamp_of(path));
}

}  // namespace mars::document
