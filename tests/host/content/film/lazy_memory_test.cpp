// Memory in a file: what is written stays where its pages are let go, and is the same film.
#include "host/content/film/lazy_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <utility>

#include "host/content/film/film_file.h"
#include "tests/host/content/film/small_film.h"
#include "tests/sanitizers/sanitized.h"
#include "tests/temporary_folder.h"

namespace mars::film {
namespace {

std::size_t resident_bytes() {
  std::ifstream pages("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  pages >> all >> resident;
  return resident * 4096;
}

constexpr std::size_t kNumbers = std::size_t{16} << 20;  // 64 MiB

TEST(LazyMemory, InAFileTakesLittle) {
  LazyVector<std::uint32_t> numbers{LazyMemory<std::uint32_t>(true)};
  numbers.reserve(kNumbers);
  if (!numbers.get_allocator().in_file) GTEST_SKIP() << "there is no disk for temporary files";
  numbers.resize(kNumbers);
  const std::size_t before = resident_bytes();
  for (std::uint32_t k = 0; k < kNumbers; ++k) {
    numbers[k] = k;
    if (k % (1 << 20) == 0) let_pages_go(numbers);
  }
  let_pages_go(numbers);
  EXPECT_LT(resident_bytes(), before + (std::size_t{16} << 20));
  LazyVector<std::uint32_t> other;
  other = std::move(numbers);
  EXPECT_TRUE(other.get_allocator().in_file);
  for (std::uint32_t k = 0; k < kNumbers; k += 999) ASSERT_EQ(other[k], k);
}

TEST(LazyMemory, OfMemoryAloneKeepsItsPages) {
  LazyVector<std::uint32_t> numbers(kNumbers, 7);
  let_pages_go(numbers);
  EXPECT_EQ(numbers[kNumbers - 1], 7u);
}

// Two million T-matrices, 192 MB.
std::string large_film() {
  std::string actors;
  for (int i = 0; i < 2'000; ++i)
    actors += (i == 0 ? "" : ", ") + (R"({"name": "x)" + std::to_string(i)) +
              R"(", "model": "m", "keys": [{"frame": 0, "place": [0, 0, 0]}, {"frame": 999, "place": [1, 0, )" +
              std::to_string(i) + "]}]}";
  return R"({"frames": 1000, "camera": {"eye": [0, -9, 2]},
      "models": {"m": {"joints": [{"name": "j", "segment": {"shape": "box"}}]}}, "actors": [)" +
         actors + "]}";
}

TEST(LazyMemory, FilmsInFilesAreTheSame) {
  const animator::Film film = film_of(large_film());
  CompileOptions options;
  options.in_file = true;
  const std::size_t before = resident_bytes();
  const CompiledFilm in_file = compile(film, options);
  const test::TemporaryFolder folder;
  save_film(in_file, folder / "x.mars");
  const CompiledFilm back = load_compiled_film(folder / "x.mars", true);
  // A sanitizer keeps memory of its own for all that is allocated on the way.
  if (in_file.lines.get_allocator().in_file && !sanitizers::kSanitized) {
    EXPECT_LT(resident_bytes(), before + (std::size_t{100} << 20)) << "of 200 MB each";
  }
  EXPECT_EQ(in_file.checksum(), compile(film).checksum());
  EXPECT_EQ(back.checksum(), in_file.checksum());
  EXPECT_TRUE(is_saved(in_file, folder / "x.mars"));
}

}  // namespace
}  // namespace mars::film
