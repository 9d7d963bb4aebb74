// `mars film` on a film in memory.
#include <gtest/gtest.h>

#include <fstream>

#include "host/content/animator/settings/film_settings.h"
#include "host/content/modeler/figure_library.h"
#include "host/editing/edit_film.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::editing {
namespace {

class FilmWords : public testing::Test {
 protected:
  Done film(std::vector<std::string> words) {
    words.insert(words.begin(), "film");
    return edit_film(json_, "film.json", std::vector<Command>{words});
  }

  // The film stays.
  std::string failure(const std::vector<std::string>& words) {
    const document::Json before = json_;
    const std::string text = document::failure_of([&] { film(words); });
    EXPECT_EQ(json_, before);
    return text;
  }

  document::Json& actor(std::size_t number) { return json_["actors"][number]; }

  document::Json json_ = animator::new_film();
};

TEST_F(FilmWords, AddEverythingOfTheLibrary) {
  std::size_t all = 0;
  for (const auto library : {modeler::figure_library(), modeler::object_library()})
    for (const modeler::LibraryFigure& each : library) {
      film({"add", "one-" + std::string(each.name), "--model", std::string(each.name)});
      ++all;
    }
  EXPECT_EQ(json_["actors"].size(), all);
  EXPECT_EQ(json_["models"].size(), all);
}

TEST_F(FilmWords, AddActors) {
  film({"add", "tom", "--model", "man", "--place", "1", "-2", "0", "--turn", "90"});
  film({"add", "tim", "--model", "man", "--height", "4"});
  film({"add", "ball", "--model", "ball"});
  film({"add", "big", "--model", "ball", "--height", "2"});
  EXPECT_EQ(actor(0),
            document::Json::parse(R"({"name": "tom", "model": "man", "place": [1, -2, 0], "turn": [0, 0, 90]})"));
  EXPECT_EQ(actor(1), document::Json::parse(R"({"name": "tim", "model": "tim"})"));
  EXPECT_EQ(actor(2)["place"], document::Json::parse("[0, 0, 0.275]"));
  EXPECT_NEAR(actor(3)["place"][2].get<double>(), 1, 0.01);  // with its seams 2 high
  EXPECT_NE(failure({"add", "tom", "--model", "man"}).find("already"), std::string::npos);
  EXPECT_NE(failure({"add", "bob", "--model", "mann"}).find("did you mean 'man'?"), std::string::npos);
  EXPECT_NE(failure({"add", "bob", "--model", "none.json"}).find("does not exist"), std::string::npos);
  EXPECT_NE(failure({"add", "bob", "--model", "tim", "--height", "3"}).find("leave --height out"), std::string::npos);
}

// None stands in another, on whatever floor and however it is turned.
TEST_F(FilmWords, AddActorsBesideOthers) {
  film({"add", "floor", "--model", "floor"});
  for (const char* name : {"tom", "anna"}) film({"add", name, "--model", "man", "--beside", "0"});
  EXPECT_FALSE(actor(1).contains("place"));
  const double anna = actor(2)["place"][1];
  EXPECT_GT(anna, 1.4);
  EXPECT_LT(anna, 4);
  film({"add", "ball", "--model", "ball", "--beside", "0"});
  EXPECT_GT(actor(3)["place"][1].get<double>(), anna + 0.5);
  EXPECT_EQ(actor(3)["place"][2], 0.275);
  film({"add", "second-floor", "--model", "floor", "--beside", "0"});
  EXPECT_FALSE(actor(4).contains("place"));
  actor(1)["keys"] = document::Json::parse(R"([{"frame": 0, "place": [0, 0, 0]}, {"frame": 40, "place": [40, 0, 0]}])");
  film({"add", "late", "--model", "man", "--beside", "40"});
  EXPECT_GT(actor(5)["place"][1].get<double>(), anna + 1.4) << "tom has gone by then, and was there before";
  json_["models"]["hall"] = document::Json::parse(R"({"joints": [
    {"name": "ground", "limits": {}, "segment": {"shape": "box", "sbb": [[-20, -20, -0.5], [20, 20, 0]]}},
    {"name": "wall", "limits": {}, "segment": {"shape": "box", "sbb": [[-20, -20, 0], [-19, 20, 9]]}}]})");
  film({"add", "hall", "--model", "hall", "--beside", "0"});
  EXPECT_FALSE(actor(6).contains("place")) << "all stand between its walls";
  EXPECT_NE(failure({"add", "x", "--model", "man", "--beside", "0", "--place", "1", "2", "3"}).find("--place"),
            std::string::npos);
}

TEST_F(FilmWords, AddNoActorWhereThereIsNoRoomBesideOthers) {
  json_["models"]["huge"] = document::Json::parse(
      R"({"joints": [{"name": "body", "segment": {"shape": "box", "sbb": [[-4e8, -4e8, -4e8], [4e8, 4e8, 4e8]]}}]})");
  film({"add", "first", "--model", "huge", "--beside", "0"});
  const document::Json before = json_;
  EXPECT_NE(failure({"add", "second", "--model", "huge", "--beside", "0"}), "");
  EXPECT_EQ(json_, before);
}

TEST_F(FilmWords, RemoveAndRenameActorsWithWhatNamesThem) {
  film({"add", "tom", "--model", "man"});
  film({"add", "ball", "--model", "ball"});
  actor(1)["attach"] = {{"actor", "tom"}, {"joint", "right-hand"}};
  actor(1).erase("place");
  film({"rename", "tom", "anna"});
  EXPECT_EQ(actor(1)["attach"]["actor"], "anna");
  EXPECT_NE(failure({"remove", "anna"}).find("hang on: ball"), std::string::npos);
  EXPECT_NE(failure({"rename", "anna", "ball"}).find("already"), std::string::npos);
  EXPECT_NE(failure({"rename", "anna", "camera"}).find("camera"), std::string::npos);
  film({"remove", "ball"});
  film({"remove", "anna"});
  EXPECT_TRUE(json_["actors"].empty());
  EXPECT_TRUE(json_["models"].empty());
}

TEST_F(FilmWords, ChangeSettings) {
  film({"set", "frames=10", "size=64,36", "ambient=0.1,0.2,0.3", "curve=none"});
  EXPECT_EQ(json_["size"], document::Json::parse("[64, 36]"));
  EXPECT_EQ(json_["curve"], "none");
  film({"set", "size=1024x512", "rate=30"});
  EXPECT_EQ(json_["size"], document::Json::parse("[1024, 512]"));
  for (const char* word : {"size=1024", "size=1024x512x3", "size=[1024", "size=large", "background=1", "background=red",
                           "frames=1,2", "rate=fast", "samples=many"}) {
    const std::string refusal = failure({"set", word});
    const std::string key(word, std::string_view(word).find('='));
    EXPECT_NE(refusal.find("is no value of " + key), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("write it like " + key + "="), std::string::npos) << refusal;
  }
  EXPECT_NE(failure({"set", "frames=0"}).find("from 1 to 1000000"), std::string::npos);
  EXPECT_NE(failure({"set", "frame=1"}).find("did you mean 'frames'?"), std::string::npos);
  EXPECT_NE(failure({"set", "frames"}).find("KEY=VALUE"), std::string::npos);
  EXPECT_NE(failure({"set", "rate=1", "rate=2"}).find("twice"), std::string::npos);
  EXPECT_NE(failure({"new"}).find("is open already"), std::string::npos);
}

TEST_F(FilmWords, RepairAFilmWhoseSoundIsMissing) {
  const test::TemporaryFolder folder;
  const std::string sound = folder / "sound.wav";
  std::ofstream(sound) << "sound";
  json_["audio"] = "gone.wav";
  film({"set", "frames=10"});
  EXPECT_EQ(json_["audio"], "gone.wav");
  film({"add", "tom", "--model", "man"});
  EXPECT_NE(failure({"set", "audio=none.wav"}).find("none.wav', which does not exist"), std::string::npos);
  film({"set", "audio=" + sound});
  EXPECT_EQ(json_["audio"], sound);
}

TEST_F(FilmWords, ChangeTheCamera) {
  json_["camera"]["keys"] = document::Json::parse(R"([{"frame": 0, "exposure": 1}])");
  film({"camera", "near=0.5", "far=500", "fov=35"});
  EXPECT_NE(failure({"camera", "eye=1,2"}).find("write it like eye="), std::string::npos);
  EXPECT_EQ(json_["camera"], document::Json::parse(R"({"eye": [14, -8, 4.5], "at": [0, 0, 2.3], "fov": 35, "near": 0.5,
      "far": 500, "keys": [{"frame": 0, "exposure": 1}]})"));
  EXPECT_NE(failure({"camera", "exposure=2"}).find("also set by keys"), std::string::npos);
  EXPECT_NE(failure({"camera", "far=0.1"}).find("not beyond near"), std::string::npos);
  EXPECT_NE(failure({"camera", "nera=1"}).find("did you mean 'near'?"), std::string::npos);
}

TEST_F(FilmWords, AddAndRemoveLights) {
  EXPECT_EQ(film({"light", "add", "place=1,2,3", "intensity=2"}).report,
            "light/4, beside those that the film was shown with: light/1 to light/3\n");
  EXPECT_EQ(json_["lights"].size(), 4u);
  EXPECT_TRUE(json_.contains("ambient"));
  EXPECT_NE(failure({"light", "rig"}).find("has lights of its own"), std::string::npos);
  EXPECT_NE(failure({"light", "add", "intensity=2"}).find("neither a direction nor a place"), std::string::npos);
  EXPECT_NE(failure({"light", "remove", "5"}).find("1 to 4"), std::string::npos);
  for (int i = 0; i < 4; ++i) film({"light", "remove", "1"});
  film({"light", "rig"});
  EXPECT_EQ(json_["lights"].size(), 3u);
}

TEST_F(FilmWords, ChangeALight) {
  EXPECT_NE(failure({"light", "set", "1", "intensity=2"}).find("light rig"), std::string::npos);
  film({"light", "add", "place=1,2,3", "intensity=2"});
  json_["lights"][3]["keys"] = document::Json::parse(R"([{"frame": 4, "reach": 5}])");
  film({"light", "set", "4", "intensity=3", "color=1,0.5,0"});
  EXPECT_EQ(json_["lights"][3], document::Json::parse(R"({"place": [1, 2, 3], "intensity": 3, "color": [1, 0.5, 0],
      "keys": [{"frame": 4, "reach": 5}]})"));
  EXPECT_EQ(std::prev(json_["lights"][3].end()).key(), "keys");
  EXPECT_NE(failure({"light", "set", "4", "reach=2"}).find("also set by keys"), std::string::npos);
  EXPECT_NE(failure({"light", "set", "5", "reach=2"}).find("1 to 4"), std::string::npos);
  EXPECT_NE(failure({"light", "set", "4", "raech=2"}).find("did you mean 'reach'?"), std::string::npos);
}

TEST(NewFilm, HasLightsOfWhichTheBrightestCasts) {
  for (const char* color : {"linear", "coded"}) {
    document::Json film = animator::new_film();
    animator::set_film(film, {{"color", color}});
    animator::light_new_film(film, "film.json");
    ASSERT_EQ(film["lights"].size(), 3u);
    EXPECT_EQ(film["lights"][0]["shadow"], true);
    EXPECT_FALSE(film["lights"][0].contains("size")) << "sharp shadows take less time";
    for (std::size_t other : {1, 2}) {
      EXPECT_FALSE(film["lights"][other].contains("shadow"));
      EXPECT_LT(film["lights"][other]["intensity"], film["lights"][0]["intensity"]);
    }
    EXPECT_EQ(film.contains("ambient"), std::string(color) == "linear");
  }
}

TEST_F(FilmWords, LetLightsCast) {
  film({"light", "add", "place=1,2,3", "shadow=true", "size=0.5"});
  EXPECT_EQ(json_["lights"][3], document::Json::parse(R"({"place": [1, 2, 3], "shadow": true, "size": 0.5})"));
  film({"light", "set", "4", "shadow=false"});
  EXPECT_EQ(json_["lights"][3]["shadow"], false);
  EXPECT_NE(failure({"light", "set", "4", "shadow=yes"}).find("shadow: is a text"), std::string::npos);
  film({"light", "set", "1", "size=0.53"});
  EXPECT_NE(failure({"light", "set", "1", "size=100"}).find("from 0 to 90"), std::string::npos);
}

TEST_F(FilmWords, CopyWhatAModelsMaterialDoesWithShadows) {
  film({"add", "tom", "--model", "man"});
  json_["models"]["man"] = modeler::library_figure("man");
  json_["models"]["man"]["materials"]["skin"]["casts"] = false;
  film({"material", "add", "skin", "--actor", "tom", "receives=false"});
  EXPECT_EQ(json_["materials"]["skin"]["casts"], false);
  EXPECT_EQ(json_["materials"]["skin"]["receives"], false);
}

TEST_F(FilmWords, GiveActorsMaterials) {
  film({"add", "tom", "--model", "man"});
  film({"material", "add", "skin", "--actor", "tom", "exponent=12"});
  EXPECT_EQ(
      json_["materials"]["skin"],
      document::Json::parse(
          R"({"color": [0.87, 0.64, 0.5], "reflection": "blinn-phong", "ambient": 0.35, "diffuse": 0.75, "specular": 0.1,
          "exponent": 12})"));
  EXPECT_EQ(actor(0)["materials"]["skin"], "skin");
  film({"material", "add", "gold", "--actor", "tom", "reflection=metallic-roughness"});
  film({"material", "set", "gold", "metallic=1"});
  EXPECT_EQ(actor(0)["material"], "gold");
  EXPECT_NE(failure({"material", "set", "gold", "metallic=2"}).find("from 0 to 1"), std::string::npos);
  EXPECT_NE(failure({"material", "set", "gld", "metallic=1"}).find("did you mean 'gold'?"), std::string::npos);
  film({"material", "remove", "gold"});
  film({"material", "remove", "skin"});
  EXPECT_EQ(actor(0), document::Json::parse(R"({"name": "tom", "model": "man"})"));
}

TEST_F(FilmWords, ShowWhatThereIsByItsNames) {
  film({"add", "tom", "--model", "man"});
  film({"light", "rig"});
  film({"material", "add", "gold"});
  const std::string shown = film({"show"}).report;
  for (const char* name : {"48 frames at 24 a second", "camera", "light/3", "material/gold", "tom"})
    EXPECT_NE(shown.find(name), std::string::npos) << shown;
}

}  // namespace
}  // namespace mars::editing
