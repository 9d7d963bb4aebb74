// mars import of FBX and COLLADA: metres and what is up come from the file, bones bend skins, what turns nodes about
// points of their own is no joint, motions without a figure have bones to be seen. Places are computed here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "host/content/animator/pose/joint_frames.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/film/compile.h"
#include "host/content/modeler/bent_skin.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/importer/import_folder.h"
#include "tests/host/content/importer/scene_texts.h"

namespace mars::importer {
namespace {

using document::failure_of;
using document::holds;

constexpr double kTurn = std::numbers::pi / 2;  // in a second

class Scenes : public ImportFolder {
 protected:
  std::string import(const std::string& name, const std::string& text) {
    ImportOptions options = options_for(write(name, text));
    options.as = ImportAs::film;
    const std::string report = import_model(options);
    film_ = animator::read_film(options.to);
    return report;
  }

  glm::dvec3 joint_at(const std::string& name, std::uint32_t frame) const {
    const auto& joints = film_.models[0].joints;
    const auto joint = std::ranges::find(joints, name, &modeler::Joint::name) - joints.begin();
    return animator::JointFrames(film_).frame_of(0, static_cast<std::size_t>(joint), frame).place;
  }

  // Of all that the film shows.
  std::vector<glm::dvec3> vertices_at(std::uint32_t frame) const {
    const film::CompiledFilm compiled = film::compile(film_);
    std::vector<glm::dvec3> places;
    for (const modeler::Joint& joint : film_.models[0].joints) {
      if (!joint.segment) continue;
      const modeler::Mesh& mesh = *film_.models[0].shapes[joint.segment->shape].mesh;
      const wire::Segment& segment = compiled.view().segments()[0];
      std::vector<wire::Matrix> bones;
      for (const wire::Track& bone : compiled.view().bones_of(segment))
        bones.push_back(compiled.view().matrix_at(bone, frame));
      if (bones.empty()) bones.push_back(compiled.view().matrix_at(segment, frame));
      const modeler::BentSkin skin(bones, segment.blend);
      const modeler::VertexBones alone{{0}, {1}};
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        places.push_back(skin.place_of(mesh.vertices[v], mesh.bones.empty() ? alone : mesh.bones[v]));
    }
    return places;
  }

  void expect_vertices(std::vector<glm::dvec3> wanted, std::uint32_t frame) const {
    const std::vector<glm::dvec3> found = vertices_at(frame);
    for (const glm::dvec3& place : wanted) {
      double nearest = 1e9;
      for (const glm::dvec3& other : found) nearest = std::min(nearest, glm::distance(place, other));
      EXPECT_LT(nearest, 1e-4) << frame << ": " << place.x << " " << place.y << " " << place.z;
    }
  }

  animator::Film film_;
};

TEST_F(Scenes, MotionsOfFbxHaveBonesToBeSeenInMetres) {
  const std::string report = import("walk.fbx", test::fbx_motion());
  EXPECT_TRUE(holds(report, "joints of 3 nodes")) << report;
  EXPECT_TRUE(holds(report, "the animation 'Turn' of 1 s")) << report;
  ASSERT_EQ(film_.frames, 25u) << report;
  EXPECT_EQ(film_.rate, 24);
  for (const std::uint32_t frame : {0u, 12u, 24u}) {
    const double angle = kTurn * frame / 24 + std::numbers::pi;
    EXPECT_LT(glm::distance(joint_at("Hips", frame), {0, 0, 1}), 1e-5);
    EXPECT_LT(glm::distance(joint_at("Leg", frame), {0.1, 0, 1}), 1e-5);
    const glm::dvec3 foot(0.1 - 0.5 * std::sin(angle), 0, 1 + 0.5 * std::cos(angle));
    EXPECT_LT(glm::distance(joint_at("Foot", frame), foot), 1e-4) << frame;
  }
}

// As Max and Maya write names of other alphabets.
TEST_F(Scenes, NamesThatAreNoUtf8AreNames) {
  std::string text = test::fbx_motion();
  for (std::size_t at; (at = text.find("Model::Hips")) != std::string::npos;) text.replace(at, 11, "Model::H\xfcpte");
  import("walk.fbx", text);
  EXPECT_LT(glm::distance(joint_at("H\xef\xbf\xbdpte", 0), {0, 0, 1}), 1e-5);
}

TEST_F(Scenes, FbxTurnsAboutPointsOfItsOwnAndSaysWhatIsUp) {
  const std::string report = import("flag.fbx", test::fbx_pivot());
  EXPECT_FALSE(holds(report, "joints of")) << report;
  for (const std::uint32_t frame : {0u, 15u, 24u}) {
    const double angle = kTurn * frame / 24, c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](double x, double z) { return glm::dvec3(0.5 + (x - 0.5) * c, (x - 0.5) * s, z); };
    expect_vertices({turned(0, 0), turned(1, 0), turned(0, 1)}, frame);
  }
}

TEST_F(Scenes, SkinsOfColladaBendInMetres) {
  const std::string report = import("strip.dae", test::dae_skin());
  EXPECT_TRUE(holds(report, "a skin, which 2 joints move, of 1 mesh")) << report;
  EXPECT_TRUE(holds(report, "0.508 m tall")) << report;
  constexpr double kInch = 0.0254;
  for (const std::uint32_t frame : {0u, 12u, 24u}) {
    const double angle = kTurn * frame / 24, c = std::cos(angle), s = std::sin(angle);
    const auto bent = [&](double x, double z) { return kInch * glm::dvec3(x * c + z * s, 0, 10 - x * s + z * c); };
    expect_vertices({{0, 0, 0}, {2 * kInch, 0, 10 * kInch}, bent(0, 10), bent(2, 10)}, frame);
  }
}

TEST_F(Scenes, DamagedFilesAreOneClearFailure) {
  const std::string fbx = test::fbx_motion(), dae = test::dae_skin();
  const auto failure = [&](const std::string& name, const std::string& text) {
    return failure_of([&] { import(name, text); });
  };
  EXPECT_TRUE(holds(failure("cut.fbx", fbx.substr(0, fbx.size() / 2)), "cut.fbx: is no sound mesh file"));
  EXPECT_TRUE(holds(failure("cut.dae", dae.substr(0, dae.size() / 2)), "cut.dae: is no sound mesh file"));
  EXPECT_TRUE(holds(failure("old.fbx", "Kaydara FBX Binary  nothing"), "old.fbx: is no sound mesh file"));
}

}  // namespace
}  // namespace mars::importer
