// Messages of Open MPI on standard error whose cause is known and has a remedy. docs/doctor.md lists them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure/failure.h"
#include "host/shell/launch/slots.h"

namespace mars::launch {

// The remedy for machines that cannot reach each other.
inline constexpr const char* kOpenPorts =
    "open the ports between the machines, or name their network: export OMPI_MCA_btl_tcp_if_include=eth0 "
    "OMPI_MCA_oob_tcp_if_include=eth0";

struct MpiWords {
  std::string_view words;  // as Open MPI writes them, on one line
  const char* problem;
  const char* remedy;
};

// Nearest to the cause first.
std::span<const MpiWords> mpi_words();

// The first of them that `text` holds, wherever its lines are broken; with the machine, program and library that it
// names. `machines`: of the job, in the order of its ranks; none: not known.
std::optional<Failure> meaning_of(const std::string& text, const std::vector<Slots>& machines = {});

}  // namespace mars::launch
