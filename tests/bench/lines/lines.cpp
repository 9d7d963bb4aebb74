// What a scanline costs by what is counted of it, from which the mapping `cost` has its constants
// (node/group/mapping.h): every line of the films' first frames is drawn and shaded, the best of many rounds counts,
// and t = a boxes + b samples is fitted to the lines of all films, each film with the same weight. Then how even each
// mapping makes the lines' times.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "node/group/mapping.h"
#include "node/simd/instruction_set.h"
#include "tests/bench/floors/workload.h"

namespace mars::bench {
namespace {

constexpr int kRounds = 25;
constexpr std::array<std::uint32_t, 2> kSize{1920, 1080};

// One film with the kernels of one instruction set.
class Film {
 public:
  Film(const Workload& work, std::string name, simd::InstructionSet set)
      : work_(work),
        name_(std::move(name)),
        raster_(raster::raster_kernels(set)),
        shading_(shading::shading_kernels(set)),
        depth_(work.width() + simd::kVectorSlack),
        ids_(depth_.size(), shading::kNoTriangle),
        pixels_(work.pixels() + depth_.size()),
        runs_(pixels_.size()),
        seconds_(work.height(), std::numeric_limits<double>::infinity()) {}

  const std::string& name() const { return name_; }
  const std::vector<raster::LineLoad>& loads() const { return work_.line_loads(); }
  // Of each line, in the best round so far.
  const std::vector<double>& seconds() const { return seconds_; }

  // Draws all lines as a node does.
  void draw() {
    std::uint64_t pixels = 0, runs = 0;
    for (std::uint32_t line = 0; line < work_.height(); ++line) {
      const auto begin = std::chrono::steady_clock::now();
      const shading::Shaded shaded = draw(line, runs_.data() + runs, pixels_.data() + pixels);
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
      seconds_[line] = std::min(seconds_[line], spent.count());
      pixels += shaded.pixels;
      runs += shaded.runs;
    }
  }

 private:
  shading::Shaded draw(std::uint32_t line, wire::Run* runs, std::uint32_t* pixels) {
    const auto boxes = work_.boxes().stationary(line);
    if (boxes.empty()) return {};
    std::fill_n(depth_.begin(), work_.width(), 0.0f);
    const shading::Extent extent =
        raster_.draw(work_.shading().triangles, boxes.data(), static_cast<std::uint32_t>(boxes.size()), line,
                     work_.shading().pattern, {depth_.data(), ids_.data(), 0});
    const shading::Shaded shaded = shading_.shade(work_.shading(), ids_.data(), line, extent, runs, pixels);
    std::fill(ids_.begin() + extent.first, ids_.begin() + extent.last, shading::kNoTriangle);
    return shaded;
  }

  const Workload& work_;
  std::string name_;
  const raster::RasterKernels& raster_;
  const shading::ShadingKernels& shading_;
  std::vector<float> depth_;  // of one line
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint32_t> pixels_;
  std::vector<wire::Run> runs_;
  std::vector<double> seconds_;
};

using Films = std::vector<const Film*>;

// Seconds.
struct Cost {
  double box = 0;
  double sample = 0;
};

// Of least squares, each film's errors in parts of its time.
Cost fit(const Films& films) {
  double bb = 0, bs = 0, ss = 0, bt = 0, st = 0;
  for (const Film* film : films) {
    double all = 0;
    for (const double t : film->seconds()) all += t;
    for (std::size_t line = 0; line < film->loads().size(); ++line) {
      const double boxes = static_cast<double>(film->loads()[line].boxes()) / all,
                   samples = static_cast<double>(film->loads()[line].samples()) / all, t = film->seconds()[line] / all;
      bb += boxes * boxes;
      bs += boxes * samples;
      ss += samples * samples;
      bt += boxes * t;
      st += samples * t;
    }
  }
  const double determinant = bb * ss - bs * bs;
  return {(bt * ss - st * bs) / determinant, (st * bb - bt * bs) / determinant};
}

// Greatest over average time of homes.
double unevenness(const Film& film, wire::Mapping mapping, std::size_t nodes) {
  std::vector<std::uint64_t> totals{0};
  for (const raster::LineLoad& load : film.loads())
    totals.push_back(totals.back() + (mapping == wire::Mapping::cost ? group::line_cost(load) : load.boxes()));
  std::vector<geometry::LineRange> homes(nodes);
  group::map_lines(mapping, totals, homes);
  double greatest = 0, all = 0;
  for (const geometry::LineRange& home : homes) {
    double spent = 0;
    for (std::uint32_t line = home.first; line < home.last; ++line) spent += film.seconds()[line];
    greatest = std::max(greatest, spent);
    all += spent;
  }
  return greatest * static_cast<double>(nodes) / all;
}

void print_costs(const std::string& name, const Cost& cost) {
  std::printf("%-16s%10.2f%10.2f%10.1f\n", name.c_str(), 1e9 * cost.box, 1e9 * cost.sample, cost.box / cost.sample);
}

void print_unevenness(const Film& film) {
  std::printf("%-16s", film.name().c_str());
  for (const std::size_t nodes : {2, 4, 8}) {
    for (const wire::Mapping mapping : {wire::Mapping::greedy, wire::Mapping::optimal, wire::Mapping::cost})
      std::printf("%8.2f", unevenness(film, mapping, nodes));
    std::printf("  ");
  }
  std::puts("");
}

void print_counts(const Workload& work, const std::string& name) {
  std::uint64_t boxes = 0, samples = 0;
  for (const raster::LineLoad& load : work.line_loads()) {
    boxes += load.boxes();
    samples += load.samples();
  }
  std::printf("%s: %llu edge boxes, %llu samples, %llu pixels\n", name.c_str(), static_cast<unsigned long long>(boxes),
              static_cast<unsigned long long>(samples), static_cast<unsigned long long>(work.pixels()));
}

int run(std::vector<std::filesystem::path> paths) {
  if (paths.empty())
    for (const char* name : {"s1.json", "s1m.json", "s2.json", "s3.json", "demo.json", "visit.json"})
      paths.push_back(std::filesystem::path(MARS_EXAMPLES) / name);
  std::vector<std::unique_ptr<Workload>> workloads;
  std::vector<std::vector<Film>> films;  // by instruction set
  for (const auto& path : paths) {
    workloads.push_back(std::make_unique<Workload>(path, film::CompileOptions{{}, kSize}));
    print_counts(*workloads.back(), path.stem().string());
  }
  for (const char* limit : {"avx512", "avx2", "sse4", "sse2"}) {
    const simd::InstructionSet set = simd::best_instruction_set(limit);
    if (simd::name_of(set) != std::string(limit)) continue;  // this CPU has it not
    films.emplace_back();
    for (std::size_t i = 0; i < paths.size(); ++i)
      films.back().emplace_back(*workloads[i], paths[i].stem().string() + '/' + limit, set);
  }
  for (int round = 0; round < kRounds; ++round)
    for (auto& of_set : films)
      for (Film& film : of_set) film.draw();
  std::puts("\nns               a box  a sample     ratio");
  for (const auto& of_set : films) {
    Films all;
    for (const Film& film : of_set) {
      print_costs(film.name(), fit({&film}));
      all.push_back(&film);
    }
    print_costs("all", fit(all));
  }
  std::puts("\ngreatest : average time of homes, by greedy, optimal and cost, on 2, 4 and 8 nodes");
  for (const auto& of_set : films)
    for (const Film& film : of_set) print_unevenness(film);
  return 0;
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--help") {
    std::puts(
        "mars bench lines [FILM ...]: what a scanline costs (docs/measuring.md); default: s1, s1m, s2, s3, demo, "
        "visit");
    return 0;
  }
  try {
    return mars::bench::run({argv + 1, argv + argc});
  } catch (const mars::Failure& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
