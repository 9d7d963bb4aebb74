// A whole studio, without nodes and a network, to which pages send messages: what scripts of targets are about. Its
// files are in memory; whatever a script changed is as before when the next one begins.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/studio/project/project.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/json_edits.h"

namespace mars::fuzz {

using studio::Json;
using Messages = std::vector<Json>;

struct OpenFile {
  std::string name;                                        // which the studio opens
  std::vector<std::pair<std::string, std::string>> files;  // its own, and those that it names: name and text
};

class StudioPages {
 public:
  // Scripts are made of both; the studio takes the sound messages as they are, one after another.
  StudioPages(OpenFile file, const Messages& sound, const Messages& others = {});
  ~StudioPages();

  // A script names messages, each with changes, and which page sends it. The empty one sends the sound messages.
  // Throws Failure, the last refusal, where the studio refused something.
  void take(std::string_view script);

 private:
  class Open;

  void reopen();
  void send_all_sound();
  Json next_of(Script& script) const;

  OpenFile file_;
  Messages messages_;
  std::size_t sound_;  // of them, from the first on
  JsonEdits edits_;
  std::unique_ptr<Open> open_;
};

// Lines of JSON.
Messages messages_of(std::string_view lines);

// A film of a figure and a ball, whose figure can do all actions; and one of three joints with a shape of its own, as a
// film and as a model.
OpenFile figure_film();
OpenFile small_film();
OpenFile small_model();

}  // namespace mars::fuzz
