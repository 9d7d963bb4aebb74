// Whole pages of memory, for blocks that ranks share.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hal/failure/failure.h"

namespace mars::messages {

// `bytes` zeroed bytes, aligned to a page, which take memory as they are touched: of `file` from its begin or, without
// one, of this process alone. nullptr where they are more than half of the addresses that the process has left
// (ulimit -v), or where the machine does not give them.
std::shared_ptr<std::byte> map_pages(std::size_t bytes, std::optional<int> file = std::nullopt);

// Lets the machine give large pages (2 MiB), where it has them, for the whole pages in `block`: before they are
// touched.
void prefer_large_pages(std::span<std::byte> block);

// The whole pages in `bytes`, which nobody will read before they are written again, need no memory until then.
void give_pages_back(std::span<std::byte> bytes);

// Of a block that a machine's nodes cannot share; `where` names the one that throws it.
Failure too_much_to_share(std::size_t bytes, const std::string& where);

}  // namespace mars::messages
