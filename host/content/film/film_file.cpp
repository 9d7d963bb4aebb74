#include "host/content/film/film_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <utility>

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

std::array<char, 32> checksum_over(const Header& header, const CompiledFilm& film) {
  document::Checksum checksum;
  checksum.add(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, checksum)));
  film.visit_pieces([&](std::span<const std::byte> piece) { checksum.add(piece); });
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
  header.checksum = checksum_over(header, film);
  const auto text_of = [](const void* bytes, std::size_t count) {
    return std::string_view(static_cast<const char*>(bytes), count);
  };
  write(text_of(&header, sizeof header));
  film.visit_pieces([&](std::span<const std::byte> piece) { write(text_of(piece.data(), piece.size())); });
}

// A film that is read piece by piece, so that it is in memory once.
class FilmReading {
 public:
  FilmReading(const std::filesystem::path& path, bool in_file) : path_(path), film_(empty_film(in_file)) {}

  void take(std::string_view piece) {
    if (read_ == 0) piece = take_header(piece);
    auto* const to = reinterpret_cast<char*>(film_.lines.data());
    if (piece.size() > header_.block_bytes - read_) refuse(path_, "its size is wrong");
    std::copy(piece.begin(), piece.end(), to + read_);
    read_ += piece.size();
    let_pages_go(film_.lines);
  }

  CompiledFilm film() {
    if (film_.lines.empty() || read_ < header_.block_bytes) refuse(path_, "it is cut short");
    if (checksum_over(header_, film_) != header_.checksum) refuse(path_, "its checksum is wrong");
    film_.source = path_.string();
    film_.actors = header_.actors;
    film_.joints = header_.joints;
    wire::PackedFilm(film_.block(), film_.source);  // checks every index
    let_pages_go(film_.lines);
    return std::move(film_);
  }

 private:
  // The first piece, which has all of it; returns what is behind.
  std::string_view take_header(std::string_view piece) {
    if (piece.size() < sizeof header_) refuse(path_, "it is cut short");
    std::memcpy(&header_, piece.data(), sizeof header_);
    if (header_.magic != kMagic) refuse(path_, "it does not begin as one");
    if (header_.version != wire::kFilmVersion)
      refuse(path_, "it has version " + std::to_string(header_.version) + ", this program reads " +
                        std::to_string(wire::kFilmVersion));
    const std::uintmax_t bytes = std::filesystem::file_size(path_);
    if (header_.block_bytes % sizeof(CompiledFilm::Line) != 0 || header_.block_bytes != bytes - sizeof header_)
      refuse(path_, bytes - sizeof header_ < header_.block_bytes ? "it is cut short" : "its size is wrong");
    film_.lines.resize(header_.block_bytes / sizeof(CompiledFilm::Line));
    return piece.substr(sizeof header_);
  }

  const std::filesystem::path& path_;
  Header header_{};
  CompiledFilm film_;
  std::size_t read_ = 0;  // bytes of the block
};

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

CompiledFilm load_compiled_film(const std::filesystem::path& path, bool in_file) {
  FilmReading reading(path, in_file);
  const auto take = [&](std::string_view piece) { reading.take(piece); };
  if (!document::read_pieces(path, take, document::kLargestFileRead))
    throw Failure("there is no such file", path.string(), "check its name");
  return reading.film();
}

}  // namespace mars::film
