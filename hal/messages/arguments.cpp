#include "hal/messages/arguments.h"

#include <cstdint>

#include "hal/messages/call_failure.h"
#include "hal/messages/message_types.h"

namespace mars::messages {
namespace {

// Failures are apart from the checks, which are the quicker for it.
[[noreturn]] void fail_length(const Caller& caller, const char* call, long length) {
  caller.fail(call, kBadLength, "length " + std::to_string(length) + " is negative", "give a length in bytes");
}

[[noreturn]] void fail_buffer(const Caller& caller, const char* call, std::size_t bytes) {
  caller.fail(call, kNullBuffer, "the buffer of " + bytes_text(bytes) + " is a null pointer",
              "give a buffer, or length 0");
}

[[noreturn]] void fail_pid(const Caller& caller, const char* call, long pid) {
  caller.fail(call, kNoSuchPid, "there is no pid " + std::to_string(pid),
              "every node runs one process, pid 0; the host may have any");
}

[[noreturn]] void fail_node(const Caller& caller, const char* call, long node, const char* all) {
  const char* host = caller.backend().has_host() ? ", the host is myhost()"
                                                 : ", and this job has no host: mars-nx run ./host ./node starts one";
  caller.fail(call, kNoSuchNode, "there is no node " + std::to_string(node),
              "nodes are 0 to " + std::to_string(caller.backend().nodes() - 1) + host + ", -1 is " + all);
}

[[noreturn]] void fail_type(const Caller& caller, const char* call, long type) {
  caller.fail(call, kBadType, "message type " + std::to_string(type) + " is reserved",
              "use 0 to 999999999, or 1073741824 to 1999999999 for force messages");
}

[[noreturn]] void fail_typesel(const Caller& caller, const char* call, long typesel) {
  caller.fail(call, kBadType, "typesel " + std::to_string(typesel) + " is a reserved type",
              "use 0 to 999999999, -1 for any, or 1073741824 to 1999999999 for force messages");
}

std::size_t check_buffer(const Caller& caller, const char* call, const void* buffer, long length) {
  if (length < 0) fail_length(caller, call, length);
  const auto bytes = static_cast<std::size_t>(length);
  if (buffer == nullptr && bytes > 0) fail_buffer(caller, call, bytes);
  return bytes;
}

// The host sets its own pid, and messages to it may give any.
void check_pid(const Caller& caller, const char* call, long node, long pid) {
  const bool any = node == caller.backend().host();
  if (pid < -1 || (pid > 0 && !any)) fail_pid(caller, call, pid);
}

void check_node(const Caller& caller, const char* call, long node, const char* all) {
  const Backend& backend = caller.backend();
  if (node < -1 || node > backend.host() || (node == backend.host() && !backend.has_host()))
    fail_node(caller, call, node, all);
}

}  // namespace

std::string bytes_text(std::size_t bytes) { return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes"); }

Outgoing check_send(const Caller& caller, const char* call, long type, const void* buffer, long length, long node,
                    long pid) {
  if (type_class(type) == TypeClass::reserved) fail_type(caller, call, type);
  const std::size_t bytes = check_buffer(caller, call, buffer, length);
  check_pid(caller, call, node, pid);
  check_node(caller, call, node, "all others");
  const int first = static_cast<int>(node);
  const Receivers receivers =
      node == -1 ? Receivers{0, caller.backend().nodes(), true} : Receivers{first, first + 1, false};
  return {receivers, static_cast<int>(type), buffer, bytes};
}

Selection check_selection(const Caller& caller, const char* call, long typesel, long node, long pid) {
  const std::int32_t narrow = narrow_typesel(typesel);
  if (narrow >= 0 && type_class(narrow) == TypeClass::reserved) fail_typesel(caller, call, narrow);
  check_node(caller, call, node, "any");
  check_pid(caller, call, node, pid);
  return {narrow, static_cast<int>(node)};
}

ReceiveBuffer check_receive_buffer(const Caller& caller, const char* call, void* buffer, long length) {
  return {buffer, check_buffer(caller, call, buffer, length)};
}

}  // namespace mars::messages
