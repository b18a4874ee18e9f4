// manifest.json: where a set of results comes from and which files belong to it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "springfold/io/results.hpp"

namespace springfold::io {

/// A file of the result set, relative to its folder, with '/' between parts.
struct ListedFile {
  std::string path{};
  std::string hash{};     ///< SHA-256 of the bytes; empty: not known or not reproducible
  std::size_t bytes = 0;  ///< 0 without hash
};

std::string manifest_text(const Case& the_case, SetState state,
                          const std::vector<ListedFile>& files);

/// Files that the manifest in `folder` lists, pending ones too; empty when there is none or it cannot
/// be read, whatever it holds. Paths
/// that would lead out of branches/ and plots/ or the folder itself are left out.
std::vector<std::string> files_listed_in(const std::filesystem::path& folder);

/// The same files with their hashes; bytes are 0.
std::vector<ListedFile> hashes_listed_in(const std::filesystem::path& folder);

/// Adds files to an existing manifest, in place of entries of the same path. Without a readable
/// manifest nothing happens.
/// @throws std::runtime_error when it cannot be written
void list_in_manifest(const std::filesystem::path& folder, const std::vector<ListedFile>& files);

/// Changes the state that an existing manifest tells, and the files that it calls pending.
/// @throws std::runtime_error when it cannot be written
void set_manifest_state(const std::filesystem::path& folder, SetState state,
                        const std::vector<std::string>& pending);

}  // namespace springfold::io
