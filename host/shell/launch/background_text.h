// A text that is looked for on a thread of its own: what the thread looks at, a dead disk perhaps, may hold it up for
// ever. Nobody waits for it then, and the process ends beside it.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <string>

namespace mars::launch {

class BackgroundText {
 public:
  BackgroundText() = default;
  // Waits a second for it, no longer.
  ~BackgroundText();
  BackgroundText(const BackgroundText&) = delete;
  BackgroundText& operator=(const BackgroundText&) = delete;

  // Where the machine gives no thread, the text is why.
  void begin(std::function<std::string()> find);
  // Once it is there; "" before and after.
  std::string take();

 private:
  bool ready_within(std::chrono::seconds wait) const;

  std::future<std::string> text_;
};

// For main's end: where a text is still looked for, ends the process here with all that was written, since exit() would
// destroy what that thread uses.
int exit_code(int code);

}  // namespace mars::launch
