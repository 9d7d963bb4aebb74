#include <gtest/gtest.h>

#include "host/content/modeler/read_model.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::modeler {
namespace {

Model model_of_text(const std::string& json) {
  const document::Document document(json, "m.json");
  return read_model(document.root());
}

std::string spline_model(const std::string& bspline) {
  return R"({"joints": [{"name": "a", "segment": {"shape": "sail"}}], "shapes": {"sail": {"bspline": )" + bspline +
         "}}}";
}

// Rows of points along u, all different.
std::string grid_of_points(int columns, int rows) {
  std::string text = "[";
  for (int j = 0; j < rows; ++j) {
    text += j ? ", [" : "[";
    for (int i = 0; i < columns; ++i)
      text += (i ? ", [0." : "[0.") + std::to_string(i) + ", 0." + std::to_string(j) + ", 0.5]";
    text += "]";
  }
  return text + "]";
}

TEST(ReadBSpline, MakesAPatchForEveryPairOfSpans) {
  const auto patches = [](const std::string& rest) {
    return model_of_text(spline_model("{\"points\": " + grid_of_points(6, 5) + rest + "}")).shapes[0].patches.size();
  };
  EXPECT_EQ(patches(""), 3u * 2u);
  EXPECT_EQ(patches(R"(, "u": {"ends": "periodic"}, "v": {"degree": 1})"), 6u * 4u);
  EXPECT_EQ(patches(R"(, "u": {"ends": "open", "degree": 2})"), 4u * 2u);
  EXPECT_EQ(patches(R"(, "u": {"knots": [0, 0, 0, 0, 1, 1, 2, 2, 2, 2]})"), 2u * 2u);
  EXPECT_EQ(patches(R"(, "u": {"ends": "periodic", "knots": [0, 1, 1, 2, 3, 3, 3]})"), 3u * 2u);
}

TEST(ReadBSpline, RowsRunAlongU) {
  const Model model = model_of_text(spline_model("{\"points\": " + grid_of_points(4, 5) + "}"));
  const auto& points = model.shapes[0].patches[0].points;
  EXPECT_EQ(points[0], (std::array{0.0f, 0.0f, 0.5f}));
  EXPECT_EQ(points[3], (std::array{0.3f, 0.0f, 0.5f}));
}

struct BrokenSpline {
  const char* bspline;
  const char* place;
  const char* reported;
};

class BrokenBSpline : public testing::TestWithParam<BrokenSpline> {};

TEST_P(BrokenBSpline, IsOneClearError) {
  std::string bspline = GetParam().bspline;
  if (const auto at = bspline.find("GRID"); at != std::string::npos)
    bspline.replace(at, 4, "\"points\": " + grid_of_points(5, 4));
  const std::string failure = document::failure_of([&] { model_of_text(spline_model(bspline)); });
  EXPECT_TRUE(document::holds(failure, "m.json:1: shapes.sail.bspline" + std::string(GetParam().place) + ": "))
      << failure;
  EXPECT_TRUE(document::holds(failure, GetParam().reported)) << failure;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BrokenBSpline,
    testing::Values(
        BrokenSpline{"{}", "", "has no 'points'"}, BrokenSpline{R"({"points": []})", ".points", "is empty"},
        BrokenSpline{R"({"points": [[[0, 0, 0], [1, 0, 0]], [[0, 0, 0]]]})", ".points[1]",
                     "has 1 points, the first row has 2"},
        BrokenSpline{R"({"points": [[[0, 0, 2]]]})", ".points[0][0][2]", "is 2"},
        BrokenSpline{R"({"points": [[[0, 0, 0], [1, 0, 0]], [[0, 0, 1], [1, 0, 1]]]})", ".points",
                     "has 2 points along u, degree 3 needs at least 4"},
        BrokenSpline{R"({"points": [[[0, 0, 0], [1, 0, 0]]], "u": {"degree": 1}, "v": {"degree": 1}})", ".points",
                     "has 1 points along v, degree 1 needs at least 2"},
        BrokenSpline{R"({GRID, "w": {}})", ".w", "is no key of a bspline"},
        BrokenSpline{R"({GRID, "u": {"degre": 2}})", ".u.degre", "did you mean 'degree'?"},
        BrokenSpline{R"({GRID, "u": {"degree": 4}})", ".u.degree", "from 1 to 3"},
        BrokenSpline{R"({GRID, "u": {"ends": "close"}})", ".u.ends", "choose one of: clamped, open, periodic"},
        BrokenSpline{R"({GRID, "u": {"ends": "open", "knots": [0, 1]}})", ".u.ends", "stands beside knots"},
        BrokenSpline{R"({GRID, "u": {"knots": [0, 1]}})", ".u.knots",
                     "has 2 knots for 5 points of degree 3 (write 9 of them: points + degree + 1"},
        BrokenSpline{R"({GRID, "u": {"ends": "periodic", "knots": [0, 1]}})", ".u.knots", "write 6 of them"},
        BrokenSpline{R"({GRID, "u": {"knots": [0, 0, 0, 0, 1, 0.5, 2, 2, 2]}})", ".u.knots[5]",
                     "is 0.5, less than the knot before it"},
        BrokenSpline{R"({GRID, "u": {"knots": [0, 0, 0, 0, 0, 1, 1, 1, 1]}})", ".u.knots[0]",
                     "stands 5 times (at degree 3 write it at most 4 times"},
        BrokenSpline{R"({GRID, "u": {"degree": 1, "knots": [0, 0, 1, 1, 2, 2, 2]}})", ".u.knots[2]",
                     "stands 2 times, the surface would tear there"},
        BrokenSpline{R"({GRID, "u": {"degree": 2, "ends": "periodic", "knots": [0, 0, 1, 2, 3, 3]}})", ".u.knots[0]",
                     "stands 3 times"},
        BrokenSpline{R"({GRID, "u": {"knots": [0, 1, 2, 3, 3, 3, 4, 5, 6]}})", ".u.knots", "the same knot"}));

}  // namespace
}  // namespace mars::modeler
