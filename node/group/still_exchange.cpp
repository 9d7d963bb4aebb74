#include "node/group/still_exchange.h"

#include <algorithm>
#include <cstring>

#include "node/wire/commands.h"
#include "node/wire/protocol.h"
#include "node/wire/still_plan.h"

namespace mars::group {
namespace {

constexpr const char* kLinesText = "still lines";

// Before lines that are depths alone, and before each line with groups.
using LineBytes = std::uint64_t;

std::size_t most_bytes(const raster::StillLines& still) { return still.most_packed() + sizeof(geometry::LineRange); }

}  // namespace

// Home lines of nodes, in pieces of several.
class StillExchange::Lines : public Relayed {
 public:
  Lines(const StillNeeds& needs, raster::StillLines& still)
      : needs_(needs), still_(still), left_(lines_of(static_cast<int>(mynode()))) {}

  bool has_part(int node) const override { return lines_of(node).count() > 0; }
  bool is_left() const override { return left_.count() > 0; }

  std::size_t fill(std::span<std::byte> piece) override {
    return still_.has_groups() ? fill_with_lines(piece) : fill_with_depths(piece);
  }

  void take(int owner, std::span<const std::byte> piece) override {
    still_.has_groups() ? take_lines(owner, piece) : take_depths(owner, piece);
  }

 private:
  // Needed lines that `node` is home of.
  geometry::LineRange lines_of(int node) const {
    return geometry::overlap(needs_.homes[static_cast<std::size_t>(node - needs_.group.first)], still_.lines());
  }

  // As many as a piece has, but one at least.
  std::size_t fill_with_depths(std::span<std::byte> piece) {
    geometry::LineRange lines{left_.first, left_.first};
    std::size_t bytes = 0;
    for (std::size_t line = 0; lines.last < left_.last; ++lines.last, bytes += line) {
      line = still_.depth_bytes({lines.last, lines.last + 1});
      if (bytes > 0 && sizeof lines + bytes + line > wire::kRelayPiece) break;
    }
    left_.first = lines.last;
    std::memcpy(piece.data(), &lines, sizeof lines);
    still_.pack_depths(lines, piece.data() + sizeof lines);
    return sizeof lines + bytes;
  }

  void take_depths(int owner, std::span<const std::byte> piece) {
    geometry::LineRange lines{};
    wire::require_sense(piece.size() >= sizeof lines, owner, kLinesText);
    std::memcpy(&lines, piece.data(), sizeof lines);
    const geometry::LineRange all = lines_of(owner);
    wire::require_sense(all.first <= lines.first && lines.first <= lines.last && lines.last <= all.last &&
                            piece.size() == sizeof lines + still_.depth_bytes(lines),
                        owner, kLinesText);
    still_.unpack_depths(lines, piece.data() + sizeof lines);
  }

  // Those that are kept.
  std::size_t fill_with_lines(std::span<std::byte> piece) {
    std::size_t bytes = 0;
    for (; left_.count() > 0; ++left_.first) {
      const LineBytes line = still_.packed_bytes(left_.first);
      if (line == 0) continue;
      if (bytes > 0 && bytes + sizeof line + line > wire::kRelayPiece) break;
      std::memcpy(piece.data() + bytes, &line, sizeof line);
      still_.pack(left_.first, piece.data() + bytes + sizeof line);
      bytes += sizeof line + line;
    }
    return bytes;
  }

  void take_lines(int owner, std::span<const std::byte> piece) {
    while (!piece.empty()) {
      LineBytes bytes = 0;
      wire::require_sense(piece.size() >= sizeof bytes, owner, kLinesText);
      std::memcpy(&bytes, piece.data(), sizeof bytes);
      piece = piece.subspan(sizeof bytes);
      wire::require_sense(bytes <= piece.size() && still_.is_packed(piece.first(bytes)), owner, kLinesText);
      still_.unpack(piece.first(bytes));
      piece = piece.subspan(bytes);
    }
  }

  const StillNeeds& needs_;
  raster::StillLines& still_;
  geometry::LineRange left_;  // of the caller
};

StillExchange::StillExchange(const raster::Neighbours& neighbours, const raster::StillLines& still)
    : neighbours_(neighbours),
      relay_(wire::kStillLines, most_bytes(still), kLinesText),
      collectors_(static_cast<std::size_t>(neighbours.group().count)) {}

void StillExchange::complete(const StillNeeds& needs, raster::StillLines& still) {
  Lines lines(needs, still);
  relay_.exchange(Collectors(needs.group, needs.contributes, neighbours_, collectors_), lines);
}

}  // namespace mars::group
