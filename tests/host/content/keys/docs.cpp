#include "tests/host/content/keys/docs.h"

#include <sstream>
#include <vector>

#include "host/content/document/file.h"
#include "host/content/document/json_file.h"
#include "host/content/keys/schema.h"
#include "host/content/keys/text.h"
#include "host/content/modeler/shape_library.h"

namespace mars::keys {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBegin = "<!-- keys ", kEnd = "<!-- /keys -->";

// One table of the keys of all these objects.
std::string table_of_all(const std::string& names) {
  std::string table;
  std::istringstream words(names);
  for (std::string name; words >> name;) {
    std::string rows = markdown_of(object(name));
    if (!table.empty()) rows.erase(0, rows.find('\n', rows.find('\n') + 1) + 1);  // its head
    table += rows;
  }
  return table;
}

std::string with_tables(const std::string& page) {
  std::string text;
  std::size_t done = 0;
  for (std::size_t at = page.find(kBegin); at != std::string::npos; at = page.find(kBegin, done)) {
    const std::size_t names = at + kBegin.size(), names_end = page.find(" -->", names), end = page.find(kEnd, at);
    text += page.substr(done, names_end - done) + " -->\n" + table_of_all(page.substr(names, names_end - names));
    done = end;
  }
  return text + page.substr(done);
}

std::vector<std::string_view> shapes() {
  std::vector<std::string_view> names;
  for (const modeler::LibraryShape& shape : modeler::shape_library()) names.push_back(shape.name);
  return names;
}

}  // namespace

std::map<fs::path, std::string> docs_of_keys() {
  const fs::path docs = fs::path(MARS_SOURCE_DIR) / "docs";
  std::map<fs::path, std::string> files{
      {docs / "schema/film.schema.json", document::laid_out(film_schema())},
      {docs / "schema/model.schema.json", document::laid_out(model_schema(shapes()))}};
  for (const char* page : {"film-format.md", "light-and-materials.md", "model-format.md", "shapes.md"})
    files[docs / page] = with_tables(document::read_file(docs / page));
  return files;
}

}  // namespace mars::keys
