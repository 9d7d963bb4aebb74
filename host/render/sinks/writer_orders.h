// The host's orders for nodes that write frames' files (node/wire/frame_writer.h): where files go, and what they say of
// themselves. The host's run has the claim to the folder; the files that its nodes are writing have names of that run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/render/sinks/manifest.h"

namespace mars::sinks {

struct WriterOrders {
  std::filesystem::path folder;     // of frames; absolute
  std::filesystem::path run_files;  // with what the names of the run's own files begin (sinks/runs_folder.h)
  Manifest manifest;                // what its frames are of; without frames

  std::filesystem::path file_of(std::uint32_t frame) const;
  std::filesystem::path part_of(std::uint32_t frame) const;
  // While it is there, the run has its claim.
  std::filesystem::path claim() const;
  // The host makes the first, and each node that sees it the second: so both know that they see the same folder.
  std::filesystem::path host_probe() const;
  std::filesystem::path node_probe(std::int32_t node) const;
};

// Whether the file is there, or comes soon: file systems of networks show late what others have made.
bool appears(const std::filesystem::path& file);

std::vector<std::byte> bytes_of(const WriterOrders& orders);
// Throws Failure where they make no sense.
WriterOrders read_orders(std::span<const std::byte> bytes);

}  // namespace mars::sinks
