#include "tests/hal/conformance/expect.h"

#include <stdexcept>

#include "hal/failure.h"

namespace mars::hal::conformance {

void broken(const std::string& how, const Place& at) {
  throw std::runtime_error(std::string(at.file_name()) + ":" + std::to_string(at.line()) + ": " + how);
}

void expect_in(const std::string& text, const std::vector<std::string>& parts, const Place& at) {
  for (const std::string& part : parts)
    if (text.find(part) == std::string::npos) broken("\"" + part + "\" is not in \"" + text + "\"", at);
}

void expect_fails(const std::function<void()>& call, const std::vector<std::string>& parts, const Place& at) {
  try {
    call();
  } catch (const Failure& failure) {
    expect_in(failure.what(), parts, at);
    return;
  }
  broken("the call does not fail", at);
}

}  // namespace mars::hal::conformance
