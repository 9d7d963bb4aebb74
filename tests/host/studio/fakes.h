// A project, a stage and a renderer's link that do as little as the studio can do with.
#pragma once

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "host/studio/studio.h"

namespace mars::test {

using studio::Json;
using studio::PageNumber;

// Steps are {"set": TEXT}; "bad" makes no sense, "line" has a wrong line, "disk" cannot be written, "unshown" not be
// described, "long" says on standard output that it begins, and takes a minute.
class FakeProject : public studio::Project {
 public:
  bool is_model() const override { return true; }
  const animator::Film& film() const override { return film_; }
  bool rig_lights() const override { return true; }
  bool has_keys(const std::string&, const std::string&) const override { return false; }
  std::uint64_t revision() const override { return revision_; }
  std::uint64_t shapes_revision() const override { return 1; }
  std::optional<Pulled> pulled() const override { return {}; }
  std::uint32_t frame() const override { return frame_; }
  void set_frame(std::uint32_t frame) override { frame_ = frame; }

  void preview(const Json& step) override {
    show(step);
    in_gesture_ = true;
  }
  void commit(const Json& step) override {
    show(step);
    in_gesture_ = false;
    written.push_back(shown_);
  }
  void cancel() override {
    in_gesture_ = false;
    shown_ = "cancelled";
    ++revision_;
  }
  bool in_gesture() const override { return in_gesture_; }
  void undo() override { show({{"set", "undone"}}); }
  void redo() override { show({{"set", "redone"}}); }

  bool look_at_files() override {
    const bool changed = std::exchange(outside_change, false);
    if (changed) ++revision_;
    return changed;
  }
  const std::optional<studio::Problem>& problem() const override { return problem_; }
  Json describe() const override {
    if (shown_ == "unshown") throw std::length_error("nobody expected it");
    return {{"is", "project"}, {"shown", shown_}, {"frame", frame_}};
  }
  Json describe_poses() const override { return {{"is", "poses"}, {"shown", shown_}}; }

  std::uint64_t keys_revision() const override { return written.size(); }
  Json channels(const std::vector<std::string>& things) override { return {{"is", "channels"}, {"things", things}}; }
  Json curves(const studio::CurvesWanted& wanted) override { return {{"is", "curves"}, {"thing", wanted.thing}}; }
  Json check_script(const std::string& name, const std::string&) override { return {{"is", "script"}, {"name", name}}; }
  Json scripts() const override { return {{"is", "scripts"}}; }

  std::vector<std::string> take_remarks() override { return std::exchange(remarks, {}); }

  std::vector<std::string> remarks;
  bool outside_change = false;
  std::vector<std::string> written;

 private:
  void show(const Json& step) {
    const std::string text = step.at("set").get<std::string>();
    if (text == "bad") throw Failure("the step makes no sense", "joint 'arm'", "");
    if (text == "line") throw Failure("is no action", "play.script:4: walk", "");
    if (text == "disk") throw std::system_error(std::make_error_code(std::errc::no_space_on_device));
    if (text == "long") {
      std::cout << "a long step begins\n" << std::flush;
      std::this_thread::sleep_for(std::chrono::minutes(1));
    }
    shown_ = text;
    ++revision_;
  }

  animator::Film film_;
  std::uint64_t revision_ = 1;
  std::uint32_t frame_ = 0;
  bool in_gesture_ = false;
  std::string shown_ = "nothing";
  std::optional<studio::Problem> problem_;
};

class FakeLink final : public studio::RendererLink {
 public:
  void set_film(std::shared_ptr<const std::vector<std::byte>>) override {}
  void begin(std::uint32_t, std::uint32_t, std::vector<std::byte>) override {}
  void draw(std::uint32_t, std::uint32_t, std::span<const wire::MovedSegment>,
            std::span<const wire::MovedPatch>) override {}
  void close(std::uint32_t) override {}
};

// A view shows a picture when it is made ("view") and whenever its eye moves ("orbit"): a pattern that its number
// changes. Answers "painted" with a remark.
class FakeStage final : public studio::Stage {
 public:
  explicit FakeStage(Listener listener) : listener_(std::move(listener)) {}

  void take(PageNumber page, const Json& message) override {
    const std::string what = message.at("do");
    if (message.contains("step") || what == "undo" || what == "redo" || what == "frame" || what == "cancel") {
      last_edit = message.value("edit", std::uint64_t{0});
    } else if (what == "view") {
      width_ = message.at("width");
      height_ = message.at("height");
      show(page, message, true);
    } else if (what == "orbit") {
      show(page, message, !message.value("moving", false));
    } else if (what == "painted") {
      listener_.tell(page, {{"is", "remark"}, {"text", "painted " + message.at("picture").dump()}});
    } else if (what != "unview") {
      throw Failure("'" + what + "' is unknown", "", "");
    }
  }
  void page_closed(PageNumber page) override { closed.push_back(page); }
  void project_changed() override { ++changes; }
  void take_surface(studio::SurfacePicture) override {}
  void surface_dropped(std::uint32_t, std::uint32_t) override {}

  std::vector<PageNumber> closed;
  std::uint64_t last_edit = 0;
  int changes = 0;

  static std::uint32_t pixel(std::uint32_t x, std::uint32_t y, std::uint32_t picture) {
    return 0xff000000u | ((x / 8 + picture) & 255) | ((y / 8) & 255) << 8 | 40 << 16;
  }

 private:
  void show(PageNumber page, const Json& message, bool rests) {
    studio::ViewPicture picture;
    picture.page = page;
    picture.view = message.at("view");
    picture.picture = ++pictures_;
    picture.edit = message.value("edit", std::uint64_t{0});
    picture.width = width_;
    picture.height = height_;
    picture.rests = rests;
    picture.rects = {{0, 0, width_, height_}};
    for (std::uint32_t y = 0; y < height_; ++y)
      for (std::uint32_t x = 0; x < width_; ++x) picture.pixels.push_back(pixel(x, y, picture.picture));
    picture.handles = Json::array({{{"id", 1}, {"kind", "point"}}});
    listener_.picture(std::move(picture));
  }

  Listener listener_;
  std::uint16_t width_ = 0, height_ = 0;
  std::uint32_t pictures_ = 0;
};

// Takes no file.
class FakeImporting final : public studio::Importing {
 public:
  explicit FakeImporting(Listener listener) : listener_(std::move(listener)) {}

  void take(PageNumber page, const Json& message) override {
    heard.push_back(message.at("do"));
    if (message.contains("step")) listener_.commit(page, message.at("step"), {{"import", "rock.obj"}});
  }
  std::unique_ptr<studio::Upload> upload(const studio::UploadedFile&) override {
    throw Failure("no import waits for this file", "", "");
  }
  void page_closed(PageNumber) override { heard.push_back("closed"); }

  std::vector<std::string> heard;

 private:
  Listener listener_;
};

// Notes what it hears, and when it may work.
class FakeThumbnails final : public studio::Thumbnails {
 public:
  void take(PageNumber, const Json& message) override { heard.push_back(message.at("do")); }
  void page_closed(PageNumber) override { heard.push_back("closed"); }
  void look(bool at_rest) override { heard.push_back(at_rest ? "at rest" : "moved"); }

  std::vector<std::string> heard;
};

class FakeRendering final : public studio::Rendering {
 public:
  void take(PageNumber, const Json& message) override { heard.push_back(message.at("do")); }
  void page_opened(PageNumber) override { heard.push_back("opened"); }
  void page_closed(PageNumber) override { heard.push_back("closed"); }

  std::vector<std::string> heard;
};

}  // namespace mars::test
