// A text that is looked for by a process of its own, which is there from the beginning: while a job is waited for
// (host/child/child.h) programs are started by other processes only.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "host/child/descriptor.h"
#include "host/child/process.h"

namespace mars::launch {

class PreparedText {
 public:
  // `find` is called in a copy of this process, once begin() was called; where it fails, the text is why. The process
  // ends with this object or with the thread that made it.
  explicit PreparedText(const std::function<std::string()>& find);

  void begin() { asked_.writing.close(); }
  // Once it is whole; none before and after.
  std::optional<std::string> take();

 private:
  child::Pipe asked_;
  child::Descriptor text_;
  child::Process process_;
  bool taken_ = false;
};

}  // namespace mars::launch
