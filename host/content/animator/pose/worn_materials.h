// Which material a segment is made of: the actor's own choice, the film's in place of its model's, or its model's.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "host/content/animator/pose/film.h"

namespace mars::animator {

// One of the film or of a model; neither: the default.
struct WornMaterial {
  const MaterialMotion* of_film = nullptr;
  const modeler::NamedMaterial* of_model = nullptr;
};

class WornMaterials {
 public:
  explicit WornMaterials(const Film& film);  // which must outlive it
  explicit WornMaterials(const Film&&) = delete;

  // Of a segment of the actor whose model names `material` ("": none); nothing if no such material is there.
  std::optional<WornMaterial> of(const Actor& actor, const std::string& material) const;

  // What the film or the model is then to have by that name.
  static const std::string& name_of(const Actor& actor, const std::string& material);
  static const std::string& name_of(const Actor&&, auto&&) = delete;
  static const std::string& name_of(auto&&, const std::string&&) = delete;

 private:
  const Film& film_;
  std::unordered_map<std::string_view, const MaterialMotion*> of_film_;
};

}  // namespace mars::animator
