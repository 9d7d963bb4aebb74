// What a person asks of `mars studio`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "host/shell/options/render_options.h"

namespace mars::studio {

struct StudioSettings {
  std::string file;                   // a film or a model; "": figure.json, or film.json
  bool film = false;                  // where the file is not there, a film is begun instead of a model
  std::optional<std::uint16_t> port;  // none: the usual one, or one that is free; 0: any that is free
  std::string listen;                 // ADDRESS or ADDRESS:PORT; "": this machine only
  std::string certificate, key;       // PEM files; "": no TLS
  bool insecure = false;              // other machines' pages may come without TLS
  bool browser = true;                // one is opened where there is a display
  options::RenderOptions renderer;    // backend, nodes, hostfile of the host that draws
  std::filesystem::path page;         // the folder of the page's files
};

}  // namespace mars::studio
