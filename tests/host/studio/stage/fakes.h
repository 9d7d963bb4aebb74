// A project over a film in memory, without files, and a renderer that notes what it is asked for and can draw it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/studio/link/renderer_link.h"
#include "host/studio/project/project.h"
#include "host/studio/stage/stage.h"

namespace mars::studio {

class FakeProject : public Project {
 public:
  explicit FakeProject(animator::Film film, bool model = false)
      : saved_(std::move(film)), film_(saved_), model_(model) {}

  bool is_model() const override { return model_; }
  const animator::Film& film() const override { return film_; }
  bool rig_lights() const override { return rig_lights_; }
  bool has_keys(const std::string&, const std::string&) const override { return has_keys_; }
  std::uint64_t revision() const override { return revision_; }
  std::uint64_t shapes_revision() const override { return shapes_revision_; }
  std::optional<Pulled> pulled() const override { return pulled_; }
  std::uint32_t frame() const override { return frame_; }
  void set_frame(std::uint32_t frame) override { frame_ = frame; }
  void preview(const Json& step) override;
  void commit(const Json& step) override;
  void cancel() override;
  bool in_gesture() const override { return in_gesture_; }
  void undo() override {}
  void redo() override {}
  bool look_at_files() override { return false; }
  const std::optional<Problem>& problem() const override { return problem_; }
  Json describe() const override { return {}; }
  Json describe_poses() const override { return {}; }
  std::uint64_t keys_revision() const override { return revision_; }
  Json channels(const std::vector<std::string>&) override { return {}; }
  Json curves(const CurvesWanted&) override { return {}; }
  Json check_script(const std::string&, const std::string&) override { return {}; }
  Json scripts() const override { return {}; }

  // The film changes by itself, as by a command.
  void change(const std::function<void(animator::Film&)>& change, bool shapes = false);

  bool rig_lights_ = false, has_keys_ = true;
  std::vector<Json> previews, commits;
  int cancels = 0;

 private:
  void apply(const Json& step);
  void pose(animator::Actor& actor, const Json& effect);
  void move_camera(const Json& effect);
  void move_light(animator::LightMotion& light, const Json& effect);
  void change_model(const Json& effect);

  animator::Film saved_, film_;
  bool model_;
  std::uint64_t revision_ = 1, shapes_revision_ = 1;
  std::optional<Pulled> pulled_;
  std::uint32_t frame_ = 0;
  bool in_gesture_ = false;
  std::optional<Problem> problem_;
};

class FakeLink : public RendererLink {
 public:
  struct Asked {
    bool begins;
    std::uint32_t view, picture;
    std::vector<std::byte> scene;              // of a beginning
    std::vector<wire::MovedSegment> segments;  // of an inbetween
    std::vector<wire::MovedPatch> patches;
  };

  void set_film(std::shared_ptr<const std::vector<std::byte>> block) override { films.push_back(block); }
  void begin(std::uint32_t view, std::uint32_t picture, std::vector<std::byte> scene) override {
    asked.push_back({true, view, picture, std::move(scene), {}, {}});
  }
  void draw(std::uint32_t view, std::uint32_t picture, std::span<const wire::MovedSegment> segments,
            std::span<const wire::MovedPatch> patches) override {
    asked.push_back({false, view, picture, {}, {segments.begin(), segments.end()}, {patches.begin(), patches.end()}});
  }
  void close(std::uint32_t view) override { closed.push_back(view); }

  std::vector<std::shared_ptr<const std::vector<std::byte>>> films;
  std::vector<Asked> asked;
  std::vector<std::uint32_t> closed;
};

// The size of tests' views.
inline constexpr int kViewWidth = 640, kViewHeight = 480;

// A pixel as pages name it.
inline std::string xy(const glm::dvec2& pixel) {
  return "\"x\": " + std::to_string(pixel.x) + ", \"y\": " + std::to_string(pixel.y);
}

// A stage with one page, 1, that keeps what it gets.
struct OnStage {
  explicit OnStage(animator::Film film, bool model = false)
      : project(std::move(film), model),
        stage(make_stage(project, link,
                         {[this](ViewPicture picture) { pictures.push_back(std::move(picture)); },
                          [this](PageNumber page, const Json& message) { sent.emplace_back(page, message); }})) {}

  void take(const std::string& text) { stage->take(1, Json::parse(text)); }
  // Of this size, from "front", ..., as "surface", ...
  void view(int number, int width, int height, const std::string& from, const std::string& as,
            const std::string& more = "");
  // The renderer answers what it was asked last, with one black pixel.
  void answer();
  void answer(const FakeLink::Asked& asked, std::uint32_t width, std::uint32_t height);
  // The page has painted all that came.
  void paint();
  // The last message of this kind.
  Json last(const std::string& kind) const;
  // In pixels, as the last handles or picture say.
  std::vector<Json> shapes(const std::string& id) const;

  FakeProject project;
  FakeLink link;
  std::vector<ViewPicture> pictures;
  std::vector<std::pair<PageNumber, Json>> sent;
  std::unique_ptr<Stage> stage;
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> sizes;  // of views that are made in their order
};

animator::Film example(const std::string& name);
// As the studio shows a model: one actor, "model".
animator::Film model_film(const std::string& name);

}  // namespace mars::studio
