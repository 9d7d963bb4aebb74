// Views of an OpenColorIO config that this test writes, against their formulas in doubles; and pixels of light.
#include "host/images/display_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/images/half_light.h"
#include "tests/temporary_folder.h"

namespace mars::images {
namespace {

using wire::PixelFormat;

// A matrix, then a power, or a table of three numbers a channel between which is interpolated.
constexpr const char* kConfig = R"(ocio_profile_version: 2
search_path: .
roles: {scene_linear: light, default: light}
displays:
  screen:
    - !<View> {name: Film, colorspace: film}
    - !<View> {name: Table, colorspace: table}
colorspaces:
  - !<ColorSpace>
    name: light
  - !<ColorSpace>
    name: half_light
    from_scene_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: film
    from_scene_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: [0.6, 0.3, 0.1, 0, 0.2, 0.7, 0.1, 0, 0, 0.25, 0.75, 0, 0, 0, 0, 1]}
        - !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1], direction: inverse}
  - !<ColorSpace>
    name: table
    from_scene_reference: !<FileTransform> {src: table.cube, interpolation: linear}
)";
constexpr const char* kTable = "LUT_1D_SIZE 3\nDOMAIN_MIN 0 0 0\nDOMAIN_MAX 1 1 1\n0 0 0\n0.7 0.6 0.5\n1 1 0.9\n";
constexpr double kMatrix[3][3] = {{0.6, 0.3, 0.1}, {0.2, 0.7, 0.1}, {0, 0.25, 0.75}};
constexpr double kMiddle[3] = {0.7, 0.6, 0.5}, kEnd[3] = {1, 1, 0.9};

class DisplayViews : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "config.ocio") << kConfig;
    std::ofstream(folder_ / "table.cube") << kTable;
  }

  ViewWish wish(const std::string& view, const std::string& input = "") const {
    return {(folder_ / "config.ocio").string(), "", view, input};
  }

  const test::TemporaryFolder folder_;
};

std::array<double, 3> film_of(const float* light) {
  std::array<double, 3> out{};
  for (std::size_t row = 0; row < 3; ++row) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += kMatrix[row][i] * double{light[i]};
    out[row] = std::pow(sum, 1 / 2.2);
  }
  return out;
}

double table_of(double light, std::size_t channel) {
  const double at = std::min(light, 1.0) * 2;
  return at < 1 ? at * kMiddle[channel] : kMiddle[channel] + (at - 1) * (kEnd[channel] - kMiddle[channel]);
}

TEST_F(DisplayViews, AreTheirFormulas) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> light(0, 1);
  std::vector<float> pixels(3 * 500);
  for (float& number : pixels) number = light(random);
  std::vector<float> film = pixels, table = pixels, brighter = pixels;
  open_view(wish("Film"))->show(film);
  open_view(wish("Table"))->show(table);
  open_view(wish("Film", "half_light"))->show(brighter);
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    const auto expected = film_of(&pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(double{film[i + c]}, expected[c], 2e-5);
      ASSERT_NEAR(double{table[i + c]}, table_of(double{pixels[i + c]}, c), 2e-5);
      ASSERT_NEAR(double{brighter[i + c]}, expected[c] * std::pow(0.5, 1 / 2.2), 2e-5);
    }
  }
}

TEST_F(DisplayViews, AreNamedByWhatTheyCompute) {
  const ViewName film = open_view(wish(""))->name();
  EXPECT_EQ(film.display, "screen");
  EXPECT_EQ(film.view, "Film");
  EXPECT_EQ(film.input, "scene_linear");
  EXPECT_EQ(open_view(wish("Film"))->name(), film);
  const ViewName table = open_view(wish("Table"))->name();
  EXPECT_NE(table.checksum, film.checksum);
  std::string config = kConfig;
  config.replace(config.find("0.25, 0.75"), 10, "0.35, 0.65");
  std::ofstream(folder_ / "config.ocio") << config;
  EXPECT_NE(open_view(wish("Film"))->name().checksum, film.checksum);
}

TEST_F(DisplayViews, RefuseWhatIsNotThere) {
  const auto problem = [](const ViewWish& wish) -> std::string {
    try {
      open_view(wish);
    } catch (const Failure& failure) {
      return failure.problem + " / " + failure.remedy;
    }
    return "";
  };
  EXPECT_EQ(problem(wish("Noir")), "has no view 'Noir' / it has Film, Table");
  EXPECT_NE(problem(wish("Film", "log")).find("no colour space or role"), std::string::npos);
  EXPECT_NE(problem({(folder_ / "none.ocio").string()}).find("is no file"), std::string::npos);
  EXPECT_NE(problem({(folder_ / "table.cube").string()}).find("is no sound OpenColorIO config"), std::string::npos);
  std::ofstream(folder_ / "odd.ocio") << "ocio_profile_version: 2\nroles: [\n";
  const std::string odd = problem({(folder_ / "odd.ocio").string()});
  EXPECT_NE(odd.find("it is not written as such configs are, in YAML, at line "), std::string::npos) << odd;
  EXPECT_EQ(odd.find("yaml-cpp"), std::string::npos) << odd;
  std::string config = kConfig;
  config.replace(config.find("table.cube"), 10, "gone1.cube");  // OpenColorIO keeps files that it has read
  std::ofstream(folder_ / "config.ocio") << config;
  EXPECT_NE(problem(wish("Table")).find("cannot show light"), std::string::npos);
}

// Shows what it gets.
class Plain : public DisplayView {
 public:
  Plain() : DisplayView({}) {}
  void show(std::span<float>) const override {}
};

TEST(ShownPixels, AreStraightAndExposed) {
  constexpr std::uint32_t kHalf = 0x3800, kQuarter = 0x3400, kOne = 0x3c00, kTwo = 0x4000, kBelow = 0xbc00;
  EXPECT_EQ(light_of_half(kQuarter), 0.25f);
  const std::vector<std::uint32_t> light{kQuarter | kTwo << 16, kBelow};
  EXPECT_EQ(shown_pixels(Plain(), light, 1, PixelFormat::rgb8), (std::vector<std::uint32_t>{0x00ff40}));
  EXPECT_EQ(shown_pixels(Plain(), light, 2, PixelFormat::rgb16), (std::vector<std::uint32_t>{0xffff8000, 0}));
  const std::vector<std::uint32_t> covered{kQuarter | kHalf << 16, kHalf << 16, kOne, 0};
  EXPECT_EQ(shown_pixels(Plain(), covered, 1, PixelFormat::rgba8), (std::vector<std::uint32_t>{0x8000ff80, 0}));
}

}  // namespace
}  // namespace mars::images
