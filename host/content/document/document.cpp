#include "host/content/document/document.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"

namespace mars::document {
namespace {

// Walks the text for the parser and knows how far it has come.
struct Reader {
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  using iterator_category = std::input_iterator_tag;

  const char* at;
  const char** reached;

  char operator*() const { return *at; }
  Reader& operator++() {
    *reached = at++;
    return *this;
  }
  Reader operator++(int) {
    const Reader before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Reader& other) const { return at == other.at; }
  bool operator!=(const Reader& other) const { return at != other.at; }
};

// What is not JSON, by words of the parser's message, which are not for people. The first that fits counts.
struct Mistake {
  std::string_view words;
  const char* problem;
  const char* remedy;
};

constexpr const char* kEndsEarly = "it ends before its last bracket";
constexpr const char* kCutShort = "the file may be cut short";
constexpr const char* kEscapes = "after a backslash write one of \" \\ / b f n r t, or u and four hexadecimal digits";
constexpr std::array kMistakes = {
    Mistake{"; expected end of input", "it goes on after its end", "take out what follows the last bracket"},
    Mistake{"end of input", kEndsEarly, kCutShort},
    Mistake{"missing closing quote", "it ends within a text", kCutShort},
    Mistake{"UTF-8", "a text is not UTF-8", "save the file as UTF-8"},
    Mistake{"control character", "a text holds the end of a line, or another control character",
            "end each text in the line where it begins"},
    Mistake{"surrogate", "a text holds half a character", kEscapes},
    Mistake{"backslash", "a text holds a wrong escape", kEscapes},
    Mistake{"'\\u'", "a text holds a wrong escape", kEscapes},
    Mistake{"number overflow", "a number is too large", "write one below 1.8e308"},
    Mistake{"invalid number", "a number is not complete", "write numbers like -1, 0.5 or 2e-3"},
};

// The problem and the remedy.
std::pair<std::string, const char*> complaint(const std::string& token, std::string_view message) {
  for (const Mistake& mistake : kMistakes)
    if (message.find(mistake.words) != message.npos)
      return {std::string("is not JSON: ") + mistake.problem, mistake.remedy};
  if (token.find('/') != token.npos) return {"is not JSON", "JSON has no comments: take them out"};
  return {"is not JSON", "write plain JSON: keys and texts in double quotes, no trailing commas, no NaN"};
}

}  // namespace

// Takes the parser's events and appends nodes.
class Builder {
 public:
  Builder(Document& document, std::string_view json, const char* const& reached)
      : document_(document), json_(json), reached_(reached), counted_(json.data()) {
    document_.texts_.push_back('\0');
  }

  bool null() { return add(Kind::null), true; }
  bool boolean(bool value) { return add(Kind::boolean).boolean = value, true; }
  bool number_integer(std::int64_t value) { return add(Kind::number).number = static_cast<double>(value), true; }
  bool number_unsigned(std::uint64_t value) { return add(Kind::number).number = static_cast<double>(value), true; }
  bool number_float(double value, const std::string&) { return add(Kind::number).number = value, true; }
  bool string(std::string& value) {
    require_sound(value, "text");
    const std::uint64_t offset = store(value);
    add(Kind::text).text = offset;
    return true;
  }
  bool binary(std::vector<std::uint8_t>&) { return false; }
  bool start_object(std::size_t) { return open(Kind::object); }
  bool start_array(std::size_t) { return open(Kind::list); }
  bool key(std::string& value) {
    require_sound(value, "key");
    key_ = static_cast<std::uint32_t>(store(value));
    return true;
  }
  bool end_array() { return close(), true; }
  bool end_object() {
    refuse_double_keys(open_.back());
    return close(), true;
  }
  bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& error) {
    if (cut_short()) fail(std::string("is not JSON: ") + kEndsEarly, kCutShort);
    const auto [problem, remedy] = complaint(token, error.what());
    fail_here(problem, remedy);
  }

 private:
  using Node = Document::Node;

  // Newlines before the last character read: a number is known only by the character after it.
  std::uint32_t line() {
    line_ += static_cast<std::uint32_t>(std::count(counted_, reached_, '\n'));
    counted_ = reached_;
    return line_;
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) {
    throw Failure(problem, document_.name_ + ":" + std::to_string(line()), remedy);
  }

  // As fail(), and names what is being read: a value, or the object of which it is a key.
  [[noreturn]] void fail_here(const std::string& problem, const std::string& remedy) {
    if (open_.empty()) fail(problem, remedy);
    const bool value = key_ != 0 || document_.nodes_[open_.back()].kind == Kind::list;
    if (value) add(Kind::null);
    const Element at(&document_, value ? static_cast<std::uint32_t>(document_.nodes_.size() - 1) : open_.back());
    const std::string path = at.path();
    throw Failure(problem, document_.name_ + ":" + std::to_string(line()) + (path.empty() ? "" : ": ") + path, remedy);
  }

  // All of it was read, lists or objects are open, and it does not end with a bracket that could close them.
  bool cut_short() const {
    const char* const last = json_.data() + json_.find_last_not_of(" \t\r\n");
    return !open_.empty() && reached_ >= last && *last != ']' && *last != '}';
  }

  void require_sound(const std::string& text, const std::string& what) {
    if (text.size() > kMaxText)
      fail_here("has a " + what + " of " + std::to_string(text.size()) + " bytes", "at most 4096 bytes");
    if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }))
      fail_here("has a " + what + " with a control character", "take it out");
  }

  std::uint64_t store(const std::string& text) {
    if (text.empty()) return 0;
    const std::uint64_t offset = document_.texts_.size();
    if (offset + text.size() > 0xf000'0000u) fail("has too much text", "use fewer or shorter names");
    document_.texts_.append(text).push_back('\0');
    return offset;
  }

  Node& add(Kind kind) {
    auto& nodes = document_.nodes_;
    if (nodes.size() >= kMaxElements) fail("has more than 60 million values", "spread it over several model files");
    if (!open_.empty()) ++nodes[open_.back()].count;
    Node node{};
    node.key = std::exchange(key_, 0);
    node.parent = open_.empty() ? 0 : open_.back();
    node.end = static_cast<std::uint32_t>(nodes.size() + 1);
    node.line = line();
    node.kind = kind;
    nodes.push_back(node);
    return nodes.back();
  }

  bool open(Kind kind) {
    if (open_.size() >= kMaxDepth)
      fail("nests lists and objects more than 64 deep", "films and models need fewer than 10 levels");
    add(kind).count = 0;
    open_.push_back(static_cast<std::uint32_t>(document_.nodes_.size() - 1));
    return true;
  }

  void close() {
    document_.nodes_[open_.back()].end = static_cast<std::uint32_t>(document_.nodes_.size());
    open_.pop_back();
  }

  void refuse_double_keys(std::uint32_t object) {
    const auto& nodes = document_.nodes_;
    const auto key_of = [&](std::uint32_t child) { return std::string_view(&document_.texts_[nodes[child].key]); };
    children_.clear();
    for (std::uint32_t child = object + 1; child < nodes.size(); child = nodes[child].end) children_.push_back(child);
    std::sort(children_.begin(), children_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(key_of(a), a) < std::pair(key_of(b), b); });
    const auto twice = std::adjacent_find(children_.begin(), children_.end(),
                                          [&](std::uint32_t a, std::uint32_t b) { return key_of(a) == key_of(b); });
    if (twice == children_.end()) return;
    document_.nodes_[object].end = static_cast<std::uint32_t>(nodes.size());
    Element(&document_, twice[1])
        .refuse("stands twice in one object, first in line " + std::to_string(nodes[*twice].line),
                "take one of them out");
  }

  Document& document_;
  const std::string_view json_;
  const char* const& reached_;
  const char* counted_;
  std::uint32_t line_ = 1;
  std::uint32_t key_ = 0;
  std::vector<std::uint32_t> open_;      // lists and objects not yet closed
  std::vector<std::uint32_t> children_;  // of the object being closed
};

const char* name_of(Kind kind) {
  constexpr const char* names[] = {"null", "true or false", "a number", "a text", "a list", "an object"};
  return names[static_cast<std::size_t>(kind)];
}

Document::Document(std::string_view json, std::string name) : name_(std::move(name)) {
  if (json.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw Failure("is empty", name_, "write a film or model as JSON");
  if (json.substr(0, 4096).find('\0') != std::string_view::npos)
    throw Failure("is binary, not JSON", name_,
                  "name a film or model written as JSON; mars import makes one of another program's file");
  const char* reached = json.data();
  Builder builder(*this, json, reached);
  const char* const end = json.data() + json.size();
  nlohmann::json::sax_parse(Reader{json.data(), &reached}, Reader{end, &reached}, &builder);
}

Document read_document(const std::filesystem::path& path) {
  return Document(read_file(path, kLargestDocument), path.string());
}

Document read_document(const Element& name, const std::filesystem::path& path) {
  std::string text;
  try {
    text = read_file(path, kLargestDocument);
  } catch (const Failure& failure) {
    throw Failure(failure.problem, name.where() + ": " + failure.where, failure.remedy);
  }
  return Document(text, path.string());
}

Kind Element::kind() const { return document_->nodes_[index_].kind; }

std::uint32_t Element::line() const { return document_->nodes_[index_].line; }

std::string_view Element::key() const { return &document_->texts_[document_->nodes_[index_].key]; }

std::optional<Element> Element::parent() const {
  if (index_ == 0) return std::nullopt;
  return Element(document_, document_->nodes_[index_].parent);
}

std::string Element::path() const {
  if (index_ == 0) return "";
  const Element parent(document_, document_->nodes_[index_].parent);
  const std::string above = parent.path();
  if (parent.kind() == Kind::list) {
    std::size_t number = 0;
    for (Iterator sibling = parent.begin(); sibling.index_ < index_; ++sibling) ++number;
    return above + "[" + std::to_string(number) + "]";
  }
  const std::string_view name = key();
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c >= 0x80;
  });
  if (!plain) return above + "[\"" + shortened(name) + "\"]";
  return (above.empty() ? "" : above + ".") + shortened(name);
}

std::string Element::where() const {
  const std::string at = path();
  const std::string file = document_->name() + ":" + std::to_string(line());
  return at.empty() ? file : file + ": " + at;
}

Element::Iterator Element::begin() const { return {document_, index_ + 1}; }

Element::Iterator Element::end() const { return {document_, document_->nodes_[index_].end}; }

std::size_t Element::size() const { return kind() >= Kind::list ? document_->nodes_[index_].count : 0; }

Element::Iterator& Element::Iterator::operator++() {
  index_ = document_->nodes_[index_].end;
  return *this;
}

std::optional<Element> Element::find(std::string_view key) const {
  if (kind() != Kind::object) return std::nullopt;
  for (const Element child : *this)
    if (child.key() == key) return child;
  return std::nullopt;
}

double Element::number() const {
  check(kind() == Kind::number, "a number is asked of a number");
  return document_->nodes_[index_].number;
}

bool Element::boolean() const {
  check(kind() == Kind::boolean, "true or false is asked of a boolean");
  return document_->nodes_[index_].boolean;
}

std::string_view Element::text() const {
  check(kind() == Kind::text, "a text is asked of a text");
  return &document_->texts_[document_->nodes_[index_].text];
}

void Element::refuse(const std::string& problem, const std::string& remedy) const {
  throw Failure(problem, where(), remedy);
}

}  // namespace mars::document
