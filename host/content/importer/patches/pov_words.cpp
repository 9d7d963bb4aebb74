#include "host/content/importer/patches/pov_words.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/sources/companion.h"
#include "host/content/importer/patches/patch_scene.h"

namespace mars::importer {
namespace {

constexpr std::size_t kDeepestInclude = 16;

bool begins_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }

class PovLexer {
 public:
  PovLexer(std::string_view file, const std::string& name) : rest_(file), name_(name) {}

  std::vector<PovWord> words() {
    std::vector<PovWord> all;
    do all.push_back(next());
    while (all.back().kind != PovKind::end);
    return all;
  }

 private:
  char at(std::size_t place) const { return place < rest_.size() ? rest_[place] : '\0'; }

  void drop(std::size_t count) {
    for (const char c : rest_.substr(0, count)) line_ += c == '\n';
    rest_.remove_prefix(std::min(count, rest_.size()));
  }

  // White space and comments; those between /* and */ may hold others.
  void skip() {
    while (!rest_.empty()) {
      if (std::isspace(static_cast<unsigned char>(rest_[0])))
        drop(1);
      else if (rest_.starts_with("//"))
        drop(std::min(rest_.find('\n'), rest_.size()));
      else if (rest_.starts_with("/*"))
        skip_comment();
      else
        return;
    }
  }

  void skip_comment() {
    const std::size_t begin = line_;
    std::size_t depth = 0;
    do {
      if (rest_.empty())
        throw Failure("has a comment without an end", name_ + ":" + std::to_string(begin), "end it with */");
      const bool opens = rest_.starts_with("/*"), closes = rest_.starts_with("*/");
      depth += opens;
      depth -= closes;
      drop(opens || closes ? 2 : 1);
    } while (depth > 0);
  }

  PovWord next() {
    skip();
    PovWord word{PovKind::end, "", 0, line_};
    if (rest_.empty()) return word;
    if (begins_word(rest_[0])) return named(PovKind::word, 0);
    if (rest_[0] == '#' && begins_word(at(1))) return named(PovKind::directive, 1);
    if (is_digit(rest_[0]) || (rest_[0] == '.' && is_digit(at(1)))) return number();
    if (rest_[0] == '"') return text();
    word.kind = PovKind::sign;
    word.text = rest_[0];
    drop(1);
    return word;
  }

  PovWord named(PovKind kind, std::size_t begin) {
    std::size_t end = begin;
    while (begins_word(at(end)) || is_digit(at(end))) ++end;
    PovWord word{kind, std::string(rest_.substr(begin, end - begin)), 0, line_};
    drop(end);
    return word;
  }

  PovWord number() {
    std::size_t end = 0;
    while (is_digit(at(end)) || at(end) == '.') ++end;
    if (const bool sign = at(end + 1) == '+' || at(end + 1) == '-';
        (at(end) == 'e' || at(end) == 'E') && is_digit(at(end + 1 + sign)))
      for (end += 1 + sign; is_digit(at(end));) ++end;
    PovWord word{PovKind::number, std::string(rest_.substr(0, end)), 0, line_};
    const std::string digits = (word.text[0] == '.' ? "0" : "") + word.text;
    const auto value = document::number_in<double>(digits.ends_with('.') ? digits + "0" : digits);
    if (!value)
      throw Failure("has '" + word.text + "', which is no number", name_ + ":" + std::to_string(line_), "correct it");
    word.number = *value;
    drop(end);
    return word;
  }

  PovWord text() {
    std::size_t end = 1;
    while (end < rest_.size() && rest_[end] != '"') end += rest_[end] == '\\' ? 2 : 1;
    if (end >= rest_.size())
      throw Failure("has a text without an end", name_ + ":" + std::to_string(line_), "end it with \"");
    PovWord word{PovKind::text, std::string(rest_.substr(1, end - 1)), 0, line_};
    drop(end + 1);
    return word;
  }

  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 1;
};

class PovIncluder {
 public:
  explicit PovIncluder(std::filesystem::path scene) : scene_(std::move(scene)) {}

  PovText read() {
    add("", scene_, 0);
    text_.words.push_back(std::move(end_));
    return std::move(text_);
  }

 private:
  // `inside`: the file's folder as seen from the scene's.
  void add(const std::filesystem::path& inside, const std::filesystem::path& path, std::size_t depth) {
    const std::string file = document::read_file(path, kLargestPatchScene);
    const std::size_t number = text_.files.size();
    text_.files.push_back(path.string());
    bytes_ += file.size();
    if (depth > kDeepestInclude || bytes_ > kLargestPatchScene)
      throw Failure("is included too often, or too deep", path.string(), "include it once");
    std::vector<PovWord> words = PovLexer(file, path.string()).words();
    for (PovWord& word : words) word.file = number;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
      const auto included =
          words[i].is(PovKind::directive, "include") ? file_of(inside, path, words[i + 1]) : std::nullopt;
      if (included)
        add(included->parent_path(), scene_.parent_path() / *included, depth + 1), ++i;
      else
        text_.words.push_back(std::move(words[i]));
    }
    end_ = std::move(words.back());
  }

  // As seen from the scene's folder, which it must not leave: beside the file that names it, or else in that folder.
  std::optional<std::filesystem::path> file_of(const std::filesystem::path& inside, const std::filesystem::path& path,
                                               const PovWord& name) const {
    std::error_code none;
    if (name.kind != PovKind::text) return std::nullopt;
    if (!stays_inside(inside / name.text)) companion(path, name.text);  // which refuses it
    for (const std::filesystem::path& file : {inside / name.text, std::filesystem::path(name.text)})
      if (stays_inside(file) && std::filesystem::is_regular_file(companion(scene_, file.string()), none)) return file;
    return std::nullopt;
  }

  std::filesystem::path scene_;
  PovText text_;
  PovWord end_;
  std::size_t bytes_ = 0;
};

}  // namespace

PovText pov_text(const std::filesystem::path& path) { return PovIncluder(path).read(); }

}  // namespace mars::importer
