// Files that appear whole or not at all, also where the machine loses its power: written under a temporary name,
// brought to the disk, then renamed. The temporary file is always a new one: nothing that has its name, a link or a
// file that another process writes, is ever written to. Whatever goes wrong is one Failure with the system's reason,
// and the temporary file is gone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mars::document {

// What ends the temporary names; a killed process may leave such files, never others.
inline constexpr std::string_view kPartSuffix = ".part";

// For files that a person names: where `path` is a link, the file it leads to is replaced, in its own folder. Refused
// are links that lead nowhere, links of other users, and links to their files. The temporary file is beside the one
// that is replaced, named .NAME.<16 random digits>.part, and locked where the file system can lock: those that killed
// processes have left are removed.
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_whole_file(const std::filesystem::path& path, std::string_view text);
// What `produce` writes, piece by piece.
using Write = std::function<void(std::string_view piece)>;
void write_whole_file(const std::filesystem::path& path, const std::function<void(const Write&)>& produce);

// For files of a folder that MARS keeps: where `path` is a link, the link itself is replaced, for nobody has asked to
// write where it leads. `part` is the temporary file, on the same file system; where another process removes it
// meanwhile, it is written once more.
void replace_file(const std::filesystem::path& path, const std::filesystem::path& part,
                  std::span<const std::byte> bytes);
void replace_file(const std::filesystem::path& path, const std::filesystem::path& part,
                  const std::function<void(const Write&)>& produce);
using Pieces = std::vector<std::span<const std::byte>>;
void replace_file(const std::filesystem::path& path, const std::filesystem::path& part, const Pieces& pieces);

// A new file, which readers may see before it is whole; removed again where writing fails. False where its folder is
// not there. Throws Failure also where there is something of that name.
bool create_file(const std::filesystem::path& path, std::string_view text);

// Throws as writing `path` would, as far as can be known before; leaves nothing behind.
void check_can_write(const std::filesystem::path& path);

// Refuses to write `to` where it is the file `from` that is read.
void refuse_same_file(const std::filesystem::path& from, const std::filesystem::path& to);

// 16 hexadecimal digits that no other process comes to, nor can foresee.
std::string unique_word();

// Throws FileFailure("cannot <act>: <the system's reason>", path, what to do about it) for `error`, an errno.
[[noreturn]] void fail_file(const char* act, const std::filesystem::path& path, int error);

}  // namespace mars::document
