// One rendering, as the host's process does it from a film to the last frame: the same in every program that renders.
// It knows no command line: RenderJob says what a person asked for.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/content/film/compile.h"
#include "host/content/film/frame_set.h"
#include "host/render/events/course.h"
#include "host/render/farm/farm.h"
#include "host/render/farm/plan.h"
#include "host/render/sinks/manifest.h"
#include "host/render/sinks/sink_pool.h"
#include "node/wire/protocol.h"

namespace mars::session {

// Who composes frames and writes their files. `automatic`: nodes where that is forecast to be faster.
enum class Writers { automatic, host, nodes };

struct HostMachine {
  std::uint64_t memory = 0;  // bytes; 0: of this machine as much as it may use
  int processors = 0;        // 0: this machine's
};

// What is known of a rendering before it begins.
struct Prediction {
  std::uint32_t groups = 0;       // that make it shortest; 0: as make_groups says
  std::int32_t contributors = 0;  // to keyframes, with these groups, as in farm::Plan
  std::int32_t sharers = 1;       // of inbetweens, so too
  std::uint32_t most_frames = 0;  // of a task, as in farm::PlanRequest
  events::Course course{};        // of its frames
  std::string warning{};          // why nothing is predicted; "": none
  // Whether nodes would write frames' files sooner than the host, with this many nodes on a machine; none: nothing is
  // predicted. The film must be there still.
  std::function<bool(int nodes_a_machine)> nodes_write_sooner{};
};

struct RenderJob {
  std::string film;  // its file, as the person gave it
  // Reads and compiles it, which may take long; `warn` takes one line about a probable mistake.
  std::function<film::CompiledFilm(const std::function<void(const std::string&)>& warn)> load_film;
  // With which it is compiled, as on a command line: a folder's frames are those of one film with the same options.
  std::vector<std::string> film_options;
  std::string folder;                                 // for the frames; "": they go nowhere
  bool overwrite = false;                             // frames that the folder has already
  bool kept_film = false;                             // the folder's, as in resume::Wish
  sinks::FrameForm form{};                            // of its files
  std::shared_ptr<const images::DisplayView> view{};  // form.view's; none: the film's curve shows light
  Writers writers = Writers::automatic;
  film::FrameSet frames;
  wire::Mapping mapping = wire::Mapping::cost;
  wire::Exchange exchange = wire::Exchange::automatic;
  bool coherence = true;
  bool adapts = true;                  // as in farm::FarmOptions
  std::uint32_t block = 16;            // side of the compositor's blocks, pixels
  std::uint32_t groups = 0;            // as in PlanRequest
  std::int32_t sharers = 0;            // so too; 0: as predicted
  std::uint32_t most_frames = 0;       // so too; 0: as predicted
  std::string report;                  // file for the measurements; "": none
  std::string trace;                   // file for a picture of the run; "": none
  std::string watch;                   // socket of who watches; "": nobody does
  std::string backend;                 // its name: mpi, threads or simulated
  std::vector<std::string> arguments;  // all this, as it was given to the host
  HostMachine host;                    // that the host has
  // Makes the pool of sinks; none: threads take frames.
  std::function<std::unique_ptr<sinks::SinkPool>(sinks::Sink& sink, const sinks::SinkPool::Shape& shape)> make_sinks;
  bool counts_files = false;  // that are not written, as simulations do
  // Of simulated nodes, which only count what files take; none: the folder's.
  std::optional<farm::Writing> writing;
  // Asked once, before the film goes to nodes; none, or 0 groups and no course: nothing is predicted.
  std::function<Prediction(const wire::PackedFilm& film, const farm::PlanRequest& request, int nodes)> predict;
  // The command that renders again, all frames or one, with this number of nodes.
  std::function<std::string(std::uint32_t nodes, std::optional<std::uint32_t> frame)> replay;
};

// This machine's where `asked` says nothing.
HostMachine host_machine(HostMachine asked);
// Sinks work while nodes wait for credit, so they may have every processor.
std::uint32_t sink_threads(const HostMachine& host);

// The calling HAL process is the host. Reports events on standard output. A failure is reported as a fault event, and
// thrown for the caller, which ends the run.
void run_session(const RenderJob& job);

}  // namespace mars::session
