// How the joints of a model of a glTF file move: as poses of joints that only turn, which is what keys can show, and as
// matrices, which show whatever the file's nodes do.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "host/content/importer/gltf/film_clock.h"
#include "host/content/importer/imported_mesh.h"
#include "host/content/importer/motions/film_text.h"
#include "host/content/modeler/frames.h"

namespace mars::importer {

class JointMotions {
 public:
  // `rest`: how the file's nodes stand in each other while the model rests. All must outlive it.
  JointMotions(const MeshFile& model, const NodesInFilm& nodes, const std::vector<glm::dmat4>& rest);
  JointMotions(auto&&, const NodesInFilm&&, auto&&...) = delete;

  const std::vector<modeler::Joint>& joints() const { return joints_; }
  std::size_t frames() const { return nodes_.frames(); }

  // Of each joint: leads from where a point that goes with it is while the model rests to where it is at the frame.
  std::vector<glm::dmat4> moves_at(std::size_t frame) const;

  // All that is seen at any frame.
  modeler::Box box() const;

  struct ByKeys {
    ActorMotion motion;                   // its place moves the lowest joint that carries all that is seen
    double error = 0;                     // how far a point may be from where the file has it, in units
    std::size_t sliding = 0, scaled = 0;  // joints of which keys do not show it
    double farthest = 0;                  // that one slides, in units
  };
  ByKeys by_keys() const;

  // Of a joint with a segment or one that is a bone; others need none.
  bool needs_matrix(std::size_t joint) const { return needs_matrix_[joint]; }
  // From the coordinates of its segment to the film's, for `moves` of moves_at().
  glm::dmat4 matrix(std::size_t joint, const glm::dmat4& moves) const;

 private:
  struct Slides;

  void add_boxes(const MeshFile& model);
  void add_skin(const MeshFile& model, std::size_t joint);
  void widen(std::size_t joint, const glm::dvec3& point);
  std::vector<glm::dmat3> turns_of(const std::vector<glm::dmat4>& moves) const;
  std::vector<glm::dvec3> places_of(const std::vector<glm::dmat3>& turns) const;
  void add_poses(const std::vector<glm::dmat3>& turns, ActorMotion& motion) const;
  std::size_t placed_joint(const std::vector<bool>& slides) const;
  double error_at(const std::vector<glm::dmat4>& moves, const std::vector<glm::dmat3>& turns,
                  const glm::dvec3& place) const;

  const NodesInFilm& nodes_;
  std::vector<glm::dmat4> nodes_at_rest_;
  std::vector<std::size_t> node_of_;  // of each joint; kNone: it goes with its parent
  std::vector<modeler::Joint> joints_;
  std::vector<glm::dvec3> origins_;                   // of each joint at rest
  std::vector<std::optional<modeler::Box>> carries_;  // at rest, what goes with each joint
  std::vector<bool> needs_matrix_;
  double size_;
};

}  // namespace mars::importer
