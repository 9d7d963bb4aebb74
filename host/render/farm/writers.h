// Runs whose nodes write frames' files (node/wire/frame_writer.h). A group of nodes writes the frames that it draws if
// all its machines see the folder; the pictures of other groups go to the host, which composes and writes them.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/render/farm/group_work.h"
#include "node/wire/protocol.h"

namespace mars::farm {

struct Writing {
  std::vector<std::byte> orders;  // for the nodes
  // Whether nodes are to write, when all have greeted; none: they are.
  std::function<bool(std::span<const wire::Hello> nodes)> is_wanted;
  // Whether the host sees what the first node of a machine, which sees the folder, has made there. May wait.
  std::function<bool(const wire::Hello& first)> shares_folder;
  std::function<void(const wire::Written&)> written;  // a frame's file is there
};

// All nodes have the film and their orders. `sees_folder`: what each node says. Has groups
// write, and returns what a person should know of the others; "": all groups write, or none does and nobody said so.
std::string choose_writers(std::vector<GroupWork>& groups, std::span<const wire::Hello> nodes, const Writing& writing,
                           const std::function<bool(int node)>& sees_folder);

}  // namespace mars::farm
