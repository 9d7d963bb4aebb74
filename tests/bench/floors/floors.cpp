// How far the kernels are from the least that their work can cost, on the measuring scenes: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "node/simd/instruction_set.h"
#include "node/shading/colored_surface.h"
#include "node/tessellator.h"
#include "tests/bench/floors/bare.h"
#include "tests/bench/floors/workload.h"

namespace mars::bench {
namespace {

constexpr int kRounds = 15;
constexpr int kRow = 1920;  // samples of the bare loop's rows
constexpr int kSpan = 16;

template <typename Work>
double seconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Models and interpolations other than Phong's, in the order of Bare::models.
struct Model {
  const char* name;
  wire::Reflection reflection;
  wire::Interpolation interpolation;
};
constexpr Model kModels[] = {
    {"blinn-phong", wire::Reflection::blinn_phong, wire::Interpolation::phong},
    {"cook-torrance", wire::Reflection::cook_torrance, wire::Interpolation::phong},
    {"metallic-roughness", wire::Reflection::metallic_roughness, wire::Interpolation::phong},
    {"gouraud, flat", wire::Reflection::phong, wire::Interpolation::gouraud},
};

// One scene with the kernels of one instruction set; every step says how many seconds it took.
class Bench {
 public:
  Bench(Workload& workload, simd::InstructionSet set)
      : work_(workload),
        instruction_set_(set),
        bare_(bare_for(set)),
        depth_(workload.width() + simd::kVectorSlack),
        ids_(depth_.size(), shading::kNoTriangle),
        depths_(workload.pixels()),
        pixels_(workload.pixels() + simd::kVectorSlack + kRow),
        runs_(workload.pixels() + 1) {}

  // The bare loop over as many pixels as are seen, `at_a_time` pixels at a time.
  double bare_shading(int at_a_time) { return bare_shading(bare_.shade, at_a_time); }
  double bare_shading(Bare::Shade shade, int at_a_time) {
    const Stretch stretch{{0.3f, 0.2f, 0.9f}, {1e-4f, 2e-4f, -1e-4f}, {-0.2f, 0.1f, 1}, {4e-4f, 0, 0}};
    return seconds([&] {
      for (std::uint64_t at = 0; at < work_.pixels(); at += static_cast<std::uint64_t>(at_a_time))
        shade(stretch, work_.shading().materials[0], work_.shading().lights[0], at_a_time, pixels_.data() + at);
    });
  }
  double bare_planes() {
    return seconds([&] {
      bare_.write_depths(work_.shading().triangles, work_.pieces().data(), work_.pieces().size(), depth_.data());
    });
  }
  double bare_copies() {
    return seconds(
        [&] { bare_.copy_depths(depths_.data(), work_.pieces().data(), work_.pieces().size(), depth_.data()); });
  }

  // Visibility and shading line by line, as a node does it; the parts' seconds.
  struct Scanlines {
    double draw = 0;
    double shade = 0;
  };
  Scanlines scanlines() { return scanlines(work_.shading()); }
  Scanlines scanlines(const shading::Shading& shading_now) {
    const raster::RasterKernels& raster = raster::raster_kernels(instruction_set_);
    const shading::ShadingKernels& shading = shading::shading_kernels(instruction_set_);
    Scanlines spent;
    std::uint64_t pixels = 0, runs = 0;
    for (std::uint32_t line = 0; line < work_.height(); ++line) {
      const auto boxes = work_.boxes().stationary(line);
      if (boxes.empty()) continue;
      std::fill(depth_.begin(), depth_.end(), 0.0f);
      shading::Extent extent{};
      spent.draw += seconds([&] {
        extent = raster.draw(work_.shading().triangles, boxes.data(), static_cast<std::uint32_t>(boxes.size()), line,
                             work_.shading().pattern, {depth_.data(), ids_.data(), 0});
      });
      shading::Shaded done{};
      spent.shade += seconds([&] {
        done = shading.shade(shading_now, ids_.data(), line, extent, runs_.data() + runs, pixels_.data() + pixels);
      });
      pixels += done.pixels;
      runs += done.runs;
      std::fill(ids_.begin() + extent.first, ids_.begin() + extent.last, shading::kNoTriangle);
    }
    return spent;
  }

  double bare_model(std::size_t model) { return bare_shading(bare_.models[model], kRow); }
  double shade_model(std::size_t model) {
    std::vector<wire::Material> materials(work_.materials().begin(), work_.materials().end());
    for (wire::Material& material : materials) {
      material.reflection = kModels[model].reflection;
      material.interpolation = kModels[model].interpolation;
    }
    shading::Shading shading = work_.shading();
    shading.materials = materials.data();
    return scanlines(shading).shade;
  }
  // Dicing, and colours of all vertices or triangles as seen from outside.
  double dice_and_color(bool flat) {
    shape::Dicer dicer(instruction_set_);
    shading::ColoredSurface colored(instruction_set_);
    const shading::Coloring coloring{work_.shading(), 0, true, false};
    return seconds([&] {
      work_.dice(dicer, [&](const shape::Surface& surface) {
        if (!flat) colored.by_vertices(surface, coloring);
        for (std::uint32_t first = 0; flat && first < surface.triangles().count; first += colored.kFlatTriangles)
          colored.by_triangles(surface, first, coloring);
      });
    });
  }
  double dice() {
    shape::Dicer dicer(instruction_set_);
    return seconds([&] { work_.dice(dicer); });
  }
  double dice_and_set_up() {
    return seconds([&] { work_.make(instruction_set_); });
  }
  double fill() {
    return seconds([&] { work_.fill(); });
  }

 private:
  Workload& work_;
  simd::InstructionSet instruction_set_;
  const Bare& bare_;
  std::vector<float> depth_;  // of one line
  std::vector<std::uint32_t> ids_;
  std::vector<float> depths_;  // of all that is seen
  std::vector<std::uint32_t> pixels_;
  std::vector<wire::Run> runs_;
};

// Keeps the best time of every benchmark, and prints nothing.
class Best : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const double time = run.real_accumulated_time / static_cast<double>(run.iterations);
      const auto [at, added] = seconds_.try_emplace(run.run_name.function_name, time);
      if (!added) at->second = std::min(at->second, time);
    }
  }
  // 0 where it was not run.
  double of(const std::string& name) const {
    const auto at = seconds_.find(name);
    return at == seconds_.end() ? 0 : at->second;
  }

 private:
  std::map<std::string, double> seconds_;
};

struct Case {
  std::string name;  // scene/set
  std::unique_ptr<Bench> bench;
  const Workload* work;
};

std::string bare_name(std::size_t model) { return std::string("bare ") + kModels[model].name; }

void add_step(const Case& one, const std::string& step, const std::function<double(Bench&)>& run) {
  benchmark::RegisterBenchmark((one.name + "/" + step).c_str(),
                               [&bench = *one.bench, run](benchmark::State& state) {
                                 for (auto _ : state) state.SetIterationTime(run(bench));
                               })
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(kRounds);
}

void add_steps(const Case& one) {
  add_step(one, "rows", [](Bench& b) { return b.bare_shading(kRow); });
  add_step(one, "spans", [](Bench& b) { return b.bare_shading(kSpan); });
  add_step(one, "shade", [](Bench& b) { return b.scanlines().shade; });
  add_step(one, "copies", [](Bench& b) { return b.bare_copies(); });
  add_step(one, "planes", [](Bench& b) { return b.bare_planes(); });
  add_step(one, "draw", [](Bench& b) { return b.scanlines().draw; });
  add_step(one, "dice", [](Bench& b) { return b.dice(); });
  add_step(one, "make", [](Bench& b) { return b.dice_and_set_up(); });
  add_step(one, "fill", [](Bench& b) { return b.fill(); });
  add_step(one, "gouraud", [](Bench& b) { return b.dice_and_color(false); });
  add_step(one, "flat", [](Bench& b) { return b.dice_and_color(true); });
  for (std::size_t model = 0; model < std::size(kModels); ++model) {
    add_step(one, bare_name(model), [model](Bench& b) { return b.bare_model(model); });
    add_step(one, kModels[model].name, [model](Bench& b) { return b.shade_model(model); });
  }
}

// "-" for what was not measured.
void print_row(const std::string& name, std::initializer_list<double> numbers) {
  std::printf("%-12s", name.c_str());
  for (const double number : numbers)
    if (std::isnormal(number))
      std::printf("%12.2f", number);
    else
      std::printf("%12s", "-");
  std::puts("");
}

void print(const std::vector<Case>& cases, const Best& best) {
  const auto ns = [&](const Case& one, const std::string& step) { return 1e9 * best.of(one.name + '/' + step); };
  std::puts("Shading, ns a pixel    rows       spans       shade     of rows    of spans");
  for (const Case& one : cases) {
    const auto pixels = static_cast<double>(one.work->pixels());
    const double rows = ns(one, "rows"), spans = ns(one, "spans"), shade = ns(one, "shade");
    print_row(one.name, {rows / pixels, spans / pixels, shade / pixels, shade / rows, shade / spans});
  }
  for (std::size_t model = 0; model < std::size(kModels); ++model) {
    std::printf("\n%-21s   rows       shade     of rows\n", kModels[model].name);
    for (const Case& one : cases) {
      const auto pixels = static_cast<double>(one.work->pixels());
      const double rows = ns(one, bare_name(model)), shade = ns(one, kModels[model].name);
      print_row(one.name, {rows / pixels, shade / pixels, shade / rows});
    }
  }
  std::puts("\nColours, ns a        sample   a vertex  a triangle");
  for (const Case& one : cases) {
    const double rows = ns(one, "rows") / static_cast<double>(one.work->pixels()), dice = ns(one, "dice");
    const auto vertices = static_cast<double>(one.work->counts().vertices);
    const auto triangles = static_cast<double>(one.work->classified());
    print_row(one.name, {rows, (ns(one, "gouraud") - dice) / vertices, (ns(one, "flat") - dice) / triangles});
  }
  std::puts("\nVisibility, ms       copies      planes        draw   of copies   of planes    ns a box");
  for (const Case& one : cases) {
    const auto boxes = static_cast<double>(one.work->boxes().boxes.size());
    const double copies = ns(one, "copies"), planes = ns(one, "planes"), draw = ns(one, "draw");
    print_row(one.name, {copies / 1e6, planes / 1e6, draw / 1e6, draw / copies, draw / planes, draw / boxes});
  }
  std::puts("\nOther steps, ns a    vertex  classified     emitted  box filled");
  for (const Case& one : cases) {
    const wire::WorkCounts& counts = one.work->counts();
    const double dice = ns(one, "dice"), set_up = ns(one, "make") - dice;
    print_row(one.name,
              {dice / static_cast<double>(counts.vertices), set_up / static_cast<double>(one.work->classified()),
               set_up / static_cast<double>(counts.triangles),
               ns(one, "fill") / static_cast<double>(one.work->boxes().boxes.size())});
  }
}

void print_counts(const Workload& work, const std::string& name) {
  std::printf(
      "%s: %llu vertices, %llu triangles classified, %llu emitted, %zu edge boxes, %zu visible pieces, %llu pixels\n",
      name.c_str(), static_cast<unsigned long long>(work.counts().vertices),
      static_cast<unsigned long long>(work.classified()), static_cast<unsigned long long>(work.counts().triangles),
      work.boxes().boxes.size(), work.pieces().size(), static_cast<unsigned long long>(work.pixels()));
}

int run(int argc, char** argv) {
  // Rounds of one benchmark are spread over the whole run: quiet moments come to all.
  std::vector<char*> words(argv, argv + argc);
  std::string interleaved = "--benchmark_enable_random_interleaving=true";
  words.insert(words.begin() + 1, interleaved.data());
  int count = static_cast<int>(words.size());
  benchmark::Initialize(&count, words.data());
  std::vector<std::filesystem::path> films(words.begin() + 1, words.begin() + count);
  if (films.empty())
    for (const char* name : {"s1.json", "s1m.json", "s2.json"})
      films.push_back(std::filesystem::path(MARS_EXAMPLES) / name);
  std::vector<std::unique_ptr<Workload>> workloads;
  std::vector<Case> cases;
  for (const auto& film : films) {
    workloads.push_back(std::make_unique<Workload>(film));
    print_counts(*workloads.back(), film.stem().string());
    for (const char* limit : {"avx512", "avx2", "sse4", "sse2"}) {
      const simd::InstructionSet set = simd::best_instruction_set(limit);
      if (simd::name_of(set) != std::string(limit)) continue;  // this CPU has it not
      cases.push_back({film.stem().string() + '/' + limit, std::make_unique<Bench>(*workloads.back(), set),
                       workloads.back().get()});
    }
  }
  for (const Case& one : cases) add_steps(one);
  Best best;
  benchmark::RunSpecifiedBenchmarks(&best);
  std::puts("");
  print(cases, best);
  return 0;
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  try {
    return mars::bench::run(argc, argv);
  } catch (const mars::Failure& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
