// What words of a command line change or read: a file, or what is open in the studio. And what they say to the person.
#pragma once

#include <filesystem>
#include <string>

#include "host/content/document/json_file.h"

namespace mars::editing {

class Edited {
 public:
  virtual ~Edited() = default;

  virtual std::filesystem::path path() const = 0;       // for messages, and of what is beside it
  virtual void create(const document::Json& json) = 0;  // refuses where there is one already

  virtual void remark(const std::string& line) = 0;  // what a person should know
  virtual void print(const std::string& text) = 0;   // what was asked for
};

}  // namespace mars::editing
