#include "tests/node/shading/vertex_light.h"

#include <gtest/gtest.h>

#include <memory>

namespace mars::shading {

Frame::Frame() {
  shading.projection = shape::projection(640, 480, 2);
  shading.pattern = shape::sample_pattern(1);
  shading.encoding.space = wire::ColorSpace::linear;
  shading.up[1] = 1;
}

const Shading& Frame::view() {
  shading.materials = &material;
  shading.lights = lights.data();
  shading.light_count = static_cast<std::uint32_t>(lights.size());
  return shading;
}

Colors light_of(Frame& frame, const std::vector<Spot>& spots, simd::InstructionSet set) {
  const std::size_t stride = spots.size() + simd::kVectorSlack;
  std::vector<float> numbers[6];
  shape::Vertices vertices{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    numbers[axis].resize(stride), numbers[3 + axis].resize(stride);
    for (std::size_t k = 0; k < spots.size(); ++k) {
      numbers[axis][k] = static_cast<float>(spots[k].place[axis]);
      numbers[3 + axis][k] = static_cast<float>(spots[k].normal[axis]);
    }
    vertices.place[axis] = numbers[axis].data();
    vertices.normal[axis] = numbers[3 + axis].data();
  }
  const std::unique_ptr<float[][shape::kValues]> values(new float[stride][shape::kValues]());
  for (std::size_t k = 0; k < spots.size(); ++k) values[k][shape::kDepth] = static_cast<float>(-1 / spots[k].place[2]);
  vertices.values = values.get();
  const std::unique_ptr<float[][shape::kValues]> carried(new float[stride][shape::kValues]());
  Colors colors{std::vector<float>(stride), std::vector<float>(stride), std::vector<float>(stride)};
  const shape::VertexColors out{{colors[0].data(), colors[1].data(), colors[2].data()}, carried.get()};
  shading_kernels(set).shade_vertices(frame.view(), 0, 1, vertices, static_cast<std::uint32_t>(spots.size()), out);
  for (auto& plane : colors) plane.resize(spots.size());
  for (std::size_t k = 0; k < spots.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(carried[k][1 + c], colors[c][k] * values[k][shape::kDepth]) << "a vertex carries its colour / w";
  return colors;
}

}  // namespace mars::shading
