// Keys of film and model files as words of a command, by their table (host/content/keys/key.h): an option for each key,
// or KEY=VALUE for all. Their values are as a file writes them; who reads the changed file checks them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/cli/command.h"
#include "host/content/document/json_file.h"
#include "host/content/keys/key.h"

namespace mars::editing {

// "--x-axis X Y Z" for "x_axis", of each key of the object that commands take. What is typed goes to `values`.
void add_key_options(cli::Command command, const keys::Object& object, document::Json& values);

// An argument.
cli::Option add_key_values(cli::Command command, const keys::Object& object, std::vector<std::string>& words,
                           const std::string& example);

// Of words like "roughness=0.5", "color=1,0.8,0.6", "reflection=phong". Throws where a word is no KEY=VALUE, or its key
// none of the object's.
document::Json values_of(std::span<const std::string> words, const keys::Object& object);

// It takes numbers within the key's range.
void limit(cli::Option option, const keys::Key& key);

}  // namespace mars::editing
