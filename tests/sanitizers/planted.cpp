// A program with one error of each kind that sanitizers find; the word given says which.
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace {

void overflow_a_buffer() {
  volatile std::size_t size = 8;
  volatile char* const buffer = static_cast<char*>(std::malloc(size));
  for (std::size_t i = 0; i <= size; ++i) buffer[i] = 1;
  std::free(const_cast<char*>(buffer));
}

void overflow_a_number() {
  volatile int number = INT_MAX;
  number = number + 1;
}

void leak() {
  [[maybe_unused]] static void* volatile lost;
  lost = std::malloc(8);
  lost = nullptr;
}

void race() {
  int shared = 0;
  std::jthread other([&] { ++shared; });
  ++shared;
}

}  // namespace

int main(int argc, char** argv) {
  const char* const error = argc == 2 ? argv[1] : "";
  if (std::strcmp(error, "buffer") == 0) overflow_a_buffer();
  if (std::strcmp(error, "number") == 0) overflow_a_number();
  if (std::strcmp(error, "leak") == 0) leak();
  if (std::strcmp(error, "race") == 0) race();
  std::puts("ended");
  return 0;
}
