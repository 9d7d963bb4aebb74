// The pages that are open, as the studio sees them: what it sends them, and what it receives from them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "host/studio/importing/upload.h"
#include "host/studio/stage/stage.h"

namespace mars::web {

using studio::Json;
using studio::PageNumber;

class Pages {
 public:
  virtual ~Pages() = default;

  // Stage::kAllPages: all of them. A page that is gone hears nothing.
  virtual void tell(PageNumber page, const Json& message) = 0;
  virtual void show(studio::ViewPicture picture) = 0;
};

// Pages are numbered from 1, and no number comes twice.
struct PageListener {
  std::function<void(PageNumber page)> opened;
  std::function<void(PageNumber page, const Json& message)> received;  // an object with a text `do`
  std::function<void(PageNumber page)> closed;
  // A file that a page begins to send. Throws Failure where the studio does not wait for it.
  std::function<std::unique_ptr<studio::Upload>(const studio::UploadedFile& file)> uploaded = {};
};

}  // namespace mars::web
