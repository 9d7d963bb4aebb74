// The studio between pages, project and stage.
#include "host/studio/studio.h"

#include <gtest/gtest.h>

#include "tests/host/studio/fakes.h"

namespace mars::studio {
namespace {

struct Heard {
  PageNumber page;
  Json message;
};

class RecordingPages final : public web::Pages {
 public:
  void tell(PageNumber page, const Json& message) override { heard.push_back({page, message}); }
  void show(ViewPicture) override {}

  // What was said since the last time: "1 project, 0 poses".
  std::string said() {
    std::string all;
    for (const Heard& each : std::exchange(heard, {}))
      all += (all.empty() ? "" : ", ") + std::to_string(each.page) + " " + each.message["is"].get<std::string>();
    return all;
  }

  std::vector<Heard> heard;
};

class StudioTest : public testing::Test {
 protected:
  StudioTest() {
    auto project = std::make_unique<test::FakeProject>();
    project_ = project.get();
    const auto make_link = [this](RendererLink::Listener listener) {
      link_ = std::move(listener);
      return std::make_unique<test::FakeLink>();
    };
    const auto make_stage = [this](Project&, RendererLink&, Stage::Listener listener) {
      auto stage = std::make_unique<test::FakeStage>(std::move(listener));
      stage_ = stage.get();
      return stage;
    };
    const auto make_rendering = [this](Rendering::Listener) {
      auto rendering = std::make_unique<test::FakeRendering>();
      rendering_ = rendering.get();
      return rendering;
    };
    const auto make_importing = [this](const Project&, Importing::Listener listener) {
      auto importing = std::make_unique<test::FakeImporting>(std::move(listener));
      importing_ = importing.get();
      return importing;
    };
    const auto make_thumbnails = [this](Thumbnails::Listener) {
      auto thumbnails = std::make_unique<test::FakeThumbnails>();
      thumbnails_ = thumbnails.get();
      return thumbnails;
    };
    studio_.emplace(Parts{std::move(project), make_link, make_stage, make_rendering, make_importing, make_thumbnails},
                    pages_);
  }

  void say(PageNumber page, const char* message) { studio_->handle_message(page, Json::parse(message)); }

  RecordingPages pages_;
  test::FakeProject* project_ = nullptr;
  test::FakeStage* stage_ = nullptr;
  test::FakeRendering* rendering_ = nullptr;
  test::FakeImporting* importing_ = nullptr;
  test::FakeThumbnails* thumbnails_ = nullptr;
  RendererLink::Listener link_;
  std::optional<Studio> studio_;
};

TEST_F(StudioTest, ANewPageIsToldAll) {
  link_.ready(4, 2);
  link_.state("the nodes are gone");
  pages_.heard.clear();
  studio_->page_opened(3);
  ASSERT_EQ(pages_.heard.size(), 2u);
  EXPECT_EQ(pages_.heard[0].message["is"], "project");
  EXPECT_EQ(pages_.heard[1].page, 3u);
  EXPECT_EQ(pages_.heard[1].message.dump(), R"({"is":"state","renderer":"the nodes are gone","nodes":4,"machines":2})");
}

TEST_F(StudioTest, GesturesTellPosesAndTheirEndTellsAll) {
  say(1, R"({"do": "preview", "edit": 7, "step": {"set": "a"}})");
  EXPECT_EQ(pages_.said(), "0 poses");
  EXPECT_EQ(stage_->last_edit, 7u);
  EXPECT_EQ(stage_->changes, 1);
  EXPECT_TRUE(project_->written.empty());
  say(1, R"({"do": "commit", "edit": 8, "step": {"set": "b"}})");
  EXPECT_EQ(pages_.said(), "0 project");
  EXPECT_EQ(project_->written, std::vector<std::string>{"b"});
  say(2, R"({"do": "undo"})");
  say(2, R"({"do": "frame", "frame": 5})");
  EXPECT_EQ(pages_.said(), "0 project, 0 project");
  EXPECT_EQ(project_->frame(), 5u);
}

TEST_F(StudioTest, RenderingsHearWhatIsForThem) {
  studio_->page_opened(2);
  say(2, R"({"do": "render", "options": {"folder": "out"}})");
  say(2, R"({"do": "painted", "view": 255, "picture": 1})");
  say(2, R"({"do": "undo"})");
  studio_->page_closed(2);
  EXPECT_EQ(rendering_->heard, (std::vector<std::string>{"opened", "render", "painted", "closed"}));
}

TEST_F(StudioTest, AnImportIsAStepOfItsPage) {
  say(2, R"({"do": "import", "step": {"set": "rock"}})");
  EXPECT_EQ(project_->written, std::vector<std::string>{"rock"});
  ASSERT_EQ(pages_.heard.size(), 3u);
  EXPECT_EQ(pages_.heard[0].message.dump(), R"({"is":"done","commands":[["import","rock.obj"]]})");
  EXPECT_EQ(pages_.heard[0].page, 2u);
  EXPECT_EQ(pages_.heard[1].message["is"], "project");
  pages_.said();
  say(2, R"({"do": "import", "step": {"set": "bad"}})");
  EXPECT_EQ(pages_.said(), "2 refused");
  studio_->page_closed(2);
  EXPECT_EQ(importing_->heard, (std::vector<std::string>{"import", "import", "closed"}));
}

TEST_F(StudioTest, ThumbnailsWaitForHands) {
  say(2, R"({"do": "models"})");
  studio_->look_at_files();
  say(1, R"({"do": "orbit", "view": 0, "edit": 1})");
  studio_->look_at_files();
  say(1, R"({"do": "painted", "view": 0, "picture": 1})");
  say(2, R"({"do": "thumbnail", "model": "man"})");
  studio_->look_at_files();
  say(1, R"({"do": "preview", "step": {"set": "a"}})");
  studio_->look_at_files();
  studio_->look_at_files();  // the gesture goes on
  say(1, R"({"do": "cancel"})");
  studio_->look_at_files();
  studio_->look_at_files();
  studio_->page_closed(2);
  EXPECT_EQ(thumbnails_->heard, (std::vector<std::string>{"models", "at rest", "moved", "thumbnail", "at rest", "moved",
                                                          "moved", "moved", "at rest", "closed"}));
}

TEST_F(StudioTest, KeysAndCurvesAreToldToWhoAsked) {
  say(1, R"({"do": "channels", "things": ["*"]})");
  say(2, R"({"do": "curves", "thing": "tom", "parts": ["head"], "first": 0, "last": 9})");
  say(2, R"({"do": "actions"})");
  EXPECT_EQ(pages_.said(), "1 channels, 2 curves, 2 actions");
  say(1, R"({"do": "preview", "step": {"set": "a"}})");
  EXPECT_EQ(pages_.said(), "0 poses, 2 curves");
  say(1, R"({"do": "cancel"})");
  EXPECT_EQ(pages_.said(), "0 project, 2 curves");
  say(1, R"({"do": "frame", "frame": 3})");
  EXPECT_EQ(pages_.said(), "0 project");
  say(1, R"({"do": "commit", "step": {"set": "b"}})");
  EXPECT_EQ(pages_.said(), "0 project, 1 channels, 2 curves");
  say(1, R"({"do": "channels", "things": []})");
  say(2, R"({"do": "curves"})");
  say(1, R"({"do": "commit", "step": {"set": "c"}})");
  EXPECT_EQ(pages_.said(), "0 project");
  say(1, R"({"do": "channels", "things": ["tom"]})");
  studio_->page_closed(1);
  pages_.said();
  say(2, R"({"do": "commit", "step": {"set": "d"}})");
  EXPECT_EQ(pages_.said(), "0 project");
}

TEST_F(StudioTest, RemarksAreSaidToWhoseStepItWas) {
  project_->remarks = {"clamped"};
  say(2, R"({"do": "commit", "step": {"set": "a"}})");
  EXPECT_EQ(pages_.said(), "2 remark, 0 project");
  say(2, R"({"do": "script", "name": "a.script", "text": ""})");
  say(2, R"({"do": "scripts"})");
  EXPECT_EQ(pages_.said(), "2 script, 2 scripts");
}

TEST_F(StudioTest, ARefusalHasTheLineThatIsToBlame) {
  say(2, R"({"do": "commit", "step": {"set": "line"}})");
  ASSERT_EQ(pages_.heard.size(), 1u);
  EXPECT_EQ(pages_.heard[0].message["line"], 4);
}

// Whatever a page makes the studio throw is an answer to that page.
TEST_F(StudioTest, NoPageEndsTheStudio) {
  say(2, R"({"do": "commit", "step": {"set": "unshown"}})");
  EXPECT_EQ(pages_.said(), "2 refused");
  studio_->page_opened(3);
  EXPECT_EQ(pages_.said(), "3 remark");
  studio_->page_closed(2);
  project_->outside_change = true;
  studio_->look_at_files();
  EXPECT_EQ(pages_.said(), "0 remark");
  say(1, R"({"do": "undo"})");
  EXPECT_EQ(pages_.said(), "0 project");
}

TEST_F(StudioTest, RefusesWhatMakesNoSense) {
  for (const char* message :
       {R"({"do": "commit", "step": {"set": "bad"}})", R"({"do": "commit"})", R"({"do": "commit", "step": 3})",
        R"({"do": "preview", "step": {"set": [1]}})", R"({"do": "frame", "frame": -1})",
        R"({"do": "frame", "frame": 1e9})", R"({"do": "view", "width": "wide"})", R"({"do": "unheard"})",
        R"({"do": "channels"})", R"({"do": "channels", "things": [3]})", R"({"do": "curves", "parts": []})",
        R"({"do": "curves", "thing": "tom", "parts": [], "first": 9, "last": 3})",
        R"({"do": "curves", "thing": "tom", "parts": [], "first": 0, "last": 1e9})", R"({"do": "script"})"}) {
    say(2, message);
    ASSERT_EQ(pages_.heard.size(), 1u) << message;
    EXPECT_EQ(pages_.heard[0].page, 2u);
    EXPECT_EQ(pages_.heard[0].message["is"], "refused");
    EXPECT_EQ(pages_.heard[0].message["do"], Json::parse(message)["do"]);
    pages_.heard.clear();
  }
  EXPECT_EQ(stage_->changes, 0);
}

TEST_F(StudioTest, TellsThePageWhatTheSystemRefuses) {
  say(2, R"({"do": "commit", "step": {"set": "disk"}})");
  ASSERT_EQ(pages_.heard.size(), 1u);
  EXPECT_EQ(pages_.heard[0].message["is"], "refused");
  EXPECT_EQ(pages_.heard[0].message["text"], "No space left on device");
}

TEST_F(StudioTest, AGestureEndsWithItsPage) {
  say(1, R"({"do": "preview", "step": {"set": "a"}})");
  studio_->page_closed(2);
  EXPECT_TRUE(project_->in_gesture());
  pages_.said();
  studio_->page_closed(1);
  EXPECT_FALSE(project_->in_gesture());
  EXPECT_EQ(pages_.said(), "0 project");
  EXPECT_EQ(stage_->closed, (std::vector<PageNumber>{2, 1}));
}

TEST_F(StudioTest, OutsideChangesShowAtOnce) {
  studio_->look_at_files();
  EXPECT_EQ(pages_.said(), "");
  project_->outside_change = true;
  studio_->look_at_files();
  EXPECT_EQ(pages_.said(), "0 project");
  EXPECT_EQ(stage_->changes, 1);
}

}  // namespace
}  // namespace mars::studio
