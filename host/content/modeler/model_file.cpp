#include "host/content/modeler/model_file.h"

#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/modeler/read_model.h"

namespace mars::modeler {
namespace {

constexpr int kMostSources = 16;  // files derived from each other, in a row

// Of all segments, also those of the file that the model is derived from; what is not as it should be is left to
// read_model() to refuse.
void add_materials(const document::Element& model, int sources, std::vector<std::string>& names) {
  if (const auto joints = model.find("joints"))
    for (const document::Element joint : *joints) {
      const auto segment = joint.find("segment");
      const auto material = segment ? segment->find("material") : std::nullopt;
      if (material && material->kind() == document::Kind::text) names.emplace_back(material->text());
    }
  const auto from = model.find("from");
  if (!from || from->kind() != document::Kind::text || sources == kMostSources) return;
  const std::filesystem::path folder = std::filesystem::path(from->document().name()).parent_path();
  const document::Document source = document::read_document(*from, folder / from->text());
  add_materials(source.root(), sources + 1, names);
}

}  // namespace

Model read_own_model(const document::Element& element) {
  if (element.find("actors") || element.find("models"))
    element.refuse("is a film, not a model",
                   "put the model into a file of its own and name it in the film: \"models\": {\"dog\": \"dog.json\"}");
  std::vector<std::string> names;
  add_materials(element, 0, names);
  return read_model(element, std::vector<std::string_view>(names.begin(), names.end()));
}

Model load_own_model(const std::filesystem::path& path) {
  const document::Document document = document::read_document(path);
  return read_own_model(document.root());
}

void create_model(const std::filesystem::path& path, const document::Json& model) {
  if (std::filesystem::exists(path))
    throw Failure(
        "is there already", path.string(),
        "choose another name, change it with mars model MODEL add or set, or begin again in its place with --replace");
  document::write_json(path, model, read_own_model);
}

void change_model(const std::filesystem::path& path,
                  const std::function<void(document::Json& json, const Model& model)>& change) {
  const auto changed = [&](document::Json& json) {
    const Model model = load_own_model(path);
    try {
      change(json, model);
    } catch (const Failure& failure) {
      throw Failure(failure.problem, path.string() + (failure.where.empty() ? "" : ": ") + failure.where,
                    failure.remedy);
    }
  };
  document::change_json(path, changed, read_own_model);
}

}  // namespace mars::modeler
