// What people type: the input's first word names the reader, the rest is its text.
#include <algorithm>
#include <map>
#include <string>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/content/document/shell_line.h"
#include "host/content/document/shell_word.h"
#include "host/content/film/frame_set.h"
#include "host/images/frame_names.h"
#include "host/images/picture_format.h"
#include "host/images/picture_size.h"
#include "host/shell/launch/command.h"
#include "host/shell/launch/mpi_words.h"
#include "host/shell/options/render_options.h"
#include "host/cli/wrapped.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::option_values {
namespace {

using Reader = void (*)(const std::string&);

void read_frames(const std::string& text) {
  const film::FrameSet set(text);
  set.of_film(500);
  film::FrameSet(set.text());
}

void read_names(const std::string& text) {
  const images::FrameNames names{images::frame_pattern(text), 7};
  check(images::frame_pattern(names.pattern) == names.pattern, "a pattern is one");
  check(images::frame_of_name(names, images::frame_name(names, 300, 500), 500) == 300, "a name says its frame");
}

void read_shell_words(const std::string& text) {
  const std::vector<std::string> words = document::shell_words(text);
  if (!std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; })) return;
  std::string line;
  for (const std::string& word : words) line += document::shell_word(word) + " ";
  check(document::shell_words(line) == words, "words come through a shell");
}

const std::map<std::string, Reader, std::less<>>& readers() {
  static const std::map<std::string, Reader, std::less<>> table{
      {"frames", read_frames},
      {"names", read_names},
      {"size", [](const std::string& text) { images::read_picture_size(text); }},
      {"range", [](const std::string& text) { animator::read_frame_range(text); }},
      {"frame", [](const std::string& text) { animator::read_frame(text); }},
      {"ease", [](const std::string& text) { animator::read_typed_ease(text); }},
      {"format", [](const std::string& text) { images::picture_format_of(text); }},
      {"tasks", [](const std::string& text) { launch::tasks_of_machines(text); }},
      {"words", [](const std::string& text) { launch::meaning_of(text); }},
      {"shell", read_shell_words},
      {"file", [](const std::string& text) { options::word_of_file(text); }},
      {"wrapped", [](const std::string& text) { cli::wrapped(text, 8, 40); }},
  };
  return table;
}

}  // namespace

void take(std::string_view input) {
  const std::size_t end = std::min(input.find(' '), input.size());
  const auto reader = readers().find(input.substr(0, end));
  const std::string text(input.substr(std::min(end + 1, input.size())));
  if (reader != readers().end()) return reader->second(text);
  for (const auto& [name, read] : readers()) read(text);
}

const Target target("option_values", Form::text, take);

}  // namespace mars::fuzz::option_values
