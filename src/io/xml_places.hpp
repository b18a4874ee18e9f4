// Where a text is no XML: the parser of robots does not say it. Private to io.
#pragma once

#include <optional>
#include <string>

#include "problems.hpp"

namespace springfold::io {

/// An end tag that ends nothing or another element, or the first tag that is never ended.
struct BrokenXml {
  Place place{};
  std::string what{};  ///< in words
};

/// Looks at tags alone; comments, declarations and texts in quotes are passed over.
/// @returns nothing where all tags fit
std::optional<BrokenXml> broken_xml(const std::string& bytes, const std::string& file);

}  // namespace springfold::io
