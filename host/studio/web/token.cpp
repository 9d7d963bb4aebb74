#include "host/studio/web/token.h"

#include <sys/random.h>

#include <array>
#include <cstddef>

#include "hal/failure/failure.h"

namespace mars::web {

std::string make_token() {
  std::array<unsigned char, 24> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Failure("the system gives no random numbers", "", "see getrandom(2)");
  std::string token;
  for (const unsigned char byte : bytes) {
    token += "0123456789abcdef"[byte >> 4];
    token += "0123456789abcdef"[byte & 15];
  }
  return token;
}

bool same_token(std::string_view token, std::string_view given) {
  unsigned different = token.size() == given.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char other = i < given.size() ? given[i] : '\0';
    different |= static_cast<unsigned char>(token[i]) ^ static_cast<unsigned char>(other);
  }
  return different == 0;
}

}  // namespace mars::web
