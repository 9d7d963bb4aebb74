// What every competitor of the benchmark does on its standard input, one order a line, one answer a line:
//   (start)          "ready TEXT"  the scene is loaded; TEXT: what it reports about itself
//   go N             "ms T"        renders N frames one after another, each until its last pixel is in memory;
//                                  T milliseconds a frame
//   picture FILE     "done"        writes the last frame as a PPM file
//   cost             "cost JSON"   measures what shadows cost; of peers that draw them only
//   (end of input)                 ends
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace mars::bench {

struct Picture {
  std::uint32_t width, height;
  // Rows from the top; red in the lowest byte, then green and blue.
  std::span<const std::uint32_t> pixels;
};

void write_ppm(const Picture& picture, const std::string& path);

// What a part of a frame costs.
struct Cost {
  std::string what, unit;
  double amount;
  std::string note;
};

// The word that tells a peer the tangent of half the angle that the sun takes up in the sky: 0 is a point, "none" means
// that nothing casts a shadow.
std::optional<float> sun_of(const std::string& word);

// The orders as they come, for a competitor that is asked what to do next.
class Orders {
 public:
  explicit Orders(std::function<Picture()> last_picture, std::function<Cost()> cost = {})
      : last_picture_(std::move(last_picture)), cost_(std::move(cost)) {}

  void send_ready(const std::string& text) const;
  // Draws pictures where they are wanted; frames of the next "go", none at the end of input. Throws
  // std::runtime_error for an order it does not know.
  std::optional<int> next_go() const;
  void send_milliseconds(double a_frame) const;

 private:
  std::function<Picture()> last_picture_;
  std::function<Cost()> cost_;
};

struct Competitor {
  std::string ready;             // one line
  std::function<void()> render;  // the next frame
  std::function<Picture()> last_picture;
  std::function<Cost()> cost;
};

// Obeys until the input ends.
void obey(const Competitor& competitor);

// A competitor's main: its exit code after `run`, whose failure is printed with its `name`.
int main_of(const char* name, const std::function<void()>& run);

inline double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace mars::bench
