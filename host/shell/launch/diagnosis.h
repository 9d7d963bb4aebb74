// Why a run failed, from what it left: its fault event, how its process ended, and its last words on standard
// error, among which Open MPI's many are understood where they matter (losses.h, mpi_words.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "hal/failure/failure.h"
#include "host/shell/launch/remains.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

// What is wrong with the surroundings, as lines without the last one's end; none: it is not asked for.
using Advice = std::function<std::string()>;

// What a person does to go on after a signal.
std::string way_to_go_on(const options::RenderOptions& options);

// Of a run that a person's signal ended.
Failure stopped(const Remains& remains, const options::RenderOptions& options);

struct Diagnosis {
  Failure failure;                   // the one message a person gets
  std::optional<std::int32_t> node;  // that died or failed
  std::string machine{};             // where it did, or which does not answer; "" where not known
  bool machine_lost = false;         // it does not answer
  bool died = false;                 // by a signal, with a machine, or with code 0: the next job need not end so
};

// With advice where the run never began or nothing else is known.
Diagnosis diagnose(const Remains& remains, const options::RenderOptions& options, const Advice& advice);

// The frame that the node was drawing when it died, where that is known.
std::optional<std::uint32_t> frame_of_death(const Remains& remains, const Diagnosis& diagnosis);

}  // namespace mars::launch
