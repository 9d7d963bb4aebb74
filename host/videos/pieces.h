// Encoded pieces of a video, files of a folder. A piece's name is a checksum of all that decides its content, so that a
// piece that is there is the one that would be made.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/content/document/folder_lock.h"
#include "host/videos/encoder.h"
#include "host/videos/order.h"

namespace mars::videos {

// The folder of a video's pieces.
std::filesystem::path pieces_folder(const std::filesystem::path& file);

class Pieces {
 public:
  // Makes the folder where it is missing, and waits until no other process makes pieces there, which `listener` learns.
  // `encoding`: the words by which ffmpeg encodes. Throws Failure where it cannot.
  Pieces(const Source& source, const Form& form, const Order& order, std::vector<std::string> encoding,
         const Listener& listener);
  Pieces(const Pieces&) = delete;
  Pieces& operator=(const Pieces&) = delete;
  ~Pieces();  // removes the folder where it has nothing

  // For another process, which may have made the video.
  bool waited() const { return waited_; }
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

  void enter(const Listener& listener);
  std::string name_of(Span span) const;
  void encode(const Piece& piece, const std::string& program, const Listener& listener, std::size_t& done);
  void remove_all_but_these() const;

  const Source& source_;
  const Form form_;
  const std::vector<std::string> encoding_;
  const std::filesystem::path file_;  // the video, for failures
  const std::filesystem::path folder_;
  std::optional<document::FolderLock> lock_;
  bool waited_ = false;
  std::vector<Piece> pieces_;
};

}  // namespace mars::videos
