// Small pictures of the library's models, as MARS renders them: made once by a rendering in the background, which gives
// way to all else, and kept in the user's cache. All calls and callbacks are on the thread that runs the io_context.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace boost::asio {
class io_context;
}

namespace mars::studio {

class Thumbnails {
 public:
  virtual ~Thumbnails() = default;

  // A model's name, and a PNG file in base64.
  using Take = std::function<void(const std::string& model, const std::string& picture)>;
  // Calls `take` for each model as soon as the pictures are there, which may be at once; never where they cannot be
  // made.
  virtual void want(Take take) = 0;
};

// `mars`: the program. `cache`: a folder, made where it is not there; "": no pictures are made.
std::unique_ptr<Thumbnails> make_thumbnails(boost::asio::io_context& context, const std::filesystem::path& mars,
                                            const std::filesystem::path& cache);

// Where the user's programs keep what they can make again, as freedesktop.org has it; "": nowhere.
std::filesystem::path thumbnail_cache();

}  // namespace mars::studio
