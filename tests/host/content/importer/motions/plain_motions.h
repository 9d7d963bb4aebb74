// Plain twins of the readers of motions: where joints are by the formats' own definitions, in 4 x 4 matrices of doubles
// and the file's axes. They read sound files only.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

namespace mars::test {

using Places = std::map<std::string, glm::dvec3>;  // of joints, by name

// At every frame.
std::vector<Places> plain_bvh(const std::filesystem::path& path);
std::vector<Places> plain_acclaim(const std::filesystem::path& asf, const std::filesystem::path& amc);

}  // namespace mars::test
