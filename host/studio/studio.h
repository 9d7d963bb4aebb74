// The studio: one project, seen and worked on by pages. Pages' messages become steps of the project, work of the
// stage and of a rendering; all pages receive what changes. It has no thread: whoever runs it calls it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/studio/animation_pages.h"
#include "host/studio/importing/importing.h"
#include "host/studio/models/thumbnails.h"
#include "host/studio/rendering/rendering.h"
#include "host/studio/web/pages.h"

namespace mars::studio {

// What the studio is made of; tests give others.
struct Parts {
  std::unique_ptr<Project> project;
  std::function<std::unique_ptr<RendererLink>(RendererLink::Listener)> make_link;
  std::function<std::unique_ptr<Stage>(Project&, RendererLink&, Stage::Listener)> make_stage;
  std::function<std::unique_ptr<Rendering>(Rendering::Listener)> make_rendering;
  std::function<std::unique_ptr<Importing>(const Project&, Importing::Listener)> make_importing;
  std::function<std::unique_ptr<Thumbnails>(Thumbnails::Listener)> make_thumbnails;
};

class Studio {
 public:
  // `pages` must outlive it.
  Studio(Parts parts, web::Pages& pages);

  // Only upload() throws. A message that fails or makes no sense is answered with `refused`; what fails otherwise is a
  // remark to the page, or to all.
  void page_opened(PageNumber page);
  void handle_message(PageNumber page, const Json& message);
  void page_closed(PageNumber page);
  // A file that a page begins to send. Throws Failure where no import waits for it.
  std::unique_ptr<Upload> upload(const UploadedFile& file) { return importing_->upload(file); }
  // Somebody else may have changed the files; and there may be time for thumbnails. Called a few times a second.
  void look_at_files();

 private:
  // What pages receive when it changes.
  struct Shown {
    std::uint64_t revision, keys_revision;
    std::uint32_t frame;
    bool in_gesture;
    std::string problem;

    bool operator==(const Shown&) const = default;
  };

  Shown shown() const;
  bool execute(PageNumber page, const Json& message);
  bool execute_step(const Json& message);
  void announce(const Shown& before, bool step_done);
  void announce_keys(const Shown& before, const Shown& now);
  void answer_failure(PageNumber page, const Json& message, const std::function<void()>& work);
  void refuse(PageNumber page, const Json& message, const Failure& why);
  RendererLink::Listener link_listener();
  void send_state(PageNumber page);
  void send_done(PageNumber page, const std::vector<editing::Command>& before);
  void commit_import(PageNumber page, const Json& step, const std::vector<editing::Command>& before);

  web::Pages& pages_;
  std::unique_ptr<Project> project_;
  std::unique_ptr<RendererLink> link_;
  std::unique_ptr<Stage> stage_;
  std::unique_ptr<Rendering> rendering_;
  std::unique_ptr<Importing> importing_;
  std::unique_ptr<Thumbnails> thumbnails_;
  AnimationPages animation_;
  std::optional<PageNumber> gesture_of_;
  bool at_rest_ = true;  // no page has moved anything since the last look
  std::string trouble_;  // the renderer's
  std::uint32_t nodes_ = 0, machines_ = 0;
};

}  // namespace mars::studio
