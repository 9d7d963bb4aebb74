#include "host/preview/load.h"

#include "host/content/animator/read_film.h"
#include "host/content/document/document.h"
#include "host/content/film/film_file.h"
#include "host/content/modeler/model_file.h"
#include "host/preview/viewpoint.h"

namespace mars::host {
namespace {

bool is_model(const Element& root) {
  return root.kind() == Kind::object && (root.find("joints") || root.find("from")) && !root.find("actors");
}

Film read_film_or_model(const std::filesystem::path& path) {
  const Document document = read_document(path);
  const Element root = document.root();
  if (is_model(root)) return turntable(read_own_model(root), path.string());
  return read_film(root, path.parent_path());
}

}  // namespace

Previewed load_previewed(const std::filesystem::path& path) {
  if (is_compiled_film(path)) {
    CompiledFilm film = load_compiled_film(path);
    View view = view_of(film, nullptr);
    return {std::move(film), std::move(view)};
  }
  const Film source = read_film_or_model(path);
  CompiledFilm film = compile(source);
  View view = view_of(film, &source);
  return {std::move(film), std::move(view)};
}

}  // namespace mars::host
