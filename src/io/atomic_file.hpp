// Files that are complete or not there.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace springfold::io {

/// Puts `bytes` under `path`: written to a temporary name in the same folder, synchronised, renamed
/// over what was there, folder synchronised. On failure what was there stays and nothing else does.
/// @throws std::runtime_error "cannot write <path>: <reason>"
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Moves a finished file of the same file system to `to`, over what was there, as safely.
/// @throws std::runtime_error "cannot write <to>: <reason>"
void publish_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// The folder and its parents; nothing happens if it is there.
/// @throws std::runtime_error "cannot create folder <path>: <reason>"
void make_folder(const std::filesystem::path& folder);

/// All bytes of the file.
/// @throws std::runtime_error "cannot read <path>: <reason>"
std::string read_file(const std::filesystem::path& path);

}  // namespace springfold::io
