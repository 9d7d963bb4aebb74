// The secret in the printed link, which lets its holder work in the studio.
#pragma once

#include <string>
#include <string_view>

namespace mars::web {

// 192 random bits in hexadecimal digits. Throws Failure where the system gives none.
std::string make_token();

// In a time that does not tell how much of `given` is right.
bool same_token(std::string_view token, std::string_view given);

}  // namespace mars::web
