#include "host/shell/launch/supervisor.h"

#include <algorithm>
#include <utility>

#include "host/child/child.h"
#include "host/content/document/text.h"

namespace mars::launch {
namespace {

constexpr int kTriesAlone = 2;  // of a frame that was set aside

// "machine n2: node 3 was killed by signal 9 (Killed)"
std::string what_happened(const Diagnosis& diagnosis) {
  const Failure& failure = diagnosis.failure;
  return failure.where.empty() ? failure.problem : failure.where + ": " + failure.problem;
}

}  // namespace

Supervisor::Supervisor(options::RenderOptions options, World world)
    : options_(std::move(options)),
      world_(std::move(world)),
      film_(document::stamp_of(options_.film)),
      frames_(options_.frames),
      restarts_(options_.restarts) {
  chosen_.nodes = options_.nodes;
}

void Supervisor::render() {
  run_job(options_);
  count_frames();
  while (!all_there()) {
    if (!may_help() && !a_machine_is_gone()) throw failure();
    explain_death();
    if (all_there()) break;
    start_again();
    run_job(next_options());
    count_frames();
  }
  for (const std::uint32_t frame : std::set(frames_.aside())) try_alone(frame);
  const std::vector<std::uint32_t> aside(frames_.aside().begin(), frames_.aside().end());
  if (!aside.empty())
    throw Failure("the nodes that drew " + film::frames_text(aside) + " were killed each time" + account(),
                  options_.folder, "please report it with the film");
}

void Supervisor::run_job(const options::RenderOptions& options) {
  last_ = world_.run_job(options, chosen_.left_out.empty() ? std::vector<Slots>() : chosen_.use);
  entered_ = entered_ || !last_.run.empty();
  booted_ = booted_ || last_.booted;
  rendered_ = rendered_ || !last_.taken.empty();
  if (!last_.well()) last_.recorded = world_.clear(last_.run);
}

// A job that did not come so far as to look into the folder says nothing.
void Supervisor::count_frames() {
  advanced_ = false;
  if (!last_.resumed && !last_.booted) return;
  const std::uint32_t there = last_.resumed ? last_.resumed->there : 0;
  frames_.set_count(last_.resumed ? last_.resumed->of : last_.progress.of());
  if (there < frames_.there()) world_.print(loss_text(there));
  host_moved_ = false;
  frames_.count(there, std::max(static_cast<std::uint32_t>(last_.taken.size()) - lost(), last_.recorded));
  if (frames_.complete() && !last_.well()) look_for_frames();
  advanced_ = frames_.there() > most_there_;
  most_there_ = std::max(most_there_, frames_.there());
}

// A job that did not end well has not looked whether all that it had is there still.
void Supervisor::look_for_frames() {
  if (const auto there = world_.count(frames_.next().first_frames(frames_.of()))) frames_.count(*there, 0);
}

// A host that fails after the last frame, though no node is to blame, could not record what it has rendered.
bool Supervisor::all_there() const {
  const bool host_failed = last_.fault && !last_.fault->node;
  return last_.well() || (frames_.complete() && !host_failed);
}

std::string Supervisor::loss_text(std::uint32_t there) const {
  const std::string reason = host_moved_
                                 ? "do all machines see the folder " + options_.folder + "?"
                                 : "others were removed from " + options_.folder + ", or it has another film now";
  return "only " + std::to_string(there) + " of " + std::to_string(frames_.there()) +
         " frames are there still: " + reason;
}

// Not where a person stopped it, and not where the film, the folder or the command line is the reason. A job whose like
// has never begun would end as it did, unless something died or somebody ended it.
bool Supervisor::may_help() const {
  if (last_.passed_on != 0 || options_.restarts == 0 || options_.sink == options::SinkKind::none) return false;
  if (options_.backend == options::Backend::simulated || last_.is_cut_off()) return false;
  if (diagnose(last_, options_, {}).died) return true;
  if (last_.fault) return booted_ && (last_.fault->node || lost() > 0);
  return booted_ || !last_.ended_for.empty();
}

// Then even a job that has never begun may begin without it.
bool Supervisor::a_machine_is_gone() {
  if (last_.passed_on != 0 || options_.restarts == 0 || last_.fault || booted_ || last_.is_cut_off()) return false;
  const std::vector<std::string> names = Machines(world_.machines(), 1).names();
  return !names.empty() && ask(std::chrono::seconds(0), names).size() < names.size();
}

Failure Supervisor::failure(const std::string& more) const {
  const Failure found = diagnose(last_, options_, world_.advice).failure;
  if (last_.passed_on != 0 || restarts_.all() == 0) return found;
  return Failure(found.problem + more + account(), found.where, found.remedy);
}

std::string Supervisor::account() const {
  if (frames_.of() == 0) return "";
  return "; " + std::to_string(frames_.there()) + " of " + std::to_string(frames_.of()) + " frames are there";
}

void Supervisor::explain_death() {
  const Diagnosis diagnosis = diagnose(last_, options_, {});
  world_.print(what_happened(diagnosis));
  const auto frame = frame_of_death(last_, diagnosis);
  if (!frame || !diagnosis.node || !deadly_.count_death(*frame, *diagnosis.node)) return;
  frames_.set_aside(*frame);
  world_.print("frame " + std::to_string(*frame) + " killed the nodes that drew it: it is set aside");
}

// Until a job has left its compiled film in the folder, the next would compile what has become of the file.
void Supervisor::refuse_edited_film() const {
  if (options_.kept_film || entered_ || document::stamp_of(options_.film) == film_) return;
  throw Failure("has changed since this command began, and no job has kept it compiled yet", options_.film,
                "the same command renders what it is now");
}

void Supervisor::start_again() {
  refuse_edited_film();
  const Diagnosis diagnosis = diagnose(last_, options_, {});
  const auto pause = restarts_.again(advanced_);
  if (!pause)
    throw failure("; gave up after " + document::counted(restarts_.most(), "restart") + " without a new frame");
  if (!machines_) machines_.emplace(world_.machines(), options_.nodes);
  machines_->blame(diagnosis.machine, diagnosis.machine_lost, advanced_);
  choose_machines(*pause);
  print_choice();
}

void Supervisor::choose_machines(std::chrono::seconds pause) {
  const std::vector<std::string> names = machines_ ? machines_->names() : std::vector<std::string>();
  const std::set<std::string> answering = ask(pause, names);
  if (names.empty()) return;
  const std::string host_before = chosen_.use.empty() ? names.front() : chosen_.use.front().host;
  chosen_ = machines_->choose(answering);
  if (chosen_.use.empty())
    throw Failure("none of the machines answers: " + document::joined(names) + account(), options_.folder,
                  "check their names, and that ssh NAME true works; the same command goes on then");
  const std::string& host = chosen_.use.front().host;
  if (host == host_before) return;
  host_moved_ = true;
  world_.print("the host runs on " + host + " now, no more on " + host_before + ": both must see the folder " +
               options_.folder);
}

std::set<std::string> Supervisor::ask(std::chrono::seconds pause, const std::vector<std::string>& machines) const try {
  return world_.ask(pause, machines);
} catch (const child::Stopped& stop) {
  throw Failure(stop.problem + " before the job was started again" + account(), options_.folder,
                way_to_go_on(options_));
}

void Supervisor::print_choice() const {
  std::string line = "starting again (" + std::to_string(restarts_.number()) + " of " +
                     std::to_string(restarts_.most()) + ") with " + document::counted(chosen_.nodes, "node");
  if (!chosen_.use.empty()) line += " on " + document::counted(chosen_.use.size(), "machine");
  if (!chosen_.left_out.empty()) line += ", without " + document::joined(chosen_.left_out);
  world_.print(line + account());
}

options::RenderOptions Supervisor::next_options() const {
  options::RenderOptions next = options_;
  next.nodes = chosen_.nodes;
  next.frames = frames_.next();
  next.kept_film = options_.kept_film || entered_;
  next.overwrite = options_.overwrite && !entered_;  // what was there before is gone since
  return next;
}

// In jobs of its own: where several nodes died at this frame by chance, it is there then.
void Supervisor::try_alone(std::uint32_t frame) {
  for (int tries = 0; tries < kTriesAlone && (tries == 0 || may_help()); ++tries) {
    const auto pause = restarts_.again(!last_.taken.empty());
    if (!pause) return;
    world_.print("frame " + std::to_string(frame) + " is tried by itself");
    choose_machines(*pause);
    options::RenderOptions alone = next_options();
    alone.frames = film::FrameSet(std::vector{frame});
    alone.report = alone.trace = "";  // of the film, not of one frame
    run_job(alone);
    if (last_.passed_on != 0) throw failure();
    if (last_.well()) return frames_.take_back(frame);
  }
}

}  // namespace mars::launch
