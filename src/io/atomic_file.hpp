// Files that are complete or not there.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace springfold::io {

/// Puts `bytes` under `path`: written to a temporary name in the same folder and renamed over what
/// was there. On failure what was there stays and nothing else does. A program that is killed at any
/// time leaves the old file or the new one; where the power fails within seconds, the file may be
/// empty: put_on_disk() waits for the disk, which takes milliseconds.
/// @throws std::runtime_error "cannot write <path>: <reason>"
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// The same, unless it takes too long: then what was there stays.
/// @param is_over  asked after every part; may be empty
/// @returns whether it was written
bool write_file(const std::filesystem::path& path, std::string_view bytes,
                const std::function<bool()>& is_over);

/// Moves a finished file of the same file system to `to`, over what was there, as safely.
/// @throws std::runtime_error "cannot write <to>: <reason>"
void publish_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Waits until the file and its name are on the disk.
/// @throws std::runtime_error "cannot write <path>: <reason>"
void put_on_disk(const std::filesystem::path& path);

/// The folder and its parents; nothing happens if it is there.
/// @throws std::runtime_error "cannot create folder <path>: <reason>"
void make_folder(const std::filesystem::path& folder);

/// All bytes of the file.
/// @throws std::runtime_error "cannot read <path>: <reason>"
std::string read_file(const std::filesystem::path& path);

}  // namespace springfold::io
