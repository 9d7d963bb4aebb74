#include "host/studio/models/model_list.h"

#include <algorithm>
#include <span>
#include <utility>

#include "host/content/document/file.h"
#include "host/content/document/json_file.h"
#include "host/content/modeler/figure_library.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;
using document::Json;

constexpr std::size_t kHead = 1 << 16;   // bytes of a file in which it says what it is
constexpr std::size_t kMostFiles = 500;  // that are listed

// Reads the keys at the top until one says whether the file is a model. The rest of it may be broken: its picture then
// says so.
class KindReader final : public nlohmann::json_sax<Json> {
 public:
  bool is_model() const { return is_model_; }

  bool key(string_t& name) override {
    if (depth_ != 1) return true;
    is_model_ = name == "joints" || name == "from";
    return !is_model_ && name != "actors" && name != "frames" && name != "camera";
  }
  bool start_object(std::size_t) override { return ++depth_ > 0; }
  bool end_object() override { return --depth_ > 0; }
  bool start_array(std::size_t) override { return ++depth_ > 1; }
  bool end_array() override { return --depth_ > 0; }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  int depth_ = 0;
  bool is_model_ = false;
};

bool says_that_it_is_a_model(const fs::path& file) {
  KindReader reader;
  Json::sax_parse(document::read_start(file, kHead), &reader);
  return reader.is_model();
}

void add_library(std::vector<ListedModel>& models, const char* kind, std::span<const modeler::LibraryFigure> all) {
  for (const modeler::LibraryFigure& each : all)
    models.push_back({std::string(each.name), std::string(each.what), kind, ""});
}

std::vector<fs::path> json_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
    const fs::path& path = entry->path();
    if (path.extension() == ".json" && !path.filename().string().starts_with('.')) files.push_back(path);
  }
  std::ranges::sort(files);
  if (files.size() > kMostFiles) files.resize(kMostFiles);
  return files;
}

std::string version_of(const document::FileStamp& stamp) {
  return std::to_string(stamp.inode) + "." + std::to_string(stamp.size) + "." + std::to_string(stamp.written);
}

}  // namespace

bool ModelList::is_model(const fs::path& file, const document::FileStamp& stamp) {
  const auto known = known_.find(file);
  if (known != known_.end() && known->second.stamp == stamp) return known->second.is_model;
  const bool is = says_that_it_is_a_model(file);
  known_[file] = {stamp, is};
  return is;
}

bool ModelList::look() {
  std::vector<ListedModel> now;
  add_library(now, "figure", modeler::figure_library());
  add_library(now, "object", modeler::object_library());
  for (const fs::path& file : json_files(folder_)) {
    const document::FileStamp stamp = document::stamp_of(file);
    if (stamp.exists && is_model(file, stamp)) now.push_back({file.filename(), "", "file", version_of(stamp)});
  }
  return std::exchange(models_, std::move(now)) != models_;
}

const ListedModel* ModelList::find(const std::string& name) const {
  const auto found = std::ranges::find(models_, name, &ListedModel::name);
  return found == models_.end() ? nullptr : &*found;
}

}  // namespace mars::studio
