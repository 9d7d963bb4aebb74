// A JSON file as a tree of elements that remember where they stand, so that every later error can name file,
// line, element path (actors[3].keys[1].pose.knee) and remedy. Plain JSON: no comments, no NaN, no key twice
// in one object; nesting, text and numbers within bounds. Read by fields.h, kept only while a film or model
// is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mars::document {

inline constexpr std::uintmax_t kLargestDocument = std::uintmax_t{1} << 30;  // bytes of its file
inline constexpr std::size_t kMaxDepth = 64;                                 // of lists and objects within each other
inline constexpr std::size_t kMaxElements = 60'000'000;
inline constexpr std::size_t kMaxText = 4096;  // bytes of one string or key

enum class Kind : std::uint8_t { null, boolean, number, text, list, object };

// "a list", for messages.
const char* name_of(Kind kind);

class Document;

// One value of a document; cheap to copy. The document must outlive it.
class Element {
 public:
  class Iterator;

  Kind kind() const;
  std::uint32_t line() const;    // from 1, where the value begins
  std::string path() const;      // "" for the whole document; long keys are shortened()
  std::string where() const;     // "film.json:12: actors[3].place"
  std::string_view key() const;  // its key in the object that holds it, "" in a list
  const Document& document() const { return *document_; }
  std::optional<Element> parent() const;  // none of the whole document

  // Children of a list or object, in the file's order; none in anything else.
  Iterator begin() const;
  Iterator end() const;
  std::size_t size() const;
  std::optional<Element> find(std::string_view key) const;

  // The value as it stands; the kind must be right.
  double number() const;
  bool boolean() const;
  std::string_view text() const;

  // Throws a Failure that names this element.
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;

 private:
  friend class Builder;
  friend class Document;
  Element(const Document* document, std::uint32_t index) : document_(document), index_(index) {}

  const Document* document_;
  std::uint32_t index_;
};

class Element::Iterator {
 public:
  using value_type = Element;
  using difference_type = std::ptrdiff_t;
  using iterator_category = std::input_iterator_tag;

  Element operator*() const { return {document_, index_}; }
  Iterator& operator++();
  bool operator==(const Iterator& other) const { return index_ == other.index_; }

 private:
  friend class Element;
  Iterator(const Document* document, std::uint32_t index) : document_(document), index_(index) {}

  const Document* document_;
  std::uint32_t index_;
};

class Document {
 public:
  // `name` is the file's name in messages.
  Document(std::string_view json, std::string name);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Element root() const { return {this, 0}; }
  const std::string& name() const { return name_; }

 private:
  friend class Element;
  friend class Element::Iterator;
  friend class Builder;

  // Elements stand in the file's order, each directly before its first child.
  struct Node {
    union {
      double number;
      std::uint64_t text;   // offset into texts_, zero-ended
      std::uint64_t count;  // of children
      bool boolean;
    };
    std::uint32_t key;  // offset into texts_; 0: none
    std::uint32_t parent;
    std::uint32_t end;  // one past the last descendant
    std::uint32_t line : 29;
    Kind kind : 3;
  };

  std::string name_;
  std::vector<Node> nodes_;
  std::string texts_;  // begins with a zero, so that offset 0 is ""
};

// Reads and parses a file.
Document read_document(const std::filesystem::path& path);
// One that `name` names: where it cannot be read, the failure names the place of `name`, too.
Document read_document(const Element& name, const std::filesystem::path& path);

}  // namespace mars::document
