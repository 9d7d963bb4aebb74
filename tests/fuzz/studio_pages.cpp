#include "tests/fuzz/studio_pages.h"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <cmath>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/studio/rendering/render_words.h"
#include "host/studio/studio.h"
#include "host/studio/web/page_message.h"
#include "host/studio/web/page_outbox.h"
#include "node/wire/scene.h"
#include "tests/fuzz/scratch.h"

namespace mars::fuzz {
namespace {

namespace fs = std::filesystem;
using studio::PageNumber;
using studio::ViewPicture;

constexpr std::size_t kMostMessages = 3;  // of a script
constexpr PageNumber kPages = 2;

constexpr const char* kModel = R"({"limbs": {"left": {"hip": "left-leg"}}, "joints": [
  {"name": "hip", "place": [0, 0, 1], "segment": {"shape": "box", "material": "shirt"}},
  {"name": "head", "parent": "hip", "place": [0, 0, 1], "segment": {"shape": "cloth"}},
  {"name": "left-leg", "parent": "hip", "place": [0, 0.5, 0], "limits": {"x": [-10, 30]}, "segment": {"shape": "cone"}}],
  "shapes": {"cloth": {"bspline": {"points": [[[0, 0, 0], [1, 0, 0]], [[0, 0, 1], [1, 0, 1]]],
                                   "u": {"degree": 1}, "v": {"degree": 1}}}},
  "materials": {"shirt": {"color": [1, 0, 0]}}})";
constexpr const char* kFilm = R"({"frames": 9, "size": [64, 48], "camera": {"eye": [9, 0, 2], "at": [0, 0, 1]},
  "lights": [{"direction": [1, 0, 1]}, {"place": [1, 2, 3], "at": [0, 0, 0], "cone": [10, 30], "reach": 4}],
  "models": {"pip": "pip.json"}, "actors": [{"name": "pip", "model": "pip", "keys": [{"frame": 4, "place": [1, 0, 0]}]}]})";

Messages joined(Messages messages, const Messages& more) {
  messages.insert(messages.end(), more.begin(), more.end());
  return messages;
}

}  // namespace

// What a serving host would do with what it is asked: nodes check it, and draw one pixel.
class CheckingLink final : public studio::RendererLink {
 public:
  explicit CheckingLink(Listener listener) : listener_(std::move(listener)) {}

  void set_film(std::shared_ptr<const std::vector<std::byte>> block) override {
    block_ = std::move(block);
    expect_sound([&] { film_.emplace(*block_, "the film"); });
  }
  void begin(std::uint32_t view, std::uint32_t picture, std::vector<std::byte> scene) override {
    expect_sound([&] {
      const wire::PackedFilm checked(scene, film_.value(), "the scene");
      sizes_[view] = {checked.settings().width, checked.settings().height};
    });
    due_.emplace_back(view, picture);
  }
  void draw(std::uint32_t view, std::uint32_t picture, std::span<const wire::MovedSegment> segments,
            std::span<const wire::MovedPatch>) override {
    for (const wire::MovedSegment& each : segments)
      for (const auto& row : each.matrix.m)
        check(std::ranges::all_of(row, [](double number) { return std::isfinite(number); }), "matrices are finite");
    due_.emplace_back(view, picture);
  }
  void close(std::uint32_t) override {}

  // All but every fifth, which is dropped.
  bool answer() {
    if (due_.empty()) return false;
    const auto [view, picture] = due_.front();
    due_.pop_front();
    if (picture % 5 == 0) {
      listener_.dropped(view, picture);
      return true;
    }
    studio::SurfacePicture drawn;
    drawn.view = view;
    drawn.picture = picture;
    drawn.head.width = sizes_[view].first;
    drawn.head.height = sizes_[view].second;
    drawn.head.rects = 1;
    drawn.rects = {{0, 0, 1, 1}};
    drawn.pixels = {0xff000000u};
    listener_.picture(std::move(drawn));
    return true;
  }

 private:
  // No page may make the studio ask for what ends the nodes.
  template <typename Work>
  static void expect_sound(Work work) {
    try {
      work();
    } catch (const Failure& failure) {
      throw BrokenRule(std::string("nodes would refuse: ") + failure.what());
    }
  }

  Listener listener_;
  std::shared_ptr<const std::vector<std::byte>> block_;
  std::optional<wire::PackedFilm> film_;
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> sizes_;
  std::deque<std::pair<std::uint32_t, std::uint32_t>> due_;
};

// A rendering that starts no process, and no thread before a page asks for one.
class WordsOnly final : public studio::Rendering {
 public:
  WordsOnly(boost::asio::io_context& context, studio::RenderingSettings settings, Listener listener)
      : context_(context), settings_(std::move(settings)), listener_(std::move(listener)) {}

  void take(PageNumber page, const Json& message) override {
    if (message.at("do") == "render") {
      studio::render_words(settings_, message.value("options", Json::object()), "socket");
      return;
    }
    if (!rendering_) rendering_ = studio::make_rendering(context_, settings_, listener_);
    rendering_->take(page, message);
  }
  void page_opened(PageNumber) override {}
  void page_closed(PageNumber page) override {
    if (rendering_) rendering_->page_closed(page);
  }

 private:
  boost::asio::io_context& context_;
  studio::RenderingSettings settings_;
  Listener listener_;
  std::unique_ptr<studio::Rendering> rendering_;
};

// Outboxes whose network is fast.
class Outboxes final : public web::Pages {
 public:
  void tell(PageNumber number, const Json& message) override {
    if (const auto is = message.find("is"); is != message.end() && *is == "refused") note_refusal(message);
    for (auto& [each, box] : boxes_)
      if (each == number || number == studio::Stage::kAllPages) box.tell(message);
  }
  void show(ViewPicture picture) override {
    const auto box = boxes_.find(picture.page);
    if (box == boxes_.end()) return;
    unpainted_.push_back({picture.page, {{"do", "painted"}, {"view", picture.view}, {"picture", picture.picture}}});
    box->second.show(std::move(picture), web::PageOutbox::Time());
  }

  void close(PageNumber page) { boxes_.erase(page); }
  bool hear(PageNumber page, const Json& message) { return boxes_[page].hear(message, web::PageOutbox::Time()); }

  // What pages say when all has arrived.
  std::vector<std::pair<PageNumber, Json>> deliver() {
    for (auto& [page, box] : boxes_)
      while (box.next(web::PageOutbox::Time())) {
      }
    return std::exchange(unpainted_, {});
  }

  std::string take_refusal() { return std::exchange(refusal_, ""); }

 private:
  // What MARS did not expect is no answer, though the studio survives it.
  void note_refusal(const Json& message) {
    refusal_ = message.at("text").get<std::string>();
    check(!refusal_.starts_with("MARS did not expect") && refusal_.find(".cpp:") == std::string::npos,
          refusal_.c_str());
  }

  std::map<PageNumber, web::PageOutbox> boxes_;
  std::vector<std::pair<PageNumber, Json>> unpainted_;
  std::string refusal_;
};

class StudioPages::Open {
 public:
  explicit Open(const fs::path& file) {
    const auto make_link = [this](studio::RendererLink::Listener listener) {
      auto link = std::make_unique<CheckingLink>(std::move(listener));
      link_ = link.get();
      return link;
    };
    const auto make_rendering = [&](studio::Rendering::Listener listener) {
      const studio::RenderingSettings settings{file, file.parent_path(), "/none/mars"};
      return std::make_unique<WordsOnly>(context_, settings, std::move(listener));
    };
    const auto make_importing = [&](const studio::Project& project, studio::Importing::Listener listener) {
      return studio::make_importing(context_, {file, "/none/mars"}, project, std::move(listener));
    };
    const auto make_thumbnails = [&](studio::Thumbnails::Listener listener) {
      return studio::make_thumbnails(context_, {file, "/none/mars", file.parent_path()}, std::move(listener));
    };
    auto project = studio::open_project(file);
    project_ = project.get();
    studio_.emplace(studio::Parts{std::move(project), make_link, studio::make_stage, make_rendering, make_importing,
                                  make_thumbnails},
                    pages_);
    keys_ = project_->keys_revision();
    poses_ = project_->describe_poses();
  }

  void close_pages() {
    for (PageNumber page = 1; page <= kPages; ++page) {
      pages_.close(page);
      studio_->page_closed(page);
    }
    project_->cancel();
    project_->set_frame(0);
    project_->take_remarks();
    context_.restart();
    context_.poll();
  }

  void send(PageNumber page, const Json& message) {
    hear(page, web::read_page_message(text_of(message)));
    for (bool more = true; more;) {
      more = link_->answer();
      for (const auto& [number, painted] : pages_.deliver()) {
        hear(number, painted);
        more = true;
      }
    }
  }

  std::string take_refusal() { return pages_.take_refusal(); }

  // But for what pages have seen, all is as it began.
  bool is_as_begun() {
    return project_->keys_revision() == keys_ && (!project_->is_model() || project_->describe_poses() == poses_);
  }

 private:
  void hear(PageNumber page, const Json& message) {
    if (pages_.hear(page, message)) studio_->handle_message(page, message);
  }

  boost::asio::io_context context_;
  Outboxes pages_;
  studio::Project* project_ = nullptr;
  CheckingLink* link_ = nullptr;
  std::optional<studio::Studio> studio_;
  std::uint64_t keys_ = 0;
  Json poses_;
};

StudioPages::StudioPages(OpenFile file, const Messages& sound, const Messages& others)
    : file_(std::move(file)), messages_(joined(sound, others)), sound_(sound.size()), edits_(messages_) {}

StudioPages::~StudioPages() = default;

void StudioPages::reopen() {
  open_.reset();
  const fs::path folder = scratch().path("open");
  fs::remove_all(folder);
  fs::create_directory(folder);
  fs::current_path(folder);  // as the studio is started
  for (const auto& [name, text] : file_.files) scratch().file("open/" + name, text);
  open_ = std::make_unique<Open>(folder / file_.name);
}

void StudioPages::send_all_sound() {
  for (std::size_t i = 0; i < sound_; ++i) {
    open_->send(1, messages_[i]);
    const std::string refusal = open_->take_refusal();
    check(refusal.empty(), (text_of(messages_[i]) + ": " + refusal).c_str());
  }
}

Json StudioPages::next_of(Script& script) const {
  Json message = messages_[script.below(messages_.size())];
  for (std::size_t changes = script.below(4); changes > 0; --changes) edits_.edit(message, script);
  return message;
}

void StudioPages::take(std::string_view text) {
  if (!open_ || !open_->is_as_begun()) reopen();
  Script script(text);
  if (script.at_end()) send_all_sound();
  Failure refused("", "", "");
  for (std::size_t i = 0; i < kMostMessages && !script.at_end(); ++i) {
    const PageNumber page = script.below(8) < 7 ? 1 : 2;
    try {
      open_->send(page, next_of(script));
    } catch (const Failure& failure) {  // it is no message
      refused = failure;
    }
  }
  open_->close_pages();
  if (const std::string refusal = open_->take_refusal(); !refusal.empty()) throw Failure(refusal, "", "");
  if (!refused.problem.empty()) throw refused;
}

Messages messages_of(std::string_view lines) {
  Messages messages;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    if (end > 0) messages.push_back(Json::parse(lines.substr(0, end)));
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return messages;
}

OpenFile figure_film() {
  const fs::path film = MARS_FUZZ_FILM;
  return {"film.json",
          {{"film.json", document::read_file(film, 1 << 20)},
           {"figure.json", document::read_file(film.parent_path() / "figure.json", 1 << 20)},
           {"play.script", "at 0 tom spin degrees 90 until 5\n"}}};
}

OpenFile small_film() { return {"film.json", {{"film.json", kFilm}, {"pip.json", kModel}}}; }

OpenFile small_model() { return {"pip.json", {{"pip.json", kModel}}}; }

}  // namespace mars::fuzz
