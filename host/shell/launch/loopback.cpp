// Loaded into mpirun alone (LD_PRELOAD), where it starts ranks on this machine only: sockets that would listen on all
// addresses listen on the loopback interface. Open MPI has no setting for it.
#include <dlfcn.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <string_view>

namespace {

using Bind = int (*)(int, const sockaddr*, socklen_t);

// What mpirun starts is not concerned. We come first in the list; others in it are somebody else's.
[[gnu::constructor]] void leave_list() {
  constexpr std::string_view kName = "LD_PRELOAD=";
  for (char** line = environ; line != nullptr && *line != nullptr; ++line) {
    if (!std::string_view(*line).starts_with(kName)) continue;
    const char* rest = std::strchr(*line, ':');
    if (rest == nullptr)
      unsetenv("LD_PRELOAD");
    else
      std::memmove(*line + kName.size(), rest + 1, std::strlen(rest));
    return;
  }
}

}  // namespace

extern "C" int bind(int socket, const sockaddr* address, socklen_t size) noexcept {
  static const Bind next = reinterpret_cast<Bind>(dlsym(RTLD_NEXT, "bind"));
  sockaddr_in v4{};
  if (address->sa_family == AF_INET && size >= sizeof v4) {
    std::memcpy(&v4, address, sizeof v4);
    if (v4.sin_addr.s_addr == htonl(INADDR_ANY)) v4.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return next(socket, reinterpret_cast<const sockaddr*>(&v4), sizeof v4);
  }
  sockaddr_in6 v6{};
  if (address->sa_family == AF_INET6 && size >= sizeof v6) {
    std::memcpy(&v6, address, sizeof v6);
    if (IN6_IS_ADDR_UNSPECIFIED(&v6.sin6_addr)) v6.sin6_addr = in6addr_loopback;
    return next(socket, reinterpret_cast<const sockaddr*>(&v6), sizeof v6);
  }
  return next(socket, address, size);
}
