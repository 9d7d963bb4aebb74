// What comes from another film: `mars animate motion`, and actors of `mars film add --from`.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/content/animator/settings/film_settings.h"
#include "host/content/film/film_json.h"
#include "host/content/modeler/figure_library.h"
#include "host/editing/edit_film.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::editing {
namespace {

namespace fs = std::filesystem;

class OtherFilm : public testing::Test {
 protected:
  OtherFilm() {
    edit(json_, {"film", "add", "anna", "--model", "child"});
    document::Json other = animator::new_film();
    other["rate"] = 30;
    edit(other, {"film", "add", "tom", "--model", "man"});
    edit(other, {"animate", "walk", "tom", "--steps", "2", "--lengthen"});
    edit(other, {"film", "add", "ball", "--model", "ball"});
    other["actors"][1].erase("place");
    for (int frame = 0; frame <= 30; ++frame)
      other["actors"][1]["keys"].push_back({{"frame", frame}, {"place", {frame / 30.0, 0, 0}}});
    film::create_film(folder_ / "walk.json", other);
  }

  Done edit(document::Json& json, const Command& words) {
    return edit_film(json, folder_ / "film.json", std::vector<Command>{words});
  }

  const test::TemporaryFolder folder_;
  document::Json json_ = animator::new_film();
};

TEST_F(OtherFilm, GivesAnActorTheMotionOfAnother) {
  const Done done = edit(json_, {"animate", "motion", "anna", "--from", "walk.json", "--actor", "tom", "--lengthen"});
  EXPECT_NE(done.report.find("joints by limb"), std::string::npos) << done.report;
  EXPECT_NE(done.report.find("30 frames a second became 24"), std::string::npos) << done.report;
  EXPECT_NE(done.report.find("keys became"), std::string::npos) << done.report;
  EXPECT_GT(json_["actors"][0]["keys"].size(), 3u);
  EXPECT_EQ(document::failure_of([&] { edit(json_, {"animate", "check"}); }), "");
}

// Models that stand in the other film may name files, as seen from its folder.
TEST_F(OtherFilm, GivesAnActorWhoseModelNamesFiles) {
  fs::create_directory(folder_ / "cast");
  std::ofstream(folder_ / "cast/skin.png") << "picture";
  document::Json model = modeler::library_figure("man");
  std::ofstream(folder_ / "cast/man.json") << model.dump();
  document::Json other = animator::new_film();
  other["models"] = {{"twin", {{"from", "man.json"}, {"proportions", document::Json::object()}}}, {"own", model}};
  other["models"]["own"]["materials"]["skin"]["images"]["color"] = "skin.png";
  other["actors"] = {{{"name", "tim"}, {"model", "twin"}}, {{"name", "tom"}, {"model", "own"}}};
  film::create_film(folder_ / "cast/others.json", other);
  for (const char* name : {"tim", "tom"}) edit(json_, {"film", "add", name, "--from", "cast/others.json"});
  EXPECT_EQ(json_["models"]["twin"]["from"], "cast/man.json");
  EXPECT_EQ(json_["models"]["own"]["materials"]["skin"]["images"]["color"], "cast/skin.png");
}

TEST_F(OtherFilm, SaysWhoseMotionIsMeant) {
  const auto failure = [&](const Command& words) { return document::failure_of([&] { edit(json_, words); }); };
  EXPECT_NE(failure({"animate", "motion", "anna", "--from", "walk.json"}).find("--actor NAME"), std::string::npos);
  EXPECT_NE(failure({"animate", "motion", "anna", "--from", "walk.json", "--actor", "tim"}).find("did you mean 'tom'?"),
            std::string::npos);
  EXPECT_NE(failure({"animate", "motion", "anna", "--from", "walk.json", "--actor", "tom", "--frame", "900-"})
                .find("its last key is at frame"),
            std::string::npos);
}

TEST_F(OtherFilm, ACarriedActorIsDetachedFirst) {
  edit(json_, {"film", "add", "cart", "--model", "box"});
  edit(json_, {"animate", "attach", "anna", "--to", "cart", "--frame", "6"});
  const Command words{"animate", "motion", "anna", "--from", "walk.json", "--actor", "tom", "--lengthen"};
  EXPECT_NE(document::failure_of([&] { edit(json_, words); }).find("is carried by 'cart' at frame 6"),
            std::string::npos);
  edit(json_, {"animate", "detach", "anna", "--frame", "8"});
  edit(json_, words);  // from the frame at which it is detached
  EXPECT_EQ(document::failure_of([&] { edit(json_, {"animate", "check"}); }), "");
}

// Places of motion that is keyed at each frame are where they are at that time.
TEST_F(OtherFilm, KeysOfAnActorKeepTheirTimes) {
  const Done done = edit(json_, {"film", "add", "ball", "--from", "walk.json", "--lengthen"});
  ASSERT_EQ(done.remarks.size(), 1u);
  EXPECT_NE(done.remarks[0].find("30 frames a second are at those of 24"), std::string::npos);
  const document::Json& keys = json_["actors"][1]["keys"];
  EXPECT_EQ(keys.back()["frame"], 24);
  for (const document::Json& key : keys)
    EXPECT_NEAR(key["place"][0].get<double>(), key["frame"].get<double>() / 24, 1e-8) << key;
}

}  // namespace
}  // namespace mars::editing
