// The models that a film can have as actors: those of the library, and files beside the one that is open.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "host/content/document/recorded_reads.h"

namespace mars::studio {

struct ListedModel {
  std::string name;     // as `mars film FILM add ACTOR --model` takes it: "man", "soldier.json"
  std::string what;     // the library's sentence; "": of a file
  std::string kind;     // "figure" or "object" of the library, or "file"
  std::string version;  // another one whenever the file changes; "": of the library

  bool operator==(const ListedModel&) const = default;
};

class ModelList {
 public:
  explicit ModelList(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Looks at the folder; returns whether the list is another.
  bool look();
  // The library's, then files by their names.
  const std::vector<ListedModel>& models() const { return models_; }
  const ListedModel* find(const std::string& name) const;  // nullptr: none

 private:
  struct KnownFile {
    document::FileStamp stamp;
    bool is_model;
  };

  bool is_model(const std::filesystem::path& file, const document::FileStamp& stamp);

  std::filesystem::path folder_;
  std::map<std::filesystem::path, KnownFile> known_;
  std::vector<ListedModel> models_;
};

}  // namespace mars::studio
