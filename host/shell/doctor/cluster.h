// All machines of a rendering, as the doctor of this machine finds them: what each says of itself, and what they are to
// each other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/shell/doctor/show.h"

namespace mars::doctor {

struct Cluster {
  std::vector<MachineFindings> machines;  // that answered
  std::vector<Finding> findings;          // about machines that did not, and about all together
  std::string cut_off;                    // which machines do not reach each other; "": all that answered do
};

// The machines of the hostfile, or of the batch job. None where a rendering would use this machine alone. `folder`:
// that they should share, absolute; "": it is not asked for. `self`: the running program's own file, the same on all
// machines. Throws Failure as launch::named_machines does.
std::optional<Cluster> look_at_machines(const std::string& hostfile, const std::string& folder,
                                        const std::filesystem::path& self);

}  // namespace mars::doctor
