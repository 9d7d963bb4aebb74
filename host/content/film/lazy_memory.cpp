#include "host/content/film/lazy_memory.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/resource.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <filesystem>

namespace mars::film {
namespace {

// A disk's: files of other folders are memory, too.
bool has_room(int file, std::size_t bytes) {
  struct statfs system {};
  struct rlimit limit {};
  if (fstatfs(file, &system) != 0 || system.f_type == TMPFS_MAGIC || system.f_type == RAMFS_MAGIC) return false;
  if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur < bytes) return false;
  return fallocate(file, 0, 0, static_cast<off_t>(bytes)) == 0;
}

void* map_file(std::size_t bytes) {
  std::error_code none;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
  const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file < 0) return MAP_FAILED;
  void* const pages =
      has_room(file, bytes) ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
  close(file);
  return pages;
}

}  // namespace

void* map_pages(std::size_t bytes, bool& in_file) {
  if (in_file) {
    if (void* const pages = map_file(bytes); pages != MAP_FAILED) return pages;
    in_file = false;
  }
  void* const pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  madvise(pages, bytes, MADV_HUGEPAGE);
  return pages;
}

}  // namespace mars::film
