#include "host/content/modeler/patch_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/content/modeler/teapot.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::modeler {
namespace {

namespace fs = std::filesystem;

class PatchFileTest : public testing::Test {
 protected:
  fs::path write(const std::string& text) const {
    std::ofstream(folder_ / "in.bpt") << text;
    return folder_ / "in.bpt";
  }
  std::string failure(const std::string& text) const {
    const fs::path path = write(text);
    return document::failure_of([&] { read_patch_file(path); });
  }

  const test::TemporaryFolder folder_;
};

std::string one_patch(const std::string& degrees = "3 3") {
  std::string text = "1\n" + degrees + "\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) text += std::to_string(10 + 2 * i) + " " + std::to_string(-j) + " 7\r\n";
  return text;
}

TEST_F(PatchFileTest, ScalesIntoTheUnitCube) {
  const PatchFile file = read_patch_file(write(one_patch()));
  ASSERT_EQ(file.patches.size(), 1u);
  EXPECT_EQ(file.bounds.min, glm::dvec3(10, -3, 7));
  EXPECT_EQ(file.bounds.max, glm::dvec3(16, 0, 8)) << "flat in z: one unit thick";
  EXPECT_EQ(file.extent, glm::dvec3(6, 3, 0));
  EXPECT_EQ(file.patches[0].points[0], (std::array<float, 3>{0, 1, 0}));
  EXPECT_EQ(file.patches[0].points[15], (std::array<float, 3>{1, 0, 0}));
}

TEST_F(PatchFileTest, TellsTheLineOfWhatIsWrong) {
  EXPECT_TRUE(document::holds(failure(""), "ends before the number of patches"));
  EXPECT_TRUE(document::holds(failure("x"), "has 'x' for the number of patches"));
  for (const char* count : {"0", "1.5", "4000000000", "1e300"})
    EXPECT_TRUE(document::holds(failure(count),
                                "for the number of patches (begin with the number of patches, a whole number from 1"));
  EXPECT_TRUE(document::holds(failure("1\n3 3\n0 2e9"), "has 2e+09 for y (at most 1e9"));
  EXPECT_TRUE(document::holds(failure("9999999\n3 3\n"), "cut short"));
  EXPECT_TRUE(document::holds(failure(one_patch("2 3")), ":2: has a patch of degrees 2 3"));
  EXPECT_TRUE(document::holds(failure(one_patch() + "1\n"), "goes on after its last patch"));
  EXPECT_TRUE(document::holds(failure("1\n3 3\n0 0 nan"), "in.bpt:3"));
}

TEST_F(PatchFileTest, TheTeapotOfOthersIsOurs) {
  const fs::path path = fs::path(MARS_SOURCE_DIR) / "../shared/data/teapot.bpt";
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const PatchFile file = read_patch_file(path);
  const auto ours = make_teapot(1);
  ASSERT_EQ(file.patches.size(), ours.size());
  EXPECT_EQ(file.bounds.min, kTeapotBounds.min);
  EXPECT_EQ(file.bounds.max, kTeapotBounds.max);
  for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_EQ(file.patches[i].points, ours[i].points);
}

}  // namespace
}  // namespace mars::modeler
