// A serving host and its nodes as one process of the studio's: it starts them, watches them, and says in one line why
// they ended. That is launch's work, which waits; so a copy of this process does it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "host/child/command.h"
#include "host/child/process.h"
#include "host/shell/launch/command.h"
#include "host/shell/options/render_options.h"

namespace mars::studio {

// What hosts are started from, found once: programs are started to find it.
struct HostStart {
  options::RenderOptions options;  // with backend and number of nodes
  launch::Programs programs;
  launch::Surroundings surroundings;
};

// By the backend, nodes and hostfile of `options`; `self`: the running program's own file. The host is on this machine,
// whatever machines the hostfile names. Throws Failure where there is nothing to start.
HostStart prepare_host(options::RenderOptions options, const std::filesystem::path& self);

// The hostfile's machines as the job uses them: this one, named `here`, first. It has one slot, for the host, if the
// hostfile does not name it.
std::vector<launch::Slots> machines_from_here(std::vector<launch::Slots> machines, const std::string& here);

// That serves at this socket.
child::Command host_command(const HostStart& start, const std::string& socket);

// Starts the job in a copy of this process, which prints in one line why it ended, if it did not end well.
std::unique_ptr<child::Process> start_host_job(const child::Command& command, const options::RenderOptions& options,
                                               const child::ProcessSetup& setup);

}  // namespace mars::studio
