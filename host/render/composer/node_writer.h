// The frame writer of a node (node/wire/frame_writer.h): composes bands, and writes files beside the node's drawing.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "host/content/film/frame_content.h"
#include "host/render/composer/band_composer.h"
#include "host/render/composer/band_record.h"
#include "host/render/composer/frame_files.h"
#include "host/render/composer/interval_background.h"
#include "host/render/sinks/writer_orders.h"
#include "node/wire/frame_writer.h"

namespace mars::composer {

class NodeWriter : public wire::FrameWriter {
 public:
  // `node`: the caller's. `is_first`: of its machine; it makes what the host looks for in the folder.
  NodeWriter(const wire::PackedFilm& film, const sinks::WriterOrders& orders, std::int32_t node, bool is_first);

  bool sees_folder() const override { return sees_folder_; }

  std::uint32_t lines_of_band() const override { return bands_.lines_a_band(); }
  std::size_t shared_bytes() const override { return background_.bytes(); }
  void share(std::span<std::byte> memory) override { background_.use(memory); }
  void begin_keyframe(const Keyframe& keyframe) override;
  void begin_inbetween(std::uint32_t frame, const wire::LineSpan& home) override;
  void paste(const wire::Strip& strip, std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels) override;
  std::span<const std::byte> edge() override { return edge_; }
  void add_edge(std::span<const std::byte> edge) override;
  void finish_bands() override;
  bool has_background() const override { return background_given_ < background_message_.size(); }
  std::span<const std::byte> next_background(std::size_t bytes) override;
  std::size_t most_band_bytes() const override { return background_.band_bytes(); }
  void add_background(std::span<const std::byte> background) override;
  std::span<const std::byte> picture() override;
  void add_picture(std::span<const std::byte> picture) override;
  void write() override;
  bool is_full() override { return files_.is_full(); }
  bool is_busy() override { return files_.is_busy(); }
  std::optional<wire::Written> take_written() override { return files_.take_written(); }
  bool has_written() override { return files_.has_written(); }
  std::optional<std::string> take_warning() override { return files_.take_warning(); }

 private:
  // A band of the caller's whose last lines are another's.
  struct SharedBand {
    BandComposer::Part part{};  // that is there; its pixels are the two below
    std::uint32_t lines = 0;    // that are there
    bool is_touched = false;
    std::vector<std::uint32_t> still, whole;
  };

  void take_keyframe_part(const BandComposer::Part& part);
  void make_edge(const BandComposer::Part& part);
  void keep_shared_band(const BandComposer::Part& part);
  void finish_band(std::uint32_t band, bool is_touched, std::span<const std::uint32_t> still,
                   std::span<const std::uint32_t> whole);
  void add_own_background(std::uint32_t band, std::span<const std::uint32_t> still);
  bool inbetweens_touch(std::uint32_t band) const;
  std::vector<BandRecord> records() const;
  FrameFile file_of(std::span<const BandRecord> records);
  void put(const FrameFile& file) const;

  const sinks::WriterOrders orders_;
  bool sees_folder_ = true;
  const images::PictureBands bands_;
  const film::FrameContent content_;
  BandComposer composer_;
  IntervalBackground background_;

  // The keyframe that was begun last, and its interval.
  Keyframe keyframe_{};
  std::vector<std::byte> edge_, background_message_, picture_message_;
  std::size_t background_given_ = 0;  // bytes of the message
  SharedBand shared_;

  // The frame that was begun last.
  std::uint32_t frame_ = 0;
  bool is_keyframe_ = false;
  std::vector<std::vector<std::byte>> pictures_;  // messages; of a node that writes the frame
  std::vector<std::vector<std::byte>> drawn_;     // by band: an inbetween's records; empty: as the background's

  FrameFiles files_;
};

}  // namespace mars::composer
