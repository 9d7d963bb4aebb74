// `mars doctor`: looks the surroundings over, really starts a tiny job, and says what to do about each trouble;
// in a Slurm job on all of its machines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host/shell/launch/launch.h"

namespace mars::doctor {

struct DoctorOptions {
  std::uint32_t nodes = 0;    // 0: as mars render without --nodes
  bool this_machine = false;  // only facts, as lines for the doctor that asked
  int reserved_cores = 0;     // that nodes leave to the host
  std::string version;        // of MARS
};

// Whether nothing is in trouble; prints everything on standard output. `self`: the running program's own file.
bool run_doctor(const DoctorOptions& options, const std::filesystem::path& self);

// What mars render prints when a start fails.
launch::Adviser adviser(const std::filesystem::path& self);

}  // namespace mars::doctor
