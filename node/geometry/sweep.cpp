#include "node/geometry/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace mars::geometry {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::max();
constexpr std::size_t kMostHulls = std::size_t{1} << 14;
constexpr std::size_t kMostShadows = std::size_t{1} << 20;

using Point = std::array<double, 3>;

// What lies between some points.
struct Hull {
  std::array<Point, SweptHull::kMostPoints> points;
  std::uint32_t count = 0;

  void add(const Point& point) { points[count++] = point; }
  std::span<const Point> all() const& { return std::span(points).first(count); }
  std::span<const Point> all() const&& = delete;
};

// Along the axes of some space.
struct Box {
  Point low{kBeyond, kBeyond, kBeyond};
  Point high{-kBeyond, -kBeyond, -kBeyond};

  void add(const Point& point) {
    for (std::size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], point[a]), high[a] = std::max(high[a], point[a]);
  }
  void add(const Hull& hull) {
    for (const Point& point : hull.all()) add(point);
  }
  bool is_empty() const { return !(low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2]); }
  Box wider(double by) const {
    Box box = *this;
    for (std::size_t a = 0; a < 3; ++a) box.low[a] -= by, box.high[a] += by;
    return box;
  }
};

Point moved(const wire::Matrix& matrix, const Point& p) {
  const auto row = [&](std::size_t r) {
    return matrix.m[r][0] * p[0] + matrix.m[r][1] * p[1] + matrix.m[r][2] * p[2] + matrix.m[r][3];
  };
  return {row(0), row(1), row(2)};
}

Hull moved(const wire::Matrix& matrix, const Hull& hull) {
  Hull out;
  for (const Point& point : hull.all()) out.add(moved(matrix, point));
  return out;
}

template <typename Place>
Hull corners_of(const Place& low, const Place& high) {
  Hull corners;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const auto along = [&](std::size_t axis) -> double { return (corner >> axis & 1 ? high : low)[axis]; };
    corners.add({along(0), along(1), along(2)});
  }
  return corners;
}

// Where the camera is in the world.
Point eye_of(const wire::Camera& camera) {
  const auto& m = camera.world_to_eye.m;
  Point eye{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t r = 0; r < 3; ++r) eye[a] -= m[r][a] * m[r][3];
  return eye;
}

// A skin's bones, along the world's axes from the camera; `skin` is where they are put. Nodes blend in eye space: where
// the sum of a point's weights is not quite 1, the point goes a little towards the camera, here too.
void find_bones(const Scene& scene, const wire::Segment& segment, std::uint32_t frame, SkinBounds& skin) {
  const wire::PackedFilm& film = scene.film();
  const Point eye = eye_of(film.camera_at(frame));
  skin.begin(segment.blend, scene.most_bones());
  for (const wire::Track& track : film.bones_of(segment)) {
    wire::Matrix bone = film.matrix_at(track, frame);
    for (std::size_t r = 0; r < 3; ++r) bone.m[r][3] -= eye[r];
    skin.add(bone);
  }
}

Point from_eye(const double* place, const Point& eye) {
  return {place[0] + eye[0], place[1] + eye[1], place[2] + eye[2]};
}

// In the world.
Hull corners_of(const SkinBounds::Box& box, const Point& eye) {
  return corners_of(from_eye(box.low, eye), from_eye(box.high, eye));
}

// Where a segment's whole shape is in the world. `skin`: room for bones.
Hull whole_of(const Scene& scene, const wire::Segment& segment, std::uint32_t frame, const ShapeBoxes& boxes,
              SkinBounds& skin) {
  const ShapeBoxes::Box& all = boxes.of(segment.shape);
  if (segment.bone_count == 0) return moved(scene.film().matrix_at(segment, frame), corners_of(all.low, all.high));
  find_bones(scene, segment, frame, skin);
  return corners_of(skin.round(boxes, segment.shape), eye_of(scene.film().camera_at(frame)));
}

// What of the picture a hull in eye space may be on.
class View {
 public:
  View(const wire::Camera& camera, const Scene& scene)
      : projection_(projection_of(camera, scene.film().settings())), width_(scene.width()), height_(scene.height()) {}

  const shape::Projection& projection() const { return projection_; }

  PictureBounds bound(const Hull& hull) const {
    Bounds bounds;
    for (const Point& point : hull.all()) {
      const double w = -point[2];
      if (w != w) return {{0, static_cast<std::uint32_t>(height_)}, {0, static_cast<std::uint32_t>(width_)}};
      if (w >= projection_.near) {
        add(point, w, bounds);
        continue;
      }
      for (const Point& other : hull.all())
        if (-other[2] >= projection_.near) add(at_near(point, other), projection_.near, bounds);
    }
    const auto [top, bottom] = pixels(bounds.low_y, bounds.high_y, height_);
    const auto [left, right] = pixels(bounds.low_x, bounds.high_x, width_);
    if (top >= bottom || left >= right) return {};
    return {{top, bottom}, {left, right}};
  }

 private:
  struct Bounds {
    double low_x = kBeyond, high_x = -kBeyond, low_y = kBeyond, high_y = -kBeyond;
  };

  void add(const Point& place, double w, Bounds& bounds) const {
    const double spread = projection_.parallel ? 1 : w;
    const double x =
        projection_.center[0] - projection_.origin[0] + projection_.scale * projection_.squeeze * place[0] / spread;
    const double y = projection_.center[1] - projection_.origin[1] - projection_.scale * place[1] / spread;
    bounds.low_x = std::min(bounds.low_x, x), bounds.high_x = std::max(bounds.high_x, x);
    bounds.low_y = std::min(bounds.low_y, y), bounds.high_y = std::max(bounds.high_y, y);
  }
  // Between two places on both sides of the near plane.
  Point at_near(const Point& behind, const Point& before) const {
    const double part = (projection_.near + before[2]) / (before[2] - behind[2]);
    Point place;
    for (std::size_t a = 0; a < 3; ++a) place[a] = before[a] + part * (behind[a] - before[a]);
    return place;
  }
  static std::array<std::uint32_t, 2> pixels(double low, double high, double all) {
    constexpr double kMargin = 1;  // for snapping and rounding
    return {static_cast<std::uint32_t>(std::clamp(low - kMargin, 0.0, all)),
            static_cast<std::uint32_t>(std::clamp(high + kMargin + 1, 0.0, all))};
  }

  const shape::Projection projection_;
  double width_, height_;
};

// The shadows of moving parts on what stands still.
class Shadows {
 public:
  // `skin`: room for a segment's bones; `scratch`: for the rest.
  Shadows(const Scene& scene, std::uint32_t frame, const ShapeBoxes& boxes, std::size_t casters, SkinBounds& skin,
          ShadowScratch& scratch)
      : camera_(scene.film().camera_at(frame)),
        view_(camera_, scene),
        lights_(scratch.lights),
        receivers_(scratch.receivers) {
    const wire::PackedFilm& film = scene.film();
    lights_.clear();
    receivers_.clear();
    for (const wire::Track& track : film.light_tracks())
      if (film.casts(track)) lights_.push_back(film.lights()[film.value_at(track, frame)]);
    Box all;
    for (std::size_t s = 0; s < film.segments().size(); ++s) {
      if (!scene.stands(s)) continue;
      const Hull corners = whole_of(scene, film.segments()[s], frame, boxes, skin);
      Box box;
      box.add(corners);
      receivers_.push_back({box.low, box.high});
      all.add(corners);
    }
    if (receivers_.size() * casters * lights_.size() > kMostShadows) receivers_.assign(1, {all.low, all.high});
  }

  // Visits what shadows of a caster within the box, of the world, may be on.
  template <typename Visit>
  void visit(const Box& caster, const Visit& visit) const {
    for (const auto& [low, high] : receivers_)
      for (const wire::Light& light : lights_)
        if (const Box shadow = shadow_of(caster, {low, high}, light); !shadow.is_empty())
          visit(view_.bound(moved(camera_.world_to_eye, corners_of(shadow.low, shadow.high))));
  }

 private:
  // A point c of the caster has its shadow at c - t d, t >= 0, d the direction to the light, or the way from c to a
  // point of it. Along each axis this lies between the receiver's bounds, which limits t.
  Box shadow_of(const Box& caster, const Box& receiver, const wire::Light& light) const {
    const double error = error_on(receiver);
    const Box from = caster.wider(error), onto = receiver.wider(error);
    const bool has_place = light.kind != wire::LightKind::directional;
    double least = 0, most = kMostWay;
    Point low, high;  // of d
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = light.vector[a] - double{light.size} - (has_place ? from.high[a] : 0);
      high[a] = light.vector[a] + double{light.size} - (has_place ? from.low[a] : 0);
      limit(low[a], from.high[a] - onto.low[a], least, most);
      limit(-high[a], onto.high[a] - from.low[a], least, most);
    }
    Box shadow;
    if (!(least <= most)) return shadow;
    for (std::size_t a = 0; a < 3; ++a) {
      shadow.low[a] = std::max(onto.low[a], from.low[a] - std::max(least * high[a], most * high[a]));
      shadow.high[a] = std::min(onto.high[a], from.high[a] - std::min(least * low[a], most * low[a]));
    }
    return shadow;
  }

  // t per <= bound.
  static void limit(double per, double bound, double& least, double& most) {
    if (per > 0) most = std::min(most, bound / per);
    if (per < 0) least = std::max(least, bound / per);
    if (per == 0 && bound < 0) most = -1;
  }

  // How far off its surface a point there may be (shadow/light_view.h).
  double error_on(const Box& receiver) const {
    const shape::Projection& p = view_.projection();
    double w = 0;
    const Hull corners = corners_of(receiver.low, receiver.high);
    for (const Point& corner : corners.all()) w = std::max(w, -moved(camera_.world_to_eye, corner)[2]);
    w = std::min(w, double{p.far});
    const double coarsest = p.scale * std::min(1.0, double{p.squeeze});
    if (p.parallel) return 1 / (16.0 * coarsest) + (w + p.radius) / (1 << 18) + p.far / (1 << 22);
    w /= p.corner;
    return w * (1 / (64.0 * coarsest) + 1.0 / (1 << 18)) + w * w / p.near / (1 << 22);
  }

  static constexpr double kMostWay = 1e18;

  const wire::Camera& camera_;
  const View view_;
  std::vector<wire::Light>& lights_;
  std::vector<std::array<Point, 2>>& receivers_;
};

// Hulls in the world round the moving pieces of segments: round each patch and meshlet, or round a whole shape.
class Pieces {
 public:
  Pieces(const Scene& scene, const ShapeBoxes& boxes, bool are_fine, SkinScratch& scratch)
      : scene_(scene), film_(scene.film()), boxes_(boxes), are_fine_(are_fine), scratch_(scratch) {}

  template <typename Visit>
  void visit(std::uint32_t number, std::uint32_t frame, const Visit& visit) {
    const wire::Segment& segment = film_.segments()[number];
    if (!are_fine_) return visit(whole_of(scene_, segment, frame, boxes_, scratch_.bones));
    if (segment.bone_count > 0) return visit_skin(number, frame, visit);
    const wire::Matrix& matrix = film_.matrix_at(segment, frame);
    for (const wire::Patch& patch : film_.patches_of(segment.shape)) {
      Hull hull;
      for (const auto& point : patch.points) hull.add({point[0], point[1], point[2]});
      visit(moved(matrix, hull));
    }
    for (const wire::Meshlet& meshlet : film_.meshlets_of(segment.shape))
      visit(moved(matrix, corners_of(meshlet.low, meshlet.high)));
  }

 private:
  template <typename Visit>
  void visit_skin(std::uint32_t number, std::uint32_t frame, const Visit& visit) {
    const wire::Segment& segment = film_.segments()[number];
    SkinBounds& bones = scratch_.bones;
    find_bones(scene_, segment, frame, bones);
    const Point eye = eye_of(film_.camera_at(frame));
    scratch_.net.start(film_);
    std::size_t piece = 0;
    for (const wire::NetPatch& patch : film_.net_patches_of(segment.shape))
      if (scene_.moves(number, piece++)) visit(hull_of(patch, eye));
    for (const wire::Meshlet& meshlet : film_.meshlets_of(segment.shape)) {
      if (!scene_.moves(number, piece++)) continue;
      const SkinBounds::Box box = bones.round(film_.bones_of(meshlet.skin), meshlet.low, meshlet.high,
                                              pairs_of(film_, meshlet, scene_.bone_pairs()));
      visit(corners_of(box, eye));
    }
  }

  // Of the patch's points, or, where some of them may be at several places, of the box round all these.
  Hull hull_of(const wire::NetPatch& patch, const Point& eye) {
    Hull points;
    Box all;
    bool in_doubt = false;
    const auto move = [&](const wire::NetPoint& point) { return both_ends(scratch_.bones.round(film_, point)); };
    for (const std::uint32_t stencil : patch.stencils) {
      const auto& box = scratch_.net.bezier(film_, stencil, move);
      const Point low = from_eye(box.data(), eye), high = from_eye(box.data() + 3, eye);
      points.add(low);
      all.add(low), all.add(high);
      in_doubt |= low != high;
    }
    return in_doubt ? corners_of(all.low, all.high) : points;
  }

  static std::array<double, 6> both_ends(const SkinBounds::Box& box) {
    return {box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]};
  }

  const Scene& scene_;
  const wire::PackedFilm& film_;
  const ShapeBoxes& boxes_;
  bool are_fine_;
  SkinScratch& scratch_;
};

// Visits each of the frames at which the segment, its material or the camera is another than at the one before.
template <typename Visit>
void visit_places(const wire::PackedFilm& film, const wire::Segment& segment, std::span<const std::uint32_t> frames,
                  const Visit& visit) {
  const auto differ = [&](std::uint32_t one, std::uint32_t other) {
    const auto changes = [&](const wire::Track& track) {
      return film.value_at(track, one) != film.value_at(track, other);
    };
    const bool moves =
        segment.bone_count == 0 ? changes(segment.motion) : std::ranges::any_of(film.bones_of(segment), changes);
    return moves || changes(segment.material) || changes(film.settings().camera);
  };
  for (std::size_t k = 0; k < frames.size(); ++k)
    if (k == 0 || differ(frames[k], frames[k - 1])) visit(frames[k]);
}

SweptHull swept(const Hull& hull) {
  SweptHull out{};
  for (const Point& point : hull.all()) {
    for (std::size_t a = 0; a < 3; ++a) out.along[a][out.count] = static_cast<float>(point[a]);
    ++out.count;
  }
  return out;
}

// One segment's way through the frames, as that of what casts shadows.
class Way {
 public:
  Way(std::vector<SweptHull>& casters, std::size_t places_a_hull) : casters_(casters), places_a_hull_(places_a_hull) {}

  void add(const Hull& in_world, const Hull& in_eye_space) {
    world_.add(in_world);
    if (places_a_hull_ == 1) return casters_.push_back(swept(in_eye_space));
    eye_.add(in_eye_space);
    if (++places_ == places_a_hull_) finish();
  }
  void finish() {
    if (!eye_.is_empty()) casters_.push_back(swept(corners_of(eye_.low, eye_.high)));
    eye_ = {};
    places_ = 0;
  }
  const Box& in_world() const { return world_; }

 private:
  std::vector<SweptHull>& casters_;
  const std::size_t places_a_hull_;
  std::size_t places_ = 0;
  Box world_, eye_;
};

}  // namespace

void Sweep::begin(const Scene& scene, std::span<const std::uint32_t> frames, const ShapeBoxes& boxes,
                  const Cover& cover) {
  casters_.clear();
  lines_ = {};
  if (frames.empty()) return;
  const wire::PackedFilm& film = scene.film();
  const std::span<const std::uint32_t> movers = scene.movers();
  std::uint64_t pieces = 0;
  for (const std::uint32_t segment : movers) pieces += scene.moving_pieces(segment);
  const bool any_still = scene.any_stands();
  Pieces hulls(scene, boxes, any_still && pieces * frames.size() <= kMostHulls, scratch_);
  std::optional<Shadows> shadows;
  if (any_still && scene.casting_count() > 0)
    shadows.emplace(scene, frames.front(), boxes, movers.size(), scratch_.bones, shadow_scratch_);
  for (const std::uint32_t number : movers) {
    const wire::Segment& segment = film.segments()[number];
    Way way(casters_, movers.size() * frames.size() / kMostHulls + 1);
    visit_places(film, segment, frames, [&](std::uint32_t frame) {
      const wire::Camera& camera = film.camera_at(frame);
      const bool casts = film.material_at(segment, frame).casts == 1;
      const View view(camera, scene);
      hulls.visit(number, frame, [&](const Hull& in_world) {
        const Hull in_eye_space = moved(camera.world_to_eye, in_world);
        const PictureBounds bounds = view.bound(in_eye_space);
        take_in(bounds.lines);
        if (any_still) cover(bounds);
        if (shadows && casts) way.add(in_world, in_eye_space);
      });
    });
    way.finish();
    if (shadows && !way.in_world().is_empty())
      shadows->visit(way.in_world(), [this](const PictureBounds& bounds) { take_in(bounds.lines); });
  }
}

void Sweep::take_in(const LineRange& lines) {
  if (lines.count() == 0) return;
  lines_ =
      lines_.count() == 0 ? lines : LineRange{std::min(lines_.first, lines.first), std::max(lines_.last, lines.last)};
}

}  // namespace mars::geometry
