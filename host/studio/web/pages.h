// The pages that are open, as the studio sees them: what it sends them, and what it receives from them.
#pragma once

#include <functional>

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
};

}  // namespace mars::web
