// Imports as pages see them, with a program in place of mars: what comes into the film, and that nothing else stays.
#include "host/studio/importing/importing.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/studio/importing/upload_folder.h"
#include "tests/host/studio/fakes.h"
#include "tests/sanitizers/sanitized.h"
#include "tests/temporary_folder.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;

// A film at 24 frames a second with an actor "rock".
class FilmProject final : public test::FakeProject {
 public:
  FilmProject() {
    film_.rate = 24;
    film_.actors.resize(1);
    film_.actors[0].name = "rock";
  }
  bool is_model() const override { return false; }
  const animator::Film& film() const override { return film_; }

 private:
  animator::Film film_;
};

// import FROM -o TO ...: the file's text decides what becomes of it.
constexpr const char* kMars = R"sh(#!/bin/sh
case "$(cat "$2")" in
  bad*) echo "mars: $2:3: is no number (export it again)" >&2; exit 1;;
  long*) echo $$ > "$(dirname "$0")/process"; exec sleep 100;;
esac
(cd "$(dirname "$2")" && find . -type f | sort) >> "$(dirname "$0")/came"
shift; echo "$@" >> "$(dirname "$0")/words"
case "$(cat "$1")" in
  painted*) mkdir "${3%.json}-images"; printf picture > "${3%.json}-images/a.png";;
esac
printf '{"made of": "%s"}' "$(cat "$1")" > "$3"
echo "$3: model of one joint"; echo "  read       all of $1"
)sh";

constexpr std::chrono::milliseconds kSoon{30};
constexpr const char* kFigure = R"({"buffers": [{"uri": "a%20figure.bin"}, {"uri": "data:;base64,AAAA"}],
  "images": [{"uri": "bumps.png"}, {"uri": "tex/skin.png"}], "textures": [{"source": 1}],
  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 1}}]})";

class ImportingTest : public testing::Test {
 protected:
  ImportingTest() {
    fs::create_directories(folder_ / "films");
    std::ofstream(folder_ / "mars") << kMars;
    fs::permissions(folder_ / "mars", fs::perms::owner_all);
    make({folder_ / "films/play.json", folder_ / "mars"});
  }

  void make(const ImportingSettings& settings) {
    importing_ = make_importing(context_, settings, project_,
                                {[this](PageNumber page, const Json& message) {
                                   EXPECT_EQ(page, 1u);
                                   messages_.push_back(message);
                                 },
                                 [this](PageNumber, const Json& step, const std::vector<editing::Command>& before) {
                                   if (refuses_) throw Failure("the film is broken", "play.json:3", "correct it");
                                   step_ = step;
                                   before_ = before;
                                 }});
  }
  void make_impatient() {
    importing_.reset();
    make({folder_ / "films/play.json", folder_ / "mars", kSoon, kSoon});
  }

  struct Content {
    std::string name, text;
  };

  static Json list_of(const std::vector<Content>& files) {
    Json list = Json::array();
    for (const Content& file : files) list.push_back({{"name", file.name}, {"size", file.text.size()}});
    return list;
  }

  void begin(const std::vector<Content>& files) {
    importing_->take(1, {{"do", "import"}, {"files", list_of(files)}});
    EXPECT_EQ(last()["state"], "receiving");
  }

  std::unique_ptr<Upload> upload(std::uint32_t file, std::uint64_t bytes) {
    return importing_->upload({last()["number"], file, bytes});
  }

  void send(const std::vector<Content>& files) {
    begin(files);
    send_announced(files, 0);
  }

  // To the import that waits for them, after `first` others.
  void send_more(const std::vector<Content>& files, std::size_t first) {
    importing_->take(1, {{"do", "import_more"}, {"files", list_of(files)}});
    ASSERT_EQ(last()["state"], "receiving");
    send_announced(files, first);
  }

  void send_announced(const std::vector<Content>& files, std::size_t first) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      const auto up = upload(static_cast<std::uint32_t>(first + i), files[i].text.size());
      const std::string_view text = files[i].text;
      up->take(text.substr(0, text.size() / 2));
      up->take(text.substr(text.size() / 2));
      up->end();
    }
  }

  template <typename Holds>
  bool run_until(Holds holds) {
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(200) * sanitizers::kSlowness;
    while (!holds() && std::chrono::steady_clock::now() < last) {
      context_.restart();
      context_.run_one_for(std::chrono::milliseconds(20));
    }
    return holds();
  }
  bool ends(const char* state) {
    return run_until([&] { return last()["state"] == state; });
  }

  Json last() const { return messages_.empty() ? Json::object() : messages_.back(); }

  // In the film's folder, hidden files too.
  std::vector<std::string> left() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "films")) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  }

  std::string text_of(const std::string& file) const {
    std::ifstream stream(folder_ / file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  using Names = std::vector<std::string>;

  const test::TemporaryFolder folder_;
  boost::asio::io_context context_;
  // Without it, a context that waits for another thread's work alone would stop for good.
  const boost::asio::executor_work_guard<boost::asio::io_context::executor_type> kept_{context_.get_executor()};
  FilmProject project_;
  std::vector<Json> messages_;
  Json step_;
  std::vector<editing::Command> before_;
  bool refuses_ = false;
  std::unique_ptr<Importing> importing_;
};

TEST_F(ImportingTest, AModelComesIntoTheFilm) {
  std::ofstream(folder_ / "films/rock.json") << "of somebody else";
  send({{"tex/rock.mtl", "grey"}, {"rock.obj", "stone"}});
  ASSERT_TRUE(ends("done")) << last();
  EXPECT_EQ(left(), (Names{"rock-2.json", "rock.json"}));
  EXPECT_EQ(text_of("films/rock-2.json"), R"({"made of": "stone"})");
  EXPECT_EQ(text_of("films/rock.json"), "of somebody else");
  EXPECT_EQ(step_.dump(), R"({"commands":[["film","add","rock-2","--model","rock-2.json","--beside","0"]]})");
  EXPECT_EQ(before_, (std::vector<editing::Command>{{"import", "rock.obj", "-o", "rock-2.json"}}));
  EXPECT_EQ(last()["reports"][0], "rock-2.json: model of one joint\n  read       all of rock.obj\n");
  EXPECT_EQ(last()["actors"], Json{"rock-2"});
}

// Under a name that neither a model nor a folder of images has: the model names its images.
TEST_F(ImportingTest, ImagesComeBesideTheFilmWithTheirModel) {
  fs::create_directory(folder_ / "films/rock-images");
  send({{"rock.obj", "painted"}});
  ASSERT_TRUE(ends("done")) << last();
  EXPECT_EQ(left(), (Names{"rock-2-images", "rock-2.json", "rock-images"}));
  EXPECT_EQ(text_of("films/rock-2-images/a.png"), "picture");
  refuses_ = true;
  send({{"rock.obj", "painted"}});
  ASSERT_TRUE(ends("failed")) << last();
  EXPECT_EQ(left(), (Names{"rock-2-images", "rock-2.json", "rock-images"})) << "what no film came to have";
}

TEST_F(ImportingTest, MotionsHaveTheFilmsFrames) {
  send({{"walk.bvh", "left right"}, {"ball.ply", "round"}});
  ASSERT_TRUE(ends("done")) << last();
  EXPECT_EQ(left(), (Names{"ball.json", "walk.json"}));
  EXPECT_EQ(step_.dump(), R"({"commands":[["film","add","walk","--from","walk.json","--lengthen"],)"
                          R"(["film","add","ball","--model","ball.json","--beside","0"]]})");
  EXPECT_NE(text_of("words").find("walk.json --rate 24\n"), std::string::npos) << text_of("words");
}

TEST_F(ImportingTest, ABadFileLeavesNothing) {
  send({{"ball.ply", "round"}, {"rock.obj", "bad"}});
  ASSERT_TRUE(ends("failed")) << last();
  EXPECT_EQ(last()["text"], "rock.obj:3: is no number (export it again)");
  EXPECT_EQ(left(), Names{});
  EXPECT_TRUE(step_.is_null());
  send({{"rock.obj", "stone"}});  // another may come
  EXPECT_TRUE(ends("done"));
}

TEST_F(ImportingTest, AFilmThatRefusesKeepsNoModel) {
  refuses_ = true;
  send({{"rock.obj", "stone"}});
  ASSERT_TRUE(ends("failed"));
  EXPECT_EQ(last()["text"], "play.json:3: the film is broken (correct it)");
  EXPECT_EQ(left(), Names{});
}

TEST_F(ImportingTest, CutUploadsLeaveNothing) {
  begin({{"rock.obj", "stone"}, {"rock.mtl", "grey"}});
  {
    const auto up = upload(0, 5);
    up->take("st");
    EXPECT_EQ(left().size(), 1u);
  }
  EXPECT_EQ(last()["state"], "failed");
  EXPECT_EQ(left(), Names{});
}

TEST_F(ImportingTest, OnlyFilesThatWereNamedAreTaken) {
  begin({{"rock.obj", "stone"}});
  const std::uint32_t number = last()["number"];
  EXPECT_THROW(importing_->upload({number + 1, 0, 5}), Failure);
  EXPECT_THROW(importing_->upload({number, 1, 5}), Failure);
  EXPECT_THROW(importing_->upload({number, 0, 6}), Failure);
  const auto up = upload(0, 5);
  EXPECT_THROW(upload(0, 5), Failure);
  EXPECT_THROW(begin({{"ball.ply", "round"}}), Failure);
  importing_->take(1, {{"do", "stop_import"}});
  EXPECT_EQ(last()["state"], "stopped");
  EXPECT_THROW(up->take("st"), Failure);
  EXPECT_THROW(up->end(), Failure);
  EXPECT_EQ(left(), Names{});
}

TEST_F(ImportingTest, TheReaderEndsWithItsPage) {
  send({{"rock.obj", "long"}});
  ASSERT_TRUE(run_until([&] { return !text_of("process").empty() && text_of("process").back() == '\n'; }));
  const pid_t reader = std::stoi(text_of("process"));
  importing_->page_closed(2);
  EXPECT_EQ(kill(reader, 0), 0);
  importing_->page_closed(1);
  EXPECT_NE(kill(reader, 0), 0);
  EXPECT_EQ(left(), Names{});
  EXPECT_EQ(last()["state"], "stopped");
}

TEST_F(ImportingTest, ItWaitsForFilesThatOthersName) {
  send({{"figure.gltf", kFigure}});
  ASSERT_EQ(last()["state"], "waiting");
  EXPECT_EQ(last()["missing"].dump(), R"([{"name":"a figure.bin","of":"figure.gltf","needed":true},)"
                                      R"({"name":"tex/skin.png","of":"figure.gltf","needed":false}])");
  EXPECT_EQ(last()["seconds"], 120);
  EXPECT_THROW(importing_->take(2, {{"do", "import_more"}, {"files", Json::array()}}), Failure);
  EXPECT_THROW(importing_->take(1, {{"do", "import_more"}, {"files", list_of({{"figure.gltf", ""}})}}), Failure);
  send_more({{"a figure.bin", "numbers"}}, 1);
  ASSERT_EQ(last()["state"], "waiting");
  EXPECT_EQ(last()["missing"].size(), 1u);
  send_more({{"skin.png", "colours"}}, 2);  // which belongs into a folder
  ASSERT_TRUE(ends("done")) << last();
  EXPECT_EQ(text_of("came"), "./a figure.bin\n./figure.gltf\n./skin.png\n./tex/skin.png\n");
  EXPECT_EQ(left(), Names{"figure.json"});
}

TEST_F(ImportingTest, AMotionWaitsForItsSkeleton) {
  send({{"walks/02_01.amc", "steps"}});
  ASSERT_EQ(last()["state"], "waiting");
  EXPECT_EQ(last()["missing"].dump(), R"([{"name":"walks/*.asf","of":"walks/02_01.amc","needed":true}])");
  send_more({{"02.asf", "bones"}}, 1);
  ASSERT_TRUE(ends("done")) << last();
  EXPECT_EQ(text_of("came"), "./02.asf\n./02_01.amc\n");
  EXPECT_EQ(last()["actors"], Json{"02_01"});
}

TEST_F(ImportingTest, WhatIsNotNeededCanBeLeftOut) {
  send({{"rock.obj", "mtllib rock.mtl\nv 0 0 0\n"}});
  ASSERT_EQ(last()["state"], "waiting");
  importing_->take(1, {{"do", "import_more"}, {"files", Json::array()}});
  EXPECT_TRUE(ends("done")) << last();
  make_impatient();
  send({{"stone.obj", "mtllib rock.mtl\nv 0 0 0\n"}});
  ASSERT_EQ(last()["state"], "waiting");
  EXPECT_TRUE(ends("done")) << last();
}

TEST_F(ImportingTest, ItDoesNotWaitForEver) {
  make_impatient();
  send({{"figure.gltf", kFigure}});
  ASSERT_TRUE(ends("failed"));
  EXPECT_EQ(last()["text"],
            "a figure.bin did not come within 1 second: figure.gltf cannot be read without (import them together)");
  begin({{"ball.ply", "round"}, {"rock.obj", "stone"}});
  {
    const auto up = upload(0, 5);
    up->take("round");
    up->end();
  }
  ASSERT_TRUE(ends("failed"));
  EXPECT_EQ(last()["text"],
            "rock.obj did not come: the page sent nothing for 1 second (import the files again, together)");
  EXPECT_EQ(left(), Names{});
}

// As SIGKILL leaves it.
TEST_F(ImportingTest, FoldersOfKilledStudiosGo) {
  const pid_t killed = fork();
  if (killed == 0) {
    const UploadFolder folder(folder_ / "films");
    std::ofstream(folder.path() / "there") << "figure";
    raise(SIGKILL);
  }
  waitpid(killed, nullptr, 0);
  ASSERT_EQ(left().size(), 1u);
  begin({{"rock.obj", "stone"}});  // another studio's
  fs::create_directory(folder_ / "films/.mars-import-mine");
  boost::asio::io_context context;
  const auto next = make_importing(context, {folder_ / "films/play.json", folder_ / "mars"}, project_, {});
  ASSERT_EQ(left().size(), 2u);
  upload(0, 5)->take("stone");  // it goes on there
  EXPECT_EQ(left(), Names{".mars-import-mine"});
}

}  // namespace
}  // namespace mars::studio
