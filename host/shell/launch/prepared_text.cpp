#include "host/shell/launch/prepared_text.h"

#include <signal.h>
#include <unistd.h>

#include "hal/failure/explain.h"

namespace mars::launch {
namespace {

std::string found_by(const std::function<std::string()>& find) try {
  return find();
} catch (const std::exception& failure) {
  return "\n" + reason_of(failure);
}

}  // namespace

// The copy has our end of the pipe, too: it would never see that we have closed it.
PreparedText::PreparedText(const std::function<std::string()>& find)
    : asked_(child::make_pipe()),
      text_(child::file_in_memory()),
      process_(
          [&] {
            asked_.writing.close();
            char nothing = 0;
            if (read(asked_.reading.number(), &nothing, 1) < 0) return 1;
            return child::write_all(text_, found_by(find)) ? 0 : 1;
          },
          {.signal_at_our_end = SIGKILL, .default_signals = {SIGINT, SIGTERM, SIGHUP}}) {}

std::optional<std::string> PreparedText::take() {
  if (taken_ || !process_.poll()) return std::nullopt;
  taken_ = true;
  const std::string text = child::content_of(text_);
  return text.empty() ? std::nullopt : std::optional(text);
}

}  // namespace mars::launch
