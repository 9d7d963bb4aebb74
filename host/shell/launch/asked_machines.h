// Which machines a run was asked to use: those of a hostfile, or of the batch job in which it runs. Without an mpirun a
// run has this machine alone.
#pragma once

#include <string>
#include <vector>

#include "host/child/environment.h"
#include "host/shell/launch/slots.h"

namespace mars::launch {

// "the Slurm job has 4 machines", "hosts names other machines"; "" where this machine is enough, as for a batch job of
// one machine. `hostfile`: "" where there is none. Throws Failure as named_machines does.
std::string asked_machines(const std::string& hostfile, const child::Environment& environment);

// Those of the hostfile; else those of a job of PBS, Grid Engine or LSF that has several, with their slots: an mpirun
// that was built without the batch system finds this machine alone. None where there is neither, and in a Slurm job.
// Throws Failure as read_hostfile does, and where the batch system's file cannot be read.
std::vector<Slots> named_machines(const std::string& hostfile, const child::Environment& environment);

// Whether PBS, Grid Engine or LSF names the machines of a job, this one among them.
bool batch_lists_machines(const child::Environment& environment);

}  // namespace mars::launch
