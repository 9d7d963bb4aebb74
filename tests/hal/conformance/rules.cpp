#include "tests/hal/conformance/rules.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <tuple>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

std::vector<Rule>& known() {
  static std::vector<Rule> all;
  return all;
}

std::string full_name(const Rule& rule) { return rule.topic() + "/" + rule.body; }

void expect_nothing_left() {
  if (iprobe(-1) == 0) return;
  throw Failure("it left a message of type " + std::to_string(infotype()) + " and " + std::to_string(infocount()) +
                    " bytes from " + std::to_string(infonode()),
                "", "");
}

void run_rule(const Rule& rule) try {
  rule.run();
  meet(expect_nothing_left);
} catch (const std::exception& broken) {
  const messages::Backend& backend = messages::process().backend();
  throw Failure(
      full_name(rule) + ": " + broken.what(),
      messages::rank_name(backend.rank(), backend.host()) + " of " + std::to_string(backend.nodes()) + " nodes", "");
}

}  // namespace

std::string Rule::topic() const { return std::filesystem::path(file).stem(); }

bool know(const Rule& rule) {
  known().push_back(rule);
  return true;
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> sorted = [] {
    std::vector<Rule> all = known();
    std::sort(all.begin(), all.end(), [](const Rule& a, const Rule& b) {
      return std::make_tuple(a.topic(), a.line) < std::make_tuple(b.topic(), b.line);
    });
    return all;
  }();
  return sorted;
}

void run_rules() {
  for (const Rule& rule : rules()) {
    if (is_host()) {
      std::printf("%2ld nodes: %s", numnodes(), full_name(rule).c_str());
      std::fflush(stdout);
    }
    const double begin = dclock();
    run_rule(rule);
    if (is_host()) std::printf(", %.0f ms\n", (dclock() - begin) * 1000);
  }
}

std::string table_of_rules() {
  std::string text =
      "# The rules of NX that tests check\n\n"
      "Each rule is one test body. A host and 1, 2, 3, 4, 7, 8, 16 and 32 nodes run it on every backend\n"
      "(`tests/hal/conformance/`, one file for each topic). The tests make this page, and compare it.\n";
  std::string topic;
  for (const Rule& rule : rules()) {
    if (rule.topic() != topic) {
      topic = rule.topic();
      text += "\n## " + topic + "\n\n| rule | body | failing case |\n|---|---|---|\n";
    }
    text += std::string("| ") + rule.rule + " | `" + rule.body + "` | " + rule.failing + " |\n";
  }
  return text;
}

}  // namespace mars::conformance
