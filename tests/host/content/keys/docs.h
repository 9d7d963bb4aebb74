// What docs/ says of keys, which comes from their table: the JSON Schemas, and tables of pages between
// <!-- keys light --> and <!-- /keys -->.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace mars::keys {

// Each file below docs/ that has something of the table, and what it should hold.
std::map<std::filesystem::path, std::string> docs_of_keys();

}  // namespace mars::keys
