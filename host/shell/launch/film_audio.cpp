#include "host/shell/launch/film_audio.h"

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/fields.h"
#include "host/content/film/film_file.h"

namespace mars::launch {

std::optional<videos::Audio> audio_of_film(const std::filesystem::path& film) {
  if (film::is_compiled_film(film)) return std::nullopt;
  const document::Document document = document::read_document(film);
  const document::Fields fields(document.root(), keys::object("film"));
  const auto audio = fields.find("audio");
  if (!audio) return std::nullopt;
  return videos::Audio{document::read_file_name(*audio), fields.number("audio_delay")};
}

std::optional<videos::Audio> audio_of_folder(const sinks::Manifest& manifest) {
  if (manifest.sources.empty() || !document::file_exists(manifest.sources.front().path)) return std::nullopt;
  return audio_of_film(manifest.sources.front().path);
}

}  // namespace mars::launch
