// What a person may ask of a rendering, told in the same words by every program that renders: `mars render`,
// and the programs it starts or a person starts instead. One table holds every option's name, help, programs
// and both directions: from a command line and to the command line of the program started next.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/options/frame_set.h"
#include "node/protocol.h"

namespace mars::host {

// In place of a film's file: a tiny film that every program has in it, to see whether a start works.
inline constexpr const char* kTrialFilm = ":trial";

enum class Backend { automatic, mpi, threads };
enum class Intervals { automatic, keyframes };
enum class SinkKind { png, none };

struct PictureSize {
  std::uint32_t width;  // pixels, 1..node::kMaxSide
  std::uint32_t height;

  bool operator==(const PictureSize&) const = default;
};

struct RenderOptions {
  std::string film;         // FILM.json or FILM.mars
  std::string folder;       // for the frames; "" only without a sink
  std::uint32_t nodes = 0;  // 0: as many as the machine has processors for
  Backend backend = Backend::automatic;
  FrameSet frames;
  std::optional<PictureSize> size;  // none: the film's own
  node::Mapping mapping = node::Mapping::greedy;
  Intervals intervals = Intervals::automatic;
  bool no_coherence = false;  // every frame from scratch
  std::uint32_t block = 16;   // side of the compositor's blocks, pixels
  std::uint32_t cubes = 0;    // intervals rendered at a time; 0: as many as pay
  SinkKind sink = SinkKind::png;
  std::string report;  // file for the measurements; "": none
  bool quiet = false;

  bool operator==(const RenderOptions&) const = default;
};

// Who reads the options: each takes those that concern it.
enum class Program : unsigned { mars = 1, host = 2, cube = 4, threads = 8, compile = 16 };

// Adds the options `program` takes to its command line, which is then checked as a whole too; `options` must
// outlive the parsing.
void add_render_options(CLI::App& app, RenderOptions& options, Program program);

// The arguments that make `program` read these options again, those it takes; defaults are left out.
std::vector<std::string> arguments_for(Program program, const RenderOptions& options);

}  // namespace mars::host
