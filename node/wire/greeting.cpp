#include "node/wire/greeting.h"

#include <cstring>
#include <initializer_list>

#include "hal/failure/failure.h"
#include "node/wire/film_parts.h"
#include "node/wire/protocol.h"

namespace mars::wire {
namespace {

constexpr std::array<char, 4> kStampMagic{'M', 'A', 'R', 'S'};
constexpr std::array<std::uint8_t, 3> kRelease{MARS_RELEASE};

// FNV-1a.
constexpr std::uint32_t hash_of(std::initializer_list<std::size_t> sizes) {
  std::uint32_t hash = 2166136261u;
  for (const std::size_t size : sizes) hash = (hash ^ static_cast<std::uint32_t>(size)) * 16777619u;
  return hash;
}

constexpr std::uint32_t kSizes = hash_of(
    {sizeof(Hello),    sizeof(Load),    sizeof(Loaded),       sizeof(Render), sizeof(Credit), sizeof(Strip),
     sizeof(Run),      sizeof(Fault),   sizeof(FilmSettings), sizeof(Patch),  sizeof(Shape),  sizeof(Segment),
     sizeof(Material), sizeof(Matrix),  sizeof(Camera),       sizeof(Light),  sizeof(Track),  sizeof(Change),
     sizeof(Interval), sizeof(Meshlet), sizeof(AmbientLight), sizeof(Fog),    sizeof(Beat),   sizeof(InbetweenBands)});

std::string version_of(const WireStamp& stamp) {
  const auto& [major, minor, patch] = stamp.release;
  return "MARS " + std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch) + " (wire " +
         std::to_string(stamp.wire) + ")";
}

}  // namespace

WireStamp own_stamp() { return {kStampMagic, kByteOrder, kWireVersion, kRelease, kSizes}; }

bool is_stamped(std::span<const std::byte> message) {
  return message.size() >= sizeof(WireStamp) &&
         std::memcmp(message.data(), kStampMagic.data(), kStampMagic.size()) == 0;
}

void check_stamp(std::span<const std::byte> message, const std::string& sender, const std::string& receiver) {
  const WireStamp own = own_stamp();
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    throw Failure(sender + " " + what + ", " + receiver + " runs " + version_of(own), "", remedy);
  };
  const std::string same = "install the same MARS on all machines";
  if (!is_stamped(message)) refuse("is not MARS, or of a version before 0.2.0", same);
  WireStamp stamp;
  std::memcpy(&stamp, message.data(), sizeof stamp);
  if (stamp.byte_order != own.byte_order)
    refuse("runs " + version_of(stamp) + " with bytes in another order", "use machines of one byte order");
  if (stamp.wire != own.wire || stamp.release != own.release) refuse("runs " + version_of(stamp), same);
  if (stamp.sizes != own.sizes) refuse("runs " + version_of(stamp) + " built with messages of other sizes", same);
}

}  // namespace mars::wire
