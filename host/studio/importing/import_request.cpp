#include "host/studio/importing/import_request.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/importer/file_kind.h"

namespace mars::studio {
namespace {

using importer::FileKind;

constexpr std::size_t kLongestName = 100, kDeepestName = 8, kLongestValue = 40;
constexpr std::array<std::string_view, 5> kOptions{"height", "scale", "front", "up", "crease"};

// No part of it is hidden, leads elsewhere, or could harm a terminal.
bool is_plain(const std::string& name) {
  const auto is_odd = [](unsigned char c) { return c < ' ' || c == 127 || c == '\\'; };
  const bool begins_well = !name.empty() && name.front() != '/' && name.front() != '.' && name.front() != '-';
  return begins_well && name.back() != '/' && name.find("//") == name.npos && name.find("/.") == name.npos &&
         std::ranges::none_of(name, is_odd);
}

bool is_short(const std::string& name) {
  std::size_t parts = 0;
  for (const std::filesystem::path& part : std::filesystem::path(name))
    if (++parts > kDeepestName || part.string().size() > kLongestName) return false;
  return true;
}

ImportedFile read_file_of(const Json& json) {
  const std::string name = json.at("name").get<std::string>();
  if (!is_plain(name) || !is_short(name))
    throw Failure("cannot name an imported file", document::in_quotes(document::printable(name)),
                  "rename it: without a leading dot or dash, of at most 100 bytes");
  const Json& size = json.at("size");
  if (!size.is_number_unsigned()) throw Failure("has no size", name, "");
  return {name, size.get<std::uint64_t>()};
}

// Their values are the command's to check.
std::vector<std::string> read_options(const Json& options) {
  if (!options.is_object()) throw Failure("an import's options are an object", "", "");
  for (const auto& [name, value] : options.items())
    if (std::ranges::find(kOptions, name) == kOptions.end())
      throw Failure("is no option of imports by pages", document::in_quotes(document::printable(name)),
                    "they have " + document::joined(kOptions));
  std::vector<std::string> words;
  for (const std::string_view name : kOptions) {
    const auto found = options.find(name);
    if (found == options.end() || found->is_null() || *found == "") continue;
    const std::string value = found->is_number() ? found->dump() : found->get<std::string>();
    if (value.size() > kLongestValue || value.find('\0') != value.npos)
      throw Failure("is no value of the option", "--" + std::string(name), "see mars import --help");
    words.push_back("--" + std::string(name) + "=" + value);
  }
  return words;
}

void check_size(const std::vector<ImportedFile>& files) {
  std::uint64_t bytes = 0;
  for (const ImportedFile& file : files) {
    if (file.bytes > kMostImportedBytes - bytes)
      throw Failure("are more than " + std::to_string(kMostImportedBytes >> 20) + " MiB together", "the files",
                    "import them by the command: mars import " + document::printable(file.name));
    bytes += file.bytes;
  }
}

// Letters of all alphabets, digits, and what joins them: a name for a file, a joint and an actor.
std::string name_for(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string();
  for (char& c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (letter < 128 && !std::isalnum(letter) && c != '-' && c != '_' && c != '.') c = '-';
  }
  name.erase(0, name.find_first_not_of("-._"));
  return name.empty() ? "figure" : name;
}

}  // namespace

void add_files(ImportRequest& request, const Json& message) {
  const Json& list = message.at("files");
  std::vector<ImportedFile> files = request.files;
  if (!list.is_array() || list.empty() || list.size() > kMostImportedFiles - files.size())
    throw Failure("one import takes 1 to " + std::to_string(kMostImportedFiles) + " files", "", "import fewer at once");
  std::set<std::string> names;
  for (const ImportedFile& file : files) names.insert(file.name);
  for (const Json& file : list) {
    files.push_back(read_file_of(file));
    if (!names.insert(files.back().name).second)
      throw Failure("is there twice", files.back().name, "import one of the two");
  }
  check_size(files);
  request.files = std::move(files);
}

ImportRequest import_request(const Json& message) {
  ImportRequest request;
  add_files(request, message);
  if (const auto options = message.find("options"); options != message.end()) request.options = read_options(*options);
  return request;
}

std::vector<ImportJob> import_jobs(const std::vector<ImportedFile>& files) {
  std::vector<std::string> captured, skeletons;
  std::vector<ImportJob> jobs;
  for (const ImportedFile& file : files) {
    const auto kind = importer::known_kind(file.name);
    if (kind == FileKind::amc)
      captured.push_back(file.name);
    else if (kind == FileKind::asf)
      skeletons.push_back(file.name);
    else if (kind)
      jobs.push_back({file.name, {}, kind == FileKind::bvh, name_for(file.name)});
  }
  std::ranges::sort(captured);
  if (!captured.empty())
    jobs.push_back({captured.front(), {captured.begin() + 1, captured.end()}, true, name_for(captured.front())});
  else
    for (const std::string& skeleton : skeletons) jobs.push_back({skeleton, {}, false, name_for(skeleton)});
  if (jobs.empty()) importer::kind_of_name(files.front().name);  // says what it is, and what to do
  return jobs;
}

}  // namespace mars::studio
