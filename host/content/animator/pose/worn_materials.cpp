#include "host/content/animator/pose/worn_materials.h"

#include <algorithm>

namespace mars::animator {
namespace {

// The name of the film's that the actor has in place of its model's; null: it has none.
const std::string* chosen_by(const Actor& actor, const std::string& material) {
  if (!actor.material.empty()) return &actor.material;
  const auto instead = std::ranges::find(actor.materials, material, &std::pair<std::string, std::string>::first);
  return instead == actor.materials.end() ? nullptr : &instead->second;
}

}  // namespace

WornMaterials::WornMaterials(const Film& film) : film_(film) {
  for (const MaterialMotion& motion : film.materials) of_film_.emplace(motion.name, &motion);
}

const std::string& WornMaterials::name_of(const Actor& actor, const std::string& material) {
  const std::string* const chosen = chosen_by(actor, material);
  return chosen ? *chosen : material;
}

std::optional<WornMaterial> WornMaterials::of(const Actor& actor, const std::string& material) const {
  const std::string& name = name_of(actor, material);
  if (name.empty()) return WornMaterial{};
  if (!chosen_by(actor, material))
    for (const modeler::NamedMaterial& own : film_.models[actor.model].materials)
      if (own.name == name) return WornMaterial{.of_model = &own};
  if (const auto found = of_film_.find(name); found != of_film_.end()) return WornMaterial{.of_film = found->second};
  return std::nullopt;
}

}  // namespace mars::animator
