// Scripts (docs/motion.md) beside a film that is open: NAME.script in its folder.
#pragma once

#include <filesystem>

#include "host/studio/project/step.h"

namespace mars::studio {

class Scripts {
 public:
  // Files below `folder` alone are read and written.
  Scripts(const std::filesystem::path& film, std::filesystem::path folder);

  // Whole or not at all.
  void write(const ScriptStep& script) const;
  // Those that are short enough for a page to send them back, by their names ("scripts").
  Json list() const;

 private:
  std::filesystem::path beside_, folder_;
};

}  // namespace mars::studio
