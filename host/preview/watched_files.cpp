#include "host/preview/watched_files.h"

#include <utility>

namespace mars::host {

void WatchedFiles::set_read(FileStamps read) {
  read_ = std::move(read);
  last_look_ = read_;
}

FileStamps WatchedFiles::stamps_now() const {
  FileStamps stamps;
  for (const auto& [path, stamp] : read_) stamps.emplace(path, stamp_of(path));
  return stamps;
}

bool WatchedFiles::changed_and_settled() {
  const FileStamps before = std::exchange(last_look_, stamps_now());
  return last_look_ == before && last_look_ != read_;
}

}  // namespace mars::host
