// JSON files that our commands change: read, changed in memory, checked by the file's own reader, and only then
// written, whole. What a person wrote keeps its order; its layout is ours.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "host/content/document/document.h"

namespace mars::document {

using Json = nlohmann::ordered_json;

// Refuses what read_document() refuses, with the line.
Json read_json(const std::filesystem::path& path);

// A number as a person would write it: 2, not 2.0; ten digits.
Json plain_number(double number);

// A flag of an object that a stranger wrote; `otherwise` where the key is missing or null. Throws Failure where it is
// no flag.
bool flag_in(const Json& object, const std::string& key, bool otherwise);

// As a person would write it: a list or object that fits in 110 columns stands on one line.
std::string laid_out(const Json& json);

// Writes the file if `check` does not throw at what it would hold; else the file stays as it was. Failures name
// the lines of the file as it would be.
void write_json(const std::filesystem::path& path, const Json& json,
                const std::function<void(const Element& root)>& check);

// Reads, changes and writes the file, with `check` as above. Others that change files of its folder this way wait, so
// that no change is lost, where the file system can lock.
void change_json(const std::filesystem::path& path, const std::function<void(Json&)>& change,
                 const std::function<void(const Element& root)>& check);

}  // namespace mars::document
