// Encoded pieces of a video, files of a folder in the video's working folder. A piece's name is a checksum of all that
// decides its content, so that a piece that is there is the one that would be made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/videos/encoder.h"
#include "host/videos/order.h"

namespace mars::videos {

// Removes all pieces that a video's working folder has.
void remove_pieces(const std::filesystem::path& work);

class Pieces {
 public:
  // Makes the folder where it is missing. `encoding`: the words by which ffmpeg encodes. `work`: the video's working
  // folder, which the caller alone uses. Throws Failure where it cannot.
  Pieces(const Source& source, const Form& form, const Order& order, std::vector<std::string> encoding,
         const std::filesystem::path& work);
  Pieces(const Source&&, auto&&...) = delete;
  Pieces(const Pieces&) = delete;
  Pieces& operator=(const Pieces&) = delete;
  ~Pieces();  // removes the folder where it has nothing

  // Encodes those that are not there. Throws Failure where one cannot be written.
  void encode(const std::string& program, const Listener& listener);
  // A list of them all, as ffmpeg's concat takes it.
  std::filesystem::path list() const;
  // Of them all: the video is there.
  void remove();

 private:
  struct Piece {
    Span span;
    std::string name;
  };

  std::string name_of(Span span) const;
  void encode(const Piece& piece, const std::string& program, const Listener& listener, std::size_t& done);

  const Source& source_;
  const Form form_;
  const std::vector<std::string> encoding_;
  const std::filesystem::path file_;  // the video, for failures
  const std::filesystem::path folder_;
  std::vector<Piece> pieces_;
};

}  // namespace mars::videos
