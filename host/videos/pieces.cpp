#include "host/videos/pieces.h"

#include <algorithm>
#include <span>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/document/filled_file.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/videos/probe.h"

namespace mars::videos {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "piece-";
constexpr const char* kListName = "pieces.txt";

fs::path pieces_folder(const fs::path& work) { return work / "pieces"; }

void add(document::Checksum& sum, const std::string& text) {
  sum.add(std::as_bytes(std::span(text.c_str(), text.size() + 1)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) document::fail_file("create the folder", folder, error.value());
}

bool is_own(const std::string& name) {
  return name.starts_with(kPrefix) || name.starts_with("." + std::string(kPrefix)) || name == kListName;
}

// Others are pieces of films as they were, of other options, or of a run that was killed while it wrote.
void remove_all_but(const std::vector<std::string>& names, const fs::path& folder) {
  std::error_code none;
  for (fs::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none)) {
    const std::string name = entry->path().filename().string();
    if (is_own(name) && std::ranges::find(names, name) == names.end()) fs::remove(entry->path(), none);
  }
}

// Names that are no addresses: # and ? mean nothing there.
std::string list_word(const fs::path& file) {
  std::string word = "'";
  for (const char c : file_word(file)) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

}  // namespace

void remove_pieces(const fs::path& work) {
  std::error_code none;
  remove_all_but({}, pieces_folder(work));
  fs::remove(pieces_folder(work), none);
}

Pieces::Pieces(const Source& source, const Form& form, const Order& order, std::vector<std::string> encoding,
               const fs::path& work)
    : source_(source), form_(form), encoding_(std::move(encoding)), file_(order.file), folder_(pieces_folder(work)) {
  make_folder(folder_);
  for (std::size_t first = 0; first < source.frames.size(); first += order.piece_frames) {
    const Span span{first, std::min(first + order.piece_frames, source.frames.size())};
    pieces_.push_back({span, name_of(span)});
  }
  std::vector<std::string> names;
  for (const Piece& piece : pieces_) names.push_back(piece.name);
  remove_all_but(names, folder_);
}

Pieces::~Pieces() {
  std::error_code none;
  fs::remove(folder_, none);  // not where it has something
}

std::string Pieces::name_of(Span span) const {
  document::Checksum sum;
  for (const std::string& word : input_words(form_, source_)) add(sum, word);
  for (const std::string& word : encoding_) add(sum, word);
  add(sum, std::to_string(source_.size.width) + "x" + std::to_string(source_.size.height));  // of what is padded
  for (std::size_t place = span.first; place < span.end; ++place) add(sum, source_.content(place));
  return std::string(kPrefix) + sum.digits() + std::string(form_.codec->piece_ending);
}

void Pieces::encode(const std::string& program, const Listener& listener) {
  std::size_t done = 0;
  const auto is_there = [&](const Piece& piece) { return document::file_exists(folder_ / piece.name); };
  for (const Piece& piece : pieces_)
    if (is_there(piece)) done += piece.span.end - piece.span.first;
  if (done > 0 && listener.note)
    listener.note(document::counted(done, "frame") + " of " + file_.string() + " are encoded already");
  for (const Piece& piece : pieces_)
    if (!is_there(piece)) encode(piece, program, listener, done);
}

void Pieces::encode(const Piece& piece, const std::string& program, const Listener& listener, std::size_t& done) {
  document::fill_whole_file(folder_ / piece.name, [&](const fs::path& part) {
    std::vector<std::string> words = input_words(form_, source_);
    words.insert(words.end(), encoding_.begin(), encoding_.end());
    words.insert(words.end(), {"-f", std::string(form_.codec->piece_muxer), file_word(part)});
    Ffmpeg ffmpeg(program, words, file_, listener.bounds);
    feed(ffmpeg, form_, source_, piece.span, [&] {
      ++done;
      if (listener.encoded) listener.encoded(done, source_.frames.size());
    });
    ffmpeg.finish();
    require_pictures(part, file_, piece.span.end - piece.span.first);
  });
}

fs::path Pieces::list() const {
  const double rate = exact_rate(source_.rate);
  std::string text;
  for (const auto& [span, name] : pieces_)
    text += "file " + list_word(folder_ / name) + "\nduration " +
            document::formatted("%.6f", static_cast<double>(span.end - span.first) / rate) + "\n";
  document::write_whole_file(folder_ / kListName, text);
  return folder_ / kListName;
}

void Pieces::remove() {
  pieces_.clear();
  remove_all_but({}, folder_);
}

}  // namespace mars::videos
