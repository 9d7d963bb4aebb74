// The environment: the one table of MARS_* variables, and its only reader. Programs' main files and libmars-nx read it
// and pass the values on; no other library does.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/messages/collective_method.h"

namespace mars::messages {

struct Setting {
  const char* name;
  const char* meaning;
  const char* fallback;  // what happens without it, for people

  // Of programs written for NX alone; else of whatever renders.
  bool of_nx() const { return std::string_view(name).starts_with("MARS_NX_"); }
};

std::span<const Setting> settings_table();

struct Settings {
  std::optional<std::uint64_t> memory;     // bytes a node may use for its frames; none: the program decides
  std::optional<std::uint64_t> nx_memory;  // bytes of messages under way between mars-nx's processes; none: it decides
  std::optional<bool> nx_host;             // rank 0 of an MPI job is the host; none: its program decides
  bool nx_strict = false;                  // long messages are not buffered (hal/messages/rendezvous.h)
  CollectiveMethod nx_collectives = CollectiveMethod::automatic;
  bool nx_handler_thread = false;  // handlers run between NX calls too (hal/nx/progress_thread.h)
  std::string simd;                // widest instruction set that kernels may use; "": the processor's
};

// Throws a Failure that names the variable and what it may be.
Settings read_settings();

// Whether an MPI's starter (mpirun, srun) made this process a rank of a job.
bool started_by_mpi();

// Takes the text that the process that started this one as a rank left in the environment (hal/processes/place.h) out
// of it; none: it left none.
std::optional<std::string> take_place_text();
inline constexpr const char* kPlaceSetting = "MARS_NX_PLACE";

// The terminal, by the environment.
struct TerminalKind {
  std::string name;       // TERM; "": none
  bool colors24 = false;  // COLORTERM: every colour
};
TerminalKind terminal_kind();

// A line about each MARS_* variable that is not in the table, with the nearest name that is.
std::vector<std::string> unknown_settings();

// The table as text, for help and documentation.
std::string settings_text(bool of_nx);

}  // namespace mars::messages
