// The JSON Schemas of film and model files, from the table of keys: docs/schema.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

namespace mars::keys {

// As docs/schema/film.schema.json and model.schema.json have them. `shapes`: names of the library's.
nlohmann::ordered_json film_schema();
nlohmann::ordered_json model_schema(std::span<const std::string_view> shapes);

}  // namespace mars::keys
