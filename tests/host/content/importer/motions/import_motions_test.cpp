// mars import of motions: joints of the film are where the formats' definitions put them, limits are the file's, and
// damaged files are one clear failure.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/importer/motions/motion_files.h"
#include "host/content/document/json_file.h"
#include "host/content/modeler/frames.h"

namespace mars::importer {
namespace {

namespace fs = std::filesystem;
using document::failure_of;
using document::holds;

class Motions : public ImportFolder {
 protected:
  std::string with(std::string text, const std::string& part, const std::string& other) const {
    text.replace(text.find(part), part.size(), other);
    return text;
  }

  std::string refused(const std::string& name, const std::string& text) {
    ImportOptions options = options_for(write(name, text));
    return failure_of([&] { import_model(options); });
  }
};

TEST_F(Motions, BvhJointsAreWhereItsChannelsPutThem) {
  const fs::path path = write("a.bvh", kBvh);
  const std::string report = import_model(options_for(path));
  EXPECT_TRUE(holds(report, "film of 4 frames at 30 a second, actor 'a'")) << report;
  EXPECT_TRUE(holds(report, "6 joints, 4 frames at 30 a second")) << report;
  EXPECT_TRUE(holds(report, "nothing: all of the file was read")) << report;
  FilmPlaces film(folder_ / "model.json");
  EXPECT_EQ(film.film.rate, 30);
  expect_places(film, test::plain_bvh(path), 1, 1, 1e-6);
}

TEST_F(Motions, BvhIsScaledToAHeight) {
  const fs::path path = write("a.bvh", kBvh);
  ImportOptions options = options_for(path);
  options.size.height = 21.4;  // of 10.7 units
  import_model(options);
  FilmPlaces film(folder_ / "model.json");
  expect_places(film, test::plain_bvh(path), 1, 2, 1e-5);
}

TEST_F(Motions, TheModelAloneStandsOnTheFloor) {
  ImportOptions options = options_for(write("a.bvh", kBvh));
  options.as = ImportAs::model;
  const std::string report = import_model(options);
  EXPECT_TRUE(holds(report, "4 frames of motion (--as film makes keys of them)")) << report;
  const document::Json model = document::read_json(folder_ / "model.json");
  EXPECT_EQ(model.at("joints").at(0).at("place"), document::Json::array({0, 0, 6.2}));
  EXPECT_TRUE(model.at("joints").at(5).contains("segment"));
}

TEST_F(Motions, BetweenFramesPlacesGoStraightAndTurnsTheSmallestWay) {
  ImportOptions options = options_for(write("a.bvh", kBvh));
  options.rate = 60;
  import_model(options);
  FilmPlaces film(folder_ / "model.json");
  EXPECT_EQ(film.film.frames, 7u);
  const std::vector<test::Places> file = test::plain_bvh(folder_ / "a.bvh");
  const auto gone = glm::dvec3(0.5, 6.05, 1);
  const glm::dvec3 hips = film.at("Hips", 1);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(hips[axis], in_our_axes(gone)[axis], 1e-6);
    EXPECT_NEAR(film.at("LeftFoot", 2)[axis], in_our_axes(file[1].at("LeftFoot"))[axis], 1e-6);
  }
  // Half of the smallest turn is at the same angle from both ends.
  const glm::dvec3 before = film.at("LeftLeg", 0) - film.at("LeftUpLeg", 0),
                   half = film.at("LeftLeg", 1) - film.at("LeftUpLeg", 1),
                   after = film.at("LeftLeg", 2) - film.at("LeftUpLeg", 2);
  EXPECT_GT(glm::length(after - before), 0.1);
  EXPECT_LT(glm::length(half - before), glm::length(after - before));
  EXPECT_LT(glm::length(half - after), glm::length(after - before));
}

TEST_F(Motions, PositionsMayStandInTheOffsetsStead) {
  const std::string offset = with(kBvh, "OFFSET 0 0 0", "OFFSET 0 6 0");
  const std::string report = import_model(options_for(write("a.bvh", offset)));
  EXPECT_TRUE(holds(report, "the root's positions, which stand in its OFFSET's stead")) << report;
  FilmPlaces film(folder_ / "model.json");
  EXPECT_NEAR(film.at("Hips", 0).z, 6, 1e-9);
  const std::string added = import_model(options_for(write("a.bvh", with(offset, "\n0 6 0 ", "\n0 0.1 0 "))));
  EXPECT_TRUE(holds(added, "the root's positions, added to its OFFSET")) << added;
  EXPECT_NEAR(FilmPlaces(folder_ / "model.json").at("Hips", 0).z, 6.1, 1e-9);
}

TEST_F(Motions, JointsThatSlideAreReported) {
  std::string text = with(kBvh, "CHANNELS 1 Yrotation", "CHANNELS 2 Yposition Yrotation");
  for (const char* number : {"0    0 0 0       0 0", "70   15", "-120 -95", "179  1"})
    text = with(text, number, std::string("1.5 ") + number);
  EXPECT_TRUE(holds(import_model(options_for(write("a.bvh", text))), "nothing: all of the file was read"));
  const std::string report = import_model(options_for(write("a.bvh", with(text, "1.5 70", "2.5 70"))));
  EXPECT_TRUE(holds(report, "how 1 joint slides, up to 0.75 units of the file")) << report;
}

TEST_F(Motions, DamagedBvhIsRefusedAtItsLine) {
  EXPECT_EQ(refused("a.bvh", ""), (folder_ / "a.bvh").string() + ": is empty (export it again)");
  EXPECT_TRUE(holds(refused("a.bvh", "\n"), "ends before 'HIERARCHY' at its beginning (the file may be cut short"));
  const auto expect = [&](const char* part, const char* other, const std::string& message) {
    const std::string found = refused("a.bvh", with(kBvh, part, other));
    EXPECT_TRUE(holds(found, "a.bvh" + message)) << found;
  };
  expect("JOINT Head", "JIONT Head", ":10: has 'JIONT' in a joint");
  expect("OFFSET 0 1.5 0", "OFFSET 0 x 0", ":12: has 'x' for an offset");
  expect("CHANNELS 1 Yrotation", "CHANNELS 1 Wrotation", ":13: has a channel 'Wrotation'");
  expect("CHANNELS 1 Yrotation", "CHANNELS 2 Yrotation Yrotation", ":13: has a joint that turns about one axis twice");
  expect("CHANNELS 1 Yrotation", "CHANNELS 9 Yrotation", ":13: has 9 channels in a joint");
  expect("MOTION", "ROOT Other {}\nMOTION", ":39: has a second ROOT");
  expect("Frames: 4", "Frames: 5", ":46: promises 5 frames and ends after 4");
  expect("Frames: 4", "Frames: 3", ":45: goes on after its last frame, 3");
  expect("100 30\n", "100\n", ":46: ends before a channel of a frame");
  expect("Frame Time: 0.0333333", "Frame Time: 0", ":41: has a frame time of 0 s");
  expect("60 5", "60 nan", ":43: has 'nan' for a channel of a frame");
  expect("60 5", "60 5,5", ":43: has '5,5' for a channel of a frame");
}

TEST_F(Motions, AcclaimsBonesAreWhereTheirAxesPutThem) {
  const fs::path asf = write("a.asf", kAsf), amc = write("a_01.amc", kAmc);
  const std::string report = import_model(options_for(amc));
  EXPECT_TRUE(holds(report, "the skeleton of a.asf")) << report;
  EXPECT_FALSE(holds(report, "wider limits")) << report;
  FilmPlaces film(folder_ / "model.json");
  EXPECT_EQ(film.film.rate, 24);
  ImportOptions options = options_for(amc);
  options.rate = 120;
  import_model(options);
  FilmPlaces dense(folder_ / "model.json");
  expect_places(dense, test::plain_acclaim(asf, amc), 1, 1, 1e-6);
}

TEST_F(Motions, RadiansAreAsGoodAsDegrees) {
  std::string amc = ":RADIANS\n1\nroot 1 5 3 0.5 0 0\nback 0.1 0.2 0.3\nthigh 1\nfoot 0.25 -0.5\n";
  write("a.asf", kAsf);
  import_model(options_for(write("a.amc", amc)));
  const FilmPlaces film(folder_ / "model.json");
  const document::Json json = document::read_json(folder_ / "model.json");
  EXPECT_NEAR(json.at("actors").at(0).at("pose").at("thigh").at(0).get<double>(), 57.2957795, 1e-6);
}

TEST_F(Motions, LimitsAreTheFiles) {
  import_model(options_for(write("a.asf", kAsf)));
  const document::Json joints = document::read_json(folder_ / "model.json").at("joints");
  // The file's turn about z is outermost, MARS's about x.
  EXPECT_EQ(joints.at(1).at("limits"), document::Json::parse(R"({"x": [-35, 25], "y": [-30, 30], "z": [-45, 20]})"));
  EXPECT_EQ(joints.at(2).at("limits"), document::Json::parse(R"({"x": [-10, 170]})"));
  EXPECT_EQ(joints.at(3).at("limits"), document::Json::parse(R"({"x": [-70, 20], "y": [-45, 90]})"));
}

TEST_F(Motions, LimitsGiveWayToTheMotionAndTheReportSaysSo) {
  write("a.asf", kAsf);
  const std::string report = import_model(options_for(write("a.amc", with(kAmc, "thigh 100", "thigh 170.55"))));
  EXPECT_FALSE(holds(report, "wider")) << "frame 2 of 120 a second is not in a film of 24";
  ImportOptions options = options_for(write("a.amc", with(kAmc, "thigh 45", "thigh 170.55")));
  EXPECT_TRUE(holds(import_model(options), "wider limits for 1 joint that the motion takes beyond them: thigh"));
  EXPECT_EQ(FilmPlaces(folder_ / "model.json").joint("thigh").limits[0].upper, 170.6);
}

TEST_F(Motions, TakesFollowEachOther) {
  write("a.asf", kAsf);
  ImportOptions options = options_for(write("a_01.amc", kAmc));
  options.more = {write("a_02.amc", kAmc)};
  options.rate = 120;
  const std::string report = import_model(options);
  EXPECT_TRUE(holds(report, "a_02.amc from the file's frame 2")) << report;
  FilmPlaces film(folder_ / "model.json");
  EXPECT_EQ(film.film.frames, 4u);
  EXPECT_EQ(film.at("foot", 0), film.at("foot", 2));
}

TEST_F(Motions, DamagedAcclaimFilesAreRefusedAtTheirLine) {
  const auto expect_asf = [&](const char* part, const char* other, const std::string& message) {
    const std::string found = refused("a.asf", with(kAsf, part, other));
    EXPECT_TRUE(holds(found, "a.asf" + message)) << found;
  };
  expect_asf("axis 0 0 20 XYZ", "axis 0 0 20 XYY", ":31: has the order of axes 'XYY'");
  expect_asf("dof rx\n", "dof rw\n", ":32: has the degree of freedom 'rw'");
  expect_asf("(-10.0 170.0)", "(170.0 -10.0)", ":33: has the limits 170 to -10");
  expect_asf("(-10.0 170.0)", "(-10.0 170.0) (0 1)", ":33: has more limits in a bone than its 1 degree of freedom");
  expect_asf("thigh foot", "thigh feet", ":48: names 'feet', which is no bone of :bonedata");
  expect_asf("thigh foot", "thigh", ":50: has a bone 'foot' that hangs from nothing");
  expect_asf("name foot", "name thigh", ":44: has two bones 'thigh'");
  write("a.asf", kAsf);
  const auto expect_amc = [&](const char* part, const char* other, const std::string& message) {
    const std::string found = refused("a.amc", with(kAmc, part, other));
    EXPECT_TRUE(holds(found, "a.amc" + message)) << found;
  };
  expect_amc("thigh 45", "thing 45", ":7: names 'thing', which is no bone of the skeleton");
  expect_amc("thigh 45", "thigh 45 1", ":7: has not the 1 number for 'thigh'");
  expect_amc("foot -20 15", "foot -20", ":8: has not the 2 numbers for 'foot'");
  expect_amc("thigh 45\n", "", ":8: leaves 'thigh' out of its first frame");
  expect_amc("1\nroot", "one\nroot", ":4: has 'one' for a frame's number");
  fs::remove(folder_ / "a.asf");
  EXPECT_TRUE(holds(refused("a.amc", kAmc), "needs its skeleton, an .asf file, which is not beside it"));
}

TEST_F(Motions, ACapturedWalkStandsWhereItsFilesPutIt) {
  const fs::path data = fs::path(MARS_SOURCE_DIR) / "../shared/data";
  if (!fs::exists(data / "02_01.amc")) GTEST_SKIP() << "no files in " << data;
  const std::string report = import_model(options_for(data / "02_01.amc"));
  EXPECT_TRUE(holds(report, "343 frames at 120 a second")) << report;
  FilmPlaces film(folder_ / "model.json");
  EXPECT_EQ(film.film.rate, 24);
  expect_places(film, test::plain_acclaim(data / "02.asf", data / "02_01.amc"), 5, 1, 1e-4);
  import_model(options_for(data / "02.asf"));
  const document::Json thigh = document::read_json(folder_ / "model.json").at("joints").at(4);
  EXPECT_EQ(thigh.at("name"), "lfemur");
  EXPECT_EQ(thigh.at("limits"), document::Json::parse(R"({"x": [-60, 70], "y": [-70, 70], "z": [-20, 160]})"));
}

}  // namespace
}  // namespace mars::importer
