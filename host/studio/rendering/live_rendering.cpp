#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/render/compositor/rectangles.h"
#include "host/studio/link/host_connection.h"
#include "host/studio/link/host_process.h"
#include "host/studio/rendering/drawn_picture.h"
#include "host/studio/rendering/finished_frames.h"
#include "host/studio/rendering/rendering_page.h"
#include "host/studio/rendering/render_words.h"
#include "host/studio/rendering/rendering.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
using Error = boost::system::error_code;
using namespace std::chrono_literals;

constexpr auto kTick = 250ms;   // between two words about how far it is
constexpr int kTicksALook = 4;  // at the folder

// A job of mars render, with what is known of it. What its host said last may come after its end.
struct Job {
  std::unique_ptr<HostConnection> connection;
  std::unique_ptr<HostProcess> process;
  std::optional<pictures::Begin> begin;  // of its last host
  std::uint32_t there = 0, of = 0;       // frames that the folder had, of those asked for; 0: not known
  std::uint32_t drawn = 0;               // since that host began
  double seconds = 0;                    // for the frames above
  bool stopping = false;
};

Json ranges_of(const std::vector<std::uint32_t>& numbers) {
  Json ranges = Json::array();
  for (std::size_t first = 0, last; first < numbers.size(); first = last) {
    last = first + 1;
    while (last < numbers.size() && numbers[last] == numbers[last - 1] + 1) ++last;
    ranges.push_back({numbers[first], numbers[last - 1]});
  }
  return ranges;
}

class LiveRendering : public Rendering {
 public:
  LiveRendering(asio::io_context& context, RenderingSettings settings, Listener listener)
      : context_(context), settings_(std::move(settings)), listener_(std::move(listener)), timer_(context) {}
  ~LiveRendering() override {
    *alive_ = false;
    reader_.stop();
  }

  void take(PageNumber page, const Json& message) override;
  void page_opened(PageNumber page) override;
  void page_closed(PageNumber page) override { pages_.erase(page); }

 private:
  void start(const Json& options);
  void stop();
  void watch(const Json& message);
  void look_at_folder(const std::filesystem::path& folder);
  void scrub(PageNumber page, const Json& message);
  void painted(PageNumber page, const Json& message);

  void heard(const std::string& line);
  void ended(const child::Ending& ending, const std::string& reason);
  HostConnection::Listener host_listener();
  void begin(const pictures::BeginMessage& hosts);
  void update(pictures::Picture update);
  void drawn(pictures::DrawnMessage drawn);

  void tick();
  void look();
  void take_look(const std::filesystem::path& folder, FolderLook look);
  void take_status(const sinks::Status& status);
  void read(PageNumber page, std::uint32_t frame);
  template <typename Work, typename Done>
  void read_files(Work work, Done done);

  void become(const char* state, std::string text);
  Json describe() const;
  void show(PageNumber page, RenderingPage& view);
  void show_drawn(PageNumber page, RenderingPage& view);
  void show_frame(PageNumber page, const images::Image& image);
  void show_all();
  void send(PageNumber page, RenderingPage& view, ViewPicture picture);
  bool is_busy() const { return job_.process != nullptr; }

  asio::io_context& context_;
  const RenderingSettings settings_;
  const Listener listener_;
  asio::steady_timer timer_;
  asio::thread_pool reader_{1};  // of files
  // What the reader has read when this is gone, nobody takes.
  const std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);

  const char* state_ = "none";
  std::string text_;
  std::filesystem::path folder_;  // of the frames; "": none yet
  Json nodes_ = Json::array();
  std::uint32_t done_ = 0, of_ = 0;      // of a run of somebody else
  double rate_ = 0;                      // its last, frames a second
  std::optional<std::uint32_t> newest_;  // the newest frame that was shown
  std::vector<std::uint32_t> finished_;  // frames in the folder
  int ticks_ = 0;
  bool ticking_ = false, looking_ = false;
  DrawnPicture picture_;
  std::map<PageNumber, RenderingPage> pages_;
  Job job_;  // without a process: none runs
};

void LiveRendering::take(PageNumber page, const Json& message) {
  const std::string what = message.at("do");
  if (what == "render") return start(message.value("options", Json::object()));
  if (what == "stop") return stop();
  if (what == "watch") return watch(message);
  if (what == "scrub") return scrub(page, message);
  if (what == "painted") return painted(page, message);
}

void LiveRendering::page_opened(PageNumber page) {
  RenderingPage& view = pages_[page];
  listener_.tell(page, describe());
  if (!picture_.there()) return;
  view.due = picture_.no_blocks();
  view.due.set_all();
  show(page, view);
}

void LiveRendering::start(const Json& options) {
  if (is_busy()) throw Failure("a rendering is under way", folder_.string(), "stop it first");
  const std::filesystem::path folder = frames_folder(options, settings_.folder);
  Job job;
  job.connection = std::make_unique<HostConnection>(context_, host_listener());
  const std::vector<std::string> words = render_words(settings_, options, job.connection->path());
  job.process = std::make_unique<HostProcess>(
      context_,
      [&](const child::ProcessSetup& setup) {
        return std::make_unique<child::Process>(child::Command{{}, words}, setup);
      },
      0s,
      HostProcess::Listener{[this](const std::string& line) { heard(line); },
                            [this](const child::Ending& ending, const std::string& reason) { ended(ending, reason); }});
  job_ = std::move(job);
  look_at_folder(folder);
}

HostConnection::Listener LiveRendering::host_listener() {
  return {.connected = {},
          .begin = [this](const pictures::BeginMessage& hosts) { begin(hosts); },
          .picture = [this](pictures::Picture picture) { update(std::move(picture)); },
          .dropped = {},
          .drawn = [this](pictures::DrawnMessage frame) { drawn(std::move(frame)); },
          .closed =
              [this](const std::string& reason) {
                if (!reason.empty()) text_ = reason;
              }};
}

// From the beginning: what was there of another is no part of it.
void LiveRendering::look_at_folder(const std::filesystem::path& folder) {
  folder_ = folder;
  finished_.clear();
  nodes_ = Json::array();
  done_ = of_ = 0;
  rate_ = 0;
  become("starting", "");
  tick();
}

void LiveRendering::stop() {
  if (!is_busy()) return;
  job_.stopping = true;
  job_.process->stop();
  become(state_, "it was asked to end");
}

void LiveRendering::watch(const Json& message) {
  if (is_busy()) throw Failure("a rendering is under way", folder_.string(), "stop it first");
  const std::filesystem::path folder = frames_folder(message, settings_.folder);
  job_ = {};
  newest_.reset();
  look_at_folder(folder);
}

void LiveRendering::scrub(PageNumber page, const Json& message) {
  RenderingPage& view = pages_[page];
  const Json& frame = message.at("frame");
  if (frame.is_null()) {
    view.scrub.reset();
    if (picture_.there()) view.due.set_all();
    return show(page, view);
  }
  if (!frame.is_number_integer() || frame < 0 || frame >= wire::kMostFrames || folder_.empty())
    throw Failure("there is no such frame", "", "");
  view.scrub = frame.get<std::uint32_t>();
  view.scrub_due = true;
  show(page, view);
}

void LiveRendering::painted(PageNumber page, const Json& message) {
  RenderingPage& view = pages_[page];
  const Json& picture = message.at("picture");
  if (!picture.is_number_integer() || picture < 0 || picture > view.picture)
    throw Failure("there was no such picture", "", "");
  view.painted = std::max(view.painted, picture.get<std::uint32_t>());
  show(page, view);
}

// A line that the host printed. Only one has numbers: how much of the folder is there.
void LiveRendering::heard(const std::string& line) {
  static const std::regex resumed("([0-9]+) of ([0-9]+) frames? (is|are) there already.*");
  std::smatch found;
  if (std::regex_match(line, found, resumed)) {
    job_.there = document::number_in<std::uint32_t>(found[1].str()).value_or(0);
    job_.of = document::number_in<std::uint32_t>(found[2].str()).value_or(0);
  }
  text_ = line;
}

void LiveRendering::begin(const pictures::BeginMessage& hosts) {
  job_.begin = hosts.begin;
  job_.drawn = 0;
  job_.seconds = 0;
  nodes_ = Json::array();
  for (const pictures::Node& node : hosts.nodes)
    nodes_.push_back({{"name", "node " + std::to_string(nodes_.size())}, {"machine", node.host.data()}});
  picture_ = DrawnPicture(hosts.begin);
  for (auto& [page, view] : pages_) view.due = picture_.no_blocks();
  become("running", "");
}

void LiveRendering::drawn(pictures::DrawnMessage drawn) {
  ++job_.drawn;
  job_.seconds = std::max(job_.seconds, drawn.head.seconds);
  picture_.note_drawn(std::move(drawn));
}

void LiveRendering::update(pictures::Picture update) {
  std::vector<compositor::BlockFlags*> due;
  for (auto& [page, view] : pages_) {
    if (view.due.rows() == 0) view.due = picture_.no_blocks();
    due.push_back(&view.due);
  }
  picture_.take(std::move(update), due);
  show_all();
}

void LiveRendering::ended(const child::Ending& ending, const std::string& reason) {
  const bool stopped = job_.stopping && !ending.well();
  asio::post(context_, [process = std::shared_ptr<HostProcess>(std::move(job_.process))] {});
  if (stopped)
    become("stopped", "the same folder and options go on with it");
  else if (ending.well())
    become("done", text_);
  else
    become("failed", reason.empty() ? "mars render ended without a word" : reason);
  look();
}

// While something is under way.
void LiveRendering::tick() {
  if (std::exchange(ticking_, true)) return;
  timer_.expires_after(kTick);
  timer_.async_wait([this, alive = alive_](Error error) {
    if (error || !*alive) return;
    ticking_ = false;
    const std::string_view state = state_;
    if (ticks_++ % kTicksALook == 0) look();
    listener_.tell(Stage::kAllPages, describe());
    if (state == "starting" || state == "running") tick();
  });
}

template <typename Work, typename Done>
void LiveRendering::read_files(Work work, Done done) {
  asio::post(reader_, [this, alive = alive_, work, done] {
    auto read = work();
    asio::post(context_, [alive, done, read = std::move(read)] {
      if (*alive) done(read);
    });
  });
}

void LiveRendering::look() {
  if (folder_.empty() || std::exchange(looking_, true)) return;
  read_files([folder = folder_] { return look_at_frames(folder); },
             [this, folder = folder_](const FolderLook& look) { take_look(folder, look); });
}

void LiveRendering::take_look(const std::filesystem::path& folder, FolderLook look) {
  looking_ = false;
  if (folder != folder_) return;
  finished_ = look.frames;
  if (look.status) take_status(*look.status);
  if (is_busy()) return;
  const std::string_view state = state_;
  if (state == "starting" || state == "running") {
    if (!look.problem.empty()) return become("failed", look.problem);
    become(look.runs ? "running" : "done", look.runs ? "" : "nobody renders into this folder");
    if (!look.runs) done_ = of_ = static_cast<std::uint32_t>(finished_.size());
    if (look.newest && look.newest != newest_) {
      newest_ = look.newest;
      for (auto& [page, view] : pages_)
        if (!view.scrub) read(page, *newest_);
    }
  }
  listener_.tell(Stage::kAllPages, describe());
}

void LiveRendering::take_status(const sinks::Status& status) {
  done_ = status.done;
  of_ = status.of;
  rate_ = status.seconds > 0 ? status.done / status.seconds : 0;
  std::map<std::int32_t, Json> nodes;
  for (const sinks::Status::Machine& machine : status.machines)
    for (const sinks::Status::Node& node : machine.nodes)
      nodes[node.node] = {
          {"name", "node " + std::to_string(node.node)}, {"machine", machine.name}, {"slow", node.slow > 1}};
  if (nodes.empty()) return;
  nodes_ = Json::array();
  for (auto& [number, node] : nodes) nodes_.push_back(std::move(node));
}

void LiveRendering::become(const char* state, std::string text) {
  state_ = state;
  text_ = std::move(text);
  listener_.tell(Stage::kAllPages, describe());
}

Json LiveRendering::describe() const {
  Json message{{"is", "rendering"}, {"state", state_}, {"text", text_},   {"done", done_},
               {"of", of_},         {"fps", rate_},    {"nodes", nodes_}, {"there", ranges_of(finished_)}};
  if (!folder_.empty()) message["folder"] = folder_.lexically_relative(settings_.folder).string();
  if (!job_.begin) return message;
  message["of"] = std::max(job_.of, job_.begin->frames);
  message["done"] = message["of"].get<std::uint32_t>() - job_.begin->frames + job_.drawn;
  message["fps"] = job_.seconds > 0 ? job_.drawn / job_.seconds : 0;
  return message;
}

void LiveRendering::show_all() {
  for (auto& [page, view] : pages_) show(page, view);
}

void LiveRendering::show(PageNumber page, RenderingPage& view) {
  if (!view.has_room()) return;
  if (view.scrub) {
    if (std::exchange(view.scrub_due, false)) read(page, *view.scrub);
  } else if (picture_.there() && view.due.count() > 0) {
    show_drawn(page, view);
  }
}

void LiveRendering::show_drawn(PageNumber page, RenderingPage& view) {
  ViewPicture picture;
  picture.width = static_cast<std::uint16_t>(picture_.width());
  picture.height = static_cast<std::uint16_t>(picture_.height());
  picture.rects = compositor::rectangles_of(view.due, picture_.width(), picture_.height());
  picture.pixels = picture_.pixels_of(picture.rects);
  picture.rests = !is_busy();
  listener_.tell(page, picture_.describe(view.due));
  view.due.clear();
  send(page, view, std::move(picture));
}

void LiveRendering::read(PageNumber page, std::uint32_t frame) {
  struct Read {
    images::Image image;
    std::string problem;
  };
  const auto work = [folder = folder_, frame] {
    try {
      return Read{read_frame(folder, frame), ""};
    } catch (const std::exception& failure) {
      return Read{{}, reason_of(failure)};
    }
  };
  read_files(work, [this, page](const Read& read) {
    if (read.problem.empty()) return show_frame(page, read.image);
    if (pages_.contains(page)) listener_.tell(page, {{"is", "remark"}, {"text", read.problem}});
  });
}

void LiveRendering::show_frame(PageNumber page, const images::Image& image) {
  const auto found = pages_.find(page);
  if (found == pages_.end()) return;
  ViewPicture picture;
  picture.width = static_cast<std::uint16_t>(image.width);
  picture.height = static_cast<std::uint16_t>(image.height);
  picture.rects = {{0, 0, picture.width, picture.height}};
  picture.pixels = pictures::cut_opaque(image.pixels, image.width, picture.rects);
  send(page, found->second, std::move(picture));
}

void LiveRendering::send(PageNumber page, RenderingPage& view, ViewPicture picture) {
  picture.page = page;
  picture.view = kRenderingView;
  picture.picture = ++view.picture;
  listener_.picture(std::move(picture));
}

}  // namespace

bool Rendering::is_for_it(const Json& message) {
  const std::string what = message.value("do", "");
  if (what == "painted") return message.value("view", Json()) == kRenderingView;
  return what == "render" || what == "stop" || what == "watch" || what == "scrub";
}

std::unique_ptr<Rendering> make_rendering(asio::io_context& context, const RenderingSettings& settings,
                                          Rendering::Listener listener) {
  return std::make_unique<LiveRendering>(context, settings, std::move(listener));
}

}  // namespace mars::studio
