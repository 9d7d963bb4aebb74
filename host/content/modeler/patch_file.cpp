#include "host/content/modeler/patch_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/file.h"

namespace mars::modeler {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;
constexpr std::size_t kMostPatches = 10'000'000;

// Words of a text between white space, with the line they stand in.
class Words {
 public:
  Words(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

  bool at_end() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front()))) {
      line_ += rest_.front() == '\n';
      rest_.remove_prefix(1);
    }
    return rest_.empty();
  }

  double number(const char* of) {
    if (at_end()) fail(std::string("ends before ") + of, "the file may be cut short");
    const std::string_view word = rest_.substr(0, std::min(rest_.find_first_of(" \t\r\n\v\f"), rest_.size()));
    const auto value = document::number_in<double>(word);
    if (!value) fail("has '" + document::printable(word) + "' for " + of, "write a number");
    rest_.remove_prefix(word.size());
    return *value;
  }

  double coordinate(const char* of) {
    const double value = number(of);
    if (!(std::abs(value) <= document::kFarthest))
      fail("has " + document::shown(value) + " for " + of, "at most 1e9 from the origin");
    return value;
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Failure(problem, name_ + ":" + std::to_string(line_), remedy);
  }

 private:
  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 1;
};

using Points = std::vector<glm::dvec3>;

glm::dvec3 placed(const Words& words, glm::dvec3 point) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(point[axis]) > document::kFarthest)
      words.fail("has a point at " + document::shown(point[axis]), "scale it to at most 1e9 from the origin");
    point[axis] += 0.0;  // no negative zero
  }
  return point;
}

Points read_points(Words& words, const glm::dmat3& placing) {
  const double count = words.number("the number of patches");
  if (!(count >= 1 && count <= kMostPatches && count == std::floor(count)))
    words.fail("has " + document::shown(count) + " for the number of patches",
               "begin with the number of patches, a whole number from 1 to " + std::to_string(kMostPatches));
  Points points;
  for (std::size_t patch = 0; patch < static_cast<std::size_t>(count); ++patch) {
    const double u = words.number("a patch's first degree"), v = words.number("a patch's second degree");
    if (u != 3 || v != 3)
      words.fail("has a patch of degrees " + document::shown(u) + " " + document::shown(v),
                 "only bicubic patches, 3 3, can be read");
    for (int point = 0; point < 16; ++point) {
      const double x = words.coordinate("x"), y = words.coordinate("y"), z = words.coordinate("z");
      points.push_back(placed(words, placing * glm::dvec3(x, y, z)));
    }
  }
  if (!words.at_end()) words.fail("goes on after its last patch", "check the number of patches in its first line");
  return points;
}

Box bounds_of(const Points& points) {
  Box box{points[0], points[0]};
  for (const glm::dvec3& point : points)
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], point[axis]);
      box.max[axis] = std::max(box.max[axis], point[axis]);
    }
  return box;
}

}  // namespace

PatchFile read_patch_file(const std::filesystem::path& path, const glm::dmat3& placing) {
  const std::string text = document::read_file(path, kLargestFile);
  Words words(text, path.string());
  const Points points = read_points(words, placing);
  const Box bounds = bounds_of(points);
  PatchFile file{std::vector<wire::Patch>(points.size() / 16), thickened(bounds), bounds.max - bounds.min};
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = file.bounds.max[axis] - file.bounds.min[axis];
      file.patches[i / 16].points[i % 16][axis] =
          static_cast<float>((points[i][axis] - file.bounds.min[axis]) / extent);
    }
  return file;
}

}  // namespace mars::modeler
