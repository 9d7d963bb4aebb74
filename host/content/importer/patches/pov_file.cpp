#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/shown_color.h"
#include "host/content/document/text.h"
#include "host/content/elementary/elementary.h"
#include "host/content/importer/patches/patch_scene.h"
#include "host/content/importer/patches/pov_values.h"

namespace mars::importer {
namespace {

constexpr std::array<std::string_view, 5> kGroups{"union", "merge", "object", "intersection", "difference"};
constexpr std::array<std::string_view, 7> kOpening{"if", "ifdef", "ifndef", "while", "for", "switch", "macro"};
constexpr std::array<std::string_view, 4> kLooks{"texture", "pigment", "material", "interior_texture"};

bool is_one_of(const auto& words, const PovWord& word) {
  return word.kind == PovKind::word && std::ranges::find(words, word.text) != words.end();
}

glm::dmat4 shifted(const glm::dvec3& by) {
  glm::dmat4 matrix(1);
  matrix[3] = glm::dvec4(by, 1);
  return matrix;
}

glm::dmat4 scaled(const glm::dvec3& by) {
  glm::dmat4 matrix(1);
  for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = by[axis];
  return matrix;
}

// About axis x, y or z, from the axis that follows it to the one after that.
glm::dmat4 turned_about(int axis, double degrees) {
  const double c = elementary::cos(glm::radians(degrees)), s = elementary::sin(glm::radians(degrees));
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  glm::dmat4 matrix(1);
  matrix[next][next] = matrix[last][last] = c;
  matrix[next][last] = s;
  matrix[last][next] = -s;
  return matrix;
}

class PovReader {
 public:
  explicit PovReader(const PovText& text) : in_(text) {}

  PatchScene read() {
    scene_.is_left_handed = true;
    scene_.patches = body({}, true);
    for (ScenePatch& patch : scene_.patches)
      for (std::size_t i = 0; is_linear_ && patch.color && i < 3; ++i)
        (*patch.color)[i] = document::shown_of_light((*patch.color)[i]);
    return std::move(scene_);
  }

 private:
  using Patches = std::vector<ScenePatch>;

  // What stands in an object's braces, from behind the first to behind the last, or in the file; `patches` are the
  // object's own.
  Patches body(Patches patches, bool is_file = false) {
    if (++depth_ > kDeepestScene) in_.refuse("has objects within objects, too deep", "join them");
    while (is_file || !in_.take_sign("}")) {
      const PovWord word = in_.peek();
      if (word.kind == PovKind::end) {
        if (!is_file) in_.refuse("ends within an object", "the file may be cut short");
        break;
      }
      if (!read_look(patches) && !read_move(patches)) read_part(word, patches);
    }
    --depth_;
    return patches;
  }

  void read_part(const PovWord& word, Patches& patches) {
    if (word.kind == PovKind::directive) return directive();
    if (begins_object(word)) return append(object(), patches);
    in_.take();
    if (word.is(PovKind::sign, "{")) return skip_block();
    if (word.kind == PovKind::word && in_.take_sign("{")) {
      ++scene_.skipped[word.text];
      if (word.text == "global_settings") note_gamma();
      skip_block();
    }
  }

  // With an assumed_gamma of 1 colours are amounts of light.
  void note_gamma() {
    for (std::size_t i = 0; in_.peek(i).kind != PovKind::end && !in_.peek(i).is(PovKind::sign, "}"); ++i)
      if (in_.peek(i).is(PovKind::word, "assumed_gamma")) is_linear_ = in_.peek(i + 1).number == 1;
  }

  void append(Patches more, Patches& patches) const {
    if (patches.size() + more.size() > kMostScenePatches)
      in_.refuse(too_many_patches(), "import parts of it by themselves");
    patches.insert(patches.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }

  bool begins_object(const PovWord& word) const {
    if (word.kind != PovKind::word) return false;
    if (objects_.contains(word.text)) return true;
    return (word.text == "bicubic_patch" || is_one_of(kGroups, word)) && in_.peek(1).is(PovKind::sign, "{");
  }

  Patches object() {
    const PovWord word = in_.take();
    if (const auto known = objects_.find(word.text); known != objects_.end()) return known->second;
    in_.expect_sign("{");
    return word.text == "bicubic_patch" ? body(patch()) : body({});
  }

  // Up to its 16 points.
  Patches patch() {
    while (in_.peek().kind == PovKind::word && !in_.peek().is(PovKind::word, "uv_vectors") && is_setting(in_.peek())) {
      const bool is_type = in_.take().text == "type";
      const double number = in_.number();
      if (is_type && number != 0 && number != 1)
        in_.refuse("has a bicubic_patch of type " + document::shown(number), "only types 0 and 1 are known");
      in_.take_sign(",");
    }
    if (in_.peek().is(PovKind::word, "uv_vectors")) {
      in_.take();
      for (int i = 0; i < 4; ++i) point();
      ++scene_.skipped["uv_vectors"];
    }
    ScenePatch patch{};
    for (glm::dvec3& each : patch.points) each = point();
    return {patch};
  }

  static bool is_setting(const PovWord& word) {
    constexpr std::array<std::string_view, 5> kSettings{"type", "flatness", "u_steps", "v_steps", "accuracy"};
    return is_one_of(kSettings, word);
  }

  glm::dvec3 point() {
    const PovValue value = in_.value();
    in_.take_sign(",");
    if (value.size() < 2 || value.size() > 3)
      in_.refuse("has a bicubic_patch with what is no point", "write its 16 points <x, y, z>");
    const glm::dvec3 point(value[0], value[1], value.size() == 3 ? value[2] : 0.0);
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(point[axis]) <= document::kFarthest))
        in_.refuse("has a point at " + document::shown(point[axis]), "at most 1e9 from the origin");
    return point;
  }

  // translate, rotate, scale, matrix and transform move all that stands before them.
  bool read_move(Patches& patches) {
    const PovWord& word = in_.peek();
    if (word.kind != PovKind::word) return false;
    const auto move = this->move();
    if (move) transform(patches, *move);
    return move.has_value();
  }

  std::optional<glm::dmat4> move() {
    const std::string word = in_.peek().text;
    constexpr std::array<std::string_view, 5> kMoves{"translate", "rotate", "scale", "matrix", "transform"};
    if (!is_one_of(kMoves, in_.peek())) return std::nullopt;
    in_.take();
    if (word == "transform") return declared_transform();
    if (word == "matrix") return matrix();
    const glm::dvec3 by = in_.vector();
    if (word == "translate") return shifted(by);
    if (word == "scale") return scaled(by);
    return turned_about(2, by.z) * turned_about(1, by.y) * turned_about(0, by.x);
  }

  // Rows of three, the last the place.
  glm::dmat4 matrix() {
    const PovValue numbers = in_.value();
    if (numbers.size() != 12) in_.refuse("has a matrix without 12 numbers", "write <x, ...> with 12 numbers");
    glm::dmat4 matrix(1);
    for (int row = 0; row < 4; ++row)
      for (int i = 0; i < 3; ++i) matrix[row][i] = numbers[static_cast<std::size_t>(3 * row + i)];
    return matrix;
  }

  glm::dmat4 declared_transform() {
    if (++depth_ > kDeepestScene) in_.refuse("has transforms within transforms, too deep", "join them");
    const glm::dmat4 all = in_.take_sign("{") ? parts_of_transform() : transform_of_name();
    --depth_;
    return all;
  }

  glm::dmat4 transform_of_name() {
    const auto known = transforms_.find(in_.peek().text);
    if (known == transforms_.end()) in_.refuse("has a transform that is not declared", "write its parts");
    in_.take();
    return known->second;
  }

  // Up to its closing brace.
  glm::dmat4 parts_of_transform() {
    glm::dmat4 all(1);
    while (!in_.take_sign("}")) {
      if (const auto known = transforms_.find(in_.peek().text); known != transforms_.end()) {
        in_.take();
        all = known->second * all;
        continue;
      }
      const auto next = move();
      if (!next) in_.refuse("has a transform with what moves nothing", "keep translate, rotate, scale and matrix");
      all = *next * all;
    }
    return all;
  }

  // The colour of what has none yet: the first that its texture names.
  bool read_look(Patches& patches) {
    if (!is_one_of(kLooks, in_.peek()) || !in_.peek(1).is(PovKind::sign, "{")) return false;
    in_.take();
    const auto color = color_of_block();
    for (ScenePatch& patch : patches)
      if (!patch.color) patch.color = color;
    return true;
  }

  std::optional<PatchColor> color_of_block() {
    in_.expect_sign("{");
    const std::size_t begin = in_.place();
    skip_block();
    const std::size_t end = in_.place();
    std::optional<PatchColor> color;
    for (in_.go_to(begin); in_.place() < end && !color; in_.take())
      if (const auto known = colors_.find(in_.peek().text); known != colors_.end())
        color = known->second;
      else if (is_one_of(kColorWords, in_.peek()))
        color = color_here();
    in_.go_to(end);
    return color;
  }

  std::optional<PatchColor> color_here() {
    const std::size_t place = in_.place();
    std::optional<PatchColor> color;
    try {
      color = cut_color(in_.vector());
    } catch (const Failure&) {
      color = std::nullopt;  // of a colour that is computed
    }
    in_.go_to(place);
    return color;
  }

  void skip_block() {
    for (std::size_t depth = 1; depth > 0;) {
      const PovWord& word = in_.take();
      if (word.kind == PovKind::end) in_.refuse("ends within braces", "the file may be cut short");
      depth += word.is(PovKind::sign, "{");
      depth -= word.is(PovKind::sign, "}");
    }
  }

  void directive() {
    const PovWord word = in_.take();
    if (word.text == "declare" || word.text == "local") return declare();
    if (word.text == "version") {
      in_.number();
      in_.take_sign(";");
      return;
    }
    ++scene_.skipped["#" + word.text];
    if (std::ranges::find(kOpening, word.text) != kOpening.end()) skip_to_end();
    if (word.text == "include") in_.take();
  }

  void skip_to_end() {
    for (std::size_t depth = 1; depth > 0;) {
      const PovWord& word = in_.take();
      if (word.kind == PovKind::end) in_.refuse("ends before an #end", "the file may be cut short");
      if (word.kind != PovKind::directive) continue;
      depth += std::ranges::find(kOpening, word.text) != kOpening.end();
      depth -= word.text == "end";
    }
  }

  void declare() {
    const std::string name = in_.take().text;
    in_.expect_sign("=");
    const PovWord& word = in_.peek();
    if (begins_object(word)) {
      objects_[name] = object();
    } else if (is_one_of(kLooks, word) && in_.peek(1).is(PovKind::sign, "{")) {
      in_.take();
      if (const auto color = color_of_block()) colors_[name] = *color;
    } else if (word.is(PovKind::word, "transform")) {
      in_.take();
      transforms_[name] = declared_transform();
    } else if (word.kind == PovKind::word && in_.peek(1).is(PovKind::sign, "{")) {
      ++scene_.skipped[in_.take().text];
      in_.take();
      skip_block();
    } else {
      declare_value(name);
    }
    in_.take_sign(";");
  }

  // One that cannot be computed is not known: its use is refused.
  void declare_value(const std::string& name) {
    const std::size_t line = in_.peek().line, place = in_.place();
    try {
      in_.declare(name, in_.value());
    } catch (const Failure&) {
      ++scene_.skipped["#declare"];
      in_.go_to(place);
      while (in_.peek().kind != PovKind::end && in_.peek().line == line && !in_.peek().is(PovKind::sign, ";"))
        in_.take();
    }
  }

  PovValues in_;
  PatchScene scene_;
  std::size_t depth_ = 0;
  bool is_linear_ = false;
  std::map<std::string, Patches> objects_;
  std::map<std::string, PatchColor> colors_;
  std::map<std::string, glm::dmat4> transforms_;
};

}  // namespace

std::string too_many_patches() {
  return document::formatted("has more than %zu patches, which need more than %.2f GB of memory", kMostScenePatches,
                             double(kMostScenePatches * kBytesOfPatch) / 1e9);
}

void transform(std::vector<ScenePatch>& patches, const glm::dmat4& by) {
  for (ScenePatch& patch : patches)
    for (glm::dvec3& point : patch.points) point = glm::dvec3(by * glm::dvec4(point, 1));
}

PatchScene read_pov(const std::filesystem::path& path) {
  const PovText text = pov_text(path);
  return PovReader(text).read();
}

}  // namespace mars::importer
