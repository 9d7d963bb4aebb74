// A file on its way from a page to the studio.
#pragma once

#include <cstdint>
#include <string_view>

namespace mars::studio {

// As a page's request names it: which file of which import, and its length.
struct UploadedFile {
  std::uint32_t import, file;
  std::uint64_t bytes;
};

// Its bytes as they come. Gone without end(), the upload was cut.
class Upload {
 public:
  virtual ~Upload() = default;

  // Throw Failure where the file cannot be kept.
  virtual void take(std::string_view piece) = 0;
  virtual void end() = 0;
};

}  // namespace mars::studio
