#include "host/preview/load.h"

#include "host/content/animator/read_film.h"
#include "host/content/document/document.h"
#include "host/content/film/film_file.h"
#include "host/content/modeler/model_file.h"
#include "host/preview/viewpoint.h"

namespace mars::preview {
namespace {

bool is_model(const document::Element& root) {
  return root.kind() == document::Kind::object && (root.find("joints") || root.find("from")) && !root.find("actors");
}

animator::Film read_film_or_model(const std::filesystem::path& path) {
  const document::Document document = document::read_document(path);
  const document::Element root = document.root();
  if (is_model(root)) return turntable(modeler::read_own_model(root), path.string());
  return animator::read_film(root, path.parent_path());
}

}  // namespace

Previewed load_previewed(const std::filesystem::path& path) {
  if (film::is_compiled_film(path)) {
    film::CompiledFilm film = film::load_compiled_film(path);
    View view = view_of(film, nullptr);
    return {std::move(film), std::move(view)};
  }
  const animator::Film source = read_film_or_model(path);
  film::CompiledFilm film = film::compile(source);
  View view = view_of(film, &source);
  return {std::move(film), std::move(view)};
}

}  // namespace mars::preview
