// A rendering as a page sees it: what is put together of its rectangles is the frame's file.
#include "host/studio/rendering/rendering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "host/images/picture_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/sanitizers/sanitized.h"
#include "tests/temporary_folder.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kColors = 0x00ffffff;

struct Page {
  std::uint32_t width = 0, height = 0, pictures = 0;
  std::vector<std::uint32_t> pixels;
};

class RenderingTest : public testing::Test {
 protected:
  RenderingTest() {
    rendering_ =
        make_rendering(context_, {fs::path(MARS_SOURCE_DIR) / "examples/robot-arm.json", folder_.path(), MARS_PROGRAM},
                       {[this](ViewPicture picture) { take(std::move(picture)); },
                        [this](PageNumber, const Json& message) { messages_.push_back(message); }});
    rendering_->page_opened(1);
  }

  void take(ViewPicture picture) {
    EXPECT_EQ(picture.view, kRenderingView);
    EXPECT_TRUE(picture.exact);
    EXPECT_EQ(picture.picture, ++page_.pictures);
    if (page_.width != picture.width || page_.height != picture.height)
      page_ = {picture.width, picture.height, page_.pictures,
               std::vector<std::uint32_t>(std::size_t{picture.width} * picture.height)};
    EXPECT_EQ(pictures::pixels_in(picture.rects), picture.pixels.size());
    pictures::paste(picture.pixels, picture.rects, page_.width, page_.pixels);
    if (paints_) say({{"do", "painted"}, {"view", kRenderingView}, {"picture", picture.picture}});
  }

  void say(const Json& message) { rendering_->take(1, message); }

  void render(Json options) {
    options.update({{"folder", "out"}, {"backend", "threads"}, {"size", "160x90"}});
    say({{"do", "render"}, {"options", options}});
  }

  template <typename Holds>
  bool run_until(Holds holds) {
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(200) * sanitizers::kSlowness;
    while (!holds() && std::chrono::steady_clock::now() < last) context_.run_one_for(std::chrono::milliseconds(20));
    return holds();
  }

  Json last(const std::string& is) const {
    const auto found = std::find_if(messages_.rbegin(), messages_.rend(), [&](const Json& m) { return m["is"] == is; });
    return found == messages_.rend() ? Json::object() : *found;
  }
  bool is(const char* state) const { return last("rendering").value("state", "") == state; }

  // The page shows this now.
  void expect_shows(std::uint32_t frame) {
    const std::string number = std::to_string(frame);
    const auto file = folder_ / ("out/frame-" + std::string(4 - number.size(), '0') + number + ".png");
    const images::Image image = images::read_picture(images::PictureFormat::png, file);
    ASSERT_EQ(image.pixels.size(), page_.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      ASSERT_EQ(image.pixels[i] & kColors, page_.pixels[i] & kColors) << "frame " << frame << ", pixel " << i;
  }

  boost::asio::io_context context_;
  // Without it, a context that waits for another thread's work alone would stop for good.
  const boost::asio::executor_work_guard<boost::asio::io_context::executor_type> kept_{context_.get_executor()};
  const test::TemporaryFolder folder_;
  std::vector<Json> messages_;
  Page page_;
  bool paints_ = true;
  std::unique_ptr<Rendering> rendering_;
};

TEST_F(RenderingTest, ShowsFramesAsTheyAreDrawn) {
  EXPECT_TRUE(is("none"));
  render({{"frames", "0-9"}, {"nodes", 2}});
  ASSERT_TRUE(run_until([&] { return is("done"); })) << last("rendering");
  ASSERT_TRUE(run_until([&] {
    return last("drawn").value("whole", false) && last("rendering")["there"] == Json{{0, 9}};
  })) << last("rendering");
  const Json drawn = last("drawn");
  expect_shows(drawn["frame"]);
  EXPECT_EQ(last("rendering")["done"], 10);
  EXPECT_EQ(last("rendering")["of"], 10);
  EXPECT_EQ(last("rendering")["nodes"].size(), 2u);
  EXPECT_EQ(drawn["ebc"].size(), 90u);
  int lines = 0;
  for (const Json& node : drawn["nodes"]) {
    EXPECT_GT(node["seconds"]["raster"], 0);
    for (const Json& range : node["lines"]) lines += range[1].get<int>() - range[0].get<int>() + 1;
  }
  EXPECT_EQ(lines, 90);

  say({{"do", "scrub"}, {"frame", 3}});
  const std::uint32_t before = page_.pictures;
  ASSERT_TRUE(run_until([&] { return page_.pictures > before; }));
  expect_shows(3);
  say({{"do", "scrub"}, {"frame", nullptr}});
  expect_shows(drawn["frame"]);
  say({{"do", "scrub"}, {"frame", 77}});
  ASSERT_TRUE(run_until([&] { return !last("remark").empty(); }));
  EXPECT_NE(last("remark")["text"].get<std::string>().find("frame 77 is not there"), std::string::npos);
}

TEST_F(RenderingTest, APageThatPaintsNothingGetsTwoPicturesAndThenTheNewest) {
  paints_ = false;
  render({{"nodes", 1}, {"samples", 16}});
  ASSERT_TRUE(run_until([&] { return is("done") && page_.pictures >= 2; })) << last("rendering");
  EXPECT_EQ(page_.pictures, 2u);
  paints_ = true;
  say({{"do", "painted"}, {"view", kRenderingView}, {"picture", 2}});
  ASSERT_TRUE(run_until([&] { return last("drawn").value("whole", false); }));
  expect_shows(last("drawn")["frame"]);
  EXPECT_THROW(say({{"do", "painted"}, {"view", kRenderingView}, {"picture", 1000}}), Failure);
}

TEST_F(RenderingTest, IsStoppedAndGoesOn) {
  render({{"nodes", 1}, {"samples", 16}});
  ASSERT_TRUE(run_until([&] { return !last("drawn").empty(); }));
  EXPECT_THROW(render({}), Failure) << "one at a time";
  say({{"do", "stop"}});
  ASSERT_TRUE(run_until([&] { return is("stopped"); })) << last("rendering");
  render({{"nodes", 1}, {"samples", 16}});
  ASSERT_TRUE(run_until([&] { return is("running"); })) << last("rendering");
  const Json now = last("rendering");
  EXPECT_GE(now["of"], now["done"]);
}

TEST_F(RenderingTest, SaysWhyItFails) {
  render({{"frames", "7000"}});
  ASSERT_TRUE(run_until([&] { return is("failed"); }));
  EXPECT_NE(last("rendering")["text"].get<std::string>().find("beyond the film's last"), std::string::npos);
}

TEST_F(RenderingTest, WatchesAFolderThatIsComplete) {
  render({{"frames", "0-4"}});
  ASSERT_TRUE(run_until([&] { return is("done"); }));
  const std::uint32_t before = page_.pictures;
  say({{"do", "watch"}, {"folder", "out"}});
  ASSERT_TRUE(run_until([&] { return is("done") && page_.pictures > before; })) << last("rendering");
  EXPECT_EQ(last("rendering")["there"], Json({{0, 4}}));
  render({{"frames", "5-6"}});
  EXPECT_TRUE(is("starting"));
  EXPECT_EQ(last("rendering")["done"], 0) << "of this rendering, not of what was watched";
}

TEST_F(RenderingTest, RefusesOptionsThatItDoesNotHave) {
  const auto failure_with = [&](const Json& options) {
    return document::failure_of([&] { say({{"do", "render"}, {"options", options}}); });
  };
  for (const char* name : {"overwrite", "Nodes", "--nodes"})
    EXPECT_TRUE(document::holds(failure_with({{name, 1}}), "is no option of renderings by pages")) << name;
  EXPECT_TRUE(document::holds(failure_with({{"alpha", "yes"}}), "'alpha': is neither true nor false"));
  EXPECT_TRUE(document::holds(failure_with({{"samples", 1.5}}), "samples is no text"));
  EXPECT_TRUE(document::holds(failure_with(Json::array({"nodes"})), "a rendering's options are an object"));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(RenderingTest, TouchesNothingOutsideOfItsFolder) {
  for (const char* folder : {"/tmp", "..", "../other", "", "."})
    for (const char* what : {"render", "watch"}) {
      const Json message{{"do", what}, {"folder", folder}, {"options", {{"folder", folder}}}};
      EXPECT_THROW(say(message), Failure) << folder;
    }
  fs::create_symlink("/tmp", folder_ / "link");
  EXPECT_THROW(say({{"do", "watch"}, {"folder", "link/out"}}), Failure);
  EXPECT_THROW(render({{"hostfile", "/etc/hosts"}}), Failure);
}

}  // namespace
}  // namespace mars::studio
