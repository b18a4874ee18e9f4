// What the parser of robots does not say: where a text is no XML, and which elements it passed over. Private to io.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

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

/// How a reader treats an element: it reads it, it knows the whole with all that stands in it, or it passes it over.
enum class XmlUse { read, whole, unread };

/// Counts the elements that are passed over: the outermost of each, not those within.
/// @param use  by the names of the element around it (empty: none) and of its own
/// @returns by the same two names. @pre all tags fit
std::map<std::pair<std::string, std::string>, int> unread_elements(
    const std::string& bytes,
    const std::function<XmlUse(const std::string& around, const std::string& name)>& use);

}  // namespace springfold::io
