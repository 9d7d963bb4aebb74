#include "host/studio/stage/stage.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <list>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "hal/failure/failure.h"
#include "host/studio/stage/flow.h"
#include "host/studio/stage/framing.h"
#include "host/studio/stage/ghosts.h"
#include "host/studio/stage/hand_words.h"
#include "host/studio/stage/hands.h"
#include "host/studio/stage/marks.h"
#include "host/studio/stage/page_message.h"
#include "host/studio/stage/selection.h"
#include "host/studio/stage/view.h"
#include "host/studio/stage/view_message.h"

namespace mars::studio {
namespace {

constexpr const char* kOrbitKinds[] = {"turn", "pan", "zoom", "selected"};
constexpr std::string_view kProjectVerbs[] = {"preview", "commit", "cancel", "undo", "redo", "frame"};
constexpr double kMostEdit = 9e15;
constexpr double kMostFalloff = 1000;
constexpr double kMuchLarger = 1.3;  // less is what a pose does

Json json_of(const glm::dvec3& vector) { return Json::array({vector.x, vector.y, vector.z}); }

bool is_same(const Eye& one, const Eye& other) {
  const preview::Orbit &a = one.orbit, &b = other.orbit;
  return one.from == other.from && a.center == b.center && a.turn == b.turn && a.height == b.height &&
         a.distance == b.distance;
}

struct Page {
  std::uint64_t edit = 0;
  Named selected;
  std::set<Pin> pins{};
};

// A gesture under way.
struct Gesture {
  PageNumber page;
  std::uint32_t view;
  AnyHand hand;
  std::uint32_t falloff;   // frames to both sides into which a pose is blended
  std::uint64_t revision;  // of the project, as the hand left it
  std::optional<Json> step{};
};

class StageOfPages : public Stage {
 public:
  StageOfPages(Project& project, RendererLink& link, Listener listener)
      : project_(project),
        link_(link),
        listener_(std::move(listener)),
        moments_(project),
        ghosts_(project, moments_),
        flow_(project, link, moments_, views_, pages()) {}

  void take(PageNumber page, const Json& message) override {
    if (!message.is_object()) throw Failure("is no object", "the message", "see docs/studio-protocol.md");
    Page& from = pages_[page];
    if (message.contains("edit"))
      from.edit = std::max(from.edit, static_cast<std::uint64_t>(number_in(message, "edit", 0, kMostEdit)));
    moments_.renew();
    let_go_of_what_changed();
    const std::string what = word_in(message, "do");
    static const std::map<std::string, void (StageOfPages::*)(PageNumber, const Json&)> handlers = {
        {"view", &StageOfPages::view},     {"orbit", &StageOfPages::orbit},
        {"unview", &StageOfPages::unview}, {"painted", &StageOfPages::painted},
        {"hover", &StageOfPages::hover},   {"select", &StageOfPages::select},
        {"grab", &StageOfPages::grab},     {"drag", &StageOfPages::drag},
        {"drop", &StageOfPages::drop},     {"let_go", &StageOfPages::let_go},
        {"pin", &StageOfPages::pin},       {"put_camera", &StageOfPages::put_camera}};
    if (const auto handler = handlers.find(what); handler != handlers.end())
      (this->*handler->second)(page, message);
    else if (std::find(std::begin(kProjectVerbs), std::end(kProjectVerbs), what) == std::end(kProjectVerbs))
      throw Failure("is '" + what + "'", "the message's 'do'", "see docs/studio-protocol.md");
    flow_.serve();
  }

  void page_closed(PageNumber page) override {
    if (gesture_ && gesture_->page == page) end_gesture();
    for (PageView& view : views_)
      if (view.page == page) close(view);
    views_.remove_if([&](const PageView& view) { return view.page == page; });
    pages_.erase(page);
    flow_.serve();
  }

  void project_changed() override {
    let_go_of_what_changed();
    moments_.renew();
    if (project_.is_model() && !project_.in_gesture() && moments_.show_the_film())
      for (PageView& view : views_) frame_again(view);
    flow_.serve();
  }

  void take_surface(SurfacePicture picture) override { flow_.take(std::move(picture)); }
  void surface_dropped(std::uint32_t link, std::uint32_t picture) override { flow_.drop(link, picture); }

 private:
  // ---- messages

  void view(PageNumber page, const Json& message) {
    const ViewMessage request = read_view(message);
    const bool chosen = !request.orbit && request.from != From::camera;
    Eye eye{request.from, request.orbit.value_or(preview::Orbit{})};
    if (chosen) eye.orbit = chosen_orbit(eye.from, moments_.subject(), double(request.width) / request.height);
    PageView& view = view_or_new(page, request.number);
    view.framed = eye.from != From::camera && (chosen || (view.framed && is_same(eye, view.eye)));
    const bool other_size = view.width != request.width || view.height != request.height;
    if (other_size || view.look.as != request.look.as) restart(view, request.look.as);
    if (view.look.hidden != request.look.hidden || view.look.ground != request.look.ground) view.shown.reset();
    view.width = request.width;
    view.height = request.height;
    view.eye = eye;
    view.look = request.look;
    view.tool = request.tool;
    view.axes = request.axes;
    view.ghosts = request.ghosts;
    view.marks = request.marks;
    view.orbiting = false;
    if (chosen) send_orbit(view);
    send_handles(view);
  }

  void orbit(PageNumber page, const Json& message) {
    PageView& view = seen_view_in(page, message);
    const std::size_t how = choice_in(message, "how", kOrbitKinds);
    const glm::dvec2 by = how < 3 ? pair_in(message, "by") : glm::dvec2(0, 0);
    if (view.eye.from == From::camera)
      view.eye = {From::free, preview::orbit_near(flow_.camera_of(view), moments_.subject())};
    if (how == 0) turn(view.eye.orbit, by);
    if (how == 1) pan(view.eye.orbit, by, view.height);
    if (how == 2) zoom(view.eye.orbit, by, from_middle(message, view), view.height);
    if (how == 3)
      show_whole(view.eye.orbit, ball_of(project_, moments_, selected_by(page)), double(view.width) / view.height);
    view.framed = false;
    view.orbiting = flag_in(message, "moving", false);
    if (!view.orbiting) send_orbit(view);
  }

  // The film's camera goes where it sees, through its own lens, what a free view shows.
  void put_camera(PageNumber page, const Json& message) {
    const PageView& view = seen_view_in(page, message);
    if (view.eye.from != From::free) refuse("is no free view", "view", "turn it first");
    const wire::Camera& camera = moments_.now().cameras.front();
    const glm::dvec3 eye = preview::eye_of(view.eye.orbit, camera);
    std::vector<std::string> settings{"eye=" + shown_numbers(eye), "at=" + shown_numbers(view.eye.orbit.center)};
    if (camera.projection == wire::Projection::orthographic)
      settings.push_back("height=" + shown_number(preview::height_of(view.eye.orbit)));
    project_.commit(set_step(project_, "camera", settings));
  }

  // Of what the message names; of none: 0.
  static glm::dvec2 from_middle(const Json& message, const PageView& view) {
    if (!message.contains("x")) return {0, 0};
    return pixel_in(message) - glm::dvec2(view.width, view.height) / 2.0;
  }

  void unview(PageNumber page, const Json& message) {
    PageView& view = view_in(page, message);
    if (gesture_ && gesture_->page == page && gesture_->view == view.number) end_gesture();
    close(view);
    views_.remove_if([&](const PageView& each) { return &each == &view; });
  }

  void painted(PageNumber page, const Json& message) {
    PageView& view = view_in(page, message);
    const auto picture = static_cast<std::uint32_t>(number_in(message, "picture", 0, view.sent));
    view.painted = std::max(view.painted, picture);
  }

  void select(PageNumber page, const Json& message) {
    const auto name = [&](const char* key) -> std::optional<std::string> {
      if (!message.contains(key) || message[key].is_null()) return std::nullopt;
      return word_in(message, key);
    };
    Named named{name("actor"), name("joint"), name("thing"), words_in(message, "more")};
    if (named.thing && (named.actor || named.joint)) refuse("is beside an actor", "thing", "select one of them");
    if (project_.is_model() && named.joint) named.actor = project_.film().actors[0].name;
    const Selection found = selection_of(project_, named);
    if (named.actor && !found.actor) refuse("is no actor", "actor", "select one that there is");
    if (named.joint && !found.joint) refuse("is no joint", "joint", "select one that there is");
    if (found.more.size() != named.more.size())
      refuse("names what is no joint beside the selected one", "more", "name each joint once, beside another");
    if (named.thing && !found.mark)
      refuse("is '" + *named.thing + "'", "thing", "select camera, or a light that the film has: light/1");
    select(page, std::move(named));
  }

  void hover(PageNumber page, const Json& message) {
    PageView& view = seen_view_in(page, message);
    const glm::dvec2 pixel = pixel_in(message);
    const auto handles = handles_in(view);
    const Handle* const handle = handle_at(handles, pixel);
    const Selection under =
        handle != nullptr ? held_by(page, *handle) : pick(project_, moments_, screen_of(view), pixel).selection;
    Json answer = {{"is", "hovered"}, {"view", view.number}};
    put_names(project_, under, answer);
    answer["handle"] = handle != nullptr ? Json(handle->id) : Json(nullptr);
    answer["text"] = text_of(project_, under);
    listener_.tell(page, answer);
    const std::string hot = handle != nullptr ? handle->id : "";
    if (hot == view.hot) return;
    view.hot = hot;
    send_handles(view);
  }

  void grab(PageNumber page, const Json& message) {
    PageView& view = seen_view_in(page, message);
    if (gesture_ && gesture_->page != page)
      throw Failure("is being changed in another page", "the " + std::string(project_.is_model() ? "model" : "film"),
                    "wait until the hand there rests");
    if (gesture_) end_gesture();
    const glm::dvec2 pixel = pixel_in(message);
    const auto handles = handles_in(view);
    const Handle* const handle = handle_at(handles, pixel);
    const Selection taken = handle != nullptr ? take(view, *handle, pixel) : take_what_is_at(view, pixel);
    if (gesture_ && message.contains("falloff"))
      gesture_->falloff = static_cast<std::uint32_t>(number_in(message, "falloff", 0, kMostFalloff));
    Json answer = {{"is", "grabbed"}, {"view", view.number}};
    put_names(project_, taken, answer);
    answer["handle"] = handle != nullptr ? Json(handle->id) : Json(nullptr);
    listener_.tell(page, answer);
  }

  Selection take(const PageView& view, const Handle& handle, const glm::dvec2& pixel) {
    const Selection held = held_by(view.page, handle);
    if (held.mark) select(view.page, names_of(project_, held));
    begin(view, hand_on({project_, moments_, view.tool, view.axes, screen_of(view), pixel, pins_of(view.page, held)},
                        held, *handle.grip));
    return held;
  }

  // The joint that it picks is selected, or the one that can turn in its place, and follows the hand if it can.
  Selection take_what_is_at(const PageView& view, const glm::dvec2& pixel) {
    const Picked picked = pick(project_, moments_, screen_of(view), pixel);
    const Selection& held = picked.selection;
    if (!held.actor) return held;
    select(view.page, names_of(project_, clicked(project_, held)));
    if (!picked.hit) return held;
    auto hand = hand_on({project_, moments_, view.tool, view.axes, screen_of(view), pixel, pins_of(view.page, held)},
                        held, *picked.hit);
    if (hand) begin(view, std::move(*hand));
    return held;
  }

  void begin(const PageView& view, AnyHand hand) {
    gesture_.emplace(Gesture{view.page, view.number, std::move(hand), 0, project_.revision()});
  }

  void drag(PageNumber page, const Json& message) {
    if (!gesture_ || gesture_->page != page) return;
    auto step = followed(gesture_->hand, pixel_in(message), has_key(message, "shift"));
    if (step) step = blended(std::move(*step), gesture_->falloff);
    if (!step || step == gesture_->step) return;
    try {
      project_.preview(*step);
    } catch (...) {
      gesture_->revision = project_.revision();
      throw;
    }
    gesture_->revision = project_.revision();
    gesture_->step = step;
  }

  void drop(PageNumber page, const Json&) {
    if (!gesture_ || gesture_->page != page) return;
    const auto step = std::move(gesture_->step);
    gesture_.reset();
    if (step) project_.commit(*step);
  }

  void let_go(PageNumber page, const Json&) {
    if (gesture_ && gesture_->page == page) end_gesture();
  }

  void pin(PageNumber page, const Json& message) {
    const Pin pin{word_in(message, "actor"), word_in(message, "joint")};
    if (!selection_of(project_, {pin.actor, pin.joint}).joint) refuse("is no joint", "joint", "pin one that there is");
    std::set<Pin>& pins = pages_[page].pins;
    flag_in(message, "pinned", true) ? void(pins.insert(pin)) : void(pins.erase(pin));
    Json answer = {{"is", "pinned"}, {"pins", Json::array()}};
    for (const Pin& each : pins) answer["pins"].push_back({{"actor", each.actor}, {"joint", each.joint}});
    listener_.tell(page, answer);
    for (PageView& view : views_)
      if (view.page == page) send_handles(view);
  }

  // By another page, a command or a step: the hand's joints may be no more.
  void let_go_of_what_changed() {
    if (gesture_ && gesture_->revision != project_.revision()) gesture_.reset();
  }

  void end_gesture() {
    const bool moved = gesture_->step.has_value();
    gesture_.reset();
    if (moved) project_.cancel();
  }

  // ---- views

  PageView& view_in(PageNumber page, const Json& message) {
    PageView* const view = view_of(page, view_number_in(message));
    if (view == nullptr) refuse("is none that there is", "view", "make it first");
    return *view;
  }

  // Of a film that cannot be shown nothing is seen that a hand could take.
  PageView& seen_view_in(PageNumber page, const Json& message) {
    PageView& view = view_in(page, message);
    if (!moments_.show_the_film()) throw Failure(moments_.problem(), "", "");
    return view;
  }

  PageView* view_of(PageNumber page, std::uint32_t number) {
    const auto found = std::find_if(views_.begin(), views_.end(),
                                    [&](const PageView& view) { return view.page == page && view.number == number; });
    return found == views_.end() ? nullptr : &*found;
  }

  PageView& view_or_new(PageNumber page, std::uint32_t number) {
    if (PageView* const known = view_of(page, number)) return *known;
    std::uint32_t link = 0;
    while (flow_.view_of_link(link) != nullptr) ++link;
    if (link >= wire::kMostViews)
      throw Failure("cannot have more than " + std::to_string(wire::kMostViews) + " views", "the studio",
                    "close pages that nobody needs");
    return views_.emplace_back(PageView{page, number, link});
  }

  void close(PageView& view) {
    if (view.known) link_.close(view.link);
    view.known = false;
  }

  // A model that a step has made much larger or smaller is shown whole again, where nobody has moved the eye.
  void frame_again(PageView& view) {
    if (!view.framed) return;
    const preview::Orbit orbit = chosen_orbit(view.eye.from, moments_.subject(), double(view.width) / view.height);
    const double growth = orbit.distance / view.eye.orbit.distance;
    if (growth < kMuchLarger && growth > 1 / kMuchLarger) return;
    view.eye.orbit = orbit;
    send_orbit(view);
  }

  void restart(PageView& view, preview::As as) {
    if (as != preview::As::surface) close(view);
    view.forget();
  }

  Screen screen_of(const PageView& view) const { return {flow_.camera_of(view), view.width, view.height}; }

  Json controls(const PageView& view) { return described(handles_in(view), view.hot); }

  // Those below first.
  std::vector<Handle> handles_in(const PageView& view) {
    if (!moments_.show_the_film()) return {};
    const Selection selection = selected_by(view.page);
    const Screen screen = screen_of(view);
    std::vector<Handle> handles = ghosts_.handles(view.link, view.ghosts, selection, screen);
    const auto add = [&](std::vector<Handle> more) { std::ranges::move(more, std::back_inserter(handles)); };
    if (view.marks && view.eye.from != From::camera) add(marks_of(project_, moments_, selection, view.tool, screen));
    add(pin_handles(project_, selection, pins_of(view.page, selection), screen));
    add(handles_of(project_, selection, view.tool, view.axes, screen));
    return handles;
  }

  void send_handles(PageView& view) {
    if (view.asked) view.asked->handles = controls(view);  // its picture comes later, and must not bring older ones
    if (view.sent == 0) return;
    listener_.tell(view.page,
                   {{"is", "handles"}, {"view", view.number}, {"picture", view.sent}, {"shapes", controls(view)}});
  }

  void send_orbit(const PageView& view) {
    const preview::Orbit& orbit = view.eye.orbit;
    listener_.tell(view.page, {{"is", "orbit"},
                               {"view", view.number},
                               {"from", kFroms[static_cast<std::size_t>(view.eye.from)]},
                               {"center", json_of(orbit.center)},
                               {"turn", orbit.turn},
                               {"height", orbit.height},
                               {"distance", orbit.distance}});
  }

  Flow::Pages pages() {
    return {.edit_of = [this](PageNumber page) { return pages_[page].edit; },
            .hand =
                [this] {
                  return gesture_ ? std::optional(Flow::HandPlace{gesture_->page, gesture_->view}) : std::nullopt;
                },
            .controls = [this](const PageView& view) { return controls(view); },
            .send_handles = [this](PageView& view) { send_handles(view); },
            .send_to_all = [this](const Json& message) { listener_.tell(kAllPages, message); },
            .picture = listener_.picture};
  }

  // ---- selections

  Selection selected_by(PageNumber page) const {
    const auto found = pages_.find(page);
    return found == pages_.end() ? Selection{} : selection_of(project_, found->second.selected);
  }

  // What a hand has that takes the handle: a mark may be another than is selected.
  Selection held_by(PageNumber page, const Handle& handle) const {
    return handle.grip->mark ? Selection{.mark = handle.grip->mark} : selected_by(page);
  }

  // Of the selected actor.
  std::vector<std::size_t> pins_of(PageNumber page, const Selection& selection) const {
    std::vector<std::size_t> joints;
    const auto found = pages_.find(page);
    if (!selection.actor || found == pages_.end()) return joints;
    for (const Pin& pin : found->second.pins) {
      const Selection pinned = selection_of(project_, {pin.actor, pin.joint});
      if (pinned.actor == selection.actor && pinned.joint) joints.push_back(*pinned.joint);
    }
    return joints;
  }

  void select(PageNumber page, Named named) {
    if (pages_[page].selected == named) return;
    pages_[page].selected = std::move(named);
    Json message = {{"is", "selected"}};
    put_names(project_, selected_by(page), message);
    message["more"] = pages_[page].selected.more;
    listener_.tell(page, message);
    for (PageView& view : views_)
      if (view.page == page) send_handles(view);
  }

  Project& project_;
  RendererLink& link_;
  Listener listener_;
  Moments moments_;
  Ghosts ghosts_;
  std::map<PageNumber, Page> pages_;
  std::list<PageView> views_;
  std::optional<Gesture> gesture_;
  Flow flow_;
};

}  // namespace

std::unique_ptr<Stage> make_stage(Project& project, RendererLink& link, Stage::Listener listener) {
  return std::make_unique<StageOfPages>(project, link, std::move(listener));
}

}  // namespace mars::studio
