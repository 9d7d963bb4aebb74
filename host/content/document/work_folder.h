// The folder of the files that commands need only while they make a file or folder NAME: NAME.mars-work, beside it. An
// empty file in it, made-by-mars, says that MARS has made the folder; a folder of this name without the file is
// somebody else's, and stays. What is in the folder stays for the same command where a process is killed. Whoever ends
// and finds nothing but the mark in it removes it.
#pragma once

#include <filesystem>
#include <functional>

namespace mars::document {

// Beside `made`; in it where it has no name of its own, as "." and "/".
std::filesystem::path work_folder_of(const std::filesystem::path& made);
// Whether it is there, and MARS has made it.
bool has_work_folder(const std::filesystem::path& made);

class WorkFolder {
 public:
  enum class Use { alone, shared };  // by processes

  // Makes the folder where it is missing. Waits until no other process uses it, or, `shared`, uses it alone, where the
  // file system can lock; `waits` is called before that. Throws Failure where the folder cannot be made, or something
  // that MARS has not made has its name.
  WorkFolder(const std::filesystem::path& made, Use use, const std::function<void()>& waits = {});
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // For another process, which may have made what this one is to make.
  bool waited() const { return waited_; }

 private:
  bool enter(Use use, const std::function<void()>& waits);
  void lock(Use use, const std::function<void()>& waits);
  bool is_named() const;
  void mark() const;

  std::filesystem::path path_;
  int folder_ = -1;  // locked: the end of the process, however it comes, gives the lock back
  bool waited_ = false;
};

}  // namespace mars::document
