// Skins in compiled films: bones stand where their joints do, weights are what the file says, and a segment moves when
// one of its bones does.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/film/changed_frames.h"
#include "host/content/film/frame_content.h"
#include "host/content/film/panorama.h"
#include "host/content/modeler/bent_skin.h"
#include "host/content/modeler/frames.h"
#include "host/content/modeler/proportions.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

const std::string kStill = R"({"name": "x", "model": "arm"})";
const std::string kBends = R"({"name": "x", "model": "arm", "keys": [{"frame": 4, "pose": {"fore": [0, 0, 0]}},
                                                                 {"frame": 9, "pose": {"fore": [0, -90, 0]}}]})";

// Where the film puts a place of the unit cube by a bone.
glm::dvec3 by_bone(const wire::PackedFilm& film, std::size_t bone, std::uint32_t frame, const glm::dvec3& place) {
  const auto& m = film.matrix_at(film.bones_of(film.segments()[0])[bone], frame).m;
  glm::dvec3 out;
  for (int r = 0; r < 3; ++r) {
    const auto& row = m[static_cast<std::size_t>(r)];
    out[r] = row[0] * place.x + row[1] * place.y + row[2] * place.z + row[3];
  }
  return out;
}

TEST(Skins, BonesStandWhereTheirJointsDo) {
  const CompiledFilm compiled_film = compiled(sleeve_film(kBends));
  const wire::PackedFilm film = compiled_film.view();
  ASSERT_EQ(film.segments()[0].bone_count, 2u);
  ASSERT_EQ(film.shapes()[0].bone_count, 2u);
  for (const std::size_t bone : {0u, 1u})
    EXPECT_LT(glm::distance(by_bone(film, bone, 0, {1, 0.5, 0.5}), glm::dvec3(4, 0, 1)), 1e-12) << "at rest";
  EXPECT_LT(glm::distance(by_bone(film, 0, 9, {1, 0.5, 0.5}), glm::dvec3(4, 0, 1)), 1e-12);
  EXPECT_LT(glm::distance(by_bone(film, 1, 9, {1, 0.5, 0.5}), glm::dvec3(2, 0, 3)), 1e-12);
}

TEST(Skins, WeightsAreDividedByTheirSumAndZerosDropped) {
  const modeler::Model model = film_of(sleeve_film(kStill)).models[0];
  const std::vector<modeler::VertexBones>& bones = model.shapes[0].mesh->bones;
  EXPECT_EQ(bones[0], (modeler::VertexBones{{0}, {1}}));
  EXPECT_EQ(bones[2], (modeler::VertexBones{{0, 1}, {0.75f, 0.25f}}));
  EXPECT_EQ(bones[4], (modeler::VertexBones{{1}, {1}}));
}

TEST(Skins, TheHeaviestFourCount) {
  const auto four = modeler::bones_of_vertex({{7, 0.1}, {2, 0.2}, {9, 0.3}, {4, 0.05}, {2, 0.1}, {1, 0.25}});
  ASSERT_TRUE(four);
  EXPECT_EQ(four->bone, (std::array<std::uint32_t, 4>{1, 2, 7, 9}));
  EXPECT_NEAR(four->weight[1], 0.3 / 0.95, 1e-6);
  EXPECT_FALSE(modeler::bones_of_vertex({{1, 0}}));
}

TEST(Skins, MoveWhenABoneDoes) {
  const CompiledFilm moving = compiled(sleeve_film(kBends, R"("frames": 20, "intervals": "keyframes")"));
  const wire::PackedFilm film = moving.view();
  ASSERT_EQ(film.intervals().size(), 3u);
  EXPECT_EQ(film.moving(film.intervals()[0]).size(), 0u);
  EXPECT_EQ(film.moving_segments(film.intervals()[1]).size(), 1u);
  EXPECT_TRUE(std::ranges::equal(film.moving(film.intervals()[1]), std::array{0u, 2u})) << "the bone that follows fore";
  EXPECT_EQ(film.moving(film.intervals()[2]).size(), 0u);
}

TEST(Skins, OtherPosesAndWeightsAreOtherFrames) {
  const std::string more = R"("frames": 20, "intervals": "keyframes")";
  std::string edited = kBends, reweighted = sleeve_film(kBends, more);
  edited.replace(edited.find("-90"), 3, "-80");
  const CompiledFilm before = compiled(sleeve_film(kBends, more)), now = compiled(sleeve_film(edited, more));
  const auto changed = changed_frames(before.view(), now.view());
  EXPECT_EQ(changed.front(), 5u);
  EXPECT_EQ(changed.back(), 19u);
  EXPECT_EQ(FrameContent(before.view()).checksum(4), FrameContent(now.view()).checksum(4));
  EXPECT_NE(FrameContent(before.view()).checksum(6), FrameContent(now.view()).checksum(6));
  reweighted.replace(reweighted.find("[1, 1, 0, 3]"), 12, "[1, 1, 0, 2]");
  const CompiledFilm other = compiled(reweighted);
  EXPECT_EQ(changed_frames(before.view(), other.view()).size(), 20u);
  EXPECT_NE(FrameContent(before.view()).checksum(0), FrameContent(other.view()).checksum(0));
}

// The text of the sleeve's film with more in its skin.
std::string with_skin(std::string json, const std::string& more) {
  const std::string joints = "[\"upper\", \"fore\"]";
  return json.replace(json.find(joints), joints.size(), joints + ", " + more);
}

TEST(Skins, BlendAsTheirModelSays) {
  const std::string json = sleeve_film(kBends, R"("frames": 20, "intervals": "keyframes")");
  const CompiledFilm linear = compiled(json), dual = compiled(with_skin(json, R"("blend": "dual-quaternions")"));
  EXPECT_EQ(linear.view().segments()[0].blend, wire::Blend::linear);
  EXPECT_EQ(dual.view().segments()[0].blend, wire::Blend::dual_quaternions);
  EXPECT_EQ(changed_frames(linear.view(), dual.view()).size(), 20u);
  EXPECT_NE(FrameContent(linear.view()).checksum(9), FrameContent(dual.view()).checksum(9));
}

// A knee of 150 degrees: what follows both bones alike keeps its distance from the hinge, where linear blending pulls
// it in.
TEST(Skins, KeepTheirVolumeByDualQuaternions) {
  const animator::Film film = film_of(with_skin(sleeve_film(kStill), R"("blend": "dual-quaternions")"));
  const modeler::Joint& joint = film.models[0].joints[0];
  std::vector<modeler::Axes> frames = modeler::rest_frames(film.models[0]);
  frames[2].turn = modeler::rotation_by_degrees({0, 1, 0}, 150);
  std::vector<wire::Matrix> bones;
  for (const modeler::Bone& bone : joint.segment->bones)
    bones.push_back(modeler::bone_matrix(frames[bone.joint], bone, joint));
  const modeler::BentSkin dual(bones, joint.segment->blend), linear(bones, wire::Blend::linear);
  const modeler::VertexBones half{{0, 1}, {0.5f, 0.5f}};
  const glm::dvec3 hinge = frames[2].place;
  const auto drawn = glm::distance(modeler::placed(bones[0], {0.5f, 0.5f, 0.25f}), hinge);
  EXPECT_GT(drawn, 0.1);
  EXPECT_NEAR(glm::distance(dual.place_of({0.5f, 0.5f, 0.25f}, half), hinge), drawn, 1e-6);
  EXPECT_LT(glm::distance(linear.place_of({0.5f, 0.5f, 0.25f}, half), hinge), 0.3 * drawn);
}

// Dual quaternions cannot turn what has no volume.
TEST(Skins, FlatBonesOfDualQuaternionsAreRefused) {
  const auto refusal = [](const std::string& json) {
    try {
      compiled(json);
    } catch (const Failure& failure) {
      return std::string(failure.problem);
    }
    return std::string("none");
  };
  const std::string binds = R"("bind": [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], [1, 0, 0, -2, 0, 1, 0, 0, 0, 0, 0, 0]])";
  EXPECT_EQ(refusal(with_skin(sleeve_film(kStill), binds)), "none");
  EXPECT_EQ(refusal(with_skin(sleeve_film(kStill), binds + R"(, "blend": "dual-quaternions")")),
            "flattens what follows 'fore', which dual quaternions cannot turn");
  const std::string flat = R"({"name": "x", "model": "arm", "matrices": [{"frame": 0, "segments": {
      "sleeve": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1]], "upper": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1]],
      "fore": [[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1]]}}]})";
  EXPECT_EQ(refusal(sleeve_film(flat)), "none");
  EXPECT_EQ(refusal(with_skin(sleeve_film(flat), R"("blend": "dual-quaternions")")),
            "has a skin whose bone 'fore' flattens what follows it, which dual quaternions cannot turn");
}

TEST(Skins, FollowProportions) {
  modeler::Model model = film_of(sleeve_film(kStill)).models[0];
  modeler::Proportions longer;
  longer.joints = {{"upper", false, {2, 1, 1}}};
  longer.ground = false;
  modeler::apply(longer, model);
  const auto bounds = modeler::rest_bounds(model);
  EXPECT_NEAR(bounds->max.x, 6, 1e-9) << "what follows the forearm lies behind an upper arm of twice the length";
}

TEST(Skins, OfPanoramasBendOnAllFaces) {
  std::string json = sleeve_film(kBends, R"("frames": 20, "size": [64, 32])");
  json.replace(json.find("\"eye\""), 5, "\"projection\": \"panorama\", \"eye\"");
  const CompiledFilm panorama = compiled(json), faces = faces_of(panorama);
  const wire::PackedFilm whole = panorama.view(), film = faces.view();
  for (const std::uint32_t frame : {0u, 7u, 19u})
    for (std::uint32_t face = 0; face < 6; ++face)
      EXPECT_EQ(film.matrix_at(film.bones()[1], 20 * face + frame), whole.matrix_at(whole.bones()[1], frame));
}

TEST(Skins, UnsoundOnesAreRefused) {
  const auto refusal = [](const std::string& from, const std::string& to) {
    std::string json = sleeve_film(kStill);
    json.replace(json.find(from), from.size(), to);
    try {
      film_of(json);
    } catch (const Failure& failure) {
      return failure.problem;
    }
    return std::string("none");
  };
  EXPECT_EQ(refusal("[0, 2]", "[2, 2]"), "has 2 joints, but a point follows bone 2");
  EXPECT_EQ(refusal("[0, 2]", "[0, 0]"), "has no weight");
  EXPECT_EQ(refusal("[0, 2]", "[0, 1, 0, 1]"), "names bone 0 twice");
  EXPECT_EQ(refusal("[0, 2]", "[0]"), "has 1 numbers");
  EXPECT_EQ(refusal("[\"upper\", \"fore\"]", "[\"fore\", \"upper\"]"), "names 'upper' after 'fore'");
  EXPECT_EQ(refusal("[\"upper\", \"fore\"]", "[\"upper\", \"hand\"]"), "is 'hand', which is no joint of this model");
  EXPECT_EQ(refusal(",\n     \"skin\": {\"joints\": [\"upper\", \"fore\"]}", ""),
            "has bones, but the segment has no skin");
  EXPECT_EQ(refusal("\"shape\": \"cloth\"", "\"shape\": \"box\""),
            "belongs to a shape with bones, which this one is not");
}

}  // namespace
}  // namespace mars::film
