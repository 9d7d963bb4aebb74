// PLY files in every form there is, and damaged ones: as many vertices and faces as the header promises, or a failure.
#include "host/content/importer/ply_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::importer {
namespace {

namespace fs = std::filesystem;

const std::string kPlaces = "property float x\nproperty float y\nproperty float z\n";
const std::string kCornerList = "property list uchar int vertex_indices\n";

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\ncomment\nobj_info of a test\n" + elements + "end_header\n";
}

std::string triangle_header(const std::string& format) {
  return header(format, "element vertex 3\n" + kPlaces + "element face 1\n" + kCornerList);
}

std::string with_ends(std::string text, const std::string& end) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size()) text.replace(at, 1, end);
  return text;
}

// A number's bytes, in the order of the format.
template <typename Number>
std::string bytes(Number number, bool little) {
  std::string text(reinterpret_cast<const char*>(&number), sizeof number);
  if (little != (std::endian::native == std::endian::little)) std::reverse(text.begin(), text.end());
  return text;
}

std::string triangle_bytes(float first, bool little) {
  std::string text;
  for (const float number : {first, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) text += bytes(number, little);
  text += '\3';
  for (const std::int32_t corner : {0, 1, 2}) text += bytes(corner, little);
  return text;
}

class PlyFileTest : public testing::Test {
 protected:
  PlyFile read(const std::string& content) const {
    std::ofstream(folder_ / "a.ply", std::ios::binary) << content;
    return read_ply_file(folder_ / "a.ply");
  }
  std::string failure(const std::string& content) const {
    const std::string text = document::failure_of([&] { read(content); });
    EXPECT_TRUE(document::holds(text, "a.ply: ")) << text;
    return text;
  }
  void expect_triangle(const std::string& content, float first = 0) const {
    const PlyFile file = read(content);
    EXPECT_EQ(file.places, (std::vector<glm::dvec3>{{first, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(file.corners, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(file.ends, std::vector<std::size_t>{3});
    EXPECT_EQ(file.not_read, std::vector<std::string>{});
  }

  const test::TemporaryFolder folder_;
};

TEST_F(PlyFileTest, TextAndBytesOfEitherOrder) {
  expect_triangle(triangle_header("ascii") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  expect_triangle(triangle_header("binary_little_endian") + triangle_bytes(0, true));
  expect_triangle(triangle_header("binary_big_endian") + triangle_bytes(0, false));
}

TEST_F(PlyFileTest, LinesEndInAnyWayAndNumbersMayLookLikeEnds) {
  const float looks_like_ends = std::bit_cast<float>(std::uint32_t{0x3f0a0d0a});  // "\n\r\n?" in a file
  const std::string body = triangle_bytes(looks_like_ends, true);
  for (const char* end : {"\n", "\r\n", "\r"}) {
    expect_triangle(with_ends(triangle_header("binary_little_endian"), end) + body, looks_like_ends);
    expect_triangle(with_ends(triangle_header("ascii") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", end));
  }
}

TEST_F(PlyFileTest, FacesMayComeFirstAndTypesHaveTwoNames) {
  expect_triangle(header("ascii",
                         "element face 1\nproperty list uint8 uint32 vertex_index\n"
                         "element vertex 3\nproperty float64 z\nproperty double y\nproperty float32 x\n") +
                  "3 0 1 2\n0 0 0\n0 0 1\n0 1 0\n");
}

// A square's two strips of a triangle each, and one strip of both.
TEST_F(PlyFileTest, StripsAreTriangles) {
  const std::string vertices = "element vertex 4\n" + kPlaces;
  const std::string places = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const auto corners = [&](const std::string& strip) {
    return read(header("ascii", vertices + "element tristrips 1\nproperty list int int vertex_indices\n") + places +
                strip)
        .corners;
  };
  const std::vector<std::uint32_t> both = {0, 1, 2, 2, 1, 3};
  EXPECT_EQ(corners("4 0 1 2 3\n"), both) << "the second turns as the first";
  EXPECT_EQ(corners("7 0 1 2 -1 2 1 3\n"), both);
  EXPECT_EQ(corners("5 0 1 2 2 3\n"), (std::vector<std::uint32_t>{0, 1, 2})) << "only leads elsewhere";
}

TEST_F(PlyFileTest, NormalsAreReadAndTheRestIsTold) {
  const PlyFile file =
      read(header("ascii", "comment TextureFile skin.png\nelement vertex 4\n" + kPlaces +
                               "property float nx\nproperty float ny\nproperty float nz\n"
                               "property uchar red\nelement face 1\nproperty float area\n" +
                               kCornerList + "element edge 1\nproperty int vertex1\nelement scan 0\nproperty int a\n") +
           "0 0 0 0 0 1 9\n1 0 0 0 0 1 9\n0 1 0 0 0 1 9\n5 5 5 0 0 1 9\n0.5 3 0 1 2\n7\n");
  EXPECT_EQ(file.normals, std::vector<glm::dvec3>(4, {0, 0, 1}));
  EXPECT_EQ(file.not_read,
            (std::vector<std::string>{"texture skin.png", "of element 'vertex': red", "of element 'face': area",
                                      "1 row of element 'edge'", "1 vertex without a face"}));
  const std::string more = triangle_header("binary_little_endian") + triangle_bytes(0, true) + "abc";
  EXPECT_EQ(read(more).not_read, std::vector<std::string>{"3 bytes after all that the header promises"});
}

TEST_F(PlyFileTest, WhatIsPromisedMustBeThere) {
  const std::string many = header("binary_little_endian", "element vertex 4000000000\n" + kPlaces);
  EXPECT_TRUE(document::holds(failure(many + triangle_bytes(0, true)), "promises 4000000000 vertices, 4 were read"));
  EXPECT_TRUE(document::holds(failure(triangle_header("ascii") + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n"),
                              "promises 1 face, 0 were read"));
  EXPECT_TRUE(document::holds(failure(triangle_header("ascii") + "0 0 0\n1 0 x\n"), "promises 3 vertices, 1 was read"));
  EXPECT_TRUE(document::holds(failure(triangle_header("ascii") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n"),
                              "goes on after all"));
  EXPECT_TRUE(document::holds(failure(triangle_header("ascii") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                              "at vertex 3, of 3 from 0"));
  EXPECT_TRUE(
      document::holds(failure(triangle_header("ascii") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 0.5\n"), "no vertex's number"));
  EXPECT_TRUE(
      document::holds(failure(triangle_header("ascii") + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), "promises 1 face"));
}

TEST_F(PlyFileTest, HeadersAreUnderstoodOrRefused) {
  EXPECT_TRUE(document::holds(failure(""), "ends within its header"));
  EXPECT_TRUE(document::holds(failure("solid\n"), "does not begin with 'ply'"));
  EXPECT_TRUE(document::holds(failure("ply\nformat ascii 1.0\nelement vertex 3\n"), "ends within its header"));
  EXPECT_TRUE(document::holds(failure("ply\nelement vertex 0\nend_header\n"), "does not say its format"));
  for (const char* line : {"format ebcdic 1.0", "element vertex many", "element vertex -1", "element vertex 3",
                           "property float x", "property quad w", "property list int vertex_indices", "end_9der"})
    EXPECT_TRUE(document::holds(failure(header("ascii", "element vertex 3\n" + kPlaces + line + "\n")),
                                "is not understood: " + std::string(line)));
  EXPECT_TRUE(document::holds(
      failure(header("ascii", "element vertex 1\nproperty float x\nproperty float y\n") + "1 1\n"), "no z"));
}

}  // namespace
}  // namespace mars::importer
