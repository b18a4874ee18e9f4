#include "undated.hpp"

#include <string_view>

#include "atomic_file.hpp"

namespace springfold::io {

std::string undated_pdf(std::string bytes) {
  for (const std::string_view key : {"/CreationDate (", "/ModDate ("})
    for (std::size_t at = bytes.find(key); at != std::string::npos; at = bytes.find(key, at + 1)) {
      const std::size_t end = bytes.find_first_not_of("D:0123456789+-Z'", at + key.size());
      if (end != std::string::npos && bytes[end] == ')')
        bytes.replace(at, end + 1 - at, end + 1 - at, ' ');
    }
  return bytes;
}

std::string undated_tex(std::string text) {
  const std::size_t made = text.find("%% generated with GNUPLOT");
  const std::size_t begin = made == std::string::npos ? made : text.find('\n', made);
  if (begin == std::string::npos || text.compare(begin + 1, 3, "%% ") != 0) return text;
  const std::size_t end = text.find('\n', begin + 1);
  if (end != std::string::npos) text.erase(begin, end - begin);
  return text;
}

std::string valid_svg(std::string text) {
  constexpr std::string_view opens = "<![CDATA[", closes = "]]>", escaped = "]]&gt;";
  std::size_t at = 0;
  while ((at = text.find(closes, at)) != std::string::npos) {
    const std::size_t before = at == 0 ? std::string::npos : text.rfind(opens, at - 1);
    const std::size_t last = at == 0 ? std::string::npos : text.rfind(closes, at - 1);
    const bool is_inside =
        before != std::string::npos && (last == std::string::npos || last < before || last == at);
    if (is_inside) {
      at += closes.size();
    } else {
      text.replace(at, closes.size(), escaped);
      at += escaped.size();
    }
  }
  return text;
}

void finish_picture(const std::filesystem::path& picture) {
  const std::string ending = picture.extension().string();
  if (ending != ".pdf" && ending != ".tex" && ending != ".svg") return;
  const std::string bytes = read_file(picture);
  const std::string finished = ending == ".pdf"   ? undated_pdf(bytes)
                               : ending == ".tex" ? undated_tex(bytes)
                                                  : valid_svg(bytes);
  if (finished != bytes) write_file(picture, finished);
}

}  // namespace springfold::io
