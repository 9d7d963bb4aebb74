#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/folder_lock.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/studio/importing/companions.h"
#include "host/studio/importing/import_request.h"
#include "host/studio/importing/importing.h"
#include "host/studio/importing/upload_folder.h"
#include "host/studio/link/host_process.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kImages = "-images";  // what follows a model's name in that of its folder of images

// What a run of `mars import` made.
struct Made {
  fs::path file;  // while the import goes on
  std::string report;
};

struct Import {
  Import(std::uint32_t its_number, PageNumber its_page, const Json& message, const fs::path& beside)
      : number(its_number),
        page(its_page),
        request(import_request(message)),
        jobs(import_jobs(request.files)),
        folder(beside),
        begun(request.files.size()) {}

  std::uint32_t number;
  PageNumber page;
  ImportRequest request;
  std::vector<ImportJob> jobs;
  UploadFolder folder;
  std::vector<bool> begun;            // files that the page sends or has sent
  std::size_t there = 0;              // files that are whole
  std::vector<Companion> missing;     // while it waits for them
  std::vector<Made> made;             // of the jobs, in their order
  std::vector<fs::path> beside_film;  // models and folders of images that have been put there
  std::string printed;                // by the run that goes on
  bool ended = false;                 // what still comes for it is refused
};

std::string in_words(std::chrono::milliseconds time) {
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(time).count();
  if (seconds < 60) return document::counted(static_cast<std::size_t>(seconds), "second", "seconds");
  return document::counted(static_cast<std::size_t>(seconds / 60), "minute", "minutes");
}

class LiveImporting;

// Writes into the import's folder while that import goes on.
class UploadToFile final : public Upload {
 public:
  UploadToFile(LiveImporting& importing, std::weak_ptr<Import> import, fs::path path)
      : importing_(importing), import_(std::move(import)), file_(std::move(path)) {}
  ~UploadToFile() override;

  void take(std::string_view piece) override;
  void end() override;

 private:
  std::shared_ptr<Import> import() const;

  LiveImporting& importing_;  // there while the import is
  std::weak_ptr<Import> import_;
  WrittenFile file_;
  bool whole_ = false;
};

class LiveImporting final : public Importing {
 public:
  LiveImporting(asio::io_context& context, ImportingSettings settings, const Project& project, Listener listener)
      : context_(context),
        settings_(std::move(settings)),
        project_(project),
        listener_(std::move(listener)),
        patience_(context) {
    remove_abandoned_uploads(fs::absolute(settings_.file).parent_path());
  }

  void take(PageNumber page, const Json& message) override {
    if (message.at("do") == "import") return begin(page, message);
    if (message.at("do") == "import_more") return take_more(page, message);
    if (import_ && import_->page == page) end("stopped", "");
  }
  std::unique_ptr<Upload> upload(const UploadedFile& file) override;
  void page_closed(PageNumber page) override {
    if (import_ && import_->page == page) end("stopped", "");
  }

  void piece_came() {
    wait(settings_.for_files, [this] { files_did_not_come(); });
  }
  void file_came();
  void upload_cut(const std::string& reason) { end("failed", reason); }

 private:
  void begin(PageNumber page, const Json& message);
  void take_more(PageNumber page, const Json& message);
  void all_came();
  void files_did_not_come();
  void companions_did_not_come();
  void wait(std::chrono::milliseconds longest, const std::function<void()>& then);
  void stop_waiting();
  void run_next();
  using PathOf = std::function<fs::path(const std::string& file)>;
  std::vector<std::string> words_of(const ImportJob& job, const PathOf& path_of, const fs::path& to) const;
  void run_ended(const child::Ending& ending, const std::string& reason);
  void finish();
  std::string unused_name(const std::string& wanted) const;
  void put_beside_film(const fs::path& made, const fs::path& to);
  std::vector<std::string> put_beside_film();
  Json step_for(const std::vector<std::string>& files, std::vector<std::string>& actors) const;
  std::vector<editing::Command> typed_for(const std::vector<std::string>& files) const;
  void end(const char* state, const std::string& text, Json more = Json::object());
  void tell(const char* state, Json more);
  std::string plain(std::string text) const;
  template <typename Work>
  void attempt(Work work);

  asio::io_context& context_;
  const ImportingSettings settings_;
  const Project& project_;
  const Listener listener_;
  asio::steady_timer patience_;
  std::uint64_t waits_ = 0;
  std::uint32_t last_number_ = 0;
  std::shared_ptr<Import> import_;  // null: none goes on
  std::unique_ptr<HostProcess> process_;
};

UploadToFile::~UploadToFile() {
  if (const auto going_on = import_.lock(); going_on && !whole_ && !going_on->ended)
    importing_.upload_cut("a file came only in part: import it again");
}

std::shared_ptr<Import> UploadToFile::import() const {
  auto import = import_.lock();
  if (!import || import->ended) throw Failure("the import has ended", "", "");
  return import;
}

void UploadToFile::take(std::string_view piece) {
  import();
  file_.write(piece);
  importing_.piece_came();
}

void UploadToFile::end() {
  import();
  whole_ = true;
  importing_.file_came();
}

void LiveImporting::begin(PageNumber page, const Json& message) {
  if (import_) throw Failure("an import is under way", "", "wait until it is done, or stop it");
  import_ = std::make_shared<Import>(++last_number_, page, message, fs::absolute(settings_.file).parent_path());
  tell("receiving", Json::object());
  piece_came();
}

// Without files the import goes on without what is missing.
void LiveImporting::take_more(PageNumber page, const Json& message) {
  if (!import_ || import_->page != page || import_->missing.empty()) throw Failure("no import waits for files", "", "");
  if (message.at("files").empty()) return attempt([this] { run_next(); });
  ImportRequest request = import_->request;
  add_files(request, message);
  import_->jobs = import_jobs(request.files);
  import_->request = std::move(request);
  import_->begun.resize(import_->request.files.size());
  import_->missing.clear();
  tell("receiving", Json::object());
  piece_came();
}

void LiveImporting::wait(std::chrono::milliseconds longest, const std::function<void()>& then) {
  patience_.expires_after(longest);
  patience_.async_wait([this, number = ++waits_, then](auto error) {
    if (!error && number == waits_) then();
  });
}

void LiveImporting::stop_waiting() {
  ++waits_;  // a call that is due already comes in vain
  patience_.cancel();
}

void LiveImporting::files_did_not_come() {
  std::string names;
  for (std::size_t i = 0; i < import_->begun.size(); ++i)
    if (!import_->begun[i]) names += (names.empty() ? "" : ", ") + document::printable(import_->request.files[i].name);
  end("failed", (names.empty() ? "the rest of a file" : names) + " did not come: the page sent nothing for " +
                    in_words(settings_.for_files) + " (import the files again, together)");
}

void LiveImporting::all_came() {
  import_->missing = missing_companions(import_->folder, import_->request, import_->jobs);
  if (import_->missing.empty()) return run_next();
  Json missing = Json::array();
  for (const Companion& each : import_->missing)
    missing.push_back({{"name", each.name}, {"of", each.of}, {"needed", each.needed}});
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(settings_.for_companions);
  tell("waiting", {{"missing", std::move(missing)}, {"seconds", seconds.count()}});
  wait(settings_.for_companions, [this] { companions_did_not_come(); });
}

// What is not needed is left out.
void LiveImporting::companions_did_not_come() {
  std::vector<Companion> needed;
  std::ranges::copy_if(import_->missing, std::back_inserter(needed), &Companion::needed);
  if (needed.empty()) return attempt([this] { run_next(); });
  end("failed", names_of(needed) + " did not come within " + in_words(settings_.for_companions) + ": " +
                    document::printable(needed.front().of) + " cannot be read without (import them together)");
}

std::unique_ptr<Upload> LiveImporting::upload(const UploadedFile& file) {
  if (!import_ || file.import != import_->number || file.file >= import_->begun.size())
    throw Failure("no import waits for this file", "", "");
  const ImportedFile& promised = import_->request.files[file.file];
  if (import_->begun[file.file]) throw Failure("is there already", promised.name, "");
  if (file.bytes != promised.bytes) throw Failure("is not as long as the page announced", promised.name, "");
  import_->begun[file.file] = true;
  try {
    return std::make_unique<UploadToFile>(*this, import_, import_->folder.uploaded(promised.name));
  } catch (const std::exception& failure) {
    end("failed", explain(failure).what());
    throw;
  }
}

void LiveImporting::file_came() {
  if (++import_->there == import_->request.files.size()) attempt([this] { all_came(); });
}

// What fails ends the import, whose page hears why.
template <typename Work>
void LiveImporting::attempt(Work work) {
  try {
    work();
  } catch (const std::exception& failure) {
    end("failed", explain(failure).what());
  }
}

// A film's motions have its own frames.
std::vector<std::string> LiveImporting::words_of(const ImportJob& job, const PathOf& path_of,
                                                 const fs::path& to) const {
  std::vector<std::string> words{"import", path_of(job.main).string()};
  for (const std::string& more : job.more) words.push_back(path_of(more).string());
  words.insert(words.end(), {"-o", to.string()});
  words.insert(words.end(), import_->request.options.begin(), import_->request.options.end());
  if (!job.moves) return words;
  if (project_.is_model())
    words.insert(words.end(), {"--as", "model"});
  else
    words.insert(words.end(), {"--rate", document::shown(project_.film().rate)});
  return words;
}

void LiveImporting::run_next() {
  stop_waiting();
  import_->missing.clear();
  const ImportJob& job = import_->jobs[import_->made.size()];
  const fs::path to = import_->folder.make_folder(import_->made.size()) / (unused_name(job.name) + ".json");
  std::vector<std::string> words = words_of(
      job, [this](const std::string& file) { return import_->folder.uploaded(file); }, to);
  words.insert(words.begin(), settings_.mars.string());
  import_->made.push_back({to, ""});
  import_->printed.clear();
  process_ = std::make_unique<HostProcess>(
      context_,
      [&](const child::ProcessSetup& setup) {
        return std::make_unique<child::Process>(child::Command{{}, words}, setup);
      },
      0s,
      HostProcess::Listener{
          [this](const std::string& line) { import_->printed += line + '\n'; },
          [this](const child::Ending& ending, const std::string& reason) { run_ended(ending, reason); }});
  tell("reading", {{"name", job.main}});
}

void LiveImporting::run_ended(const child::Ending& ending, const std::string& reason) {
  // It calls us, and goes when it is done with that.
  asio::post(context_, [process = std::shared_ptr<HostProcess>(std::move(process_))] {});
  if (!ending.well()) return end("failed", reason.empty() ? "mars import ended without a word" : reason);
  attempt([this] {
    import_->made.back().report = import_->printed;
    import_->made.size() < import_->jobs.size() ? run_next() : finish();
  });
}

// The first of NAME, NAME-2, ... of which there is neither a model nor a folder of its images, which the model names.
std::string LiveImporting::unused_name(const std::string& wanted) const {
  const fs::path folder = fs::absolute(settings_.file).parent_path();
  for (int number = 1;; ++number) {
    const std::string name = wanted + (number == 1 ? "" : "-" + std::to_string(number));
    const auto has_it = [&](const Made& made) { return made.file.stem() == name; };
    if (!document::file_exists(folder / (name + ".json")) && !fs::exists(folder / (name + kImages)) &&
        std::ranges::none_of(import_->made, has_it))
      return name;
  }
}

void LiveImporting::put_beside_film(const fs::path& made, const fs::path& to) {
  if (fs::exists(to))
    throw Failure("has appeared beside the film meanwhile", to.filename().string(), "import the files once more");
  fs::rename(made, to);
  import_->beside_film.push_back(to);
}

// Images before the model that names them.
std::vector<std::string> LiveImporting::put_beside_film() {
  const fs::path folder = fs::absolute(settings_.file).parent_path();
  const document::FolderLock lock(fs::absolute(settings_.file));
  std::vector<std::string> files;
  for (Made& made : import_->made) {
    const std::string name = made.file.filename().string(), images = made.file.stem().string() + kImages;
    if (const std::size_t at = made.report.find(made.file.string()); at != std::string::npos)
      made.report.replace(at, made.file.string().size(), name);
    if (const fs::path from = made.file.parent_path() / images; fs::exists(from))
      put_beside_film(from, folder / images);
    put_beside_film(made.file, folder / name);
    made.file = folder / name;
    files.push_back(name);
  }
  return files;
}

std::vector<editing::Command> LiveImporting::typed_for(const std::vector<std::string>& files) const {
  std::vector<editing::Command> typed;
  for (std::size_t i = 0; i < files.size(); ++i)
    typed.push_back(words_of(
        import_->jobs[i], [](const std::string& file) { return file; }, files[i]));
  return typed;
}

// An actor of each; `actors` are their names.
Json LiveImporting::step_for(const std::vector<std::string>& files, std::vector<std::string>& actors) const {
  std::set<std::string> taken{"camera"};
  for (const animator::Actor& actor : project_.film().actors) taken.insert(actor.name);
  Json commands = Json::array();
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::string name = import_->jobs[i].name;
    for (int number = 2; !taken.insert(name).second; ++number)
      name = import_->jobs[i].name + "-" + std::to_string(number);
    if (import_->jobs[i].moves)
      commands.push_back({"film", "add", name, "--from", files[i], "--lengthen"});
    else
      commands.push_back({"film", "add", name, "--model", files[i], "--beside", std::to_string(project_.frame())});
    actors.push_back(name);
  }
  return {{"commands", std::move(commands)}};
}

// Models that no film came to have are not left.
void LiveImporting::finish() {
  std::vector<std::string> files, actors;
  try {
    files = put_beside_film();
    if (!project_.is_model()) listener_.commit(import_->page, step_for(files, actors), typed_for(files));
  } catch (...) {
    std::error_code ignored;
    for (const fs::path& file : import_->beside_film) fs::remove_all(file, ignored);
    throw;
  }
  Json reports = Json::array();
  for (const Made& made : import_->made) reports.push_back(plain(made.report));
  end("done", "", {{"files", files}, {"actors", actors}, {"reports", std::move(reports)}});
}

// As a person knows the files.
std::string LiveImporting::plain(std::string text) const {
  std::vector<std::string> folders{import_->folder.uploaded("")};
  for (std::size_t run = 0; run < import_->made.size(); ++run) folders.push_back(import_->folder.folder_of(run) / "");
  for (const std::string& folder : folders)
    for (std::size_t at; (at = text.find(folder)) != text.npos;) text.erase(at, folder.size());
  return text;
}

void LiveImporting::tell(const char* state, Json more) {
  Json message{{"is", "import"}, {"number", import_->number}, {"state", state}};
  message.update(more);
  listener_.tell(import_->page, message);
}

void LiveImporting::end(const char* state, const std::string& text, Json more) {
  more["text"] = plain(text);
  import_->ended = true;
  tell(state, std::move(more));
  stop_waiting();
  process_.reset();
  import_.reset();
}

}  // namespace

bool Importing::is_for_it(const Json& message) {
  return message.at("do") == "import" || message.at("do") == "import_more" || message.at("do") == "stop_import";
}

std::unique_ptr<Importing> make_importing(asio::io_context& context, const ImportingSettings& settings,
                                          const Project& project, Importing::Listener listener) {
  return std::make_unique<LiveImporting>(context, settings, project, std::move(listener));
}

}  // namespace mars::studio
