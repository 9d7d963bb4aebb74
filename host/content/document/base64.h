// Bytes as text (RFC 4648, section 4), for terminals and pages.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace mars::document {

std::string base64(std::span<const std::byte> bytes);

}  // namespace mars::document
