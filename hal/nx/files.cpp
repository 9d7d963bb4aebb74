#include "hal/nx/cfs.h"

#include <cerrno>
#include <cstdint>

#include "hal/messages/process.h"
#include "hal/nx/guard.h"
#include "hal/nx/nx_files.h"

namespace mars::nx {
namespace {

Files& files() { return files_of(messages::process()); }

off_t place_of(const char* call, const esize_t& size) {
  const bool fits =
      size.slow >= INT32_MIN && size.slow <= UINT32_MAX && size.shigh >= INT32_MIN && size.shigh <= INT32_MAX;
  if (!fits)
    messages::process().fail(call, EINVAL, "a place's parts have 32 bits each", "put what is above 32 bits into shigh");
  return static_cast<off_t>(size.shigh) * (1L << 32) + static_cast<std::uint32_t>(size.slow);
}

esize_t esize_of(off_t place) { return {static_cast<long>(place & UINT32_MAX), static_cast<long>(place >> 32)}; }

esize_t seek(const char* call, int fd, const esize_t& offset, int whence) {
  return esize_of(files().seek(call, fd, place_of(call, offset), whence));
}

}  // namespace
}  // namespace mars::nx

using namespace mars::nx;

extern "C" {

long cread(int fd, void* buf, long len) {
  return plain([&] { return files().read("cread", fd, buf, len); });
}
long cwrite(int fd, const void* buf, long len) {
  return plain([&] { return files().write("cwrite", fd, buf, len); });
}
long iread(int fd, void* buf, long len) {
  return plain([&] { return files().start_read("iread", fd, buf, len); });
}
long iwrite(int fd, const void* buf, long len) {
  return plain([&] { return files().start_write("iwrite", fd, buf, len); });
}
long iowait(long id) {
  return plain([&] { return files().wait("iowait", id); });
}
long iodone(long id) {
  return plain([&]() -> long { return files().done("iodone", id); });
}
long iseof(int fd) {
  return plain([&]() -> long { return files().at_end("iseof", fd); });
}
esize_t eseek(int fd, esize_t offset, int whence) {
  return plain([&] { return seek("eseek", fd, offset, whence); });
}
long lsize(int fd, long offset, int whence) {
  return plain([&]() -> long { return files().enlarge("lsize", fd, offset, whence); });
}
void setiomode(int fd, int mode) {
  plain([&] { files().set_mode("setiomode", fd, mode); });
}
long iomode(int fd) {
  return plain([&]() -> long { return files().mode("iomode", fd); });
}

long _cread(int fd, void* buf, long len) {
  return twin([&] { return files().read("cread", fd, buf, len); });
}
long _cwrite(int fd, const void* buf, long len) {
  return twin([&] { return files().write("cwrite", fd, buf, len); });
}
long _iread(int fd, void* buf, long len) {
  return twin([&] { return files().start_read("iread", fd, buf, len); });
}
long _iwrite(int fd, const void* buf, long len) {
  return twin([&] { return files().start_write("iwrite", fd, buf, len); });
}
long _iowait(long id) {
  return twin([&] { return files().wait("iowait", id); });
}
long _iodone(long id) {
  return twin([&]() -> long { return files().done("iodone", id); });
}
long _iseof(int fd) {
  return twin([&]() -> long { return files().at_end("iseof", fd); });
}
esize_t _eseek(int fd, esize_t offset, int whence) {
  esize_t at{};
  const long failed = twin([&] { at = seek("eseek", fd, offset, whence); });
  return failed == 0 ? at : esize_t{-1, -1};
}
long _lsize(int fd, long offset, int whence) {
  return twin([&]() -> long { return files().enlarge("lsize", fd, offset, whence); });
}
long _setiomode(int fd, int mode) {
  return twin([&] { files().set_mode("setiomode", fd, mode); });
}
long _iomode(int fd) {
  return twin([&]() -> long { return files().mode("iomode", fd); });
}

}  // extern "C"
