#include "host/shell/launch/background_text.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <iostream>
#include <system_error>
#include <thread>
#include <utility>

#include "hal/failure/explain.h"

namespace mars::launch {
namespace {

std::atomic<int> searches{0};  // that have not ended

}  // namespace

BackgroundText::~BackgroundText() { ready_within(std::chrono::seconds(1)); }

void BackgroundText::begin(std::function<std::string()> find) {
  std::promise<std::string> found;
  text_ = found.get_future();
  const auto search = [find = std::move(find)](std::promise<std::string> answer) {
    std::string text;
    try {
      text = find();
    } catch (const std::exception& failure) {
      text = reason_of(failure);  // the run goes on
    }
    --searches;
    answer.set_value(std::move(text));
  };
  ++searches;
  try {
    std::thread(search, std::move(found)).detach();
  } catch (const std::system_error& failure) {
    --searches;
    std::promise<std::string> none;
    none.set_value(reason_of(failure));
    text_ = none.get_future();
  }
}

std::string BackgroundText::take() { return ready_within(std::chrono::seconds(0)) ? text_.get() : ""; }

bool BackgroundText::ready_within(std::chrono::seconds wait) const {
  return text_.valid() && text_.wait_for(wait) == std::future_status::ready;
}

int exit_code(int code) {
  if (searches == 0) return code;
  std::cout.flush();
  std::fflush(nullptr);
  _exit(code);
}

}  // namespace mars::launch
