#include "host/preview/film_reloader.h"

#include "hal/failure/explain.h"

namespace mars::preview {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{100};

}  // namespace

FilmReloader::FilmReloader(std::filesystem::path film, document::FileStamps read)
    : film_(std::move(film)), files_(std::move(read)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::unique_ptr<Previewed> FilmReloader::take() {
  const std::lock_guard lock(mutex_);
  return std::move(loaded_);
}

std::string FilmReloader::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

std::optional<std::chrono::duration<double>> FilmReloader::loading() const {
  const std::lock_guard lock(mutex_);
  if (!loading_since_) return std::nullopt;
  return Clock::now() - *loading_since_;
}

bool FilmReloader::stop() {
  const std::lock_guard lock(mutex_);
  thread_.request_stop();
  return loading_since_.has_value();
}

void FilmReloader::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      look(stop);
    } catch (const std::exception& failure) {  // out of memory: the next look may have more
      const std::lock_guard lock(mutex_);
      loading_since_.reset();
      trouble_ = reason_of(failure);
    }
    std::unique_lock lock(mutex_);
    stopped_.wait_for(lock, stop, kBetweenLooks, [] { return false; });
  }
}

void FilmReloader::look(const std::stop_token& stop) {
  if (!files_.changed_and_settled()) return;
  {
    const std::lock_guard lock(mutex_);
    if (stop.stop_requested()) return;
    loading_since_ = Clock::now();
  }
  load();
}

void FilmReloader::load() {
  std::unique_ptr<Previewed> film;
  std::string trouble;
  document::RecordedReads reads;
  try {
    film = std::make_unique<Previewed>(load_previewed(film_));
  } catch (const std::exception& failure) {
    trouble = reason_of(failure);
  }
  files_.set_read(reads.stamps());
  const bool torn = !film && !files_.are_as_read();  // written meanwhile: it is read again
  const std::lock_guard lock(mutex_);
  loading_since_.reset();
  if (torn) return;
  if (film) loaded_ = std::move(film);
  trouble_ = std::move(trouble);
}

}  // namespace mars::preview
