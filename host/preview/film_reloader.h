// Loads a film again, in a thread of its own, whenever its files change. The player polls and never waits.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "host/preview/load.h"
#include "host/preview/watched_files.h"

namespace mars::preview {

class FilmReloader {
 public:
  // `read`: the files that the film was loaded from.
  FilmReloader(std::filesystem::path film, document::FileStamps read);
  // Waits until a film that is being loaded is.
  ~FilmReloader() = default;

  // The film as its files say now; nullptr: it was taken, or they make no film.
  std::unique_ptr<Previewed> take();
  // Why the files make no film, in one line; "" if they do.
  std::string trouble() const;
  // For how long a film has been loading; none: it is not.
  std::optional<std::chrono::duration<double>> loading() const;
  // No load begins from now on. Whether one is still going on, for which the destructor would wait.
  bool stop();

 private:
  using Clock = std::chrono::steady_clock;

  void run(const std::stop_token& stop);
  void look(const std::stop_token& stop);
  void load();

  const std::filesystem::path film_;
  WatchedFiles files_;  // of the thread alone

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable_any stopped_;
  std::unique_ptr<Previewed> loaded_;
  std::string trouble_;
  std::optional<Clock::time_point> loading_since_;

  std::jthread thread_;  // the last, so that it ends before the others
};

}  // namespace mars::preview
