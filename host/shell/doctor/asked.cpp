#include "host/shell/doctor/asked.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "host/child/environment.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/shell/doctor/answers.h"

namespace mars::doctor {
namespace {

constexpr unsigned kLongestVisit = 60;  // seconds
constexpr std::size_t kShownDigits = 8;
constexpr std::chrono::seconds kPatience{3};  // until packets count as dropped

// Slurm names the machine as its list of machines does.
std::string own_name(const DoctorOptions& options, const Facts& facts) {
  if (!options.own_name.empty()) return options.own_name;
  return child::own_environment().value("SLURMD_NODENAME").value_or(facts.host);
}

std::string build_of(const DoctorOptions& options, const launch::Programs& programs) {
  if (!programs.node) return "MARS " + options.version + " without mars-node";
  const std::string program = document::read_file(*programs.node);
  return "MARS " + options.version + ", mars-node " +
         document::checksum_of(std::as_bytes(std::span(program))).substr(0, kShownDigits);
}

}  // namespace

void answer_doctor(const DoctorOptions& options, const std::filesystem::path& self) {
  alarm(kLongestVisit);
  const Door door;
  Facts facts = gather_facts(self, options.nodes, launch::Ask::programs);
  if (facts.slurm) facts.slurm->tasks = 0;  // they are those of this visit
  const Presence presence{{own_name(options, facts), own_addresses(), door.port()},
                          build_of(options, facts.programs),
                          facts.memory,
                          !options.token.empty() && document::file_exists(options.token)};
  const std::string& name = presence.peer.host;
  std::cout << lines_of({name, check_machine(facts)}) << line_of(presence) << std::flush;
  std::string line;
  std::getline(std::cin, line);
  auto others = read_peers(line);
  if (!others) return;
  std::cout << clock_line(name, std::chrono::system_clock::now()) << std::flush;
  std::erase_if(*others, [&](const Peer& each) { return each.host == name; });
  std::cout << line_of(name, knock(*others, kPatience)) << std::flush;
  while (std::getline(std::cin, line)) {  // others may still knock here
  }
}

}  // namespace mars::doctor
