// Files that a change makes a film or model name: a stranger may name none outside of the studio's folder.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "host/content/keys/key.h"

namespace mars::editing {

// Refuses files that `now` names and `was` does not, where `folder` is not empty and they are not below. `file` is the
// film or model itself, and `object` says which of both.
void require_new_files_below(const std::filesystem::path& folder, const std::filesystem::path& file,
                             const keys::Object& object, const nlohmann::ordered_json& was,
                             const nlohmann::ordered_json& now);

}  // namespace mars::editing
