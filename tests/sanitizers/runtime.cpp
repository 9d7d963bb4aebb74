// What sanitizers do in every program of a sanitized build: compiled in, so it holds in processes whose environment a
// test or a launcher empties. Reports go to files, build/<preset>/reports/report.PROGRAM.PROCESS, because a supervisor
// that starts a rank again, or a test that expects a failure, would hide them; ./bootstrap sanitize fails where there
// is one. ASAN_OPTIONS=log_path=stderr shows a report where it is made.
#include <dlfcn.h>

// No report; an exit code that no program of ours has; and no file for a list of suppressions that took effect.
#define MARS_REPORTS "log_path=" MARS_SANITIZER_REPORTS "/report:log_exe_name=1:exitcode=99:print_suppressions=0"

extern "C" {

// Programs of ours get a library before the sanitizer's (mars-loopback.so, which a launcher loads into them). A
// vector's or container's memory that cannot be had is a std::bad_alloc, as without sanitizers.
const char* __asan_default_options() {
  return MARS_REPORTS ":verify_asan_link_order=0:allocator_may_return_null=1:detect_stack_use_after_return=1";
}

const char* __ubsan_default_options() { return MARS_REPORTS ":print_stacktrace=1"; }

const char* __tsan_default_options() { return MARS_REPORTS ":second_deadlock_stack=1:allocator_may_return_null=1"; }

// Memory of libraries that is not freed at their end:
const char* __lsan_default_suppressions() {
  return
      // Open MPI and its components keep what MPI_Init made.
      "leak:libmpi.so\nleak:libopen-pal.so\nleak:libopen-rte.so\nleak:libpmix.so\nleak:mca_\n"
      // What they ask others for: no frames are seen behind these, as Debian's libraries have no frame pointers.
      "leak:hwloc_bitmap_alloc\nleak:__vasprintf_internal\n"
      // SDL looks for a desktop's messages.
      "leak:libdbus-1.so\n";
}

// Libraries stay: what an unloaded component of Open MPI leaves would be a leak of nobody's, which no suppression
// names.
int dlclose(void*) { return 0; }

}  // extern "C"

namespace {

// GCC's library for undefined behaviour reads log_path, but does not obey it beside AddressSanitizer.
[[gnu::constructor(101)]] void report_undefined_behaviour_to_files() {
  void* const library = dlopen("libubsan.so.1", RTLD_NOLOAD | RTLD_LAZY);
  if (library == nullptr) return;
  using SetPath = void (*)(const char*);
  const auto set_path = reinterpret_cast<SetPath>(dlsym(library, "__sanitizer_set_report_path"));
  if (set_path != nullptr) set_path(MARS_SANITIZER_REPORTS "/report");
}

}  // namespace
