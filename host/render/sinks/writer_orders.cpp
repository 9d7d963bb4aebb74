#include "host/render/sinks/writer_orders.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "host/content/document/whole_file.h"
#include "host/render/sinks/record.h"
#include "host/render/sinks/runs_folder.h"

namespace mars::sinks {

using nlohmann::json;

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestPath = 4096;
constexpr std::chrono::seconds kLongestUntilSeen{10};
constexpr std::chrono::milliseconds kLookForProbe{50};

fs::path with_ending(const fs::path& run_files, const std::string& ending) { return run_files.string() + ending; }

}  // namespace

fs::path WriterOrders::file_of(std::uint32_t frame) const { return folder / frame_file_name(manifest, frame); }

fs::path WriterOrders::part_of(std::uint32_t frame) const {
  return with_ending(run_files, "." + frame_file_name(manifest, frame) + std::string(document::kPartSuffix));
}

fs::path WriterOrders::claim() const { return with_ending(run_files, std::string(kClaimEnding)); }

fs::path WriterOrders::host_probe() const { return with_ending(run_files, ".seen"); }

fs::path WriterOrders::node_probe(std::int32_t node) const {
  return with_ending(run_files, ".seen-" + std::to_string(node));
}

bool appears(const fs::path& file) {
  std::error_code none;
  const auto last = std::chrono::steady_clock::now() + kLongestUntilSeen;
  while (!fs::exists(file, none)) {
    if (std::chrono::steady_clock::now() > last) return false;
    std::this_thread::sleep_for(kLookForProbe);
  }
  return true;
}

std::vector<std::byte> bytes_of(const WriterOrders& orders) {
  const json text = {{"folder", orders.folder.string()},
                     {"run_files", orders.run_files.string()},
                     {"manifest", to_json(orders.manifest)}};
  const std::string all = text.dump(-1, ' ', false, json::error_handler_t::replace);
  const auto bytes = std::as_bytes(std::span(all));
  return {bytes.begin(), bytes.end()};
}

WriterOrders read_orders(std::span<const std::byte> bytes) {
  const json text = parse_record({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const Record record(text);
  return {record.text("folder", kLongestPath), record.text("run_files", kLongestPath),
          manifest_of(record.value("manifest"))};
}

}  // namespace mars::sinks
