// mars import of POV-Ray's and RIB's bicubic patches: control points are where both programs' formulas put them,
// computed here; what else the files have is counted; damaged files are failures with their line.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "host/content/importer/patches/patch_scene.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/importer/import_folder.h"

namespace mars::importer {
namespace {

using document::failure_of;
using document::holds;

// 0 to 3 along x and y, with a height that tells all points apart.
glm::dvec3 grid_point(int i) { return {i % 4, i / 4, 0.1 * i}; }

std::string pov_patch(const std::string& inside = "") {
  std::string text = "bicubic_patch { type 1 flatness 0.01 u_steps 3, v_steps 3,\n";
  for (int i = 0; i < 16; ++i) {
    const glm::dvec3 p = grid_point(i);
    text += "<" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ">" +
            (i % 2 == 0 ? ", " : " ");
  }
  return text + inside + "}\n";
}

class Patches : public ImportFolder {
 protected:
  PatchScene pov(const std::string& text) const { return read_pov(write("file.pov", text)); }
  PatchScene rib(const std::string& text) const { return read_rib(write("file.rib", text)); }

  std::string failure(const std::string& name, const std::string& text) const {
    return failure_of([&] { import_model(options_for(write(name, text))); });
  }
};

void expect_at(const glm::dvec3& found, const glm::dvec3& wanted) {
  EXPECT_LT(glm::distance(found, wanted), 1e-9) << found.x << " " << found.y << " " << found.z;
}

TEST_F(Patches, OfPovRayGoWithTheirObjects) {
  const PatchScene scene =
      pov("// one\n/* two /* three */ */\n#declare Far = <10, 20, 30>;\n#declare Wave = " + pov_patch() +
          "union { object { Wave scale <2, 1, 1> }\n object { Wave rotate x*90 pigment { color rgb "
          "<1, 0.5, 0> } }\n translate Far/2 - y }\nsphere { 0, 1 }\n" +
          pov_patch("matrix <0,1,0, 1,0,0, 0,0,-1, 5,6,7>"));
  ASSERT_EQ(scene.patches.size(), 3u);
  for (int i = 0; i < 16; ++i) {
    const glm::dvec3 p = grid_point(i);
    const auto at = static_cast<std::size_t>(i);
    expect_at(scene.patches[0].points[at], {2 * p.x + 5, p.y + 9, p.z + 15});
    expect_at(scene.patches[1].points[at], {p.x + 5, -p.z + 9, p.y + 15});
    expect_at(scene.patches[2].points[at], {p.y + 5, p.x + 6, -p.z + 7});
  }
  EXPECT_EQ(scene.patches[1].color, (PatchColor{1, 0.5, 0}));
  EXPECT_FALSE(scene.patches[0].color);
  EXPECT_EQ(scene.skipped, (std::map<std::string, std::size_t>{{"sphere", 1}}));
}

TEST_F(Patches, OfPovRayComeFromIncludedFilesBesideThem) {
  write("wave.inc", "#declare Wave = " + pov_patch());
  const PatchScene scene =
      pov("#include \"colors.inc\"\n#include \"wave.inc\"\n#macro M(A)\n #if (A) sphere { 0, A } #end\n#end\nobject { "
          "Wave }");
  EXPECT_EQ(scene.patches.size(), 1u);
  EXPECT_EQ(scene.skipped, (std::map<std::string, std::size_t>{{"#include", 1}, {"#macro", 1}}));
}

TEST_F(Patches, OfPovRayAreNotIncludedFromOutsideTheFolder) {
  const test::TemporaryFolder other;
  std::ofstream(other / "far.inc") << "#declare Wave = " + pov_patch();
  std::filesystem::create_symlink(other / "far.inc", folder_ / "link.inc");
  const auto failure = [&](const std::string& name) {
    return failure_of([&] { pov("#include \"" + name + "\"\nobject { Wave }"); });
  };
  for (const std::string name : {"../far.inc", "/etc/far.inc"})
    EXPECT_TRUE(holds(failure(name), "file.pov: names '" + name + "', which is outside of its folder (put that file"))
        << failure(name);
  EXPECT_TRUE(holds(failure("link.inc"), "names 'link.inc', a link that leads out of its folder"))
      << failure("link.inc");
  EXPECT_EQ(pov("#include \"colors.inc\"\n" + pov_patch()).skipped.at("#include"), 1u) << "one of POV-Ray's own";
}

TEST_F(Patches, OfPovRayComeFromFilesThatIncludedFilesInclude) {
  std::filesystem::create_directories(folder_ / "parts/deep");
  write("wave.inc", "#declare Wave = " + pov_patch());
  write("parts/other.inc", "#declare Other = " + pov_patch());
  const auto patches = [&](const std::string& included) {
    write("parts/deep/all.inc", "#include \"" + included + "\"\n");
    return pov("#include \"parts/deep/all.inc\"\nobject { Wave } object { Other }").patches.size();
  };
  EXPECT_EQ(patches("../../wave.inc\"\n#include \"../other.inc"), 2u) << "as seen from the file that names them";
  EXPECT_EQ(patches("wave.inc\"\n#include \"parts/other.inc"), 2u) << "as seen from the scene";
  write("parts/deep/wave.inc", "#declare Wave = union { " + pov_patch() + pov_patch() + "}");
  EXPECT_EQ(patches("wave.inc\"\n#include \"../other.inc"), 3u) << "rather those beside the file that names them";
  const std::string refusal = failure_of([&] { patches("../../../wave.inc"); });
  EXPECT_TRUE(holds(refusal, "parts/deep/all.inc: names '../../../wave.inc', which is outside of its folder"))
      << refusal;
}

TEST_F(Patches, OfRibFollowTheirBasisAndMatrices) {
  std::string points;
  for (int i = 0; i < 16; ++i) {
    const glm::dvec3 p = grid_point(i);
    points += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + " ";
  }
  const PatchScene scene =
      rib("##RenderMan RIB\nTranslate 0 0 5\nWorldBegin\nAttributeBegin\nColor [1 0.5 0]\nTranslate 1 2 3\n"
          "Rotate 90 0 0 1\nPatch \"bicubic\" \"vertex point P\" [" +
          points +
          "]\nAttributeEnd\nBasis \"b-spline\" 1 \"b-spline\" 1\nConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 7 0 0 1]\n"
          "PatchMesh \"bicubic\" 4 \"nonperiodic\" 4 \"nonperiodic\" \"P\" [" +
          points + "]\nPatch \"bilinear\" \"P\" [0 0 0 3 0 0 0 3 0 3 3 3]\nSphere 1 -1 1 360\nWorldEnd\n");
  ASSERT_EQ(scene.patches.size(), 3u);
  EXPECT_TRUE(scene.is_left_handed);
  EXPECT_EQ(scene.skipped, (std::map<std::string, std::size_t>{{"Sphere", 1}}));
  EXPECT_EQ(scene.patches[0].color, (PatchColor{1, 0.5, 0}));
  EXPECT_FALSE(scene.patches[1].color);
  for (int i = 0; i < 16; ++i) {
    const glm::dvec3 p = grid_point(i);
    expect_at(scene.patches[0].points[std::size_t(i)], {1 - p.y, 2 + p.x, 3 + p.z});
    // A uniform B-spline of points on a line runs from 1 to 2 of them, evenly.
    const double u = 1 + i % 4 / 3.0, v = 1 + i / 4 / 3.0;
    expect_at(scene.patches[1].points[std::size_t(i)], {7 + u, v, 0.1 * u + 0.4 * v});
    expect_at(scene.patches[2].points[std::size_t(i)], {7 + i % 4, i / 4, (i % 4) * (i / 4) / 3.0});
  }
}

TEST_F(Patches, OfPeriodicMeshesClose) {
  std::string points;
  for (int v = 0; v < 4; ++v)
    for (int u = 0; u < 6; ++u)
      points += std::to_string(std::cos(u * 1.0471975512)) + " " + std::to_string(std::sin(u * 1.0471975512)) + " " +
                std::to_string(v) + " ";
  const PatchScene scene =
      rib("Basis \"catmull-rom\" 1 \"bezier\" 3\nPatchMesh \"bicubic\" 6 \"periodic\" 4 \"nonperiodic\" \"P\" [" +
          points + "]");
  ASSERT_EQ(scene.patches.size(), 6u);
  EXPECT_FALSE(scene.is_left_handed);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t v = 0; v < 4; ++v)
      expect_at(scene.patches[i].points[4 * v + 3], scene.patches[(i + 1) % 6].points[4 * v]);
}

TEST_F(Patches, BecomeAModelOfAJointForEachColor) {
  ImportOptions options =
      options_for(write("two.pov", pov_patch("pigment { rgb <1,0,0> }") + pov_patch("translate z*4")));
  options.size.height = 6;
  const std::string report = import_model(options);
  EXPECT_TRUE(holds(report, "model of 2 joints, the first 'two'")) << report;
  EXPECT_TRUE(holds(report, "2 patches, 1 colour")) << report;
  const modeler::Model model = modeler::load_model(options.to);
  ASSERT_EQ(model.joints.size(), 2u);
  EXPECT_NEAR(model.joints[0].segment->sbb.max.z - model.joints[0].segment->sbb.min.z, 6, 1e-6);
  EXPECT_EQ(model.joints[0].segment->sbb.max, model.joints[1].segment->sbb.max);
}

TEST_F(Patches, ColoursThatAreNoNumbersAreDark) {
  const PatchScene scene = pov(pov_patch("pigment { rgb <0/0, 2, -1> }"));
  EXPECT_EQ(scene.patches[0].color, (PatchColor{0, 1, 0}));
}

// They say what they would need before they take it.
TEST_F(Patches, TooManyAreRefusedInLittleMemory) {
  const auto refusal = [](const char* where) {
    return std::string(where) + ": has more than 500000 patches, which need more than 1.25 GB of memory";
  };
  std::string mesh = "PatchMesh \"bilinear\" 1001 \"nonperiodic\" 502 \"nonperiodic\" \"P\" [";
  for (int i = 0; i < 1001 * 502; ++i) mesh += "0 1 2 ";
  const std::string many = failure_of([&] { rib(mesh + "]"); });
  EXPECT_TRUE(holds(many, refusal("file.rib:1"))) << many;
  std::string numbers = "PatchMesh \"bicubic\" 2 \"nonperiodic\" 2 \"nonperiodic\" \"P\" [";
  for (int i = 0; i < (1 << 24) + 1; ++i) numbers += "0 ";
  const std::string listed = failure_of([&] { rib(numbers + "]"); });
  EXPECT_TRUE(holds(listed, refusal("file.rib:1"))) << listed;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  struct rusage used {};
  getrusage(RUSAGE_SELF, &used);
  EXPECT_LT(used.ru_maxrss, 500'000) << "kB";
#endif
}

TEST_F(Patches, DamagedFilesAreFailuresWithTheirLine) {
  EXPECT_TRUE(holds(failure("a.pov", "\n" + pov_patch().substr(0, 90)), "a.pov:3: "));
  EXPECT_TRUE(holds(failure("b.pov", "\nobject { " + pov_patch() + " rotate Unknown }"), "whose value is not known"));
  EXPECT_TRUE(holds(failure("c.pov", "sphere { 0, 1 }"), "has no bicubic patches"));
  EXPECT_TRUE(holds(failure("d.pov", "/* never\n"), "d.pov:1: has a comment without an end"));
  EXPECT_TRUE(holds(failure("e.pov", pov_patch("translate " + std::string(5000, '('))), "values, too deep"));
  std::string deep = "#declare T = ";
  for (int i = 0; i < 100'000; ++i) deep += "transform { ";
  EXPECT_TRUE(holds(failure("deep.pov", deep), "deep.pov:1: has transforms within transforms, too deep"));
  EXPECT_TRUE(holds(failure("f.pov", pov_patch("scale 1e12")), "f.pov: has a patch with a point at "));
  EXPECT_TRUE(holds(failure("g.pov", pov_patch("translate <1/0, 0, 0>")), "g.pov: has a patch with a point at "));
  EXPECT_TRUE(holds(failure("a.rib", "\nPatch \"bicubic\" \"P\" [0 1 2]\n"), "a.rib:2: has a Patch of 1 point"));
  EXPECT_TRUE(holds(failure("b.rib", "Basis \"bspline\" 1 \"bezier\" 3\n"), "b.rib:1: has the basis 'bspline'"));
  EXPECT_TRUE(holds(failure("c.rib", "Patch \"bicubic\" \"P\" [0 1 x]\n"), "c.rib:1: has 'x' where a number"));
  EXPECT_TRUE(holds(failure("d.rib", "AttributeEnd\n"), "d.rib:1: has AttributeEnd without its beginning"));
}

}  // namespace
}  // namespace mars::importer
