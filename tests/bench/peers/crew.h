// Threads that stay, each on a processor of its own, and do the same work together whenever it is asked for; they
// sleep in between.
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace mars::bench {

class Crew {
 public:
  // The calling thread is one of `threads`; `work` is what each of them calls.
  Crew(int threads, std::function<void()> work);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  // Until all have returned from their work.
  void run();

 private:
  void begin();
  void help(int number);

  std::function<void()> work_;
  std::atomic<unsigned> round_{0};
  std::atomic<int> busy_{0};
  std::atomic<bool> stop_{false};
  std::vector<std::thread> helpers_;
};

}  // namespace mars::bench
