#include "hal/arguments.h"

#include "hal/message_types.h"
#include "hal/nx/nx_errno.h"
#include "hal/process.h"

namespace mars::hal {
namespace {

std::size_t check_buffer(const Process& process, const char* call, const void* buffer, long length) {
  if (length < 0) {
    process.fail(call, EQLEN, "length " + std::to_string(length) + " is negative", "give a length in bytes");
  }
  const auto bytes = static_cast<std::size_t>(length);
  if (buffer == nullptr && bytes > 0) {
    process.fail(call, EQPBUF, "the buffer of " + bytes_text(bytes) + " is a null pointer",
                 "give a buffer, or length 0");
  }
  return bytes;
}

void check_pid(const Process& process, const char* call, long pid) {
  if (pid == 0 || pid == -1) return;
  process.fail(call, EQPID, "there is no pid " + std::to_string(pid), "every node runs one process, pid 0");
}

void check_node(const Process& process, const char* call, long node, const char* all) {
  const Backend& backend = process.backend();
  if (-1 <= node && node <= backend.host()) return;
  process.fail(call, EQNODE, "there is no node " + std::to_string(node),
               "nodes are 0 to " + std::to_string(backend.nodes() - 1) + ", the host is myhost(), -1 is " + all);
}

}  // namespace

std::string bytes_text(std::size_t bytes) {
  return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes");
}

Outgoing check_send(const Process& process, const char* call, long type, const void* buffer, long length,
                    long node, long pid) {
  if (type_class(type) == TypeClass::reserved) {
    process.fail(call, EQTYPE, "message type " + std::to_string(type) + " is reserved",
                 "use 0 to 999999999, or 1073741824 to 1999999999 for force messages");
  }
  const std::size_t bytes = check_buffer(process, call, buffer, length);
  check_pid(process, call, pid);
  check_node(process, call, node, "all others");
  const int first = static_cast<int>(node);
  const Receivers receivers =
      node == -1 ? Receivers{0, process.backend().nodes(), true} : Receivers{first, first + 1, false};
  return {receivers, static_cast<int>(type), buffer, bytes};
}

Selection check_selection(const Process& process, const char* call, long typesel, long node, long pid) {
  const std::int32_t narrow = narrow_typesel(typesel);
  if (narrow >= 0 && type_class(narrow) == TypeClass::reserved) {
    process.fail(call, EQTYPE, "typesel " + std::to_string(narrow) + " is a reserved type",
                 "use 0 to 999999999, -1 for any, or 1073741824 to 1999999999 for force messages");
  }
  check_node(process, call, node, "any");
  check_pid(process, call, pid);
  return {narrow, static_cast<int>(node)};
}

Room check_room(const Process& process, const char* call, void* buffer, long length) {
  return {buffer, check_buffer(process, call, buffer, length)};
}

}  // namespace mars::hal
