// Which files were read, and their state at that time, so that a viewer can detect when to read them again.
// Films name models, and models other models: only their readers know all the names.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>

namespace mars::document {

// A file as it stands: writing, replacing or removing it, or changing its permissions, changes its stamp.
struct FileStamp {
  bool exists = false;  // and can be reached
  dev_t device = 0;
  ino_t inode = 0;
  mode_t mode = 0;
  off_t size = 0;
  std::int64_t written = 0, changed = 0;  // nanoseconds

  bool operator==(const FileStamp&) const = default;
};

FileStamp stamp_of(const std::filesystem::path& path);

using FileStamps = std::map<std::filesystem::path, FileStamp>;

// While it lives, records what this thread reads through file.h, also in vain; others that live longer record it, too.
class RecordedReads {
 public:
  RecordedReads() : outer_(innermost_) { innermost_ = this; }
  ~RecordedReads() { innermost_ = outer_; }
  RecordedReads(const RecordedReads&) = delete;
  RecordedReads& operator=(const RecordedReads&) = delete;

  // As they stood before they were read for the first time.
  const FileStamps& stamps() const { return stamps_; }

  // Throws Failure where `output` is one of the files that were read: writing it would destroy what it is made of.
  void refuse_output(const std::filesystem::path& output) const;

  // For readers, before they look at a file.
  static void record(const std::filesystem::path& path);

 private:
  friend class UnrecordedReads;
  static thread_local RecordedReads* innermost_;

  RecordedReads* outer_;
  FileStamps stamps_;
};

// While it lives, nobody records what this thread reads.
class UnrecordedReads {
 public:
  UnrecordedReads() : outer_(RecordedReads::innermost_) { RecordedReads::innermost_ = nullptr; }
  ~UnrecordedReads() { RecordedReads::innermost_ = outer_; }
  UnrecordedReads(const UnrecordedReads&) = delete;
  UnrecordedReads& operator=(const UnrecordedReads&) = delete;

 private:
  RecordedReads* outer_;
};

}  // namespace mars::document
