// A contact sheet: pictures of one size in rows, each with its frame's number beneath.
#pragma once

#include <cstdint>
#include <vector>

#include "host/preview/pictures.h"

namespace mars::preview {

struct SheetPicture {
  std::uint32_t frame;
  SharedImage image;
};

// `columns` 0: about as many as rows. Throws Failure where the sheet would be larger than a picture can be.
images::Image contact_sheet(const std::vector<SheetPicture>& pictures, std::uint32_t columns);

}  // namespace mars::preview
