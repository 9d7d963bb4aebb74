#include "host/child/private_folder.h"

#include <sys/un.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/child/environment.h"

namespace mars::child {
namespace {

std::filesystem::path folder_with_room(std::size_t bytes) {
  const Environment environment = own_environment();
  const std::string usual = temporary_folder(environment);
  const std::string own = environment.value("XDG_RUNTIME_DIR").value_or("");
  std::error_code ignored;
  for (const std::string& folder : {own, usual})
    if (!folder.empty() && folder.size() + bytes < sizeof sockaddr_un::sun_path &&
        std::filesystem::is_directory(folder, ignored))
      return folder;
  return "/tmp";
}

}  // namespace

PrivateFolder::PrivateFolder(const std::string& name, const std::string& socket) : socket_(socket) {
  const std::string inside = name + "-XXXXXX";
  std::string path = folder_with_room(("/" + inside + "/" + socket).size() + 1) / inside;
  if (mkdtemp(path.data()) == nullptr)
    throw Failure(std::string("no folder can be made: ") + std::strerror(errno), path,
                  "set TMPDIR to a folder that can be written");
  path_ = path;
}

void PrivateFolder::remove() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace mars::child
