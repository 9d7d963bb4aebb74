#include "host/shell/launch/diagnosis.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <string_view>

#include "hal/failure/explain.h"
#include "host/child/child.h"
#include "host/shell/launch/losses.h"
#include "host/shell/launch/mpi_words.h"
#include "host/shell/launch/text_reader.h"

namespace mars::launch {

namespace {

constexpr std::size_t kShownWords = 40;  // lines of what is not understood

// The last `most` lines as one text.
std::string join(const std::deque<std::string>& lines, std::size_t most) {
  std::string text;
  const auto skipped = lines.size() - std::min(most, lines.size());
  for (auto line = lines.begin() + static_cast<std::ptrdiff_t>(skipped); line != lines.end(); ++line)
    text += *line + "\n";
  return text;
}

Failure failure_from(const events::Fault& fault) {
  const std::string again = fault.replay.empty() ? "" : "to see it again: " + fault.replay;
  const std::string remedy = fault.remedy.empty() || again.empty() ? fault.remedy + again : fault.remedy + "; " + again;
  return Failure(fault.problem, fault.where, remedy);
}

std::string machine_of(std::int32_t node, const std::optional<events::Booted>& booted) {
  if (booted)
    for (const events::Booted::Node& each : booted->nodes)
      if (each.node == node) return each.host;
  return "";
}

Diagnosis reported(const events::Fault& fault, const std::optional<events::Booted>& booted) {
  return {failure_from(fault), fault.node, fault.node ? machine_of(*fault.node, booted) : ""};
}

// "mars: ..." is how our programs report why they end.
std::optional<Failure> own_words(const std::deque<std::string>& lines) {
  for (const std::string& line : lines) {
    if (line.starts_with("mars: ")) return Failure(line.substr(6), "", "");
  }
  return std::nullopt;
}

// As mpirun does that was stopped and continued before it knew its daemons.
bool ended_as_if_done(const Remains& remains) { return remains.ending.well() && !remains.gave_reason(); }

Failure unknown(const Remains& remains) {
  const std::string program = std::filesystem::path(remains.program).stem().string();  // mpirun.mpich is one
  const std::string how = remains.ending.code == 0 ? " ended before all frames were there"
                                                   : " ended with exit code " + std::to_string(remains.ending.code);
  const std::string words = join(remains.last_words, kShownWords);
  return Failure(program + how, "", words.empty() ? "it gave no reason" : "its last words:\n" + words);
}

// The machine of which a starter speaks: "Node: n3", "ssh: connect to host n3 port 22: ...", "[proxy:0:1@n3] ..."; "":
// it names none.
std::string machine_in(const std::string& words) {
  for (const char* label : {"Node: ", "Local host: ", "ssh: connect to host ", "ssh: Could not resolve hostname "}) {
    TextReader line(words);
    if (!line.find(label)) continue;
    line.skip_space();
    const std::string name = line.word().value_or("");
    return name.substr(0, name.find(':'));
  }
  TextReader line(words);
  if (!line.find("[proxy:") || !line.find("@")) return "";
  const std::string name = line.word().value_or("");
  return name.substr(0, name.find(']'));
}

// "a machine does not have MARS's programs" becomes "machine n3: does not have MARS's programs".
Failure with_machine(const Failure& known, const std::string& words) {
  constexpr std::string_view kOne = "a machine ", kOther = "on another machine";
  const std::string machine = known.where.empty() ? machine_in(words) : "";
  if (machine.empty()) return known;
  std::string problem = known.problem;
  if (problem.starts_with(kOne)) problem.erase(0, kOne.size());
  if (problem.ends_with(kOther)) problem.replace(problem.size() - kOther.size(), kOther.size(), "there");
  return Failure(problem, "machine " + machine, known.remedy);
}

// Advice that fails does not hide the failure itself.
std::string text_of(const Advice& advice) try { return advice(); } catch (const child::Stopped&) {
  throw;
} catch (const std::exception& reason) {
  return reason_of(reason);
}

// The reason why it did not start is likely to be seen from here, too.
Failure with_advice(const Failure& failure, const Advice& advice) {
  if (!advice) return failure;
  std::string remedy = failure.remedy;
  const std::string more = text_of(advice);
  if (!more.empty()) remedy += (remedy.empty() || remedy.ends_with('\n') ? "" : "\n") + more;
  return Failure(failure.problem, failure.where, remedy);
}

// What the job itself reports comes before what its starter does, and a loss before what others say of it.
Diagnosis cause(const Remains& remains, const std::string& words, const std::optional<Loss>& loss,
                const Advice& advice) {
  if (remains.fault) return reported(*remains.fault, remains.booted);
  if (remains.is_cut_off()) return {Failure(remains.cut_off, "", kOpenPorts), {}};
  const auto advised = [&](const Failure& failure) { return remains.booted ? failure : with_advice(failure, advice); };
  if (!remains.ended_for.empty()) return {advised(Failure(remains.ended_for, "", "")), {}};
  if (const auto own = own_words(remains.last_words)) return {advised(*own), {}};
  if (loss && loss->machine_lost) return {loss->failure, {}, loss->machine, true};
  if (loss && loss->in_words) return {advised(with_machine(loss->failure, words)), loss->node, loss->machine};
  if (const auto known = meaning_of(words, remains.machines)) {
    const Failure found = with_machine(*known, words);
    const bool unnamed = found.where.empty() && found.problem.find("another machine") != std::string::npos;
    return {unnamed ? advised(found) : found, {}};
  }
  return {advised(loss ? loss->failure : unknown(remains)), {}};
}

}  // namespace

std::string way_to_go_on(const options::RenderOptions& options) {
  if (options.folder.empty()) return "";
  return options.overwrite ? "the same command without --overwrite goes on" : "the same command goes on";
}

Failure stopped(const Remains& remains, const options::RenderOptions& options) {
  return Failure("stopped by " + std::string(strsignal(remains.passed_on)) + " after " +
                     std::to_string(remains.brought()) + " of " + std::to_string(remains.progress.of()) + " frames",
                 options.folder, way_to_go_on(options));
}

Diagnosis diagnose(const Remains& remains, const options::RenderOptions& options, const Advice& advice) {
  if (remains.passed_on != 0) return {stopped(remains, options), {}};
  const std::string words = on_one_line(join(remains.last_words, remains.last_words.size()));
  const std::optional<Loss> loss = find_loss(remains, words);
  Diagnosis found = cause(remains, words, loss, advice);
  found.died = loss.has_value() || ended_as_if_done(remains);
  return found;
}

std::optional<std::uint32_t> frame_of_death(const Remains& remains, const Diagnosis& diagnosis) {
  if (remains.fault && remains.fault->frame) return static_cast<std::uint32_t>(*remains.fault->frame);
  if (!remains.drawing || !diagnosis.node) return std::nullopt;
  for (const events::Drawing::Node& each : remains.drawing->nodes)
    if (each.node == *diagnosis.node) return static_cast<std::uint32_t>(each.frame);
  return std::nullopt;
}

}  // namespace mars::launch
