// What pages may ask to import, and what is made of which files.
#include "host/studio/importing/import_request.h"

#include <gtest/gtest.h>

#include "hal/failure/failure.h"

namespace mars::studio {
namespace {

Json message_with(const std::vector<std::string>& names, std::uint64_t size = 1) {
  Json files = Json::array();
  for (const std::string& name : names) files.push_back({{"name", name}, {"size", size}});
  return {{"do", "import"}, {"files", files}};
}

std::vector<ImportedFile> files(const std::vector<std::string>& names) {
  return import_request(message_with(names)).files;
}

TEST(ImportRequest, TakesPlainNames) {
  const auto read = files({"rock.obj", "tex/skin 1.png", "Übung.mtl", "a/b/c/d/e/f/g/h.bin"});
  ASSERT_EQ(read.size(), 4u);
  EXPECT_EQ(read[1].name, "tex/skin 1.png");
  EXPECT_EQ(read[1].bytes, 1u);
}

TEST(ImportRequest, RefusesNamesThatLeadElsewhere) {
  for (const std::string& name :
       {std::string(), std::string("/etc/rock.obj"), std::string("../rock.obj"), std::string("a/../rock.obj"),
        std::string("a/.git/rock.obj"), std::string(".rock.obj"), std::string("."), std::string("-o"),
        std::string("a//rock.obj"), std::string("a/"), std::string("a\\rock.obj"), std::string("a\nrock.obj"),
        std::string("a\0.obj", 6), std::string("a/b/c/d/e/f/g/h/i.obj"), std::string(101, 'a')})
    EXPECT_THROW(files({name}), Failure) << name;
  EXPECT_THROW(files({"rock.obj", "rock.obj"}), Failure);
}

TEST(ImportRequest, RefusesTooMuch) {
  EXPECT_NO_THROW(import_request(message_with({"rock.obj"}, kMostImportedBytes)));
  EXPECT_THROW(import_request(message_with({"rock.obj"}, kMostImportedBytes + 1)), Failure);
  EXPECT_THROW(import_request(message_with({"a.obj", "b.obj"}, kMostImportedBytes / 2 + 1)), Failure);
  EXPECT_THROW(import_request(message_with({"a.obj", "b.obj"}, ~std::uint64_t{0})), Failure);
  EXPECT_THROW(import_request(message_with({})), Failure);
  EXPECT_THROW(import_request(message_with(std::vector<std::string>(kMostImportedFiles + 1, "a.obj"))), Failure);
  EXPECT_THROW(import_request({{"do", "import"}}), Json::exception);
  EXPECT_THROW(import_request({{"files", {{{"name", "a.obj"}, {"size", -1}}}}}), Failure);
}

TEST(ImportRequest, OptionsAreOneWordEach) {
  Json message = message_with({"rock.obj"});
  message["options"] = {{"height", "5.1"}, {"front", "-z"}, {"up", ""}};
  EXPECT_EQ(import_request(message).options, (std::vector<std::string>{"--height=5.1", "--front=-z"}));
  for (const char* other : {"output", "animation", "Height"}) {
    message["options"] = {{"height", "5.1"}, {other, "walk"}};
    EXPECT_THROW(import_request(message), Failure) << other;
  }
  message["options"] = Json::array({"height"});
  EXPECT_THROW(import_request(message), Failure);
  message["options"] = {{"height", std::string(41, '1')}};
  EXPECT_THROW(import_request(message), Failure);
}

TEST(ImportJobs, CompanionsHaveNone) {
  const auto jobs = import_jobs(files({"fig/skin.png", "fig/walker.gltf", "fig/walker.bin"}));
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs[0].main, "fig/walker.gltf");
  EXPECT_EQ(jobs[0].name, "walker");
  EXPECT_FALSE(jobs[0].moves);
}

TEST(ImportJobs, AreOfScenesAndPatchesToo) {
  const auto jobs =
      import_jobs(files({"man.FBX", "man.png", "house.dae", "pot.pov", "pot.inc", "ship.rib", "girl.vrm"}));
  ASSERT_EQ(jobs.size(), 5u);
  EXPECT_EQ(jobs[0].main, "man.FBX");
  EXPECT_EQ(jobs[2].main, "pot.pov");
  EXPECT_EQ(jobs[4].name, "girl");
}

TEST(ImportJobs, MotionsOfOneSkeletonFollowEachOther) {
  const auto jobs = import_jobs(files({"02_02.amc", "02.asf", "02_01.amc", "jump.bvh", "My rock!.OBJ"}));
  ASSERT_EQ(jobs.size(), 3u);
  EXPECT_EQ(jobs[0].main, "jump.bvh");
  EXPECT_TRUE(jobs[0].moves);
  EXPECT_EQ(jobs[1].name, "My-rock-");
  EXPECT_EQ(jobs[2].main, "02_01.amc");
  EXPECT_EQ(jobs[2].more, std::vector<std::string>{"02_02.amc"});
  EXPECT_EQ(import_jobs(files({"02.asf"}))[0].main, "02.asf");
}

TEST(ImportJobs, SayWhatCannotBeRead) {
  try {
    import_jobs(files({"figure.blend", "tex/skin.png"}));
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_NE(failure.remedy.find("Blender"), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace mars::studio
