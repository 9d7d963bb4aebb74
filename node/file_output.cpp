#include "node/file_output.h"

#include "hal/nx/nx_messages.h"
#include "node/wire/protocol.h"

namespace mars::node {
namespace {

template <typename Item>
std::span<const Item> items(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
  return {reinterpret_cast<const Item*>(bytes.data() + at), count};
}

void send(const wire::Written& written) { csend(wire::kWritten, &written, sizeof written, myhost(), 0); }

}  // namespace

FileOutput::FileOutput(wire::FrameWriter& writer, const raster::Neighbours& neighbours, group::Outbox& outbox,
                       Heartbeat& heartbeat)
    : writer_(writer),
      outbox_(outbox),
      heartbeat_(heartbeat),
      shared_(neighbours, writer.shared_bytes(), writer.shared_bytes(), raster::NeighboursMemory::Contents::own),
      exchange_(neighbours, writer),
      team_bands_(neighbours.group()) {
  writer_.share(shared_.bytes());
  heartbeat_.at_each_look([this] { report_written(); });
}

void FileOutput::paste(wire::Strip& header) {
  const std::span<const std::byte> strip = outbox_.finish_own(header);
  const std::size_t runs = header.constant_runs + header.moving_runs;
  const std::size_t pixel_bytes = strip.size() - sizeof header - runs * sizeof(wire::Run);
  writer_.paste(header, items<wire::Run>(strip, sizeof header + pixel_bytes, runs),
                items<std::uint32_t>(strip, sizeof header, pixel_bytes / sizeof(std::uint32_t)));
}

void FileOutput::write() {
  report();
  while (writer_.is_full() && !outbox_.stopped()) {
    outbox_.look_for_stop();
    heartbeat_.look();
    flick();
    report();
  }
  if (!outbox_.stopped()) writer_.write();
}

// Throws nothing of the writer's: it is called from within calls of others.
void FileOutput::report_written() {
  while (writer_.has_written()) send(*writer_.take_written());
}

void FileOutput::report() {
  while (const auto written = writer_.take_written()) send(*written);
  while (const auto text = writer_.take_warning())
    csend(wire::kStorage, text->data(), static_cast<long>(text->size()), myhost(), 0);
}

}  // namespace mars::node
