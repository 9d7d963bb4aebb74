// The time between two jobs: a pause, in which machines are asked whether they answer. A person's signal ends it.
#pragma once

#include <chrono>
#include <set>
#include <string>
#include <vector>

#include "host/child/environment.h"
#include "host/shell/launch/slots.h"

namespace mars::launch {

// How machines are asked. Without names nobody is.
enum class Question { nobody, ssh, slurm };

// Those that answer within 10 seconds, after the pause at least. `path` as for find_programs. Throws Failure where a
// person's signal ended the pause.
struct Pause {
  std::chrono::seconds length;
  Question question;
  std::vector<std::string> machines;
};
std::set<std::string> wait_and_ask(const Pause& pause, const std::string& path);

// The machines of this Slurm allocation with their tasks; none where Slurm does not say.
std::vector<Slots> slurm_machines(const child::Environment& environment, const std::string& path);

// Whether Slurm takes this job's machines for another job, after a time of grace in which they still answer; false
// where Slurm does not say.
bool is_preempted(const child::Environment& environment, const std::string& path);

// Whether a line of scontrol's about a job says so.
bool tells_preemption(const std::string& scontrol_line);

// Whether a machine in this state, as sinfo's %T or %t writes it, runs jobs and answers.
bool usable(const std::string& slurm_state);

}  // namespace mars::launch
