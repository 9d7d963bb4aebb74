#include "host/preview/watched_files.h"

#include <utility>

namespace mars::preview {

void WatchedFiles::set_read(document::FileStamps read) {
  read_ = std::move(read);
  last_look_ = read_;
}

document::FileStamps WatchedFiles::stamps_now() const {
  document::FileStamps stamps;
  for (const auto& [path, stamp] : read_) stamps.emplace(path, document::stamp_of(path));
  return stamps;
}

bool WatchedFiles::changed_and_settled() {
  const document::FileStamps before = std::exchange(last_look_, stamps_now());
  return last_look_ == before && last_look_ != read_;
}

}  // namespace mars::preview
