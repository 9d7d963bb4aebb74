// Sound messages of JSON, changed by a script (edits.h): values, keys and places of the message's tree, so that what
// comes out has the form that its reader expects, nearly.
#pragma once

#include <string>
#include <vector>

#include "host/content/document/json_file.h"
#include "tests/fuzz/edits.h"

namespace mars::fuzz {

class JsonEdits {
 public:
  // `sound`: messages whose words may stand in one another.
  explicit JsonEdits(const std::vector<document::Json>& sound);

  // One change of the message, somewhere in it.
  void edit(document::Json& message, Script& script) const;

 private:
  document::Json other_value(const document::Json& value, Script& script) const;
  std::string other_text(const std::string& text, Script& script) const;
  const std::string& word(Script& script) const { return words_[script.below(words_.size())]; }

  std::vector<std::string> words_;  // keys and texts of the sound messages
};

// Text without bytes that are not UTF-8.
std::string text_of(const document::Json& message);

}  // namespace mars::fuzz
