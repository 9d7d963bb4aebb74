#include "host/studio/studio.h"

#include <algorithm>
#include <array>
#include <utility>

#include "hal/failure/explain.h"
#include "host/content/document/text.h"

namespace mars::studio {
namespace {

std::uint32_t frame_in(const Json& message) {
  const Json& frame = message.at("frame");
  if (!frame.is_number_unsigned() || frame.get<std::uint64_t>() >= wire::kMostFrames)
    throw Failure(frame.dump() + " is no frame", "", "");
  return frame.get<std::uint32_t>();
}

// Of a file that it names, "visit.script:4: ..."; 0: none.
std::uint32_t line_in(const std::string& where) {
  const std::size_t begin = where.find(':') + 1,
                    end = std::min(where.find_first_not_of("0123456789", begin), where.size());
  if (begin == 0 || (end < where.size() && where[end] != ':')) return 0;
  return document::number_in<std::uint32_t>(where.substr(begin, end - begin)).value_or(0);
}

// What pages send by themselves, too.
bool is_of_a_hand_at_rest(const Json& message) {
  return message.at("do") == "painted" || Thumbnails::is_for_it(message);
}

struct Step {
  const char* name;
  void (*take)(Project&, const Json&);
};

constexpr std::array<Step, 6> kSteps{{
    {"preview", [](Project& project, const Json& message) { project.preview(message.at("step")); }},
    {"commit", [](Project& project, const Json& message) { project.commit(message.at("step")); }},
    {"cancel", [](Project& project, const Json&) { project.cancel(); }},
    {"undo", [](Project& project, const Json&) { project.undo(); }},
    {"redo", [](Project& project, const Json&) { project.redo(); }},
    {"frame", [](Project& project, const Json& message) { project.set_frame(frame_in(message)); }},
}};

}  // namespace

Studio::Studio(Parts parts, web::Pages& pages)
    : pages_(pages),
      project_(std::move(parts.project)),
      animation_(*project_, [this](PageNumber page, const Json& message) { pages_.tell(page, message); }) {
  link_ = parts.make_link(link_listener());
  stage_ = parts.make_stage(*project_, *link_,
                            {[this](ViewPicture picture) { pages_.show(std::move(picture)); },
                             [this](PageNumber page, const Json& message) { pages_.tell(page, message); }});
  rendering_ = parts.make_rendering({[this](ViewPicture picture) { pages_.show(std::move(picture)); },
                                     [this](PageNumber page, const Json& message) { pages_.tell(page, message); }});
  importing_ = parts.make_importing(
      *project_, {[this](PageNumber page, const Json& message) { pages_.tell(page, message); },
                  [this](PageNumber page, const Json& step, const std::vector<editing::Command>& before) {
                    commit_import(page, step, before);
                  }});
  thumbnails_ = parts.make_thumbnails({[this](PageNumber page, const Json& message) { pages_.tell(page, message); }});
}

RendererLink::Listener Studio::link_listener() {
  return {.picture =
              [this](SurfacePicture picture) {
                answer_failure(Stage::kAllPages, {}, [&] { stage_->take_surface(std::move(picture)); });
              },
          .dropped =
              [this](std::uint32_t view, std::uint32_t picture) {
                answer_failure(Stage::kAllPages, {}, [&] { stage_->surface_dropped(view, picture); });
              },
          .ready =
              [this](std::uint32_t nodes, std::uint32_t machines) {
                nodes_ = nodes;
                machines_ = machines;
                send_state(Stage::kAllPages);
              },
          .state =
              [this](const std::string& trouble) {
                trouble_ = trouble;
                send_state(Stage::kAllPages);
              }};
}

void Studio::send_state(PageNumber page) {
  pages_.tell(page, {{"is", "state"}, {"renderer", trouble_}, {"nodes", nodes_}, {"machines", machines_}});
}

void Studio::page_opened(PageNumber page) {
  answer_failure(page, {}, [&] {
    pages_.tell(page, project_->describe());
    send_state(page);
    rendering_->page_opened(page);
  });
}

void Studio::handle_message(PageNumber page, const Json& message) {
  const Shown before = shown();
  bool step_done = false;
  answer_failure(page, message, [&] { step_done = execute(page, message); });
  answer_failure(page, message, [&] {
    for (const std::string& remark : project_->take_remarks()) pages_.tell(page, {{"is", "remark"}, {"text", remark}});
    send_done(page, {});
    if (project_->in_gesture() && shown() != before) gesture_of_ = page;
    announce(before, step_done);
  });
}

// The commands of the last step, after those that made its files.
void Studio::send_done(PageNumber page, const std::vector<editing::Command>& before) {
  Json commands = before;
  for (const editing::Command& command : project_->take_commands()) commands.push_back(command);
  if (!commands.empty()) pages_.tell(page, {{"is", "done"}, {"commands", commands}});
}

void Studio::commit_import(PageNumber page, const Json& step, const std::vector<editing::Command>& before) {
  const Shown shown_before = shown();
  project_->commit(step);
  // What fails from here on leaves the step in the film.
  answer_failure(page, Json::object(), [&] {
    send_done(page, before);
    announce(shown_before, true);
  });
}

// Where every exception of the studio's work ends: what one page asks for must not end the others' session.
void Studio::answer_failure(PageNumber page, const Json& message, const std::function<void()>& work) {
  try {
    work();
  } catch (const Json::exception&) {
    refuse(page, message, {"something is missing in it, or is of another kind: see docs/studio-protocol.md", "", ""});
  } catch (const std::exception& failure) {  // of the file system, most likely
    refuse(page, message, explain(failure));
  }
}

// Whether the history may be another.
bool Studio::execute(PageNumber page, const Json& message) {
  if (!is_of_a_hand_at_rest(message)) at_rest_ = false;
  if (Rendering::is_for_it(message)) {
    rendering_->take(page, message);
    return false;
  }
  if (Importing::is_for_it(message)) {
    importing_->take(page, message);
    return false;
  }
  if (Thumbnails::is_for_it(message)) {
    thumbnails_->take(page, message);
    return false;
  }
  if (AnimationPages::is_for_it(message)) {
    animation_.take(page, message);
    return false;
  }
  const bool is_step = execute_step(message);
  stage_->take(page, message);
  return is_step && message["do"] != "preview";
}

// False: it is not for the project.
bool Studio::execute_step(const Json& message) {
  for (const Step& step : kSteps) {
    if (message["do"] != step.name) continue;
    step.take(*project_, message);
    return true;
  }
  return false;
}

void Studio::refuse(PageNumber page, const Json& message, const Failure& why) {
  if (message.is_null()) return pages_.tell(page, {{"is", "remark"}, {"text", why.what()}});
  Json refused{{"is", "refused"}, {"text", why.what()}, {"do", message["do"]}};
  if (const std::uint32_t line = line_in(why.where)) refused["line"] = line;
  pages_.tell(page, refused);
}

void Studio::page_closed(PageNumber page) {
  answer_failure(Stage::kAllPages, {}, [&] {
    const Shown before = shown();
    animation_.page_closed(page);
    rendering_->page_closed(page);
    importing_->page_closed(page);
    thumbnails_->page_closed(page);
    stage_->page_closed(page);
    if (gesture_of_ == page && project_->in_gesture()) project_->cancel();
    announce(before, false);
  });
}

void Studio::look_at_files() {
  answer_failure(Stage::kAllPages, {}, [&] {
    const Shown before = shown();
    announce(before, project_->look_at_files());
    thumbnails_->look(std::exchange(at_rest_, !project_->in_gesture()));
  });
}

Studio::Shown Studio::shown() const {
  const auto& problem = project_->problem();
  return {project_->revision(), project_->keys_revision(), project_->frame(), project_->in_gesture(),
          problem ? problem->text : ""};
}

// Gestures tell poses only; their end, and whatever else happens, tells all.
void Studio::announce(const Shown& before, bool step_done) {
  const Shown now = shown();
  if (!step_done && now == before) return;
  if (!now.in_gesture) gesture_of_.reset();
  pages_.tell(Stage::kAllPages, now.in_gesture && !step_done ? project_->describe_poses() : project_->describe());
  if (now.revision != before.revision || now.frame != before.frame) stage_->project_changed();
  announce_keys(before, now);
}

// The frame that is shown changes no key, but ends a gesture.
void Studio::announce_keys(const Shown& before, const Shown& now) {
  if (now.keys_revision != before.keys_revision)
    animation_.keys_changed();
  else if (now.revision != before.revision && (now.in_gesture || before.in_gesture))
    animation_.values_changed();
}

}  // namespace mars::studio
