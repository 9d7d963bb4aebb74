// The launcher's questions about a start that is slow or has failed, to those who know machines, such as mars doctor.
#pragma once

#include <functional>
#include <string>

#include "host/shell/options/render_options.h"

namespace mars::launch {

// Each answer says in lines what is wrong with the surroundings for a run with these options.
struct Adviser {
  using Question = std::function<std::string(const options::RenderOptions& options)>;
  Question while_it_starts;  // asked on a thread of its own while the run is waited for: starts no program
  Question after_a_failed_start;
  // About all machines of the run, where it has others than this one: which do not reach each other ("": all do), and
  // on the next lines what else there is to say.
  Question about_machines;
};

}  // namespace mars::launch
