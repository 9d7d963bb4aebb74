#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <set>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/elementary/elementary.h"
#include "host/content/importer/patches/patch_scene.h"
#include "host/content/importer/patches/rib_words.h"

namespace mars::importer {
namespace {

struct NamedBasis {
  std::string_view name;
  double numbers[16];  // rows: of t^3, t^2, t, 1
  int step;
};

constexpr NamedBasis kBases[] = {
    {"bezier", {-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0}, 3},
    {"b-spline",
     {-1. / 6, 3. / 6, -3. / 6, 1. / 6, 3. / 6, -1, 3. / 6, 0, -3. / 6, 0, 3. / 6, 0, 1. / 6, 4. / 6, 1. / 6, 0},
     1},
    {"catmull-rom", {-0.5, 1.5, -1.5, 0.5, 1, -2.5, 2, -0.5, -0.5, 0, 0.5, 0, 0, 1, 0, 0}, 1},
    {"hermite", {2, 1, -2, 1, -3, -2, 3, -1, 0, 1, 0, 0, 1, 0, 0, 0}, 2},
    {"power", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 4}};

// Requests that say how a picture is made, not what is in it.
const std::set<std::string_view> kNotAnObject = {"version",
                                                 "FrameBegin",
                                                 "FrameEnd",
                                                 "WorldEnd",
                                                 "Display",
                                                 "Format",
                                                 "Projection",
                                                 "Clipping",
                                                 "ScreenWindow",
                                                 "CropWindow",
                                                 "PixelSamples",
                                                 "PixelFilter",
                                                 "ShadingRate",
                                                 "Option",
                                                 "Attribute",
                                                 "Declare",
                                                 "Sides",
                                                 "Orientation",
                                                 "ReverseOrientation",
                                                 "Exposure",
                                                 "Quantize",
                                                 "Imager",
                                                 "Hider",
                                                 "Shutter",
                                                 "DepthOfField",
                                                 "ShadingInterpolation",
                                                 "Matte",
                                                 "Opacity",
                                                 "GeometricApproximation",
                                                 "Detail",
                                                 "DetailRange",
                                                 "RelativeDetail",
                                                 "ColorSamples",
                                                 "FrameAspectRatio",
                                                 "TextureCoordinates",
                                                 "Bound",
                                                 "Integrator",
                                                 "ScopedCoordinateSystem",
                                                 "CoordinateSystem",
                                                 "TrimCurve"};

glm::dmat4 rows_of_numbers(const double* numbers) {
  glm::dmat4 rows;
  for (int i = 0; i < 16; ++i) rows[i / 4][i % 4] = numbers[i];
  return rows;
}

struct RibBasis {
  glm::dmat4 to_bezier{1};  // [point of the Bezier curve][point that RIB has]: its weight
  int step = 3;
};

// Of a curve's matrix, as RIB has it.
RibBasis basis_of(const double* numbers, int step) {
  const glm::dmat4 bezier = glm::inverse(rows_of_numbers(kBases[0].numbers));
  // As transposes, in which GLM's products run the other way round.
  return {rows_of_numbers(numbers) * bezier, step};
}

struct RibState {
  glm::dmat4 matrix{1};
  std::optional<PatchColor> color;
  RibBasis u = basis_of(kBases[0].numbers, 3), v = u;
};

class RibReader {
 public:
  RibReader(const std::string& text, const std::string& name) : words_(text, name), name_(name) {}

  PatchScene read() {
    while ((request_ = words_.next())) handle();
    if (surfaces_.size() > 0) scene_.skipped["Surface"] += surfaces_.size();
    return std::move(scene_);
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const {
    throw Failure(problem, name_ + ":" + std::to_string(request_->line), remedy);
  }

  void handle() {
    const std::string& name = request_->name;
    if (name == "Patch") return add_patch();
    if (name == "PatchMesh") return add_mesh();
    if (name == "Basis") return set_bases();
    if (name == "Color") return set_color();
    if (name == "Surface") return note_surface();
    if (!stack(name) && !move(name) && !kNotAnObject.contains(name)) ++scene_.skipped[document::printable(name, 40)];
  }

  bool stack(const std::string& name) {
    if (name == "AttributeBegin" || name == "TransformBegin" || name == "SolidBegin") {
      if (saved_.size() == kDeepestScene) refuse("has blocks within blocks, too deep", "join them");
      saved_.push_back(state_);
    } else if (name == "AttributeEnd" || name == "TransformEnd" || name == "SolidEnd") {
      if (saved_.empty()) refuse("has " + name + " without its beginning", "remove it");
      if (name == "TransformEnd")
        state_.matrix = saved_.back().matrix;
      else
        state_ = saved_.back();
      saved_.pop_back();
    } else if (name == "WorldBegin") {
      // What stands before it places the camera, which sees x to the right, y up and z ahead.
      scene_.is_left_handed = glm::determinant(glm::dmat3(state_.matrix)) > 0;
      state_.matrix = glm::dmat4(1);
    } else {
      return false;
    }
    return true;
  }

  bool move(const std::string& name) {
    if (name == "Identity")
      state_.matrix = glm::dmat4(1);
    else if (name == "Transform")
      state_.matrix = rows_of_numbers(numbers(16).data());
    else if (name == "ConcatTransform")
      state_.matrix = state_.matrix * rows_of_numbers(numbers(16).data());
    else if (name == "Translate")
      state_.matrix = state_.matrix * moved_by(numbers(3));
    else if (name == "Scale")
      state_.matrix = state_.matrix * scaled_by(numbers(3));
    else if (name == "Rotate")
      state_.matrix = state_.matrix * turned_by(numbers(4));
    else
      return false;
    return true;
  }

  static glm::dmat4 moved_by(const std::vector<double>& by) {
    glm::dmat4 matrix(1);
    matrix[3] = glm::dvec4(by[0], by[1], by[2], 1);
    return matrix;
  }

  static glm::dmat4 scaled_by(const std::vector<double>& by) {
    glm::dmat4 matrix(1);
    for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = by[static_cast<std::size_t>(axis)];
    return matrix;
  }

  // Degrees, about an axis (Rodrigues).
  glm::dmat4 turned_by(const std::vector<double>& by) const {
    const glm::dvec3 axis(by[1], by[2], by[3]);
    if (!(glm::length(axis) > 0)) refuse("turns about no axis", "write Rotate angle x y z");
    const glm::dvec3 a = glm::normalize(axis);
    const double c = elementary::cos(glm::radians(by[0])), s = elementary::sin(glm::radians(by[0]));
    glm::dmat4 matrix(1);
    for (int i = 0; i < 3; ++i) {
      glm::dvec3 unit(0);
      unit[i] = 1;
      matrix[i] = glm::dvec4(c * unit + s * glm::cross(a, unit) + (1 - c) * glm::dot(a, unit) * a, 0);
    }
    return matrix;
  }

  // All of the request's numbers, in [ ] or not.
  std::vector<double> numbers(std::size_t count) const {
    std::vector<double> all;
    for (const RibArgument& argument : request_->arguments)
      all.insert(all.end(), argument.numbers.begin(), argument.numbers.end());
    if (all.size() != count)
      refuse("has a " + request_->name + " of " + document::counted(all.size(), "number", "numbers"),
             "write " + std::to_string(count));
    return all;
  }

  void set_color() {
    const std::vector<double> rgb = numbers(3);
    state_.color = cut_color({rgb[0], rgb[1], rgb[2]});
  }

  void note_surface() {
    if (!request_->arguments.empty() && request_->arguments[0].text) surfaces_.insert(*request_->arguments[0].text);
  }

  // Basis "b-spline" 1 "b-spline" 1: of u, then of v.
  void set_bases() {
    const auto& all = request_->arguments;
    if (all.size() != 4 || all[1].numbers.size() != 1 || all[3].numbers.size() != 1)
      refuse("has a Basis that is none", "write Basis \"bezier\" 3 \"bezier\" 3");
    state_.u = basis(all[0], all[1].numbers[0]);
    state_.v = basis(all[2], all[3].numbers[0]);
  }

  RibBasis basis(const RibArgument& given, double step) const {
    if (!(step >= 1 && step <= 4 && step == std::floor(step)))
      refuse("has a step of " + document::shown(step), "write a whole number from 1 to 4");
    if (!given.text && given.numbers.size() == 16) return basis_of(given.numbers.data(), static_cast<int>(step));
    const auto known = std::ranges::find(kBases, given.text.value_or(""), &NamedBasis::name);
    if (known == std::end(kBases))
      refuse("has the basis '" + document::printable(given.text.value_or(""), 40) + "', which is not known",
             "write bezier, b-spline, catmull-rom, hermite, power, or 16 numbers");
    return basis_of(known->numbers, static_cast<int>(step));
  }

  std::string kind() const { return request_->arguments.empty() ? "" : request_->arguments[0].text.value_or(""); }

  // "P", or "Pw" divided by w.
  std::optional<std::vector<glm::dvec3>> points() const {
    const auto& all = request_->arguments;
    for (std::size_t i = 1; i + 1 < all.size(); ++i) {
      const std::string name = name_of(all[i].text.value_or(""));
      if (name != "P" && name != "Pw") continue;
      const std::size_t width = name == "P" ? 3 : 4;
      const std::vector<double>& n = all[i + 1].numbers;
      std::vector<glm::dvec3> points;
      for (std::size_t at = 0; at + width <= n.size(); at += width) {
        if (width == 4 && n[at + 3] != n[3]) return std::nullopt;  // rational
        points.push_back(checked(glm::dvec3(n[at], n[at + 1], n[at + 2]) / (width == 4 ? n[at + 3] : 1.0)));
      }
      return points;
    }
    return std::nullopt;
  }

  // "vertex point P" is P.
  static std::string name_of(const std::string& declared) { return declared.substr(declared.find_last_of(' ') + 1); }

  glm::dvec3 checked(const glm::dvec3& point) const {
    const glm::dvec3 placed(state_.matrix * glm::dvec4(point, 1));
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(placed[axis]) <= document::kFarthest))
        refuse("has a point at " + document::shown(placed[axis]), "at most 1e9 from the origin");
    return placed;
  }

  void add_patch() {
    const auto all = points();
    if (!all) return void(++scene_.skipped["Patch that is rational or has no P"]);
    if (kind() == "bilinear" && all->size() == 4) return add(bilinear(*all, {0, 1, 2, 3}));
    if (kind() != "bicubic" || all->size() != 16)
      refuse("has a Patch of " + document::counted(all->size(), "point", "points"),
             "write \"bicubic\" and 16 points, or \"bilinear\" and 4");
    std::array<std::size_t, 16> corners;
    for (std::size_t i = 0; i < 16; ++i) corners[i] = i;
    add(bicubic(*all, corners));
  }

  // PatchMesh "bicubic" nu "periodic" nv "nonperiodic" "P" [...]
  void add_mesh() {
    const auto& all = request_->arguments;
    const auto places = points();
    if (!places) return void(++scene_.skipped["PatchMesh that is rational or has no P"]);
    const bool is_cubic = kind() == "bicubic";
    if (all.size() < 7 || (!is_cubic && kind() != "bilinear"))
      refuse("has a PatchMesh that is none", "write \"bicubic\" nu \"nonperiodic\" nv \"nonperiodic\" \"P\" [...]");
    const std::size_t nu = size(all[1]), nv = size(all[3]);
    if (places->size() != nu * nv)
      refuse("has a PatchMesh of " + std::to_string(places->size()) + " points, not " + std::to_string(nu) + " x " +
                 std::to_string(nv),
             "write as many as its sizes say");
    const Run u{nu, all[2].text == "periodic", is_cubic ? std::size_t(state_.u.step) : 1, is_cubic ? 4u : 2u},
        v{nv, all[4].text == "periodic", is_cubic ? std::size_t(state_.v.step) : 1, is_cubic ? 4u : 2u};
    for (std::size_t j = 0; j < v.patches(); ++j)
      for (std::size_t i = 0; i < u.patches(); ++i) add_part(*places, u, v, i, j, is_cubic);
  }

  // Along one side of a mesh.
  struct Run {
    std::size_t points;
    bool is_periodic;
    std::size_t step, width;

    std::size_t patches() const {
      if (points < width) return 0;
      return is_periodic ? points / step : (points - width) / step + 1;
    }
    std::size_t at(std::size_t patch, std::size_t point) const { return (patch * step + point) % points; }
  };

  void add_part(const std::vector<glm::dvec3>& places, const Run& u, const Run& v, std::size_t i, std::size_t j,
                bool is_cubic) {
    const auto at = [&](std::size_t a, std::size_t b) { return v.at(j, b) * u.points + u.at(i, a); };
    if (!is_cubic) return add(bilinear(places, {at(0, 0), at(1, 0), at(0, 1), at(1, 1)}));
    std::array<std::size_t, 16> corners;
    for (std::size_t k = 0; k < 16; ++k) corners[k] = at(k % 4, k / 4);
    add(bicubic(places, corners));
  }

  std::size_t size(const RibArgument& given) const {
    constexpr double kLargest = 1e5;
    if (given.numbers.size() != 1 || !(given.numbers[0] >= 2 && given.numbers[0] <= kLargest) ||
        given.numbers[0] != std::floor(given.numbers[0]))
      refuse("has a PatchMesh whose size is none", "write whole numbers from 2 to 100000");
    return static_cast<std::size_t>(given.numbers[0]);
  }

  ScenePatch bicubic(const std::vector<glm::dvec3>& points, const std::array<std::size_t, 16>& corners) const {
    ScenePatch patch{{}, state_.color};
    for (int b = 0; b < 4; ++b)
      for (int a = 0; a < 4; ++a) {
        glm::dvec3 sum(0);
        for (int k = 0; k < 16; ++k)
          sum += state_.u.to_bezier[a][k % 4] * state_.v.to_bezier[b][k / 4] * points[corners[std::size_t(k)]];
        patch.points[std::size_t(4 * b + a)] = sum;
      }
    return patch;
  }

  ScenePatch bilinear(const std::vector<glm::dvec3>& points, const std::array<std::size_t, 4>& corners) const {
    ScenePatch patch{{}, state_.color};
    for (std::size_t k = 0; k < 16; ++k) {
      const double u = double(k % 4) / 3, v = double(k / 4) / 3;
      patch.points[k] = (1 - v) * ((1 - u) * points[corners[0]] + u * points[corners[1]]) +
                        v * ((1 - u) * points[corners[2]] + u * points[corners[3]]);
    }
    return patch;
  }

  void add(const ScenePatch& patch) {
    if (scene_.patches.size() == kMostScenePatches) refuse(too_many_patches(), "import parts of it by themselves");
    scene_.patches.push_back(patch);
  }

  RibWords words_;
  std::string name_;
  std::optional<RibRequest> request_;
  RibState state_;
  std::vector<RibState> saved_;
  std::set<std::string> surfaces_;
  PatchScene scene_;
};

}  // namespace

PatchScene read_rib(const std::filesystem::path& path) {
  const std::string text = document::read_file(path, kLargestPatchScene);
  return RibReader(text, path.string()).read();
}

}  // namespace mars::importer
