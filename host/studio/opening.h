// Before the studio begins: what it may open, where it listens, and how a person gets there.
#pragma once

#include <filesystem>
#include <string>

#include "host/studio/studio_settings.h"
#include "host/studio/web/server.h"

namespace mars::studio {

// The file to open, below the current folder. Throws Failure where it is elsewhere, or is named and not there.
std::filesystem::path file_to_open(const std::string& name);

// Throws Failure where other machines could come without TLS and nobody said that they may, and where words do not fit
// together.
web::ServerSettings server_settings(const StudioSettings& settings);

// Whether only this machine can reach the address.
bool is_loopback(const std::string& address);

// Opens a person's browser at the link where there is a display. The link's token is in a file that only this user may
// read, as everybody may read command lines; it is removed with this.
class Browser {
 public:
  explicit Browser(const std::string& link);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

 private:
  std::filesystem::path file_;  // "": none
};

}  // namespace mars::studio
