#include "host/preview/wireframe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>

#include "host/content/animator/pose/figure.h"
#include "host/content/animator/pose/joint_frames.h"
#include "host/content/film/light_writer.h"
#include "host/images/picture_size.h"
#include "host/preview/shape_lines.h"

namespace mars::preview {
namespace {

constexpr Color kGrey{0.7f, 0.7f, 0.7f};  // of joints that no segment lends its colour

glm::dvec3 column_of(const wire::Matrix& matrix, std::size_t column) {
  return {matrix.m[0][column], matrix.m[1][column], matrix.m[2][column]};
}

// From the middle of a prism, which may be sheared, to its farthest corner.
double radius_of(const wire::Matrix& matrix) {
  const glm::dvec3 x = column_of(matrix, 0), y = column_of(matrix, 1), z = column_of(matrix, 2);
  return 0.5 * std::max(std::max(glm::length(x + y + z), glm::length(x + y - z)),
                        std::max(glm::length(x - y + z), glm::length(x - y - z)));
}

// Grows to hold balls: exact in the box of their middles, generous with their radii.
class Holder {
 public:
  void add(const wire::Matrix& matrix) {
    glm::dvec3 middle;
    for (int r = 0; r < 3; ++r) {
      const auto& row = matrix.m[static_cast<std::size_t>(r)];
      middle[r] = 0.5 * (row[0] + row[1] + row[2]) + row[3];
    }
    low_ = glm::min(low_, middle);
    high_ = glm::max(high_, middle);
    radius_ = std::max(radius_, radius_of(matrix));
  }

  bool empty() const { return low_.x > high_.x; }
  Ball ball() const {
    return empty() ? Ball{{0, 0, 0}, 1} : Ball{0.5 * (low_ + high_), glm::length(high_ - low_) / 2 + radius_};
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::max();
  glm::dvec3 low_{kFar}, high_{-kFar};
  double radius_ = 0;
};

class Maker {
 public:
  Maker(const film::CompiledFilm& film, const animator::Film* source) : film_(film.view()), source_(source) {}

  Wireframe make() {
    take_values();
    if (source_ != nullptr) find_joints();
    take_segments();
    if (source_ != nullptr)
      for (std::size_t actor = 0; actor < source_->actors.size(); ++actor) add_sticks(actor);
    else
      add_prism_axes();
    find_balls();
    return std::move(wireframe_);
  }

 private:
  void take_values() {
    const wire::FilmSettings& settings = film_.settings();
    wireframe_.frames = settings.frames;
    wireframe_.rate = settings.rate;
    const images::PictureSize size =
        images::with_square_pixels({settings.width, settings.height}, double{settings.pixel_aspect});
    wireframe_.width = size.width;
    wireframe_.height = size.height;
    wireframe_.background = film::shown_of(settings.background, settings.color_space);
    wireframe_.camera = settings.camera;
    wireframe_.cameras.assign(film_.cameras().begin(), film_.cameras().end());
    wireframe_.changes.assign(film_.changes().begin(), film_.changes().end());
    for (const wire::Matrix& matrix : film_.matrices()) wireframe_.matrices.push_back(placing(matrix));
    for (const wire::Material& material : film_.materials())
      wireframe_.colors.push_back(film::shown_of(material.color, settings.color_space));
  }

  std::uint32_t add_lines(Lines lines) {
    wireframe_.lines.push_back(std::move(lines));
    return static_cast<std::uint32_t>(wireframe_.lines.size() - 1);
  }

  // The film's segments come actor by actor, joint by joint.
  void find_joints() {
    for (std::size_t actor = 0; actor < source_->actors.size(); ++actor) {
      const modeler::Model& model = source_->model_of(actor);
      for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
        if (model.joints[joint].segment) joints_.push_back({actor, joint});
    }
  }

  void take_segments() {
    joints_.resize(film_.segments().size());
    for (const wire::Shape& shape : film_.shapes()) add_lines(control_net(film_, shape));
    const std::uint32_t cube = add_lines(cube_edges());
    std::map<std::uint32_t, std::uint32_t> prisms;  // of shapes with skins
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const wire::Segment& segment = film_.segments()[i];
      const auto bones = film_.bones_of(segment);
      parts(As::vertices)
          .push_back({segment.shape,
                      segment.motion,
                      segment.material,
                      joints_[i],
                      {bones.begin(), bones.end()},
                      segment.blend});
      Part prism{cube, segment.motion, segment.material, joints_[i]};
      if (!bones.empty()) {
        const auto [known, is_new] = prisms.try_emplace(segment.shape);
        if (is_new) known->second = add_lines(bone_prisms(film_, film_.shapes()[segment.shape]));
        prism = {known->second, segment.motion, segment.material, joints_[i], {bones.begin(), bones.end()},
                 segment.blend};
      }
      parts(As::prisms).push_back(prism);
    }
  }

  std::vector<Part>& parts(As as) { return wireframe_.parts[static_cast<std::size_t>(as)]; }

  const std::vector<std::uint32_t>& model_sticks(std::size_t model) {
    if (model_sticks_.empty()) model_sticks_.resize(source_->models.size());
    auto& numbers = model_sticks_[model];
    if (numbers.empty())
      for (Lines& lines : sticks_of(source_->models[model])) numbers.push_back(add_lines(std::move(lines)));
    return numbers;
  }

  void add_sticks(std::size_t actor_number) {
    const animator::Actor& actor = source_->actors[actor_number];
    const modeler::Model& model = source_->models[actor.model];
    const std::vector<std::uint32_t>& lines = model_sticks(actor.model);
    std::vector<std::size_t> bare;  // joints without a segment
    std::vector<wire::Track> looks;
    for (std::size_t number = 0; number < model.joints.size(); ++number) {
      const modeler::Joint& joint = model.joints[number];
      if (joint.segment) {
        const wire::Segment& segment = film_.segments()[next_segment_++];
        parts(As::stick).push_back({lines[number], segment.motion, segment.material, {actor_number, number}});
        looks.push_back(segment.material);
      } else {
        looks.push_back(joint.parent == modeler::kNone ? grey() : looks[joint.parent]);
        if (actor.matrices.empty()) bare.push_back(number);
      }
    }
    if (!bare.empty()) add_bare_joints(actor_number, bare, lines, looks);
  }

  wire::Track grey() {
    if (!grey_) {
      grey_ = wire::Track{static_cast<std::uint32_t>(wireframe_.changes.size()), 1};
      wireframe_.changes.push_back({0, static_cast<std::uint32_t>(wireframe_.colors.size())});
      wireframe_.colors.push_back(kGrey);
    }
    return *grey_;
  }

  // Where joints without segments stand, only what changes.
  void add_bare_joints(std::size_t actor_number, const std::vector<std::size_t>& joints,
                       const std::vector<std::uint32_t>& lines, const std::vector<wire::Track>& looks) {
    const animator::Actor& actor = source_->actors[actor_number];
    animator::Figure figure(source_->models[actor.model], actor.motion);
    animator::JointFrames carriers(*source_);
    std::vector<std::vector<wire::Change>> changes(joints.size());
    const std::uint32_t frames = figure.still() && actor.attach.empty() ? 1 : source_->frames;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      if (!figure.move_to(frame, carriers.root_of(actor_number, frame))) continue;
      for (std::size_t i = 0; i < joints.size(); ++i) {
        if (!figure.moved(joints[i])) continue;
        changes[i].push_back({frame, static_cast<std::uint32_t>(wireframe_.matrices.size())});
        wireframe_.matrices.push_back(placing(figure.frame_of(joints[i])));
      }
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const wire::Track track{static_cast<std::uint32_t>(wireframe_.changes.size()),
                              static_cast<std::uint32_t>(changes[i].size())};
      wireframe_.changes.insert(wireframe_.changes.end(), changes[i].begin(), changes[i].end());
      parts(As::stick).push_back({lines[joints[i]], track, looks[joints[i]], {actor_number, joints[i]}});
    }
  }

  void add_prism_axes() {
    wireframe_.sticks_of_prisms = true;
    const std::array<std::uint32_t, 3> axes{add_lines(cube_axis(0)), add_lines(cube_axis(1)), add_lines(cube_axis(2))};
    for (const wire::Segment& segment : film_.segments()) {
      const wire::Matrix& matrix = film_.matrix_at(segment, 0);
      std::size_t longest = 0;
      for (const std::size_t axis : {1u, 2u})
        if (glm::length(column_of(matrix, axis)) > glm::length(column_of(matrix, longest))) longest = axis;
      parts(As::stick).push_back({axes[longest], segment.motion, segment.material});
    }
  }

  void find_balls() {
    Holder all, moving;
    for (const wire::Segment& segment : film_.segments())
      for (std::uint32_t i = 0; i < segment.motion.count; ++i) {
        const wire::Matrix& matrix = film_.matrices()[film_.changes()[segment.motion.first + i].value];
        all.add(matrix);
        if (segment.motion.count > 1) moving.add(matrix);
      }
    wireframe_.whole = all.ball();
    wireframe_.subject = moving.empty() ? wireframe_.whole : moving.ball();
  }

  const wire::PackedFilm film_;
  const animator::Film* source_;
  Wireframe wireframe_;
  std::vector<std::vector<std::uint32_t>> model_sticks_;  // of each model, by joint; made when asked
  std::vector<JointNumber> joints_;                       // of each segment
  std::size_t next_segment_ = 0;
  std::optional<wire::Track> grey_;
};

}  // namespace

Placing placing(const wire::Matrix& matrix) {
  Placing flat;
  for (std::size_t i = 0; i < 12; ++i) flat[i] = static_cast<float>(matrix.m[i / 4][i % 4]);
  return flat;
}

wire::Matrix matrix_of(const Placing& placing) {
  wire::Matrix matrix;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c) matrix.m[r][c] = placing[4 * r + c];
  return matrix;
}

Placing placing(const modeler::Axes& frame) {
  Placing flat;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) flat[4 * row + column] = static_cast<float>(frame.turn[column][row]);
    flat[4 * row + 3] = static_cast<float>(frame.place[row]);
  }
  return flat;
}

std::uint32_t Wireframe::value_at(const wire::Track& track, std::uint32_t frame) const {
  const auto first = changes.begin() + track.first, last = first + track.count;
  const auto after = std::upper_bound(first, last, frame,
                                      [](std::uint32_t f, const wire::Change& change) { return f < change.frame; });
  return (after - 1)->value;
}

Wireframe wireframe_of(const film::CompiledFilm& film, const animator::Film* source) {
  return Maker(film, source).make();
}

}  // namespace mars::preview
