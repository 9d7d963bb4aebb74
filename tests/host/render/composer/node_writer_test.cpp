// Several nodes' writers side by side, with what they exchange handed from one to the other: files have the bytes of
// whole pictures, however the lines were divided.
#include "host/render/composer/node_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <thread>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/images/picture_file.h"
#include "host/render/compositor/plain_pixels.h"
#include "host/render/sinks/frame_folder.h"
#include "host/render/sinks/pixel_hash.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/farm/empty_film.h"
#include "tests/temporary_folder.h"

namespace mars::composer {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint64_t kBackground = 0x0000001100223344;

struct Layer {
  std::vector<wire::Run> runs;
  Words pixels;
};

// What one frame shows, and its plain twin.
struct Drawing {
  Layer constant, moving;
  Words still, whole;
};

class Group {
 public:
  Group(images::PictureFormat format, std::uint32_t width, std::uint32_t height, int nodes, unsigned seed)
      : random_(seed),
        film_({2}, width, height),
        manifest_{"film", std::string(32, 'a'), width, height, format, 24, 2, {0, 1}, {}, {}, {}},
        folder_(place_ / "out", manifest_),
        bands_(format, width, height),
        words_(bands_.words_of({0, 1}) / width) {
    folder_.add_probe();
    for (int node = 0; node < nodes; ++node) {
      writers_.push_back(std::make_unique<NodeWriter>(film_.view(), folder_.writer_orders(), node, node == 0));
      memory_.emplace_back(writers_.back()->shared_bytes());
      writers_.back()->share(memory_.back());
      cuts_.push_back(random_() % (height + 1));
    }
    cuts_.back() = height;
    std::ranges::sort(cuts_);
    touched_ = {height / 4, height / 2};
  }

  void render_keyframe(bool has_inbetweens) {
    drawing_ = draw(0);
    for (std::size_t node = 0; node < writers_.size(); ++node) {
      const wire::LineSpan home{node == 0 ? 0 : cuts_[node - 1], cuts_[node]};
      writers_[node]->begin_keyframe({0, 3, home, kBackground, touched_, has_inbetweens});
      paste(*writers_[node], drawing_, home);
    }
    exchange_edges();
    for (const auto& writer : writers_) writer->finish_bands();
    for (std::size_t from = 0; from < writers_.size(); ++from) {
      writers_.back()->add_picture(copy(writers_[from]->picture()));
      for (const std::vector<std::byte>& piece : backgrounds(*writers_[from]))
        for (std::size_t to = 0; to < writers_.size(); ++to)
          if (to != from) writers_[to]->add_background(piece);
    }
    writers_.back()->write();
    expect_file(*writers_.back(), 0, drawing_.whole);
  }

  void render_inbetween(std::size_t node) {
    Drawing inbetween = draw(1);
    inbetween.constant = {};
    writers_[node]->begin_inbetween(1, {0, bands_.height()});
    paste(*writers_[node], inbetween, {0, bands_.height()});
    writers_[node]->write();
    Words whole = drawing_.still;
    put(inbetween.moving, whole);
    expect_file(*writers_[node], 1, whole);
  }

  // By all nodes together, each some bands; `node` writes it.
  void render_shared_inbetween(std::size_t node) {
    Drawing inbetween = draw(1);
    inbetween.constant = {};
    for (std::size_t k = 0; k < writers_.size(); ++k) {
      const auto at = [&](std::size_t number) {
        const auto band = static_cast<std::uint32_t>(bands_.count() * number / writers_.size());
        return std::min(band * bands_.lines_a_band(), bands_.height());
      };
      writers_[k]->begin_inbetween(1, {at(k), at(k + 1)});
      paste(*writers_[k], inbetween, {at(k), at(k + 1)});
    }
    for (std::size_t from = 0; from < writers_.size(); ++from)
      if (from != node) writers_[node]->add_picture(copy(writers_[from]->picture()));
    writers_[node]->write();
    Words whole = drawing_.still;
    put(inbetween.moving, whole);
    expect_file(*writers_[node], 1, whole);
  }

  NodeWriter& writer(std::size_t node) { return *writers_[node]; }
  const std::vector<std::byte>& some_background() const { return some_background_; }

 private:
  // Small pieces, so that there are several.
  std::vector<std::vector<std::byte>> backgrounds(NodeWriter& writer) {
    std::vector<std::vector<std::byte>> pieces;
    while (writer.has_background()) {
      pieces.push_back(copy(writer.next_background(1000)));
      EXPECT_LE(pieces.back().size(), std::max<std::size_t>(1000, writer.most_band_bytes()));
    }
    if (!pieces.empty()) some_background_ = pieces.front();
    return pieces;
  }

  static std::vector<std::byte> copy(std::span<const std::byte> bytes) { return {bytes.begin(), bytes.end()}; }

  Layer layer(std::uint32_t first, std::uint32_t end) {
    Layer layer;
    for (std::uint32_t line = first; line < end; ++line) {
      for (std::uint32_t x = random_() % bands_.width(); random_() % 4 != 0 && x < bands_.width();) {
        const std::uint32_t count = std::min<std::uint32_t>(1 + random_() % 40, bands_.width() - x);
        layer.runs.push_back({line, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(count)});
        for (std::size_t k = 0; k < count * words_; ++k) layer.pixels.push_back(random_() & 0x00ffffff & mask(k));
        x += count + random_() % 50;
      }
    }
    return layer;
  }

  // Half floats that are numbers.
  std::uint32_t mask(std::size_t word) const { return words_ == 1 ? 0xffffffff : word % 2 == 0 ? 0x7bff7bff : 0x7bff; }

  void put(const Layer& layer, Words& picture) const {
    const std::uint32_t* source = layer.pixels.data();
    for (const wire::Run& run : layer.runs)
      for (std::size_t k = 0; k < run.count * words_; ++k)
        picture[(std::size_t{run.line} * bands_.width() + run.first) * words_ + k] = *source++;
  }

  Drawing draw(std::uint32_t frame) {
    Drawing drawing;
    drawing.constant = layer(0, bands_.height());
    drawing.moving = frame == 0 ? layer(0, bands_.height() / 3) : layer(touched_.first, touched_.end);
    drawing.still.resize(bands_.words_of({0, bands_.height()}));
    compositor::fill_pixels(drawing.still, kBackground, bands_.pixels());
    put(drawing.constant, drawing.still);
    drawing.whole = drawing.still;
    put(drawing.moving, drawing.whole);
    return drawing;
  }

  Layer part(const Layer& layer, std::uint32_t first, std::uint32_t end) const {
    Layer part;
    const std::uint32_t* source = layer.pixels.data();
    for (const wire::Run& run : layer.runs) {
      const std::size_t words = run.count * words_;
      if (run.line >= first && run.line < end) {
        part.runs.push_back(run);
        part.pixels.insert(part.pixels.end(), source, source + words);
      }
      source += words;
    }
    return part;
  }

  // In strips of some lines.
  void paste(NodeWriter& writer, const Drawing& drawing, const wire::LineSpan& lines) {
    for (std::uint32_t first = lines.first; first < lines.end;) {
      const std::uint32_t end = std::min<std::uint32_t>(lines.end, first + 1 + random_() % 30);
      Layer strip = part(drawing.constant, first, end);
      const Layer moving = part(drawing.moving, first, end);
      wire::Strip header{};
      header.first_line = first;
      header.last_line = end;
      header.constant_runs = static_cast<std::uint32_t>(strip.runs.size());
      strip.runs.insert(strip.runs.end(), moving.runs.begin(), moving.runs.end());
      strip.pixels.insert(strip.pixels.end(), moving.pixels.begin(), moving.pixels.end());
      writer.paste(header, strip.runs, strip.pixels);
      first = end;
    }
  }

  void exchange_edges() {
    for (std::size_t node = 0; node < writers_.size(); ++node) {
      if (writers_[node]->edge().empty()) continue;
      const std::uint32_t line = cuts_[node - 1] / bands_.lines_a_band() * bands_.lines_a_band();
      const auto owner = static_cast<std::size_t>(std::ranges::upper_bound(cuts_, line) - cuts_.begin());
      writers_[owner]->add_edge(copy(writers_[node]->edge()));
    }
  }

  void expect_file(NodeWriter& writer, std::uint32_t frame, const Words& pixels) {
    std::optional<wire::Written> written;
    while (!(written = writer.take_written())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(written->frame, frame);
    const std::string hash = written->pixel_hash.data();
    EXPECT_EQ(hash, sinks::pixel_hash_like(hash, bands_, pixels));
    const std::string file = document::read_file(folder_.file_of(frame));
    const std::string note = images::read_note(folder_.file_of(frame)).value();
    const auto twin = images::encode_picture(bands_, pixels, {note, manifest_.rate, frame});
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(file)), twin)) << "frame " << frame;
  }

  std::mt19937 random_;
  const test::TemporaryFolder place_;
  const farm::EmptyFilm film_;
  const sinks::Manifest manifest_;
  sinks::FrameFolder folder_;
  const images::PictureBands bands_;
  const std::size_t words_;
  std::vector<std::vector<std::byte>> memory_;
  std::vector<std::unique_ptr<NodeWriter>> writers_;
  std::vector<std::uint32_t> cuts_;  // one past each node's lines
  wire::LineSpan touched_;
  std::vector<std::byte> some_background_;  // of the last node that had any
  Drawing drawing_;
};

TEST(NodeWriter, FilesAreThoseOfWholePictures) {
  unsigned seed = 0;
  for (const auto format : {images::PictureFormat::png, images::PictureFormat::png16, images::PictureFormat::exr})
    for (const int nodes : {1, 2, 5})
      for (int round = 0; round < 2; ++round) {
        Group group(format, 320, 300, nodes, ++seed);
        group.render_keyframe(true);
        for (int node = 0; node < nodes; ++node) group.render_inbetween(static_cast<std::size_t>(node));
        for (int node = 0; node < nodes; ++node) group.render_shared_inbetween(static_cast<std::size_t>(node));
        group.render_keyframe(false);
      }
}

TEST(NodeWriter, RefusesWhatMakesNoSense) {
  Group group(images::PictureFormat::png, 320, 300, 3, 5);
  group.render_keyframe(true);
  std::mt19937 random(9);
  const std::vector<std::byte> sound = group.some_background();
  for (int round = 0; round < 300; ++round) {
    std::vector<std::byte> damaged = sound;
    damaged.resize(random() % (damaged.size() + 1));
    for (int k = 0; k < 2 && !damaged.empty(); ++k)
      damaged[random() % std::min<std::size_t>(damaged.size(), 64)] = static_cast<std::byte>(random());
    document::failure_of([&] { group.writer(1).add_background(damaged); });
    document::failure_of([&] { group.writer(1).add_edge(damaged); });
    group.writer(1).begin_inbetween(1, {0, 0});
    group.writer(1).add_picture(damaged);
    document::failure_of([&] { group.writer(1).write(); });
  }
}

}  // namespace
}  // namespace mars::composer
