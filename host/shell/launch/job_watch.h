// What the silence of a job means: of its nodes, of its host, of an end that does not come. All times are observed
// ones.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/render/events/events.h"
#include "host/shell/launch/observed_time.h"

namespace mars::launch {

class JobWatch {
 public:
  using Clock = ObservedTime::Clock;

  static constexpr std::chrono::seconds kNamed{10};         // of silence, until a person learns who is silent
  static constexpr std::chrono::seconds kHostHangs{30};     // of the host's silence, until the job is ended
  static constexpr std::chrono::seconds kNobodyBoots{120};  // until a job whose nodes do not all come is ended
  static constexpr std::chrono::seconds kLastWord{10};      // from the host's last word to the job's end

  explicit JobWatch(Clock::time_point start) : time_(start) {}

  void hear(const events::Event& event);

  struct Findings {
    std::vector<std::string> lines;  // for the person, each once for each silence
    std::string end;                 // why the job must be ended; "": it may go on
  };
  Findings look(Clock::time_point now);

 private:
  Clock::duration since(Clock::duration moment) const { return time_.passed() - moment; }
  void hear_nodes(const events::Beat& beat);

  ObservedTime time_;
  Clock::duration heard_{};          // when the host was heard last
  Clock::duration waiting_since_{};  // for nodes
  bool beats_ = false;               // it has sent one: from then on its silence means something
  bool loading_ = false;
  bool booted_ = false;
  bool last_word_ = false;   // done or fault: nothing more is to come
  bool host_named_ = false;  // in this silence
  std::string host_doing_;
  std::set<std::int32_t> silent_;   // nodes that were named and have not been heard since
  std::vector<std::string> lines_;  // to be printed at the next look
};

}  // namespace mars::launch
