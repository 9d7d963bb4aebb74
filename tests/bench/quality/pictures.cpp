// What the benchmark of quality does with pictures: PNG files, and PPM files as competitors write them.
//
//   bench-pictures rms ONE OTHER              root of the mean square difference of levels, of 255
//   bench-pictures shrink N coded|linear IN OUT   averages boxes of N x N pixels: levels as they are, or the light that
//                                             sRGB encodes, encoded again
//   bench-pictures light FILE ...             the mean light of each picture, 0..1
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure/explain.h"
#include "host/images/picture_file.h"

namespace mars::bench {
namespace {

using images::Image;

Image read_ppm(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  Image image;
  int most = 0;
  file >> magic >> image.width >> image.height >> most;
  file.get();
  image.pixels.resize(file ? std::size_t{image.width} * image.height : 0);
  for (std::uint32_t& pixel : image.pixels)
    for (int shift = 0; shift < 24; shift += 8) pixel |= static_cast<std::uint32_t>(file.get()) << shift;
  if (!file || magic != "P6" || most != 255) throw std::runtime_error(path + ": not a whole PPM picture");
  return image;
}

Image read_picture(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".ppm") return read_ppm(path);
  return images::read_picture(images::PictureFormat::png, path);
}

int level(std::uint32_t pixel, int channel) { return static_cast<int>(pixel >> (8 * channel) & 255); }

double rms(const Image& one, const Image& other) {
  if (one.width != other.width || one.height != other.height) throw std::runtime_error("the pictures differ in size");
  double squares = 0;
  for (std::size_t k = 0; k < one.pixels.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const double difference = level(one.pixels[k], c) - level(other.pixels[k], c);
      squares += difference * difference;
    }
  return std::sqrt(squares / (3.0 * static_cast<double>(one.pixels.size())));
}

// IEC 61966-2-1.
double light_of(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
double encoded(double light) { return light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

std::vector<double> lights_of_levels(bool linear) {
  std::vector<double> lights(256);
  for (int k = 0; k < 256; ++k) lights[static_cast<std::size_t>(k)] = linear ? light_of(k / 255.0) : k / 255.0;
  return lights;
}

Image shrink(const Image& image, std::uint32_t n, bool linear) {
  if (n == 0 || image.width % n != 0 || image.height % n != 0)
    throw std::runtime_error("the picture's sides are no multiples of the box's");
  const std::vector<double> lights = lights_of_levels(linear);
  const Image small{image.width / n, image.height / n, {}};
  std::vector<double> sums(std::size_t{3} * small.width * small.height);
  for (std::size_t k = 0; k < image.pixels.size(); ++k) {
    const std::size_t box = k / image.width / n * small.width + k % image.width / n;
    for (int c = 0; c < 3; ++c)
      sums[3 * box + static_cast<std::size_t>(c)] += lights[static_cast<std::size_t>(level(image.pixels[k], c))];
  }
  Image out{small.width, small.height, std::vector<std::uint32_t>(sums.size() / 3)};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double mean = sums[k] / n / n;
    const auto whole = static_cast<std::uint32_t>((linear ? encoded(mean) : mean) * 255 + 0.5);
    out.pixels[k / 3] |= whole << (8 * (k % 3));
  }
  return out;
}

double mean_light(const Image& image) {
  const std::vector<double> lights = lights_of_levels(true);
  double sum = 0;
  for (const std::uint32_t pixel : image.pixels)
    for (int c = 0; c < 3; ++c) sum += lights[static_cast<std::size_t>(level(pixel, c))];
  return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

void write_png(const Image& image, const std::string& path) {
  const std::vector<std::byte> bytes =
      images::encode_picture(images::PictureFormat::png, image.width, image.height, image.pixels);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

void run(std::span<const std::string> words) {
  if (words.size() == 3 && words[0] == "rms") {
    std::cout << rms(read_picture(words[1]), read_picture(words[2])) << '\n';
  } else if (words.size() == 5 && words[0] == "shrink") {
    const auto n = static_cast<std::uint32_t>(std::stoul(words[1]));
    write_png(shrink(read_picture(words[3]), n, words[2] == "linear"), words[4]);
  } else if (words.size() > 1 && words[0] == "light") {
    std::cout.precision(9);
    for (const std::string& file : words.subspan(1)) std::cout << mean_light(read_picture(file)) << '\n';
  } else {
    throw std::runtime_error("usage: bench-pictures rms ONE OTHER | shrink N coded|linear IN OUT | light FILE ...");
  }
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  try {
    mars::bench::run(std::vector<std::string>(argv + 1, argv + argc));
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "bench-pictures: " << mars::reason_of(failure) << '\n';
    return 1;
  }
}
