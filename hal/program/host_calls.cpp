#include <cerrno>
#include <charconv>
#include <cstddef>
#include <string>
#include <vector>

#include "hal/messages/call_failure.h"
#include "hal/nx/guard.h"
#include "hal/nx/nx_host.h"
#include "hal/nx/pid.h"
#include "hal/program/program.h"

namespace mars::program {
namespace {

struct HeldCube {
  bool held = false;
  std::string name;
  std::string type;
  std::vector<bool> reported;  // by node: waitone or waitall has reported its end
};
HeldCube cube;

std::vector<bool>::reference reported(int node) {
  if (cube.reported.empty()) cube.reported.resize(static_cast<std::size_t>(world().all_nodes()));
  return cube.reported[static_cast<std::size_t>(node)];
}

[[noreturn]] void fail(const char* call, int code, const std::string& what, const std::string& remedy) {
  if (!world().is_host()) messages::process().fail(call, code, what, remedy);
  throw messages::CallFailure(code, what, std::string("the host, ") + call, remedy);
}

void check_host(const char* call) {
  if (world().is_host()) return;
  fail(call, EQNODE, "this is the host's call",
       "start this program as the host: mars-nx run ./host ./node, or mars-nx run --host ./host");
}

void check_pid(const char* call, long pid) {
  if (pid != 0 && pid != -1)
    fail(call, EQPID, "there is no pid " + std::to_string(pid), "every node runs one process, pid 0");
}

struct Nodes {
  int first;
  int last;
};

Nodes check_nodes(const char* call, long node, long pid) {
  check_pid(call, pid);
  const int nodes = world().backend().nodes();
  if (node == -1) return {0, nodes};
  if (node < 0 || node >= nodes)
    fail(call, EQNODE, "there is no node " + std::to_string(node),
         "nodes are 0 to " + std::to_string(nodes - 1) + ", -1 is all");
  return {static_cast<int>(node), static_cast<int>(node) + 1};
}

std::string check_name(const char* call, const char* name) {
  const std::string text = name == nullptr ? "" : name;
  if (text.size() >= NAMELEN)
    fail(call, EINVAL, "\"" + text + "\" is too long for a cube's name",
         "use at most " + std::to_string(NAMELEN - 1) + " characters");
  return text;
}

// Failures of the world do not know the call.
template <class Work>
void on_world(const char* call, int code, Work work) try {
  work();
} catch (const Failure& failure) {
  fail(call, code, failure.where.empty() ? failure.problem : failure.where + ": " + failure.problem, failure.remedy);
}

// "8" or "d3"; what follows, which named memory and processors, is ignored.
int nodes_of(const char* call, const std::string& type, int all) {
  if (type.empty()) return all;
  const bool dimension = type[0] == 'd';
  int number = -1;
  std::from_chars(type.data() + dimension, type.data() + type.size(), number);
  if (number < !dimension || number > (dimension ? 20 : 1 << 20))
    fail(call, EINVAL, "\"" + type + "\" is no type of a cube", "give the number of nodes, as \"8\" or \"d3\"");
  const int nodes = dimension ? 1 << number : number;
  if (nodes <= all) return nodes;
  fail(call, EQNODE, "a cube of " + std::to_string(nodes) + " nodes is asked for, and there are " + std::to_string(all),
       "start the job with more: mars-nx run --nodes " + std::to_string(nodes));
}

void get_cube(const char* call, const char* name, const char* type) {
  check_host(call);
  const std::string text = check_name(call, name);
  const std::string kind = type == nullptr ? "" : type;
  const int nodes = nodes_of(call, kind, world().all_nodes());
  if (cube.held) fail(call, EBUSY, "the cube " + cube.name + " is held already", "relcube it first");
  on_world(call, EBUSY, [&] { world().resize(nodes); });
  renew_process();
  cube = {true, text, kind, {}};
}

void attach_cube(const char* call, const char* name) {
  check_host(call);
  const std::string text = check_name(call, name);
  if (!cube.held) cube = {true, text, "", {}};
  if (text != cube.name) fail(call, EINVAL, "there is no cube " + text, "the cube that is held is " + cube.name);
}

void kill_all() {
  world().kill(-1);
  renew_process();
  cube.reported.clear();
}

void release_cube(const char* call, const char* name) {
  check_host(call);
  const std::string text = check_name(call, name);
  if (!cube.held || (!text.empty() && text != cube.name))
    fail(call, EINVAL, "there is no cube " + text, "getcube or attachcube comes first");
  kill_all();
  cube = {};
}

void set_pid(const char* call, long pid) {
  if (pid < 0 || (pid > 0 && !world().is_host()))
    fail(call, EQPID, "pid " + std::to_string(pid) + " cannot be had",
         world().is_host() ? "the host's pid is 0 or more" : "a node's pid is 0");
  nx::own_pid = pid;
}

void load_nodes(const char* call, const char* file, long node, long pid) {
  check_host(call);
  if (file == nullptr) fail(call, EQPBUF, "the program's name is a null pointer", "give the path of a program");
  const Nodes nodes = check_nodes(call, node, pid);
  for (int each = nodes.first; each < nodes.last; ++each) {
    on_world(call, ENOENT, [&] { world().load(file, each); });
    reported(each) = false;
  }
}

// The first of them that has ended and was not reported yet, or -1; fails where none ever will.
int ended_one(const char* call, const Nodes& nodes) {
  bool some = false;
  for (int node = nodes.first; node < nodes.last; ++node) {
    const messages::World::State state = world().status(node).state;
    if (reported(node) || state == messages::World::State::nothing) continue;
    if (state == messages::World::State::ended) return node;
    some = true;
  }
  if (!some) fail(call, ECHILD, "nothing runs there that could end", "load a program first; each end is reported once");
  return -1;
}

int wait_one(const char* call, const Nodes& nodes) {
  world().begin();
  int node = -1;
  while ((node = ended_one(call, nodes)) < 0) world().wait_for_end();
  reported(node) = true;
  return node;
}

void wait_all(const char* call, long node, long pid) {
  check_host(call);
  const Nodes nodes = check_nodes(call, node, pid);
  world().begin();
  for (int each = nodes.first; each < nodes.last; ++each) {
    while (world().status(each).state == messages::World::State::running) world().wait_for_end();
    reported(each) = true;
  }
}

void wait_one(const char* call, long node, long pid, long* cnode, long* cpid, long* ccode) {
  check_host(call);
  const int ended = wait_one(call, check_nodes(call, node, pid));
  if (cnode != nullptr) *cnode = ended;
  if (cpid != nullptr) *cpid = 0;
  if (ccode != nullptr) *ccode = world().status(ended).code;
}

void kill_nodes(const char* call, long node, long pid, bool flush) {
  check_nodes(call, node, pid);
  if (!world().is_host())
    world().fail("node " + std::to_string(world().backend().rank()) + " has ended all by " + call);
  if (node == -1 && flush) return kill_all();
  const Nodes nodes = check_nodes(call, node, pid);
  for (int each = nodes.first; each < nodes.last; ++each) world().kill(each);
}

long list_cubes(const char* call, cubetable* table, long slots) {
  if (!cube.held) return 0;
  if (slots > 0 && table == nullptr) fail(call, EQPBUF, "the table is a null pointer", "give an array for the cubes");
  if (slots > 0) {
    *table = {};
    cube.name.copy(table->cubename, NAMELEN - 1);
    cube.type.copy(table->cubetype, NAMELEN - 1);
    table->nodes = world().backend().nodes();
  }
  return 1;
}

}  // namespace
}  // namespace mars::program

using namespace mars::program;

extern "C" {

void getcube(const char* name, const char* cubetype, const char*, long) {
  mars::nx::plain([&] { get_cube("getcube", name, cubetype); });
}
void attachcube(const char* name) {
  mars::nx::plain([&] { attach_cube("attachcube", name); });
}
void relcube(const char* name) {
  mars::nx::plain([&] { release_cube("relcube", name); });
}
void setpid(long pid) {
  mars::nx::plain([&] { set_pid("setpid", pid); });
}
void load(const char* file, long node, long pid) {
  mars::nx::plain([&] { load_nodes("load", file, node, pid); });
}
void waitall(long node, long pid) {
  mars::nx::plain([&] { wait_all("waitall", node, pid); });
}
void waitone(long node, long pid, long* cnode, long* cpid, long* ccode) {
  mars::nx::plain([&] { wait_one("waitone", node, pid, cnode, cpid, ccode); });
}
void killproc(long node, long pid) {
  mars::nx::plain([&] { kill_nodes("killproc", node, pid, false); });
}
void killcube(long node, long pid) {
  mars::nx::plain([&] { kill_nodes("killcube", node, pid, true); });
}
long cubeinfo(cubetable table[], long slots, long) {
  return mars::nx::plain([&] { return list_cubes("cubeinfo", table, slots); });
}

long _getcube(const char* name, const char* cubetype, const char*, long) {
  return mars::nx::twin([&] { get_cube("getcube", name, cubetype); });
}
long _attachcube(const char* name) {
  return mars::nx::twin([&] { attach_cube("attachcube", name); });
}
long _relcube(const char* name) {
  return mars::nx::twin([&] { release_cube("relcube", name); });
}
long _setpid(long pid) {
  return mars::nx::twin([&] { set_pid("setpid", pid); });
}
long _load(const char* file, long node, long pid) {
  return mars::nx::twin([&] { load_nodes("load", file, node, pid); });
}
long _waitall(long node, long pid) {
  return mars::nx::twin([&] { wait_all("waitall", node, pid); });
}
long _waitone(long node, long pid, long* cnode, long* cpid, long* ccode) {
  return mars::nx::twin([&] { wait_one("waitone", node, pid, cnode, cpid, ccode); });
}
long _killproc(long node, long pid) {
  return mars::nx::twin([&] { kill_nodes("killproc", node, pid, false); });
}
long _killcube(long node, long pid) {
  return mars::nx::twin([&] { kill_nodes("killcube", node, pid, true); });
}
long _cubeinfo(cubetable table[], long slots, long) {
  return mars::nx::twin([&] { return list_cubes("cubeinfo", table, slots); });
}

}  // extern "C"
