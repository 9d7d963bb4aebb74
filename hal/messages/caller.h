// The rank that makes a call: its backend, and how a call of it fails.
#pragma once

#include <string>

#include "hal/messages/backend.h"

namespace mars::messages {

class Caller {
 public:
  // `backend` outlives it.
  explicit Caller(Backend& backend) : backend_(backend) {}
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  Backend& backend() const { return backend_; }

  // Throws this rank's CallFailure: "node 3, csend: ..."; `code` is a CallError, or an errno of the system.
  [[noreturn]] void fail(const char* call, int code, const std::string& what, const std::string& remedy) const;

 protected:
  ~Caller() = default;

  Backend& backend_;
};

// "node 3" or "the host".
std::string rank_name(int rank, int host);

}  // namespace mars::messages
