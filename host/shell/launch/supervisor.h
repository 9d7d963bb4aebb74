// Starts a rendering's job, and starts it again when it dies: on the machines that answer, for the frames that are
// missing, until all are there, until several jobs in a row brought no frame, or until starting again cannot help. Once
// a job has left the compiled film in the folder, all later ones render that, whatever becomes of the film's files. A
// frame that kills its nodes is set aside, tried once more by itself at the end, and reported.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/content/document/recorded_reads.h"
#include "host/shell/launch/deadly_frames.h"
#include "host/shell/launch/diagnosis.h"
#include "host/shell/launch/machines.h"
#include "host/shell/launch/restarts.h"
#include "host/shell/launch/wanted_frames.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

class Supervisor {
 public:
  // What it needs of the world.
  struct World {
    // One job to its end. `machines`: to be used instead of the options'; none: the options'.
    std::function<Remains(const options::RenderOptions& options, const std::vector<Slots>& machines)> run_job;
    // After a job died, whose host had this run in the folder, "" for none: clears away what it left, and gives the
    // number of frames that it had rendered, also those that it had not heard of; 0: that is not known.
    std::function<std::uint32_t(const std::string& run)> clear;
    // The machines of the job; none where it knows only this one.
    std::function<std::vector<Slots>()> machines;
    // Waits, and gives those of the machines that answer. Throws child::Stopped where a person stops it.
    std::function<std::set<std::string>(std::chrono::seconds pause, const std::vector<std::string>& machines)> ask;
    // How many of `frames` the folder has; none: it cannot be read here.
    std::function<std::optional<std::uint32_t>(const std::vector<std::uint32_t>& frames)> count;
    std::function<void(const std::string& line)> print;
    Advice advice;
  };

  // `options`: with nodes and backend settled.
  Supervisor(options::RenderOptions options, World world);

  // Returns when all frames asked for are there. Throws Failure where they are not.
  void render();

  std::uint32_t restarts() const { return restarts_.all(); }
  bool rendered() const { return rendered_; }  // not all was there before
  const WantedFrames& frames() const { return frames_; }
  const Remains& last() const { return last_; }  // job's

 private:
  void run_job(const options::RenderOptions& options);
  void count_frames();
  void look_for_frames();
  std::uint32_t lost() const { return last_.fault ? last_.fault->lost : 0; }  // frames, before the job ended
  std::string loss_text(std::uint32_t there) const;
  bool all_there() const;
  bool may_help() const;
  bool a_machine_is_gone();
  Failure failure(const std::string& more = "") const;
  void explain_death();
  void start_again();
  void refuse_edited_film() const;
  void choose_machines(std::chrono::seconds pause);
  std::set<std::string> ask(std::chrono::seconds pause, const std::vector<std::string>& machines) const;
  void print_choice() const;
  void try_alone(std::uint32_t frame);
  options::RenderOptions next_options() const;
  std::string account() const;  // "; 3 of 5 frames are there"; "" before any job has counted them

  const options::RenderOptions options_;
  const World world_;
  const document::FileStamp film_;  // when this began
  WantedFrames frames_;
  DeadlyFrames deadly_;
  Restarts restarts_;
  std::optional<Machines> machines_;  // once a job has died
  Machines::Choice chosen_;           // for the next job
  bool host_moved_ = false;           // to another machine, since frames were counted last
  Remains last_;
  std::uint32_t most_there_ = 0;  // frames, after any job
  bool advanced_ = false;         // more frames are there than ever before
  bool entered_ = false;          // some job did: the folder has its film
  bool booted_ = false;           // some job came so far
  bool rendered_ = false;         // some job brought a frame
};

}  // namespace mars::launch
