// `mars doctor`: looks the surroundings over, really starts a tiny job, and says what to do about each trouble;
// with a hostfile or in a batch job on all machines, and between them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host/shell/launch/launch.h"

namespace mars::doctor {

struct DoctorOptions {
  std::uint32_t nodes = 0;    // 0: as mars render without --nodes
  std::string hostfile{};     // of the machines; "": those of the batch job, or this one
  std::string folder{};       // that they should share; "": the current one
  bool this_machine = false;  // answers the doctor of another machine
  std::string own_name{};     // by which that doctor knows this machine; "": Slurm's or its own
  std::string token{};        // the file that is there if this machine sees the other's folder
  int reserved_cores = 0;     // that nodes leave to the host
  std::string version;        // of MARS
};

// Whether nothing is in trouble; prints everything on standard output. `self`: the running program's own file.
bool run_doctor(const DoctorOptions& options, const std::filesystem::path& self);

// What mars render prints when a start fails.
launch::Adviser adviser(const std::filesystem::path& self);

}  // namespace mars::doctor
