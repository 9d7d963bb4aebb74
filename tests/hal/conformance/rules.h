// The rules of NX as tests, written once for all backends. A rule is a body that every rank of a world runs, host and
// nodes alike; all rules run one after the other in one world, at several numbers of nodes. To add one is to write
//
//   RULE(zero_length, "a message may be empty", "a receive of no bytes does not take a longer one") { ... }
//
// in the file of its topic. A body receives every message it sends; what it expects it says by expect.h, so that a
// rank that finds a rule broken throws, and ends the world, whatever the backend. State of handlers lies in arrays by
// rank, for ranks may be threads of one process.
#pragma once

#include <string>
#include <vector>

namespace mars::conformance {

struct Rule {
  const char* file;
  int line;
  const char* body;
  const char* rule;
  const char* failing;  // what is not done or must fail

  void (*run)();

  std::string topic() const;  // its file's name, "typesel"
};

// By topic, then in the order of the file: the same on all ranks.
const std::vector<Rule>& rules();

// Every rank of a world calls it. Runs all rules; throws a Failure that names the first one broken on this rank. The
// host prints which one runs and how long it took.
void run_rules();

// The page of all rules, as Markdown.
std::string table_of_rules();

// Returns true.
bool know(const Rule& rule);

#define RULE(body, rule, failing)                                                                       \
  void body();                                                                                          \
  [[maybe_unused]] const bool body##_is_known = know({__FILE__, __LINE__, #body, rule, failing, body}); \
  void body()

}  // namespace mars::conformance
