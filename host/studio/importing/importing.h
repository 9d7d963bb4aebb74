// Files of other programs that pages bring: uploaded, read by `mars import` in a process of its own, and put into the
// open film as models and actors (docs/studio-protocol.md, "Importing"). One import at a time. All calls and callbacks
// are on the thread that runs the io_context.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "host/editing/command.h"
#include "host/studio/importing/upload.h"
#include "host/studio/stage/stage.h"

namespace boost::asio {
class io_context;
}

namespace mars::studio {

class Importing {
 public:
  struct Listener {
    std::function<void(PageNumber page, const Json& message)> tell;
    // A step of the page's, written and sent as other steps; `before`: what a person would have typed for the files
    // that it needs. Throws Failure where it makes no sense.
    std::function<void(PageNumber page, const Json& step, const std::vector<editing::Command>& before)> commit;
  };

  virtual ~Importing() = default;

  // Whether the message is for an import: import, import_more or stop_import.
  static bool is_for_it(const Json& message);
  // Such a message. Throws Failure or Json::exception where it makes no sense.
  virtual void take(PageNumber page, const Json& message) = 0;
  // A file that the page begins to send. Throws Failure where no import waits for it.
  virtual std::unique_ptr<Upload> upload(const UploadedFile& file) = 0;
  virtual void page_closed(PageNumber page) = 0;
};

struct ImportingSettings {
  std::filesystem::path file;  // that is open: models are made beside it
  std::filesystem::path mars;  // the program
  // How long an import waits for a page that sends nothing of the files that it announced, and for files that those
  // name.
  std::chrono::milliseconds for_files = std::chrono::minutes(1);
  std::chrono::milliseconds for_companions = std::chrono::minutes(2);
};

// The project must outlive it. With its end an import ends, and leaves nothing. It begins with removing what imports of
// killed studios left beside the file.
std::unique_ptr<Importing> make_importing(boost::asio::io_context& context, const ImportingSettings& settings,
                                          const Project& project, Importing::Listener listener);

}  // namespace mars::studio
