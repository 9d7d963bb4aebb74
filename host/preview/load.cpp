#include "host/preview/load.h"

#include "host/content/animator/reading/read_film.h"
#include "host/content/document/document.h"
#include "host/content/film/film_file.h"
#include "host/content/modeler/model_file.h"
#include "host/preview/viewpoint.h"

namespace mars::preview {
namespace {

bool is_model(const document::Element& root) {
  return root.kind() == document::Kind::object && (root.find("joints") || root.find("from")) && !root.find("actors");
}

}  // namespace

Previewed load_previewed(const std::filesystem::path& path) {
  if (film::is_compiled_film(path)) {
    film::CompiledFilm film = film::load_compiled_film(path);
    Wireframe wireframe = wireframe_of(film, nullptr);
    return {std::move(film), std::move(wireframe)};
  }
  const document::Document document = document::read_document(path);
  const bool model = is_model(document.root());
  animator::Film source = model ? turntable(modeler::read_own_model(document.root()), path.string())
                                : animator::read_film(document.root(), path.parent_path());
  film::CompiledFilm film = film::compile(source);
  Wireframe wireframe = wireframe_of(film, &source);
  return {std::move(film), std::move(wireframe), std::move(source), model};
}

}  // namespace mars::preview
