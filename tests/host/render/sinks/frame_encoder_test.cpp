#include "host/render/sinks/frame_encoder.h"

#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "host/images/picture_file.h"
#include "host/render/compositor/compositor.h"
#include "host/render/sinks/counted_files.h"
#include "host/render/sinks/pixel_hash.h"

namespace mars::sinks {
namespace {

constexpr std::uint32_t kWidth = 640, kHeight = 360;  // several bands
constexpr std::uint32_t kBlock = 16;

std::vector<std::byte> file_of(FrameEncoder& encoder, compositor::Frame& frame) {
  const EncodedFrame encoded = encoder.encode(frame);
  const images::PictureEnds ends = encoder.ends_of(encoded, {.note = "note"});
  std::vector<std::byte> file;
  for (const auto piece : encoder.pieces(encoded, ends)) file.insert(file.end(), piece.begin(), piece.end());
  return file;
}

struct Interval {
  explicit Interval(std::uint32_t color) {
    compositor.begin_interval(0x203040);
    compositor.begin_frame(keyframe);
    const std::vector<wire::Run> runs{{10, 20, 300}, {200, 0, 640}};
    compositor.paste_constant(runs, std::vector<std::uint32_t>(940, color), &keyframe);
    compositor.finish_frame(keyframe, 0);
  }

  // A mover on one line.
  void draw(compositor::Frame& frame, std::uint32_t number) {
    compositor.begin_frame(frame);
    const std::vector<wire::Run> runs{{100, static_cast<std::uint16_t>(number), 50}};
    compositor.paste_moving(frame, runs, std::vector<std::uint32_t>(50, 0xff0000 + number));
    compositor.finish_frame(frame, number);
  }

  compositor::Compositor compositor{kWidth, kHeight, kBlock};
  compositor::Frame keyframe{kWidth, kHeight, kBlock};
};

const images::PictureBands kBands(images::PictureFormat::png, kWidth, kHeight);

// With the bytes of the plain twin, which encodes all of a whole picture.
void expect_plain_twin(FrameEncoder& encoder, compositor::Frame& frame) {
  const std::vector<std::byte> file = file_of(encoder, frame);
  const std::string hash = encoder.encode(frame).pixel_hash();
  frame.restore({0, kHeight});
  EXPECT_EQ(file, images::encode_picture(images::PictureFormat::png, kWidth, kHeight, frame.pixels, "note"));
  EXPECT_EQ(hash, pixel_hash_like(hash, kBands, frame.pixels));
}

TEST(FrameEncoder, FilesAreThoseOfWholePictures) {
  FrameEncoder encoder(kBands);
  Interval one(1), other(2);
  compositor::Frame frame(kWidth, kHeight, kBlock);
  for (std::uint32_t number = 1; number < 6; ++number) {
    Interval& interval = number % 2 == 0 ? one : other;
    interval.draw(frame, number);
    expect_plain_twin(encoder, frame);
  }
  expect_plain_twin(encoder, one.keyframe);
}

// What a simulation charges is what files take.
TEST(CountedFiles, CountWhatIsEncoded) {
  FrameEncoder encoder(kBands);
  CountedFiles files(kBands, 0.5);
  Interval real(1), counted(1);
  compositor::Frame frame(kWidth, kHeight, kBlock), counted_frame(kWidth, kHeight, kBlock);
  std::uint64_t encoded_bytes = 0;
  for (std::uint32_t number = 1; number < 4; ++number) {
    real.draw(frame, number);
    counted.draw(counted_frame, number);
    encoded_bytes += encoder.encode(frame).encoded_bytes;
    files.take(counted_frame);
  }
  EXPECT_EQ(files.made().files, 3u);
  EXPECT_EQ(files.made().encoded_bytes, encoded_bytes);
  EXPECT_LT(encoded_bytes, 2u * 4 * kWidth * kHeight) << "the background once, and bands that change";
  EXPECT_EQ(files.made().file_bytes, 3u * 2 * kWidth * kHeight);
}

TEST(FrameEncoder, EncodesTheBackgroundOnce) {
  FrameEncoder encoder(kBands);
  Interval interval(1);
  std::vector<compositor::Frame> frames(2, compositor::Frame(kWidth, kHeight, kBlock));
  std::vector<EncodedFrame> encoded;
  for (std::uint32_t number = 0; number < 2; ++number) {
    interval.draw(frames[number], number);
    encoded.push_back(encoder.encode(frames[number]));
  }
  std::size_t shared = 0;
  for (std::size_t band = 0; band < kBands.count(); ++band) shared += encoded[0].bands[band] == encoded[1].bands[band];
  EXPECT_EQ(shared, kBands.count() - 1) << "all but the mover's";
}

TEST(FrameEncoder, ForgetsBackgroundsThatNobodyShows) {
  FrameEncoder encoder(kBands);
  std::weak_ptr<const HashedBand> band;
  {
    Interval interval(1);
    band = encoder.encode(interval.keyframe).bands[2];
    EXPECT_FALSE(band.expired());
  }
  Interval next(2);
  encoder.encode(next.keyframe);
  EXPECT_TRUE(band.expired());
}

TEST(FrameEncoder, ManyThreadsGetTheSame) {
  FrameEncoder encoder(kBands);
  Interval interval(1);
  constexpr std::uint32_t kThreads = 4;
  std::vector<compositor::Frame> frames(kThreads, compositor::Frame(kWidth, kHeight, kBlock));
  std::vector<EncodedFrame> encoded(kThreads);
  for (std::uint32_t k = 0; k < kThreads; ++k) interval.draw(frames[k], 7);
  {
    std::vector<std::jthread> threads;
    for (std::uint32_t k = 0; k < kThreads; ++k)
      threads.emplace_back([&, k] { encoded[k] = encoder.encode(frames[k]); });
  }
  for (std::uint32_t k = 1; k < kThreads; ++k) {
    EXPECT_EQ(encoded[k].pixel_hash(), encoded[0].pixel_hash());
    EXPECT_EQ(encoded[k].bands[0], encoded[0].bands[0]);
  }
}

}  // namespace
}  // namespace mars::sinks
