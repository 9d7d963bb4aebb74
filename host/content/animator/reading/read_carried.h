// Reading of what goes along with an actor: attachments, points of the camera. Actors may stand later in the film, so
// this is read once all of them are known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/document/fields.h"

namespace mars::animator {

// Actors and joints by their names.
class Carriers {
 public:
  Carriers(const std::vector<Actor>& actors, const std::vector<modeler::Model>& models);  // which must outlive it
  Carriers(const std::vector<Actor>&&, auto&&...) = delete;
  Carriers(auto&&, const std::vector<modeler::Model>&&) = delete;

  // "actor" and, where it is given, "joint" of the object.
  struct Named {
    std::size_t actor, joint;
  };
  Named read(const document::Fields& fields) const;

 private:
  std::size_t actor(const document::Element& name) const;
  std::size_t joint(const document::Element& name, std::size_t actor) const;

  const std::vector<Actor>& actors_;
  const std::vector<modeler::Model>& models_;
  std::unordered_map<std::string_view, std::size_t> numbers_;
};

// Three numbers, or a point of an actor.
Point read_point(const document::Element& element, const Carriers& carriers);

// An "attach" where it stands in the film file.
struct WrittenAttachment {
  std::size_t actor;
  std::uint32_t frame;
  document::Element element;
};

// Gives the actors what is written, in its order. Throws where they would carry each other in a circle.
void read_attachments(const std::vector<WrittenAttachment>& written, const std::vector<modeler::Model>& models,
                      std::vector<Actor>& actors);

}  // namespace mars::animator
