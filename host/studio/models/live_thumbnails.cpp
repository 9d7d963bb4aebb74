#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/content/document/base64.h"
#include "host/content/document/file.h"
#include "host/content/document/held_folder.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/content/modeler/figure_library.h"
#include "host/studio/link/host_process.h"
#include "host/studio/models/model_list.h"
#include "host/studio/models/thumbnails.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kPrefix = "mars-thumbnails-";
constexpr const char* kSize = "320x320";      // of the pictures
constexpr std::uintmax_t kLargest = 1 << 20;  // bytes of one
constexpr child::ProcessLimits kLimits{30s, std::uint64_t{8} << 30};
constexpr int kBehindAllElse = 10;  // a niceness: a tenth of the others' time where processors are busy
constexpr int kLooks = 10;          // calls of look() between two looks at the folder

class LiveThumbnails final : public Thumbnails {
 public:
  LiveThumbnails(asio::io_context& context, ThumbnailSettings settings, Listener listener)
      : context_(context),
        settings_(std::move(settings)),
        listener_(std::move(listener)),
        list_(fs::absolute(settings_.file).parent_path()) {
    document::remove_abandoned_folders(settings_.temporary, kPrefix);
  }

  void take(PageNumber page, const Json& message) override {
    message.at("do") == "models" ? send_models(page) : ask(page, message.at("model").get<std::string>());
  }
  void page_closed(PageNumber page) override;
  void look(bool at_rest) override;

 private:
  struct Drawn {
    std::string version;
    std::string png, problem;  // one of the two is ""
  };

  void send_models(PageNumber page);
  void send_list(PageNumber page) const;
  void ask(PageNumber page, const std::string& name);
  void draw_next();
  void draw(const ListedModel& model);
  fs::path file_of(const ListedModel& model) const;
  void drawn(const ListedModel& model, const child::Ending& ending, const std::string& reason);
  void settle(const std::string& name, Drawn drawn);
  Json answer(const std::string& name) const;

  asio::io_context& context_;
  const ThumbnailSettings settings_;
  const Listener listener_;
  ModelList list_;
  int looks_ = 0;
  std::set<PageNumber> pages_;  // that know the list
  std::map<std::string, Drawn> drawn_;
  std::map<std::string, std::set<PageNumber>> asked_;
  std::deque<std::string> due_;  // names of asked_: files, which a person may just have brought, then the library's
  std::unique_ptr<document::HeldFolder> folder_;
  std::unique_ptr<HostProcess> process_;  // it goes before its folder
};

void LiveThumbnails::send_models(PageNumber page) {
  list_.look();
  pages_.insert(page);
  send_list(page);
}

void LiveThumbnails::send_list(PageNumber page) const {
  Json models = Json::array();
  for (const ListedModel& each : list_.models())
    models.push_back({{"name", each.name}, {"what", each.what}, {"kind", each.kind}, {"version", each.version}});
  listener_.tell(page, {{"is", "models"}, {"models", std::move(models)}});
}

void LiveThumbnails::ask(PageNumber page, const std::string& name) {
  if (list_.find(name) == nullptr) list_.look();  // an import has just made it
  const ListedModel* const model = list_.find(name);
  if (model == nullptr)
    throw Failure("is no model of the library or beside this file", document::in_quotes(document::printable(name)), "");
  const auto drawn = drawn_.find(name);
  if (drawn != drawn_.end() && drawn->second.version == model->version) return listener_.tell(page, answer(name));
  if (asked_[name].empty()) due_.insert(model->kind == "file" ? due_.begin() : due_.end(), name);
  asked_[name].insert(page);
}

void LiveThumbnails::page_closed(PageNumber page) {
  pages_.erase(page);
  for (auto& [name, pages] : asked_) pages.erase(page);
  std::erase_if(due_, [&](const std::string& name) { return asked_[name].empty(); });
}

void LiveThumbnails::look(bool at_rest) {
  if (!pages_.empty() && ++looks_ % kLooks == 0 && list_.look())
    for (const PageNumber page : pages_) send_list(page);
  if (at_rest && !process_ && !due_.empty()) draw_next();
}

void LiveThumbnails::draw_next() {
  const std::string name = due_.front();
  due_.pop_front();
  const ListedModel* const model = list_.find(name);
  if (model == nullptr) return settle(name, {"", "", "is no longer there"});
  try {
    draw(*model);
  } catch (const std::exception& failure) {
    settle(name, {model->version, "", explain(failure).what()});
  }
}

void LiveThumbnails::draw(const ListedModel& model) {
  folder_ = std::make_unique<document::HeldFolder>(settings_.temporary, kPrefix);
  const std::vector<std::string> words{settings_.mars.string(),
                                       "preview",
                                       file_of(model).string(),
                                       "--as",
                                       "surface",
                                       "--frames",
                                       "0",
                                       "--size",
                                       kSize,
                                       "-o",
                                       (folder_->path() / "picture.png").string()};
  process_ = std::make_unique<HostProcess>(
      context_,
      [&](const child::ProcessSetup& setup) {
        child::ProcessSetup limited = setup;
        limited.limits = kLimits;
        limited.niceness = kBehindAllElse;
        return std::make_unique<child::Process>(child::Command{{}, words}, limited);
      },
      0s,
      HostProcess::Listener{
          [](const std::string&) {},
          [this, model](const child::Ending& ending, const std::string& reason) { drawn(model, ending, reason); }});
}

fs::path LiveThumbnails::file_of(const ListedModel& model) const {
  if (model.kind == "file") return fs::path(".") / settings_.file.parent_path() / model.name;  // no option: "-a.json"
  const fs::path file = folder_->path() / (model.name + ".json");
  document::write_whole_file(file, modeler::library_figure(model.name).dump());
  return file;
}

void LiveThumbnails::drawn(const ListedModel& model, const child::Ending& ending, const std::string& reason) {
  // It calls us, and goes when it is done with that.
  asio::post(context_, [process = std::shared_ptr<HostProcess>(std::move(process_))] {});
  const auto folder = std::exchange(folder_, nullptr);
  if (const ListedModel* const now = list_.find(model.name); now != nullptr && now->version != model.version)
    return due_.push_front(model.name);  // it has changed meanwhile
  const std::string why = !reason.empty() ? reason : ending.signal != 0 ? "takes too long to draw" : "cannot be drawn";
  if (!ending.well()) return settle(model.name, {model.version, "", why});
  try {
    const std::string png = document::read_file(folder->path() / "picture.png", kLargest);
    settle(model.name, {model.version, document::base64(std::as_bytes(std::span(png))), ""});
  } catch (const std::exception& failure) {
    settle(model.name, {model.version, "", explain(failure).what()});
  }
}

void LiveThumbnails::settle(const std::string& name, Drawn drawn) {
  drawn_[name] = std::move(drawn);
  const auto asked = asked_.extract(name);
  if (asked.empty()) return;
  for (const PageNumber page : asked.mapped()) listener_.tell(page, answer(name));
}

Json LiveThumbnails::answer(const std::string& name) const {
  const Drawn& drawn = drawn_.at(name);
  Json message{{"is", "thumbnail"}, {"model", name}, {"version", drawn.version}};
  if (drawn.problem.empty())
    message["png"] = drawn.png;
  else
    message["problem"] = drawn.problem;
  return message;
}

}  // namespace

std::unique_ptr<Thumbnails> make_thumbnails(asio::io_context& context, ThumbnailSettings settings,
                                            Thumbnails::Listener listener) {
  return std::make_unique<LiveThumbnails>(context, std::move(settings), std::move(listener));
}

}  // namespace mars::studio
