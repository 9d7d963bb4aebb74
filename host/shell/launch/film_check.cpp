#include "host/shell/launch/film_check.h"

#include <system_error>

#include "host/content/document/document.h"
#include "host/content/document/file.h"
#include "host/content/film/film_file.h"

namespace mars::launch {
namespace {

constexpr std::uintmax_t kParsed = 1 << 20;  // bytes: read twice at no cost that is noticed

}  // namespace

void check_film_file(const std::filesystem::path& film) {
  std::error_code none;
  const bool large = std::filesystem::file_size(film, none) > kParsed && !none;
  const bool readable = !document::read_start(film, 1).empty();
  if (readable && (large || film::is_compiled_film(film))) return;
  document::read_document(film);
}

}  // namespace mars::launch
