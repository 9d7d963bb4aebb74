// Whether files differ from those that were read. Polled: inotify does not report what other machines write to a shared
// file system, and a look at a dozen files costs some microseconds.
#pragma once

#include "host/content/document/recorded_reads.h"

namespace mars::preview {

class WatchedFiles {
 public:
  explicit WatchedFiles(document::FileStamps read) { set_read(std::move(read)); }

  // The files were read again; those that are no longer among them are not looked at any more.
  void set_read(document::FileStamps read);

  // Looks at them. True if they are others than those that were read, and the same as at the last look: editors that
  // empty a file and then fill it, or remove it and then make it, must have time to do so.
  bool changed_and_settled();

  // Whether they are still those that were read.
  bool are_as_read() const { return stamps_now() == read_; }

 private:
  document::FileStamps stamps_now() const;

  document::FileStamps read_, last_look_;
};

}  // namespace mars::preview
