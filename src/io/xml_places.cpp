#include "xml_places.hpp"

#include <algorithm>
#include <vector>

namespace springfold::io {
namespace {

struct OpenTag {
  std::string name{};
  std::size_t at = 0;
};

Place place_in(const std::string& bytes, std::size_t at, const std::string& file) {
  const auto begin = bytes.begin(), here = begin + static_cast<std::ptrdiff_t>(at);
  const std::size_t line_begin = at == 0 ? std::string::npos : bytes.rfind('\n', at - 1);
  const std::size_t column = line_begin == std::string::npos ? at : at - line_begin - 1;
  return {file, static_cast<int>(std::count(begin, here, '\n')) + 1, static_cast<int>(column) + 1};
}

/// Behind the '>' of the tag at `at`; nothing where it has none.
std::optional<std::size_t> end_of_tag(const std::string& bytes, std::size_t at) {
  char quote = 0;
  for (; at < bytes.size(); ++at) {
    const char c = bytes[at];
    if (quote != 0)
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '>')
      return at + 1;
  }
  return std::nullopt;
}

/// Comments and the like: behind their end, or `at` where none begins there.
std::size_t behind_other(const std::string& bytes, std::size_t at) {
  struct Pair {
    const char *begin, *end;
  };
  for (const auto& [begin, end] :
       {Pair{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}})
    if (const std::string start{begin}; bytes.compare(at, start.size(), start) == 0) {
      const std::size_t found = bytes.find(end, at + start.size());
      return found == std::string::npos ? bytes.size() : found + std::string{end}.size();
    }
  return at;
}

std::string name_at(const std::string& bytes, std::size_t at) {
  return bytes.substr(at, std::min(bytes.find_first_of(" \t\r\n/>", at), bytes.size()) - at);
}

}  // namespace

std::optional<BrokenXml> broken_xml(const std::string& bytes, const std::string& file) {
  std::vector<OpenTag> open;
  std::size_t at = bytes.find('<');
  while (at != std::string::npos && at < bytes.size()) {
    if (const std::size_t behind = behind_other(bytes, at); behind != at) {
      at = bytes.find('<', behind);
      continue;
    }
    const bool ends = bytes.compare(at, 2, "</") == 0;
    const std::string name = name_at(bytes, at + (ends ? 2 : 1));
    const auto behind = end_of_tag(bytes, at);
    if (!behind) return BrokenXml{place_in(bytes, at, file), "the tag <" + name + " has no >"};
    if (ends && (open.empty() || open.back().name != name))
      return BrokenXml{place_in(bytes, at, file),
                       "got the end of <" + name + ">" +
                           (open.empty() ? ", which has not begun"
                                         : ", need that of <" + open.back().name + "> first")};
    if (ends)
      open.pop_back();
    else if (bytes[*behind - 2] != '/')
      open.push_back({name, at});
    at = bytes.find('<', *behind);
  }
  if (open.empty()) return std::nullopt;
  return BrokenXml{place_in(bytes, open.back().at, file), "<" + open.back().name + "> has no end"};
}

std::map<std::pair<std::string, std::string>, int> unread_elements(
    const std::string& bytes,
    const std::function<XmlUse(const std::string& around, const std::string& name)>& use) {
  std::map<std::pair<std::string, std::string>, int> unread;
  std::vector<std::string> open;
  std::size_t closed_within = std::string::npos;  // depth of what is not looked into
  for (std::size_t at = bytes.find('<'); at < bytes.size();) {
    if (const std::size_t behind = behind_other(bytes, at); behind != at) {
      at = bytes.find('<', behind);
      continue;
    }
    const auto behind = end_of_tag(bytes, at);
    if (!behind) break;
    if (bytes.compare(at, 2, "</") == 0) {
      if (!open.empty()) open.pop_back();
      if (open.size() <= closed_within) closed_within = std::string::npos;
    } else {
      const std::string name = name_at(bytes, at + 1);
      const bool is_open = bytes[*behind - 2] != '/';
      if (closed_within == std::string::npos) {
        const std::string around = open.empty() ? "" : open.back();
        const XmlUse found = use(around, name);
        if (found == XmlUse::unread) ++unread[{around, name}];
        if (found != XmlUse::read && is_open) closed_within = open.size();
      }
      if (is_open) open.push_back(name);
    }
    at = bytes.find('<', *behind);
  }
  return unread;
}

}  // namespace springfold::io
