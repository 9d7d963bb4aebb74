#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "hal/failure/explain.h"
#include "host/content/animator/settings/film_settings.h"
#include "host/content/document/file.h"
#include "host/content/document/folder_lock.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/film_file.h"
#include "host/content/modeler/edit.h"
#include "host/editing/edit_film.h"
#include "host/images/picture_size.h"
#include "host/preview/watched_files.h"
#include "host/studio/project/describe.h"
#include "host/studio/project/film_work.h"
#include "host/studio/project/history.h"
#include "host/studio/project/journal.h"
#include "host/studio/project/model_film.h"
#include "host/studio/project/model_work.h"
#include "host/studio/project/project.h"
#include "host/studio/project/scripts.h"

namespace mars::studio {
namespace {

constexpr const char* kBreaking = "what broke the file";

// "film.json:12: ..." is line 12 of that file.
Problem problem_of(const std::exception& reason, const std::filesystem::path& path) {
  const Failure failure = explain(reason);
  Problem problem{failure.what(), 0};
  const std::string begin = path.string() + ":";
  if (!failure.where.starts_with(begin)) return problem;
  const std::string rest = failure.where.substr(begin.size());
  problem.line = document::number_in<std::uint32_t>(rest.substr(0, rest.find_first_not_of("0123456789"))).value_or(0);
  return problem;
}

// The same for who has the file before his eyes.
Problem problem_in(const std::exception& reason, const std::filesystem::path& path) {
  const Failure failure = explain(reason);
  Problem problem = problem_of(reason, path);
  if (problem.line == 0) return problem;
  const std::string begin = path.string() + ":" + std::to_string(problem.line);
  const std::size_t rest = failure.where.find_first_not_of(": ", begin.size());
  problem.text =
      Failure(failure.problem, rest == std::string::npos ? "" : failure.where.substr(rest), failure.remedy).what();
  return problem;
}

class FileProject : public Project {
 public:
  FileProject(std::filesystem::path path, bool model, std::filesystem::path folder)
      : path_(std::move(path)), is_model_(model), journal_(path_), scripts_(path_, folder) {
    if (model)
      work_ = std::make_unique<ModelWork>(path_, std::move(folder));
    else
      work_ = std::make_unique<FilmWork>(path_, std::move(folder));
    document::RecordedReads reads;
    const auto text = document::read_file_if_there(path_, document::kLargestDocument);
    on_disk_ = text.has_value();
    const std::string content = text ? *text : document::laid_out(model ? new_model() : new_film(path_));
    work_->prepare(content, false);
    accept(content);
    good_ = reads.stamps();
    files_.set_read(good_);
    history_ = journal_.read(text_).value_or(History());
  }

  bool is_model() const override { return is_model_; }
  const animator::Film& film() const override { return work_->film(); }
  bool rig_lights() const override { return work_->rig_lights(); }
  bool has_keys(const std::string& thing, const std::string& part) const override {
    return work_->has_keys(thing, part);
  }
  std::uint64_t revision() const override { return revision_; }
  std::uint64_t shapes_revision() const override { return work_->shapes_revision(); }
  std::optional<Pulled> pulled() const override { return work_->pulled(); }
  std::uint32_t frame() const override { return frame_; }
  bool in_gesture() const override { return work_->shows(); }
  const std::optional<Problem>& problem() const override { return problem_; }
  std::vector<modeler::ControlPoint> control_points(const std::string& joint) const override {
    return work_->control_points(joint);
  }
  std::vector<std::string> take_remarks() override { return std::exchange(remarks_, {}); }
  std::vector<editing::Command> take_commands() override { return std::exchange(commands_, {}); }

  void set_frame(std::uint32_t frame) override {
    frame = std::min(frame, film().frames - 1);
    if (frame == frame_) return;
    cancel();
    frame_ = frame;
    ++revision_;
  }

  void preview(const Json& step) override {
    const Step read = read_step(step);
    ++revision_;
    work_->show(read, Work::For::eyes);
  }

  void cancel() override {
    if (!work_->shows()) return;
    ++revision_;
    work_->take_back();
  }

  void commit(const Json& json) override {
    const Step step = read_step(json);
    cancel();
    remarks_.clear();
    ++revision_;
    if (std::holds_alternative<PoseStep>(step)) {
      work_->show(step, Work::For::file);
      return work_->keep();
    }
    const document::FolderLock lock(path_);
    look_at_disk();
    refuse_while_broken();
    remarks_ = work_->show(step, Work::For::file);
    try {
      write(step);
    } catch (...) {
      work_->take_back();
      throw;
    }
    work_->keep();
    commands_ = commands_of(step);
  }

  void undo() override {
    cancel();
    const document::FolderLock lock(path_);
    look_at_disk();
    if (problem_) return repair();
    if (const HistoryEntry* const entry = history_.to_undo()) {
      const std::string before = fitting(entry->change.undone(text_));
      replace(before, [&] { journal_.write_undo(text_, before); });
      history_.undo();
    }
  }

  void redo() override {
    cancel();
    const document::FolderLock lock(path_);
    look_at_disk();
    refuse_while_broken();
    if (const HistoryEntry* const entry = history_.to_redo()) {
      const std::string after = fitting(entry->change.done(text_));
      replace(after, [&] { journal_.write_redo(text_, after); });
      history_.redo();
    }
  }

  bool look_at_files() override {
    if (!files_.changed_and_settled()) return false;
    const document::FolderLock lock(path_);
    return look_at_disk();
  }

  std::uint64_t keys_revision() const override { return keys_revision_; }
  Json channels(const std::vector<std::string>& things) override { return work_->channels(things); }
  Json curves(const CurvesWanted& wanted) override { return work_->curves(wanted); }
  Json scripts() const override { return scripts_.list(); }

  Json check_script(const std::string& name, const std::string& text) override {
    cancel();
    animator::Remarks report;
    std::optional<Problem> problem;
    try {
      report = work_->show(ScriptStep{checked_script_name(name), text}, Work::For::eyes);
      work_->take_back();
    } catch (const std::exception& reason) {
      problem = problem_in(reason, path_.parent_path() / name);
    }
    return {{"is", "script"}, {"name", name}, {"problem", described(problem)}, {"report", std::move(report)}};
  }

  Json describe() const override {
    const images::PictureSize shown = images::with_square_pixels({film().width, film().height}, film().pixel_aspect);
    Json json{{"is", "project"},
              {"kind", is_model_ ? "model" : "film"},
              {"file", path_.filename().string()},
              {"frames", film().frames},
              {"rate", film().rate},
              {"frame", frame_},
              {"size", {shown.width, shown.height}}};
    work_->describe(json, frame_);
    json["undo"] = problem_ ? Json(kBreaking) : name_of(history_.to_undo());
    json["redo"] = problem_ ? Json() : name_of(history_.to_redo());
    json["problem"] = described(problem_);
    return json;
  }

  Json describe_poses() const override {
    Json actors = Json::array();
    if (work_->shows())
      for (const std::size_t actor : work_->shown_actors()) actors.push_back(poses_of(film(), actor, frame_));
    else if (is_model_)
      actors.push_back(poses_of(film(), kModelActor, frame_));
    else
      for (std::size_t actor = 0; actor < film().actors.size(); ++actor)
        actors.push_back(poses_of(film(), actor, frame_));
    Json poses{{"is", "poses"}, {"frame", frame_}, {"actors", std::move(actors)}};
    if (work_->shows()) work_->describe_shown(poses, frame_);
    return poses;
  }

 private:
  // Of a journal that somebody has changed, what was done may not be what the file is made of.
  std::string fitting(std::optional<std::string> text) {
    if (text) return std::move(*text);
    history_ = History();
    throw Failure("does not fit the file", journal_.path().string(), "remove it; the history then starts empty");
  }

  static Json described(const std::optional<Problem>& problem) {
    return problem ? Json{{"text", problem->text}, {"line", problem->line}} : Json();
  }

  static Json name_of(const HistoryEntry* entry) { return entry ? Json(entry->name) : Json(); }
  static std::string name_of(const Step& step) { return studio::name_of(step); }

  // As `mars model MODEL new` begins.
  static Json new_model() {
    Json model = modeler::empty_model();
    modeler::add_joint(model, "body", {});
    return model;
  }

  // As `mars film` would begin it.
  static Json new_film(const std::filesystem::path& path) {
    const std::vector<editing::Command> commands{{"film", "add", "floor", "--model", "floor"}};
    Json film = animator::new_film();
    animator::light_new_film(film, path);
    editing::edit_film(film, path, commands);
    return film;
  }

  void accept(const std::string& text) {
    work_->accept();
    text_ = text;
    frame_ = std::min(frame_, film().frames - 1);
    ++revision_;
    ++keys_revision_;
  }

  // What the step shows, where it changes anything.
  void write(const Step& step) {
    const std::string after = work_->text();
    if (const auto* const script = std::get_if<ScriptStep>(&step)) scripts_.write(*script);
    if (after == text_ && on_disk_) return;
    require_writable();
    const HistoryEntry entry{time_now(), name_of(step), change_between(text_, after)};
    journal_.write_step(entry, text_, after);
    document::write_whole_file(path_, after);
    on_disk_ = true;
    text_ = after;
    frame_ = std::min(frame_, film().frames - 1);
    ++keys_revision_;
    history_.add(entry);
    journal_.shorten(history_, text_);
    say_trouble();
  }

  void require_writable() const {
    if (on_disk_ && access(path_.c_str(), W_OK) != 0) document::fail_file("write", path_, errno);
  }

  // The file and what is open become this text, or stay as they are.
  template <typename Record>
  void replace(const std::string& text, Record record) {
    require_writable();
    work_->prepare(text, others_are_as_read());
    try {
      record();
      document::write_whole_file(path_, text);
    } catch (...) {
      work_->reject();
      throw;
    }
    on_disk_ = true;
    accept(text);
  }

  void refuse_while_broken() const {
    if (problem_) throw Failure("nothing is changed while the file is broken", problem_->text, "correct it, or undo");
  }

  void say_trouble() {
    if (!journal_.trouble().empty()) remarks_.push_back("the history is not kept: " + journal_.trouble());
  }

  // The last good state, over what broke it.
  void repair() {
    document::write_whole_file(path_, text_);
    problem_.reset();
    on_disk_ = true;
    ++revision_;
  }

  // What others did to the files. True if something changed here.
  bool look_at_disk() {
    document::RecordedReads reads;
    const std::string problem = problem_ ? problem_->text : "";
    const std::uint64_t revision = revision_;
    try {
      read_disk();
      problem_.reset();
      add_stamps(good_, reads.stamps());
    } catch (const std::exception& reason) {
      problem_ = problem_of(reason, path_);
    }
    document::FileStamps looked_at = good_;
    add_stamps(looked_at, reads.stamps());
    files_.set_read(std::move(looked_at));
    return revision != revision_ || problem != (problem_ ? problem_->text : "");
  }

  static void add_stamps(document::FileStamps& stamps, const document::FileStamps& more) {
    for (const auto& [path, stamp] : more) stamps[path] = stamp;
  }

  // The files that this one names.
  bool others_are_as_read() const {
    return std::ranges::all_of(
        good_, [&](const auto& each) { return each.first == path_ || document::stamp_of(each.first) == each.second; });
  }

  void read_disk() {
    const auto text = document::read_file_if_there(path_, document::kLargestDocument);
    if (!text && !on_disk_) return;
    if (!text) throw Failure("is not there any more", path_.string(), "undo puts it back");
    const bool others_stay = others_are_as_read();
    if (*text == text_ && others_stay) return;
    cancel();
    work_->prepare(*text, others_stay);
    if (*text != text_) add_outside_change(*text);
    on_disk_ = true;
    accept(*text);
  }

  // Another studio has it in the journal already.
  void add_outside_change(const std::string& text) {
    if (auto history = journal_.read(text)) {
      history_ = std::move(*history);
      return;
    }
    const HistoryEntry entry{time_now(), kChangedOutside, change_between(text_, text)};
    journal_.write_step(entry, text_, text);
    history_.add(entry);
  }

  std::filesystem::path path_;
  bool is_model_;
  bool on_disk_ = false;
  std::unique_ptr<Work> work_;
  Journal journal_;
  Scripts scripts_;
  History history_;
  document::FileStamps good_;  // of the files as they were read without a problem
  preview::WatchedFiles files_{{}};
  std::string text_;  // the last good one of the file
  std::uint32_t frame_ = 0;
  std::uint64_t revision_ = 1, keys_revision_ = 1;
  std::optional<Problem> problem_;
  std::vector<std::string> remarks_;
  std::vector<editing::Command> commands_;
};

bool is_model(const document::Element& root) {
  return root.kind() == document::Kind::object && (root.find("joints") || root.find("from")) && !root.find("actors");
}

}  // namespace

std::unique_ptr<Project> open_project(const std::filesystem::path& file, std::filesystem::path folder, NewFile begins) {
  if (folder.empty()) folder = std::filesystem::absolute(file).parent_path();
  if (!document::file_exists(file))
    return std::make_unique<FileProject>(file, begins == NewFile::model, std::move(folder));
  if (film::is_compiled_film(file))
    throw Failure("is compiled: it has matrices, no keys", file.string(), "name the film file that it was made from");
  const document::Document document = document::read_document(file);
  return std::make_unique<FileProject>(file, is_model(document.root()), std::move(folder));
}

}  // namespace mars::studio
