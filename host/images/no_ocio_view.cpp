#include "hal/failure/failure.h"
#include "host/images/display_view.h"

namespace mars::images {

std::shared_ptr<const DisplayView> open_view(const ViewWish& wish) {
  throw Failure("this MARS was built without OpenColorIO", wish.config,
                "install libopencolorio-dev (./bootstrap does) and build again, or leave out --ocio");
}

std::optional<std::string> view_library_version() { return std::nullopt; }

}  // namespace mars::images
