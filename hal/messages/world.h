// The job that a C program belongs to, as hal/program/ needs it: made of forked
// processes (hal/processes/), of MPI's ranks (hal/mpi/), or of one node alone.
#pragma once

#include <string>

#include "hal/messages/backend.h"

namespace mars::messages {

class World {
 public:
  virtual ~World() = default;

  // This rank's; where the host calls, its cube's size is settled.
  virtual Backend& backend() = 0;
  virtual bool is_host() const = 0;
  // The orderly end of this rank, whose program ends with `code`; messages it has sent can still be received.
  virtual void leave(int code) = 0;
  // Ends this rank, and every other at its next call; prints `reason` unless it is another rank's failure,
  // which that rank prints.
  [[noreturn]] virtual void fail(const std::string& reason) = 0;

  // For the host. Failures say what and the remedy; the caller adds where.

  // How many nodes there are, of which the first backend().nodes() are the cube.
  virtual int all_nodes() const = 0;
  // Makes the first `nodes` of them the cube. No node may run.
  virtual void resize(int nodes) = 0;
  // Lets the nodes begin with what they were started for, where the host has loaded nothing.
  virtual void begin() = 0;
  // Starts a program on a node of the cube.
  virtual void load(const std::string& file, int node) = 0;
  // Ends what runs on `node`; -1: on all nodes, and throws away all messages between them and to them.
  virtual void kill(int node) = 0;

  enum class State { nothing, running, ended };
  struct Status {
    State state;
    int code;  // of an ended one; minus the signal for one that died of it
  };
  virtual Status status(int node) = 0;
  // Sleeps until the status of some node may be another, or a moment has passed.
  virtual void wait_for_end() = 0;
};

}  // namespace mars::messages
