#include "host/render/farm/writers.h"

#include <algorithm>
#include <set>

#include "host/render/farm/engine.h"

namespace mars::farm {
namespace {

constexpr std::size_t kNamed = 4;  // machines in a warning, at most

// "n2", "n2 and n3", "n2, n3, n4, n5 and 12 other machines".
std::string list_of(const std::set<std::string>& machines) {
  std::string list;
  std::size_t named = 0;
  for (const std::string& machine : machines) {
    if (named == kNamed) return list + " and " + std::to_string(machines.size() - named) + " other machines";
    const bool is_last = named + 1 == machines.size();
    if (named > 0) list += is_last ? " and " : ", ";
    list += machine;
    ++named;
  }
  return list;
}

std::string warning_of(const std::set<std::string>& machines, std::size_t writing, std::size_t groups,
                       bool any_machine_sees) {
  std::string text = list_of(machines) + (machines.size() == 1 ? " does" : " do") +
                     " not see the folder of frames as the host does: the host composes and writes ";
  if (writing > 0)
    return text + "the frames of " + std::to_string(groups - writing) + " of the " + std::to_string(groups) +
           " groups of nodes, which have nodes there";
  text += "all frames";
  return any_machine_sees ? text + ", for every group of nodes has nodes there; see --groups" : text;
}

}  // namespace

std::string choose_writers(std::vector<GroupWork>& groups, std::span<const wire::Hello> nodes, const Writing& writing,
                           const std::function<bool(int node)>& sees_folder) {
  std::vector<bool> sees(nodes.size());
  std::set<std::string> unseeing;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const wire::Hello& hello = nodes[node];
    const bool is_first = hello.machine == hello.node;
    sees[node] = sees_folder(hello.node) &&
                 (is_first ? writing.shares_folder(hello) : sees[static_cast<std::size_t>(hello.machine)]);
    if (!sees[node]) unseeing.insert(hello.host.data());
  }
  std::size_t write = 0;
  for (GroupWork& work : groups) {
    const auto first = sees.begin() + work.group().first;
    if (std::find(first, first + work.group().count, false) != first + work.group().count) continue;
    work.let_nodes_write();
    Engine::send(work.group(), wire::kWrite, {});
    ++write;
  }
  const bool any_sees = std::ranges::find(sees, true) != sees.end();
  if (write == groups.size() || (write == 0 && writing.is_wanted)) return "";
  return warning_of(unseeing, write, groups.size(), any_sees);
}

}  // namespace mars::farm
