// docs/nx-conformance.md is the table of the rules that the tests check.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/hal/conformance/rules.h"

namespace mars::conformance {
namespace {

TEST(Page, IsTheTableOfTheRules) {
  std::ifstream file(MARS_SOURCE_DIR "/docs/nx-conformance.md", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  if (page == table_of_rules()) return;
  std::ofstream("nx-conformance.md", std::ios::binary) << table_of_rules();
  FAIL() << "the page is not the suite's: cp " << std::filesystem::absolute("nx-conformance.md").string()
         << " docs/nx-conformance.md";
}

TEST(Page, NamesEveryBodyOnce) {
  std::set<std::string> names;
  for (const Rule& rule : rules()) EXPECT_TRUE(names.insert(rule.topic() + "/" + rule.body).second) << rule.body;
  EXPECT_GE(names.size(), 40u);
}

}  // namespace
}  // namespace mars::conformance
