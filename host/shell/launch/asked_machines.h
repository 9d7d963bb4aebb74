// Which machines a run was asked to use: those of a hostfile, or of the batch job in which it runs. Without an mpirun a
// run has this machine alone.
#pragma once

#include <string>

#include "host/child/environment.h"

namespace mars::launch {

// "the Slurm job has 4 machines", "hosts names other machines"; "" where this machine is enough, as for a batch job of
// one machine. `hostfile`: "" where there is none. Throws Failure as read_hostfile does.
std::string asked_machines(const std::string& hostfile, const child::Environment& environment);

// Whether PBS, Grid Engine or LSF names the machines of a job, this one among them.
bool batch_lists_machines(const child::Environment& environment);

}  // namespace mars::launch
