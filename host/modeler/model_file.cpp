#include "host/modeler/model_file.h"

#include <vector>

#include "hal/failure.h"
#include "host/modeler/read_model.h"

namespace mars::host {
namespace {

// Of all segments; what is no segment with a material is left to read_model() to tell.
std::vector<std::string_view> materials_named(const Element& model) {
  std::vector<std::string_view> names;
  const auto joints = model.find("joints");
  if (!joints) return names;
  for (const Element joint : *joints) {
    const auto segment = joint.find("segment");
    const auto material = segment ? segment->find("material") : std::nullopt;
    if (material && material->kind() == Kind::text) names.push_back(material->text());
  }
  return names;
}

}  // namespace

Model read_own_model(const Element& element) {
  if (element.find("actors") || element.find("models"))
    element.refuse("is a film, not a model",
                   "put the model into a file of its own and name it in the film: \"models\": {\"dog\": \"dog.json\"}");
  return read_model(element, materials_named(element));
}

Model load_own_model(const std::filesystem::path& path) {
  const Document document = read_document(path);
  return read_own_model(document.root());
}

void create_model(const std::filesystem::path& path, const Json& model) {
  if (std::filesystem::exists(path))
    throw Failure("is there already", path.string(), "choose another name, or change it with mars model add or set");
  write_json(path, model, read_own_model);
}

void change_model(const std::filesystem::path& path, const std::function<void(Json& model)>& change) {
  const auto changed = [&](Json& model) {
    load_own_model(path);
    try {
      change(model);
    } catch (const Failure& failure) {
      throw Failure(failure.problem, path.string() + (failure.where.empty() ? "" : ": ") + failure.where,
                    failure.remedy);
    }
  };
  change_json(path, changed, read_own_model);
}

}  // namespace mars::host
