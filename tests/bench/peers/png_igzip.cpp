#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include <cstring>
#include <stdexcept>
#include <string_view>

#include "tests/bench/peers/png_encoder.h"

namespace mars::bench {
namespace {

constexpr std::uint8_t kUp = 2;        // PNG's filter
constexpr std::size_t kChunkHead = 8;  // bytes: length, type
constexpr std::size_t kRoomForHeads = 1024;

void put_number(std::uint8_t* to, std::uint32_t number) {
  for (int k = 0; k < 4; ++k) to[k] = static_cast<std::uint8_t>(number >> (24 - 8 * k));
}

class IgzipEncoder : public PngEncoder {
 public:
  IgzipEncoder(std::uint32_t width, std::uint32_t height)
      : width_(width),
        height_(height),
        rows_((std::size_t{3} * width + 1) * height + 4),
        file_(rows_.size() + rows_.size() / 8 + kRoomForHeads),
        level_(ISAL_DEF_LVL1_DEFAULT),
        no_row_(width) {}

  std::span<const std::uint8_t> encode(std::span<const std::uint32_t> pixels) override {
    filter(pixels);
    end_ = file_.data();
    put("\x89PNG\r\n\x1a\n");
    std::uint8_t head[13] = {0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0};  // 8 bits, RGB
    put_number(head, width_);
    put_number(head + 4, height_);
    begin_chunk("IHDR");
    put({reinterpret_cast<const char*>(head), sizeof head});
    end_chunk();
    begin_chunk("IDAT");
    deflate();
    end_chunk();
    begin_chunk("IEND");
    end_chunk();
    return {file_.data(), end_};
  }

 private:
  void filter(std::span<const std::uint32_t> pixels) {
    const std::uint32_t* above = no_row_.data();
    std::uint8_t* row = rows_.data();
    for (std::size_t y = 0; y < height_; ++y, row += 3 * std::size_t{width_}) {
      *row++ = kUp;
      pack_row(&pixels[y * width_], above, width_, row);
      above = &pixels[y * width_];
    }
  }

  void deflate() {
    isal_zstream stream;
    isal_deflate_stateless_init(&stream);
    stream.level = 1;
    stream.level_buf = level_.data();
    stream.level_buf_size = static_cast<std::uint32_t>(level_.size());
    stream.gzip_flag = IGZIP_ZLIB;
    stream.end_of_stream = 1;
    stream.next_in = rows_.data();
    stream.avail_in = static_cast<std::uint32_t>(rows_.size() - 4);
    stream.next_out = end_;
    stream.avail_out = static_cast<std::uint32_t>(file_.data() + file_.size() - end_);
    if (isal_deflate_stateless(&stream) != COMP_OK) throw std::runtime_error("igzip cannot compress a picture");
    end_ = stream.next_out;
  }

  void put(std::string_view bytes) {
    std::memcpy(end_, bytes.data(), bytes.size());
    end_ += bytes.size();
  }
  void begin_chunk(std::string_view type) {
    chunk_ = end_;
    end_ += 4;
    put(type);
  }
  void end_chunk() {
    put_number(chunk_, static_cast<std::uint32_t>(end_ - chunk_ - kChunkHead));
    put_number(end_, crc32_gzip_refl(0, chunk_ + 4, static_cast<std::uint64_t>(end_ - chunk_ - 4)));
    end_ += 4;
  }

  const std::uint32_t width_, height_;
  std::vector<std::uint8_t> rows_, file_, level_;
  std::vector<std::uint32_t> no_row_;
  std::uint8_t* end_ = nullptr;    // of what the file has so far
  std::uint8_t* chunk_ = nullptr;  // that is being written
};

}  // namespace

std::unique_ptr<PngEncoder> make_igzip_encoder(std::uint32_t width, std::uint32_t height) {
  return std::make_unique<IgzipEncoder>(width, height);
}

}  // namespace mars::bench
