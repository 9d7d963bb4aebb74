#include "tests/bench/peers/peer.h"

#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace mars::bench {
namespace {

double render(const Competitor& competitor, int frames) {
  const auto start = std::chrono::steady_clock::now();
  for (int frame = 0; frame < frames; ++frame) competitor.render();
  return milliseconds_since(start) / frames;
}

std::string json_of(const Cost& cost) {
  std::ostringstream text;
  text << R"({"what": ")" << cost.what << R"(", "unit": ")" << cost.unit << R"(", "amount": )" << cost.amount
       << R"(, "note": ")" << cost.note << "\"}";
  return text.str();
}

}  // namespace

std::optional<float> sun_of(const std::string& word) {
  if (word == "none") return {};
  return std::stof(word);
}

void write_ppm(const Picture& picture, const std::string& path) {
  std::vector<char> bytes;
  bytes.reserve(std::size_t{3} * picture.pixels.size());
  for (const std::uint32_t pixel : picture.pixels)
    for (int shift = 0; shift < 24; shift += 8) bytes.push_back(static_cast<char>(pixel >> shift & 255));
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << picture.width << ' ' << picture.height << "\n255\n";
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

void Orders::send_ready(const std::string& text) const { std::cout << "ready " << text << std::endl; }

void Orders::send_milliseconds(double a_frame) const { std::cout << "ms " << a_frame << std::endl; }

std::optional<int> Orders::next_go() const {
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string order, argument;
    words >> order >> argument;
    if (order == "go") return std::stoi(argument);
    if (order == "picture") {
      write_ppm(last_picture_(), argument);
      std::cout << "done" << std::endl;
    } else if (order == "cost" && cost_) {
      std::cout << "cost " << json_of(cost_()) << std::endl;
    } else {
      throw std::runtime_error("unknown order: " + line);
    }
  }
  return {};
}

void obey(const Competitor& competitor) {
  const Orders orders(competitor.last_picture, competitor.cost);
  orders.send_ready(competitor.ready);
  while (const auto frames = orders.next_go()) orders.send_milliseconds(render(competitor, *frames));
}

int main_of(const char* name, const std::function<void()>& run) {
  try {
    run();
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << name << ": " << failure.what() << '\n';
    return 1;
  }
}

}  // namespace mars::bench
