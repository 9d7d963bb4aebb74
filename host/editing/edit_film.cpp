#include "host/editing/edit_film.h"

#include "host/content/animator/reading/read_film.h"
#include "host/editing/film_in_memory.h"

namespace mars::editing {

Done edit_film(document::Json& film, const std::filesystem::path& path, std::span<const Command> commands) {
  const document::Document document(document::laid_out(film), path.string());
  animator::Film meaning = animator::read_film(document.root(), path.parent_path());
  FilmInMemory memory(film, meaning, path, {});
  memory.execute(commands);
  memory.keep();
  return memory.done();
}

}  // namespace mars::editing
