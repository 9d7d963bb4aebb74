#include "host/content/film/film_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"

namespace mars::film {
namespace {

// As PNG's: no text file begins so, and a transfer as text breaks it.
constexpr std::array<char, 8> kMagic = {'\x89', 'M', 'A', 'R', 'S', '\r', '\n', '\x1a'};

struct Header {
  std::array<char, 8> magic;
  std::uint32_t version;  // of the block
  std::uint32_t actors;
  std::uint32_t joints;
  std::uint32_t zero;
  std::uint64_t block_bytes;
  std::array<char, 32> checksum;  // of all before it and of the block
};
constexpr std::size_t kCompared = std::size_t{1} << 16;  // bytes at a time
static_assert(sizeof(Header) == sizeof(CompiledFilm::Line));

std::array<char, 32> checksum_over(const Header& header, std::span<const std::byte> block) {
  document::Checksum checksum;
  checksum.add(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, checksum)));
  checksum.add(block);
  const std::string digits = checksum.digits();
  check(digits.size() == 32, "a checksum has 32 digits");
  std::array<char, 32> copy;
  std::copy(digits.begin(), digits.end(), copy.begin());
  return copy;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw Failure("is no sound compiled film: " + what, path.string(), "compile the film again with `mars compile`");
}

void write_film(const CompiledFilm& film, const document::Write& write) {
  Header header{kMagic, wire::kFilmVersion, film.actors, film.joints, 0, film.block().size(), {}};
  header.checksum = checksum_over(header, film.block());
  const auto text_of = [](const void* bytes, std::size_t count) {
    return std::string_view(static_cast<const char*>(bytes), count);
  };
  write(text_of(&header, sizeof header));
  write(text_of(film.block().data(), film.block().size()));
}

}  // namespace

void save_film(const CompiledFilm& film, const std::filesystem::path& path) {
  document::write_whole_file(path, [&](const document::Write& write) { write_film(film, write); });
}

void save_film(const CompiledFilm& film, const std::filesystem::path& path, const std::filesystem::path& part) {
  document::replace_file(path, part, [&](const document::Write& write) { write_film(film, write); });
}

bool is_saved(const CompiledFilm& film, const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;
  std::ifstream file(path, std::ios::binary);
  bool same = true;
  std::string there(kCompared, '\0');
  write_film(film, [&](std::string_view piece) {
    for (; same && !piece.empty(); piece.remove_prefix(std::min(piece.size(), kCompared))) {
      const std::string_view part = piece.substr(0, kCompared);
      same = file.read(there.data(), static_cast<std::streamsize>(part.size())) && there.starts_with(part);
    }
  });
  return same && file.peek() == std::ifstream::traits_type::eof();
}

bool is_compiled_film(const std::filesystem::path& path) {
  return document::read_start(path, kMagic.size()) == std::string_view(kMagic.data(), kMagic.size());
}

CompiledFilm load_compiled_film(const std::filesystem::path& path) {
  const std::string bytes = document::read_file(path);
  Header header;
  if (bytes.size() < sizeof header) refuse(path, "it is cut short");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != kMagic) refuse(path, "it does not begin as one");
  if (header.version != wire::kFilmVersion)
    refuse(path, "it has version " + std::to_string(header.version) + ", this program reads " +
                     std::to_string(wire::kFilmVersion));
  if (header.block_bytes != bytes.size() - sizeof header || header.block_bytes % sizeof(CompiledFilm::Line) != 0)
    refuse(path, bytes.size() - sizeof header < header.block_bytes ? "it is cut short" : "its size is wrong");
  CompiledFilm film;
  film.lines.resize(header.block_bytes / sizeof(CompiledFilm::Line));
  std::memcpy(film.lines.data(), bytes.data() + sizeof header, header.block_bytes);
  if (checksum_over(header, film.block()) != header.checksum) refuse(path, "its checksum is wrong");
  film.source = path.string();
  film.actors = header.actors;
  film.joints = header.joints;
  wire::PackedFilm(film.block(), film.source);  // checks every index
  return film;
}

}  // namespace mars::film
