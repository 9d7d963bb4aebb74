// A crowd of at least 100,000 control points, all of it moving, previewed on one core: for each representation and each
// kind of terminal the processor time of a frame, from the matrices to the bytes that a terminal would be sent.
#include <sched.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "hal/failure/explain.h"
#include "host/content/animator/reading/read_film.h"
#include "host/preview/film_drawing.h"
#include "host/preview/terminal_picture.h"
#include "host/preview/wireframe.h"

namespace {

using namespace mars;

constexpr std::size_t kWantedPoints = 100'000;
constexpr std::uint32_t kFrames = 48;
constexpr int kRounds = 3;

std::size_t points_of(const preview::Wireframe& wireframe) {
  std::size_t points = 0;
  for (const preview::Part& part : wireframe.parts[static_cast<std::size_t>(preview::As::vertices)])
    points += wireframe.lines[part.lines].points.size() / 3;
  return points;
}

// Figures in rows of five, each bowing and turning on its place.
preview::Wireframe crowd(int figures) {
  std::string actors;
  for (int i = 0; i < figures; ++i) {
    char text[400];
    std::snprintf(text, sizeof text,
                  "%s{\"name\": \"%d\", \"model\": \"human\", \"place\": [%d, %d, 0], \"keys\": ["
                  "{\"frame\": 0, \"turn\": [0, 0, 0], \"pose\": {\"spine\": [0, 0, 0]}},"
                  "{\"frame\": %u, \"turn\": [0, 0, 170], \"pose\": {\"spine\": [0, 30, 0]}}]}",
                  i == 0 ? "" : ", ", i, 3 * (i / 5), 2 * (i % 5) - 4, kFrames);
    actors += text;
  }
  const std::string json =
      "{\"frames\": " + std::to_string(kFrames) +
      ", \"size\": [960, 540], \"camera\": {\"eye\": [-11, -1, 5], \"at\": [4, 0, 1.6], \"fov\": 40},"
      "\"models\": {\"human\": \"models/human.json\"}, \"actors\": [" +
      actors + "]}";
  const animator::Film film = animator::read_film(document::Document(json, "crowd").root(), MARS_EXAMPLES);
  return preview::wireframe_of(film::compile(film), &film);
}

double processor_milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

struct Result {
  double draw = 0, encode = 0;  // milliseconds a frame
  std::size_t bytes = 0;        // a frame
};

// The round of least time.
Result measure(const preview::Wireframe& wireframe, preview::As as, images::PictureSize extent,
               preview::Graphics graphics) {
  const bool blocks = graphics == preview::Graphics::blocks;
  const std::uint32_t pen = blocks ? 2 : 1;
  const preview::FilmDrawing lines(wireframe);
  preview::Drawing drawing(pen * extent.width, pen * extent.height);
  Result best;
  for (int round = 0; round < kRounds; ++round) {
    const auto terminal = make_terminal_picture(graphics);
    Result now;
    for (std::uint32_t frame = 0; frame < wireframe.frames; ++frame) {
      const double begun = processor_milliseconds();
      lines.draw(drawing, as, frame, wireframe.camera_at(frame), pen, true);
      const images::Image image = blocks ? preview::halved(drawing.image()) : drawing.image();
      const double drawn = processor_milliseconds();
      now.bytes += terminal->shown(image).size() / wireframe.frames;
      now.draw += (drawn - begun) / wireframe.frames;
      now.encode += (processor_milliseconds() - drawn) / wireframe.frames;
    }
    if (round == 0 || now.draw + now.encode < best.draw + best.encode) best = now;
  }
  return best;
}

void run() {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  sched_setaffinity(0, sizeof one, &one);
  const std::size_t of_one = points_of(crowd(1));
  const double begun = processor_milliseconds();
  const preview::Wireframe wireframe = crowd(static_cast<int>((kWantedPoints + of_one - 1) / of_one));
  std::printf("%zu control points, %zu segments, %u frames; compiled and made ready in %.0f ms\n\n",
              points_of(wireframe), wireframe.parts[1].size(), wireframe.frames, processor_milliseconds() - begun);
  std::printf("%-10s %-8s %-9s %9s %9s %9s %10s\n", "shown as", "on", "pixels", "draw ms", "encode ms", "frames/s",
              "kB a frame");
  const std::map<preview::As, const char*> shown{
      {preview::As::stick, "stick"}, {preview::As::vertices, "vertices"}, {preview::As::prisms, "prisms"}};
  const std::map<preview::Graphics, const char*> terminals{
      {preview::Graphics::kitty, "kitty"}, {preview::Graphics::sixel, "sixel"}, {preview::Graphics::blocks, "blocks"}};
  for (const auto& [as, as_name] : shown)
    for (const auto& [graphics, name] : terminals) {
      const images::PictureSize extent =
          graphics == preview::Graphics::blocks ? images::PictureSize{160, 90} : images::PictureSize{960, 540};
      const Result result = measure(wireframe, as, extent, graphics);
      const std::string pixels = std::to_string(extent.width) + "x" + std::to_string(extent.height);
      std::printf("%-10s %-8s %-9s %9.2f %9.2f %9.0f %10.1f\n", as_name, name, pixels.c_str(), result.draw,
                  result.encode, 1e3 / (result.draw + result.encode), 1e-3 * double(result.bytes));
    }
}

}  // namespace

int main(int argc, char**) {
  if (argc > 1) {
    std::cout << "mars bench preview: processor time of a frame on one core; it takes no options\n";
    return 0;
  }
  try {
    run();
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "bench-preview: " << reason_of(failure) << '\n';
    return 1;
  }
}
