#include "tests/hal/conformance/expect.h"

#include <cerrno>
#include <stdexcept>

#include "hal/messages/call_failure.h"
#include "hal/messages/process.h"

namespace mars::conformance {

void broken(const std::string& how, const Place& at) {
  throw std::runtime_error(std::string(at.file_name()) + ":" + std::to_string(at.line()) + ": " + how);
}

void expect_in(const std::string& text, const std::vector<std::string>& parts, const Place& at) {
  for (const std::string& part : parts)
    if (text.find(part) == std::string::npos) broken("\"" + part + "\" is not in \"" + text + "\"", at);
}

void expect_fails(int code, const std::function<void()>& call, const std::vector<std::string>& parts, const Place& at) {
  try {
    call();
  } catch (const messages::CallFailure& failure) {
    if (failure.code != code) {
      broken("\"" + std::string(failure.what()) + "\" has errno " + std::to_string(failure.code) + ", not " +
                 std::to_string(code),
             at);
    }
    const messages::Backend& backend = messages::process().backend();
    expect_in(failure.what(), {messages::rank_name(backend.rank(), backend.host())}, at);
    expect_in(failure.what(), parts, at);
    return;
  }
  broken("the call does not fail", at);
}

void expect_errno(int code, const std::function<long()>& twin, const Place& at) {
  errno = 0;
  const long result = twin();
  const int left = errno;
  if (result != -1) broken("the twin returns " + std::to_string(result) + ", not -1", at);
  if (left != code) broken("errno is " + std::to_string(left) + ", not " + std::to_string(code), at);
}

}  // namespace mars::conformance
