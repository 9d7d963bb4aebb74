// What making frames' files takes, counted: for reports, simulations and forecasts.
#pragma once

#include <cstdint>

namespace mars::images {

struct FileWork {
  std::uint64_t files = 0;
  std::uint64_t encoded_bytes = 0;  // of pixels that were encoded
  std::uint64_t file_bytes = 0;     // that were written
  double making_seconds = 0;        // of all threads, until they write
  double storing_seconds = 0;       // in which at least one file was being written

  FileWork operator-(const FileWork& before) const {
    return {files - before.files, encoded_bytes - before.encoded_bytes, file_bytes - before.file_bytes,
            making_seconds - before.making_seconds, storing_seconds - before.storing_seconds};
  }
};

}  // namespace mars::images
