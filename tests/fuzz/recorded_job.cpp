#include "tests/fuzz/recorded_job.h"

#include <utility>

#include "hal/messages/pages.h"
#include "host/render/sinks/served_sinks.h"
#include "host/render/trace/trace.h"
#include "tests/render/films.h"

namespace mars::fuzz {
namespace {

constexpr std::uint32_t kWidth = 24, kHeight = 16;

wire::FilmData small_crowd(std::uint32_t samples) {
  wire::FilmData film = test::crowd(kWidth, kHeight, 4, 2);
  film.settings.samples = samples;
  film.settings.dice = 2;
  return film;
}

// Hands all on to the transport's own, and keeps what its rank takes.
class Recorder : public messages::Backend {
 public:
  Recorder(messages::Backend& inner, std::vector<Letter>& letters) : inner_(inner), letters_(letters) {}

  int rank() const override { return inner_.rank(); }
  int nodes() const override { return inner_.nodes(); }
  void send(int to, int type, const void* data, std::size_t length) override {
    ++sent_;
    inner_.send(to, type, data, length);
  }
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override {
    ++sent_;
    return inner_.start_send(to, type, data, length);
  }
  bool sent(messages::Ticket ticket) override { return inner_.sent(ticket); }
  std::optional<messages::Envelope> peek() override { return inner_.peek(); }
  void take(void* buffer) override {
    const messages::Envelope next = *inner_.peek();
    inner_.take(buffer);
    const auto* const bytes = static_cast<const std::byte*>(buffer);
    letters_.push_back({next.from, next.type, {bytes, bytes + next.length}, sent_});
  }
  void idle(int turn, std::chrono::microseconds longest) override { inner_.idle(turn, longest); }
  // Clocks differ, as those of machines do.
  double seconds() const override { return inner_.seconds() + 1000 * rank(); }
  messages::Neighbourhood neighbourhood() override { return {rank(), 0, 1, rank(), false}; }
  std::shared_ptr<std::byte> share(std::size_t bytes) override { return messages::map_pages(bytes); }
  messages::Offer offer(std::size_t bytes) override { return inner_.offer(bytes); }
  std::shared_ptr<std::byte> attach(int, const messages::MemoryName&, std::size_t) override { return nullptr; }
  bool finish() override { return inner_.finish(); }
  [[noreturn]] void abort(const std::string& reason) override {
    inner_.abort(reason);
    std::terminate();
  }

 private:
  messages::Backend& inner_;
  std::vector<Letter>& letters_;
  std::size_t sent_ = 0;
};

// Takes frames at once, without threads.
std::unique_ptr<sinks::SinkPool> make_sinks(sinks::Sink& sink, const sinks::SinkPool::Shape& shape) {
  return std::make_unique<sinks::ServedSinks>(sink, shape,
                                              [](const images::FileWork&) { return sinks::ServedSinks::Times(); });
}

}  // namespace

RecordedJob::RecordedJob(std::uint32_t samples, wire::PixelFormat format, bool traced)
    : film_(small_crowd(samples)), format_(format), traced_(traced), letters_(kNodes + 1) {
  test::RunOptions options = this->options();
  options.wrap = [this](messages::Backend& backend) {
    return std::make_unique<Recorder>(backend, letters_[static_cast<std::size_t>(backend.rank())]);
  };
  trace::Trace trace;
  if (traced_) options.farm.trace = &trace;
  test::run_film(film_.bytes(), options);
}

test::RunOptions RecordedJob::options() const {
  test::RunOptions options;
  options.nodes = kNodes;
  options.work.groups = 1;
  options.format = format_;
  options.memory = 4 << 20;
  options.farm.asked_memory.still = 1 << 20;
  options.make_sinks = make_sinks;
  return options;
}

namespace {

constexpr std::size_t kLongest = 1 << 20;  // bytes of a changed message

// As another rank than the receiver `self` might have sent it.
void change_one(std::vector<Letter>& letters, int self, Script& script) {
  const std::size_t at = script.below(letters.size());
  const auto place = letters.begin() + static_cast<std::ptrdiff_t>(at);
  switch (script.byte() % 16) {
    case 0: letters.erase(place); break;
    case 1: letters.insert(place, Letter(*place)); break;
    case 2: std::swap(*place, letters[script.below(letters.size())]); break;
    case 3: place->from = (self + 1 + static_cast<int>(script.below(kNodes))) % (kNodes + 1); break;
    case 4: place->type = script.byte() % 20; break;
    case 5: place->body = letters[script.below(letters.size())].body; break;
    default: edit(place->body, script, kLongest);
  }
}

}  // namespace

void hand_changed(const std::vector<Letter>& sound, Script& script, DeadPeers& peers) {
  std::vector<Letter> letters = sound;
  while (!script.at_end() && !letters.empty()) change_one(letters, peers.rank(), script);
  for (Letter& letter : letters) peers.hand(std::move(letter));
}

}  // namespace mars::fuzz
