// Which machines a job is started on again: those that answer, with as many nodes as their slots are worth. Asked again
// before each start, so that a machine which comes back is used again.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "host/shell/launch/slots.h"

namespace mars::launch {

class Machines {
 public:
  // `all`: none where a job knows only the machine on which it is started; `nodes` render on all of them.
  Machines(std::vector<Slots> all, std::uint32_t nodes);

  // A job ended by this machine: it did not answer, or a process on it died. A machine that ends two jobs in a row
  // without a new frame is left out once though it answers; one that is lost is, too, unless another has ceased to
  // answer: what a dying machine says of its connections names those that live.
  void blame(const std::string& machine, bool lost, bool new_frames);

  std::vector<std::string> names() const;

  struct Choice {
    std::vector<Slots> use;  // in the order of all; the host is on the first
    std::uint32_t nodes = 0;
    std::vector<std::string> left_out;
  };
  // None of use: no machine answers. Of machines that answer but were blamed some are used if there are no others.
  Choice choose(const std::set<std::string>& answering);

 private:
  bool another_is_gone(const std::set<std::string>& answering) const;
  Choice without(const std::set<std::string>& answering, const std::string& blamed) const;

  std::vector<Slots> all_;
  std::uint32_t nodes_;
  std::string blamed_;              // by the last job
  bool lost_ = false;               // it did not answer the last job
  std::string left_out_;            // at the next start
  std::set<std::string> answered_;  // before the last start
};

}  // namespace mars::launch
