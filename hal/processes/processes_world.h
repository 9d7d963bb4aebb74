// A C program's job of processes over shared memory, which another process started (job.h); or of one node,
// this one.
#pragma once

#include <memory>
#include <string>

#include "hal/messages/world.h"
#include "hal/processes/place.h"
#include "hal/processes/processes_backend.h"
#include "hal/processes/segment.h"

namespace mars::processes {

class ProcessesWorld : public messages::World {
 public:
  explicit ProcessesWorld(const Place& place);
  // One node alone.
  ProcessesWorld();

  messages::Backend& backend() override { return *backend_; }
  bool is_host() const override { return place_.socket >= 0; }
  void leave(int code) override;
  [[noreturn]] void fail(const std::string& reason) override;

  int all_nodes() const override { return segment_.nodes(); }
  void resize(int nodes) override;
  void begin() override;
  void load(const std::string& file, int node) override;
  void kill(int node) override;
  Status status(int node) override;
  void wait_for_end() override;

 private:
  int ask(JobRequest::What what, int node, const std::string& file);

  Segment segment_;
  const Place place_;
  Slot& slot_;
  std::unique_ptr<ProcessesBackend> backend_;
  bool begun_ = false;
};

}  // namespace mars::processes
