// Files of exact counts behind their header, whose checksum a damaged file seldom has: what is taken is rehearsed.
#include <array>

#include "host/content/document/file.h"
#include "host/experiments/forecast/counts_file.h"
#include "host/experiments/forecast/rehearsal.h"
#include "host/programs/node_counter.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"
#include "tests/node/wire/small_film.h"

namespace mars::fuzz::film_counts {
namespace {

constexpr std::size_t kHeader = 88, kLongest = 1 << 20;

struct Counted {
  const Message block = wire::pack(wire::small_film());
  const wire::PackedFilm film{block, "film"};
  const std::vector<farm::Task> tasks = farm::make_tasks(film, std::array{0u, 1u, 2u}, true);
  const Message numbers = count();

  Message count() const {
    const forecast::FilmCounts counts = forecast::count_exactly(film, tasks, programs::make_node_counter,
                                                                images::PictureFormat::png, 1, [](int, int) {});
    const std::string path = scratch().path("film.counts");
    forecast::save_counts(counts, std::string(32, '0'), path);
    const std::string bytes = document::read_file(path).substr(kHeader);
    const auto numbers = std::as_bytes(std::span(bytes));
    return {numbers.begin(), numbers.end()};
  }
};

}  // namespace

void take(std::string_view input) {
  static const Counted counted;
  Message numbers = counted.numbers;
  Script script(input);
  while (!script.at_end()) edit(numbers, script, kLongest);
  const std::string_view text(reinterpret_cast<const char*>(numbers.data()), numbers.size());
  const forecast::FilmCounts counts = forecast::read_counts(text, "film.counts", counted.tasks, counted.film);
  static const experiments::Platform platform = experiments::read_platform("fat-tree", MARS_FUZZ_PLATFORMS);
  const farm::Plan plan{counted.tasks, farm::make_groups(3, 1, counted.tasks.size())};
  forecast::rehearse(counts, plan, {counted.film, platform}, 3);
}

const Target target("film_counts", Form::bytes, take);

}  // namespace mars::fuzz::film_counts
