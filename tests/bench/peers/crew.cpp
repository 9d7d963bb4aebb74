#include "tests/bench/peers/crew.h"

#include <pthread.h>
#include <sched.h>
#include <xmmintrin.h>

namespace mars::bench {
namespace {

cpu_set_t allowed_processors() {
  cpu_set_t set;
  sched_getaffinity(0, sizeof set, &set);
  return set;
}

// To the processor of that number among those this process may use; tiny numbers become 0, as Embree advises.
void settle(int number) {
  static const cpu_set_t allowed = allowed_processors();
  _mm_setcsr(_mm_getcsr() | 0x8040);
  int left = number % CPU_COUNT(&allowed);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &allowed) || left-- > 0) continue;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(cpu, &one);
    pthread_setaffinity_np(pthread_self(), sizeof one, &one);
    return;
  }
}

}  // namespace

Crew::Crew(int threads, std::function<void()> work) : work_(std::move(work)) {
  settle(0);
  for (int k = 1; k < threads; ++k) helpers_.emplace_back([this, k] { help(k); });
}

Crew::~Crew() {
  stop_ = true;
  begin();
  for (std::thread& helper : helpers_) helper.join();
}

void Crew::run() {
  busy_.store(static_cast<int>(helpers_.size()), std::memory_order_relaxed);
  begin();
  work_();
  for (int busy = busy_.load(std::memory_order_acquire); busy != 0; busy = busy_.load(std::memory_order_acquire))
    busy_.wait(busy, std::memory_order_acquire);
}

void Crew::begin() {
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
}

void Crew::help(int number) {
  settle(number);
  for (unsigned round = 0;; ++round) {
    round_.wait(round, std::memory_order_acquire);
    if (stop_) return;
    work_();
    if (busy_.fetch_sub(1, std::memory_order_release) == 1) busy_.notify_one();
  }
}

}  // namespace mars::bench
