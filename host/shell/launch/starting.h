// The programs and surroundings that jobs are started from. They are found once, before the first job, because programs
// are started to find them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/child/command.h"
#include "host/shell/launch/between_jobs.h"
#include "host/shell/launch/command.h"
#include "host/shell/launch/slots.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

struct Starting {
  Programs programs;
  Surroundings surroundings;
  std::string path;  // where programs are searched for
};

// Settles the number of nodes and the backend. `self`: the running program's own file. Throws Failure where the options
// ask for what cannot be started here.
Starting prepare(options::RenderOptions& options, const std::filesystem::path& self);

// The command of a job. `machines`: to be used instead of the options'; none: the options'.
child::Command command_for(const options::RenderOptions& options, const Starting& starting,
                           const std::vector<Slots>& machines = {});

// The machines of the options' job; none where it knows only this one, as threads do.
std::vector<Slots> machines_of(const options::RenderOptions& options, const Starting& starting);

// How the machines are asked whether they answer.
Question question_of(const options::RenderOptions& options, const Starting& starting);

}  // namespace mars::launch
