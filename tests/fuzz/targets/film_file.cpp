// .mars files: the input changes a sound one, whose checksum is then made right again unless its first byte says no.
#include <cstddef>
#include <cstring>

#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/film/film_file.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"
#include "tests/node/wire/small_film.h"

namespace mars::fuzz::film_file {
namespace {

constexpr std::size_t kLongest = 1 << 16;
constexpr std::size_t kHead = 64, kSummed = 32;  // bytes of the header, and of it before the checksum

Message sound() {
  const Message block = wire::pack(wire::small_film());
  film::CompiledFilm film;
  film.lines.resize(block.size() / sizeof(film::CompiledFilm::Line));
  std::memcpy(film.lines.data(), block.data(), block.size());
  const auto path = scratch().path("sound.mars");
  film::save_film(film, path);
  const std::string bytes = document::read_file(path);
  Message file(bytes.size());
  std::memcpy(file.data(), bytes.data(), bytes.size());
  return file;
}

void set_checksum(Message& file) {
  if (file.size() < kHead) return;
  document::Checksum checksum;
  checksum.add(std::span(file).first(kSummed));
  checksum.add(std::span(file).subspan(kHead));
  std::memcpy(file.data() + kSummed, checksum.digits().data(), kHead - kSummed);
}

}  // namespace

void take(std::string_view input) {
  static const Message whole = sound();
  Message file = whole;
  Script script(input);
  const bool right = script.byte() != 1;
  while (!script.at_end()) edit(file, script, kLongest);
  if (right) set_checksum(file);
  const auto path = scratch().file("film.mars", {reinterpret_cast<const char*>(file.data()), file.size()});
  const film::CompiledFilm film = film::load_compiled_film(path);
  film.view().patch_instances();
}

const Target target("film_file", Form::bytes, take);

}  // namespace mars::fuzz::film_file
