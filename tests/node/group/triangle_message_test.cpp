// Triangles as they come from another node: taken whole, or refused with a word that names it.
#include "node/group/triangle_message.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "node/wire/protocol.h"

namespace mars::group {
namespace {

using raster::UnsortedEdgeBox;

// Two edge boxes of line 3 and one of line 4, of two triangles.
struct Parcel {
  wire::TriangleHead head{3, 2};
  std::vector<UnsortedEdgeBox> boxes{{{1, 2, 3, 0}, 4, 1}, {{1, 0, 7, 1}, 3, 0}, {{0, 5, 0, 0}, 3, 0}};
  std::vector<geometry::Triangle> triangles = std::vector<geometry::Triangle>(2);

  std::size_t size() const { return triangles_at(boxes.size()) + triangles.size() * sizeof(geometry::Triangle); }
};

constexpr geometry::LineRange kLineRange{3, 5};

// In memory that begins at a cache line.
raster::Polygons read(const Parcel& parcel, std::size_t size, std::vector<std::uint64_t> left = {2, 1}) {
  static std::vector<geometry::Triangle> memory(64);
  const auto bytes = std::as_writable_bytes(std::span(memory));
  std::memcpy(bytes.data(), &parcel.head, sizeof parcel.head);
  std::memcpy(bytes.data() + kBoxesAt, parcel.boxes.data(), parcel.boxes.size() * sizeof(UnsortedEdgeBox));
  std::memcpy(bytes.data() + triangles_at(parcel.boxes.size()), parcel.triangles.data(),
              parcel.triangles.size() * sizeof(geometry::Triangle));
  AwaitedTriangles awaited{kLineRange, left, 8, 2, 1};
  return read_triangles(bytes.first(size), awaited, 7);
}

void expect_refused(const std::function<void(Parcel&)>& damage, std::vector<std::uint64_t> left = {2, 1}) {
  Parcel parcel;
  damage(parcel);
  try {
    read(parcel, parcel.size(), left);
    ADD_FAILURE() << "it was taken";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.problem, "node 7 sent triangles that make no sense");
  }
}

TEST(TriangleMessage, IsTakenWhole) {
  const Parcel parcel;
  const raster::Polygons polygons = read(parcel, parcel.size());
  EXPECT_EQ(polygons.moving.size(), 1u);
  EXPECT_EQ(polygons.stationary.size(), 2u);
}

TEST(TriangleMessage, SizesAreWhatTheHeadSays) {
  const Parcel parcel;
  for (const std::size_t size : {std::size_t{0}, kBoxesAt - 1, kBoxesAt, parcel.size() - 1, parcel.size() + 64})
    EXPECT_THROW(read(parcel, size), Failure) << size;
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{4}, std::uint64_t{1} << 60, ~std::uint64_t{0}}) {
    expect_refused([&](Parcel& damaged) { damaged.head.edge_boxes = count; });
    if (count > 0) expect_refused([&](Parcel& damaged) { damaged.head.triangles = count; });
  }
}

TEST(TriangleMessage, BoxesLieInThePictureAndOnAwaitedLines) {
  expect_refused([](Parcel& parcel) { parcel.boxes[0].line = 2; });
  expect_refused([](Parcel& parcel) { parcel.boxes[0].line = 5; });
  expect_refused([](Parcel& parcel) { parcel.boxes[1].box.after = 8; });
  expect_refused([](Parcel& parcel) { parcel.boxes[1].box.sample = 2; });
  expect_refused([](Parcel& parcel) { parcel.boxes[2].box.triangle = 2; });
  expect_refused([](Parcel& parcel) { parcel.triangles[1].material = 1; });
}

TEST(TriangleMessage, NoLineGetsMoreBoxesThanItsCount) {
  expect_refused([](Parcel&) {}, {1, 2});
  expect_refused([](Parcel& parcel) { parcel.boxes[0].line = 3; });
}

}  // namespace
}  // namespace mars::group
