// A folder for sockets, which only this user may enter, and which is gone at its end.
#pragma once

#include <filesystem>
#include <string>

namespace mars::child {

class PrivateFolder {
 public:
  // Its name begins with `name`. It lies where a socket's address has room for `socket`, the name of a file in it.
  // Throws Failure where no folder can be made.
  PrivateFolder(const std::string& name, const std::string& socket);
  ~PrivateFolder() { remove(); }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  std::filesystem::path socket() const { return path_ / socket_; }
  void remove();

 private:
  const std::string socket_;
  std::filesystem::path path_;
};

}  // namespace mars::child
