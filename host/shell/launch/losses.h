// What a job lost: a process that a signal ended, or a machine. What started the job reports it in words, which are
// Open MPI's, MPICH's or srun's, or by its own end alone: exit code 128 + n stands for signal n.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/failure/failure.h"
#include "host/shell/launch/remains.h"

namespace mars::launch {

struct Loss {
  Failure failure;
  std::optional<std::int32_t> node{};
  std::string machine{};      // "" where not known
  bool machine_lost = false;  // it does not answer; else a process died
  bool in_words = true;       // else the job's end alone shows it, and says not where
};

// `words`: the last ones of the job, on one line. None where nothing shows that anything was lost.
std::optional<Loss> find_loss(const Remains& remains, const std::string& words);

}  // namespace mars::launch
