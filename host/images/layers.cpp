#include "host/images/layers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::images {
namespace {

using wire::Layer;

constexpr std::array<std::string_view, wire::kLayers> kNames{"depth", "normal", "unshadowed", "motion", "ids"};
constexpr std::size_t kHalf = 2, kWord = sizeof(std::uint32_t);  // bytes

// A file has six pairs of an identity and its share of each matte, as programs expect, two in a layer. What else a
// pixel shows, in films of 8 and 16 samples, has the least shares and is left out.
constexpr std::size_t kRanksOfLayer = 2, kMatteLayers = 3;
constexpr std::size_t kMatteWords = 2 * kRanksOfLayer * kMatteLayers;

// Words before the list of segments, which is a pixel's last layer.
std::size_t plain_words(wire::PixelFormat format) { return wire::layer_at(format, Layer::surfaces); }

class Channels {
 public:
  explicit Channels(wire::PixelFormat format) : format_(format) {}

  void add_halves(const std::string& prefix, std::string_view names, std::size_t word) {
    for (std::size_t k = 0; k < names.size(); ++k)
      channels_.push_back({prefix + names[k], true, word * kWord + k * kHalf});
  }
  void add_floats(const std::string& prefix, std::string_view names, std::size_t word) {
    for (std::size_t k = 0; k < names.size(); ++k) channels_.push_back({prefix + names[k], false, (word + k) * kWord});
  }
  void add_layer(Layer layer) {
    const std::size_t word = wire::layer_at(format_, layer);
    switch (layer) {
      case Layer::depth: return add_floats("", "Z", word);
      case Layer::normal: return add_halves("N.", "XYZ", word);
      case Layer::unshadowed: return add_halves("unshadowed.", "RGB", word);
      case Layer::motion: return add_floats("backward.", "uv", word);
      case Layer::surfaces: return add_mattes(word);
    }
  }
  std::vector<LayerChannel> take() { return std::move(channels_); }

 private:
  void add_mattes(std::size_t word) {
    for (const Matte matte : kMattes)
      for (std::size_t layer = 0; layer < kMatteLayers; ++layer, word += 2 * kRanksOfLayer)
        add_floats(document::formatted("%s%02zu.", std::string(name_of(matte)).c_str(), layer), "RGBA", word);
  }

  const wire::PixelFormat format_;
  std::vector<LayerChannel> channels_;
};

// An identity, and how many samples show it.
struct Seen {
  std::uint32_t id, samples;
};

// One matte of a pixel: to ranks, those with more samples first, of as many the one with the lower identity.
class MatteRanks {
 public:
  MatteRanks(Matte matte, const SurfaceNames& names) : matte_(matte), names_(names) {}

  void put(std::span<const std::uint32_t> surfaces, std::span<std::uint32_t> ranks) {
    count_ = 0;
    for (const std::uint32_t word : surfaces)
      if (word != 0) add(id_of(word), wire::samples_of(word));
    std::sort(seen_.begin(), seen_.begin() + static_cast<std::ptrdiff_t>(count_), [](const Seen& a, const Seen& b) {
      return a.samples != b.samples ? a.samples > b.samples : a.id < b.id;
    });
    const auto all = static_cast<float>(surfaces.size());
    for (std::size_t k = 0; 2 * k < ranks.size(); ++k) {
      ranks[2 * k] = k < count_ ? seen_[k].id : 0;
      ranks[2 * k + 1] = k < count_ ? std::bit_cast<std::uint32_t>(static_cast<float>(seen_[k].samples) / all) : 0;
    }
  }

 private:
  std::uint32_t id_of(std::uint32_t word) const {
    if (wire::segment_of(word) >= names_.segments())
      throw Failure("a strip shows a segment that its film does not have", "",
                    "run host and nodes of the same version");
    return names_.id(matte_, wire::segment_of(word));
  }
  void add(std::uint32_t id, std::uint32_t samples) {
    const auto end = seen_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto there = std::find_if(seen_.begin(), end, [&](const Seen& seen) { return seen.id == id; });
    if (there != end)
      there->samples += samples;
    else
      seen_[count_++] = {id, samples};
  }

  const Matte matte_;
  const SurfaceNames& names_;
  std::array<Seen, 16> seen_{};
  std::size_t count_ = 0;
};

}  // namespace

std::string_view name_of(Layer layer) { return kNames.at(static_cast<std::size_t>(layer)); }

wire::LayerSet layers_in(std::string_view text) {
  if (text == "all") return wire::kAllLayers;
  wire::LayerSet kinds = 0;
  while (!text.empty()) {
    const std::string_view name = text.substr(0, text.find(','));
    const auto found = std::ranges::find(kNames, name);
    if (found == kNames.end())
      throw Failure("there is no layer " + document::in_quotes(name), "",
                    "name some, with commas: " + document::joined(kNames) + "; or all");
    const wire::LayerSet kind = wire::set_of(static_cast<Layer>(found - kNames.begin()));
    if ((kinds & kind) != 0)
      throw Failure("the layer " + document::in_quotes(name) + " comes twice", "", "name it once");
    kinds |= kind;
    if (name.size() + 1 == text.size()) throw Failure("a comma with no layer behind it", "", "name a layer there");
    text.remove_prefix(std::min(text.size(), name.size() + 1));
  }
  return kinds;
}

std::string text_of(wire::LayerSet kinds) {
  std::vector<std::string_view> names;
  for (std::uint32_t k = 0; k < wire::kLayers; ++k)
    if ((kinds & wire::set_of(static_cast<Layer>(k))) != 0) names.push_back(kNames.at(k));
  return document::joined(names, ",");
}

wire::PixelFormat pixels_of(PictureFormat format, wire::LayerSet layers, std::uint32_t samples) {
  return wire::with_layers(facts_of(format).pixels, layers, samples);
}

std::vector<LayerChannel> channels_of(wire::PixelFormat pixels) {
  Channels channels(pixels);
  channels.add_halves("", wire::has_alpha(pixels) ? "RGBA" : "RGB", 0);
  for (std::uint32_t k = 0; k < wire::kLayers; ++k)
    if (const auto layer = static_cast<Layer>(k); wire::has_layer(pixels, layer)) channels.add_layer(layer);
  return channels.take();
}

std::size_t file_words(wire::PixelFormat pixels) {
  const bool mattes = wire::has_layer(pixels, Layer::surfaces);
  return plain_words(pixels) + (mattes ? kMattes.size() * kMatteWords : 0);
}

std::vector<std::uint32_t> to_file(wire::PixelFormat format, const SurfaceNames* names,
                                   std::span<const std::uint32_t> pixels) {
  check(names != nullptr, "a file with identities has their names");
  const std::size_t drawn = wire::pixel_words(format), kept = plain_words(format);
  std::vector<std::uint32_t> file(pixels.size() / drawn * file_words(format));
  std::array mattes{MatteRanks(Matte::actor, *names), MatteRanks(Matte::joint, *names),
                    MatteRanks(Matte::material, *names)};
  std::span<std::uint32_t> to(file);
  for (; !pixels.empty(); pixels = pixels.subspan(drawn)) {
    std::ranges::copy(pixels.first(kept), to.begin());
    to = to.subspan(kept);
    for (MatteRanks& matte : mattes) {
      matte.put(pixels.subspan(kept, drawn - kept), to.first(kMatteWords));
      to = to.subspan(kMatteWords);
    }
  }
  return file;
}

}  // namespace mars::images
